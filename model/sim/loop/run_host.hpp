// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The host of a run: it owns the engine, of one axis or several, and turns names and values into
// register writes. Documentation: docs/architecture.md
#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "../backends/backend.hpp"
#include "../reference/real_chain.hpp"
#include "feltgate/axes_ports.hpp"
#include "feltgate/while_armed.hpp"
#include "scene_law.hpp"

namespace feltgate {

/// A register write of the host: the word for fixed point, the value for real arithmetic.
struct HostWrite {
  Clock clock = 0;  ///< when it was queued; one write is executed per tick
  int address = 0;
  std::uint32_t data = 0;
  double value = 0;  ///< in the parameter's unit; 0 for control and command words
};

class RunHost {
 public:
  explicit RunHost(std::unique_ptr<AnyBackend> backend)
      : backend_(std::move(backend)),
        design_(&backend_->design()),
        beside_(static_cast<std::size_t>(backend_->axes()), HostBeside(design_->control_reset)) {}
  virtual ~RunHost() = default;
  RunHost(RunHost&&) = default;
  RunHost& operator=(RunHost&&) = default;

  AnyBackend& backend() { return *backend_; }
  const DesignInfo& design() const { return *design_; }

  /// Loads a law into the engine of laws. Call it once, before the first clock that matters. The
  /// law must outlive this object.
  void load(SceneLaw& law);
  /// Sets a parameter of the law or the design, in its unit, in all axes and riders. Errors:
  /// std::invalid_argument for an unknown name or a value that does not fit.
  void set_parameter(const std::string& name, double value) { set_parameters({{name, value}}); }
  /// The same for several; those of the law come into force together.
  void set_parameters(const std::map<std::string, double>& values);
  /// Sets parameters of the law only, with one commit; empty: commits the present values again.
  void feed_law(const std::map<std::string, double>& values);
  /// Switches off the self-test of a design that has it on from power-up, so that the scene begins
  /// with arming, as recordings and scenes expect. The parameter `self_test_pulse` switches it on
  /// again.
  void skip_self_test();
  /// Queues a control word: the host has control, with this scene, mode and request to arm.
  void set_control(int scene, int mode, bool arm);
  /// Queues a command word.
  void command(std::uint32_t bits);

  /// Whether the cores render the law of this run in the tick of `s`, of axis 0; and are armed.
  bool renders_law(const Snapshot& s) const { return s.scene == law_scene_; }
  bool in_law(const Snapshot& s) const { return s.armed && renders_law(s); }
  /// Whether the torque is 0 because a mailbox of the law is too old; the RTL alone does not show
  /// it.
  bool stale(const Snapshot& s) const { return s.law_stale && in_law(s); }

  /// Whether register writes wait for their ticks.
  bool writes_wait() const { return !pending_.empty(); }
  /// The inputs of the cores' chains in a tick, from the snapshots of all axes; call it for every
  /// tick. Before, `each(axis, write)` gets the writes of parameters that act from this tick on.
  template <class Each>
  std::array<ChainIn, most_axes> chain_inputs(const Snapshot* axes, Each&& each) {
    for (; writes_applied_ < axes[0].writes && !pending_.empty(); ++writes_applied_) {
      const auto [axis, w] = pending_.front();
      pending_.pop_front();
      if (w.address >= axes_engine) continue;
      if (beside_[axis].write(w.address, w.data, axes[axis].armed)) each(axis, w);
    }
    std::array<ChainIn, most_axes> in;
    for (std::size_t n = 0; n < beside_.size(); ++n) {
      const Snapshot& s = axes[n];
      const bool restart =
          beside_[n].restart(s.armed, s.scene) || (axes[0].law_restart && renders_law(s));
      in[n] = {s.position,          s.travel, s.armed, s.scene, beside_[n].mode(), restart,
               relief_of(s.limits), s.current};
    }
    return in;
  }

 protected:
  /// Queues a write in every axis, or in the engine of laws.
  virtual void write(const HostWrite& w);

 private:
  std::unique_ptr<AnyBackend> backend_;
  const DesignInfo* design_;
  std::vector<HostBeside> beside_;                         ///< one per axis
  std::deque<std::pair<std::size_t, HostWrite>> pending_;  ///< with their axes
  std::int64_t writes_applied_ = 0;
  SceneLaw* law_ = nullptr;
  int law_scene_ = -1;  ///< -1: there is no law
};

}  // namespace feltgate
