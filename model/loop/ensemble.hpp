// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// A core with its riders: queues register writes for all of them alike and collects their errors
// against the most exact of them. Used by closed loop and replay. Documentation:
// docs/architecture.md
#pragma once

#include <deque>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "bounds/coverage.hpp"
#include "engines/sampled_watch.hpp"
#include "feltgate/while_armed.hpp"
#include "loop/loop.hpp"
#include "loop/scene_law.hpp"

namespace feltgate {

/// A waveform to be written: the clocks [from, to] into `path`; to < 0: to the end; no path: none.
struct Waveform {
  std::string path;
  Clock from = 0, to = -1;
};

class Ensemble {
 public:
  Ensemble(const std::string& design, const EngineChoice& choice, std::uint64_t seed,
           EncoderPins pins, const Waveform& waveform);

  Engine& lead() { return *lead_; }
  const Engine& lead_const() const { return *lead_; }
  const DesignInfo& design() const { return *design_; }

  /// Loads a law into the engine of laws, and has the riders run it; once, before the first
  /// advance(). It must outlive this.
  void run_law(SceneLaw& law);
  /// Looks into the law that run_law() has loaded; nullptr: nobody does.
  void watch_law(std::unique_ptr<LawWatch> watch) { watch_ = std::move(watch); }
  /// A parameter of the law or of the design in its unit, for every engine; takes effect with the
  /// same tick in all.
  /// Throws std::invalid_argument for an unknown name or a value that does not fit.
  void set_parameter(const std::string& name, double value) { set_parameters({{name, value}}); }
  /// Those of the law come into force together.
  void set_parameters(const std::map<std::string, double>& values);
  /// Values of the law alone, by one commit; none: what stands is committed anew.
  void feed_law(const std::map<std::string, double>& values);
  /// Switches off the self-test of a design that has it on from power-up: what is rendered then
  /// begins with arming, as recordings and scenes ask for. `self_test_pulse` switches it on again.
  void skip_self_test();
  void set_control(int scene, int mode, bool arm);
  void command(std::uint32_t bits);
  /// Register writes wait for their ticks.
  bool writes_wait() const { return !pending_.empty(); }
  /// Appends every later write to `log`.
  void note_writes(std::vector<HostWrite>* log) { log_ = log; }
  /// From the next tick on errors are also collected apart for the ticks that this covers.
  void cover(const bounds::Coverage* coverage) {
    covers_ = coverage != nullptr;
    if (covers_) coverage_ = *coverage;
  }
  /// A chain of the caller that sees the same samples and writes; none: nullptr.
  void carry(RealChain* passenger) { passenger_ = passenger; }
  void set_panel(const Panel& panel) { lead_->set_panel(panel); }

  /// Runs the core, then the riders on each new snapshot; `each` sees every snapshot.
  template <class Each>
  void advance(Clock clocks, const EncoderEvent* first, const EncoderEvent* last, Each&& each) {
    lead_watch_.time([&] { lead_->advance(clocks, first, last); });
    for (const Snapshot& s : lead_->snapshots()) {
      ride(s);
      each(s);
    }
  }

  /// What the engine that drives the motor says in the tick of `s`, but for voltage and duty, which
  /// only a row of output needs: fill().
  void signals(EngineSignals& e, const Snapshot& s) const {
    if (choice_.rider_drives) {
      e = of_chain(riders_[0].chain->out());
      return;
    }
    e.velocity_rad_s = velocity_rad_s(s);
    e.tau_ref_nm = torque_nm(s.tau_ref);
    e.tau_hat_nm = torque_nm(s.tau_hat);
    e.current_a = current_a(s);
    e.torque_nm = design().torque_constant_nm_a * e.current_a;
  }
  /// Whether the torque is none for a mailbox of the law that is too old; the RTL alone does not
  /// tell.
  bool stale(const Snapshot& s) const { return s.law_stale && s.armed && renders_law(s); }
  /// Position, limits, faults and the signals of every engine in the tick of `s`.
  void fill(Row& row, const Snapshot& s) const;
  const EngineChoice& choice() const { return choice_; }
  const RealChain* rider(std::size_t i) const { return riders_[i].chain.get(); }
  std::size_t rider_count() const { return riders_.size(); }

  double velocity_rad_s(const Snapshot& s) const {
    return static_cast<double>(s.velocity) * unit_.velocity_rad_s;
  }
  double torque_nm(std::int64_t raw) const { return static_cast<double>(raw) * unit_.torque_nm; }
  double current_a(const Snapshot& s) const {
    return static_cast<double>(s.current_ref) * unit_.current_a;
  }
  double voltage_v(const Snapshot& s) const {
    return static_cast<double>(s.voltage) * unit_.voltage_v;
  }

  /// Largest |N-method velocity| before its low-pass that the riders saw, rad/s.
  double largest_velocity_rad_s() const { return largest_counts_ * design().rad_s_per_count; }

  /// Error and speed figures of all engines, steps left empty.
  std::vector<EngineFigures> figures() const;

 private:
  struct Rider {
    std::unique_ptr<RealChain> chain;
    std::unique_ptr<LawRider> law;  ///< of a scene with a law
    EngineFigures figures;
    SampledWatch watch;
  };
  /// What the last bit of a signal means: powers of two, so that the product is exact.
  struct Units {
    double velocity_rad_s = 0, torque_nm = 0, current_a = 0, voltage_v = 0;
  };

  bool renders_law(const Snapshot& s) const {
    return law_ != nullptr && design().scene_number("law") == s.scene;
  }
  EngineSignals of_core(const Snapshot& s) const;
  EngineSignals of_chain(const ChainOut& o) const;
  void write(HostWrite w);
  void ride(const Snapshot& s);
  void follow_law(Rider& r, const Snapshot& s) const;
  void watch_velocity(std::int16_t travel);
  void check_coverage(const Snapshot& s);
  void compare(EngineFigures& f, double velocity_rad_s, double tau_hat_nm, double current_a);

  EngineChoice choice_;
  std::unique_ptr<Engine> lead_;
  const DesignInfo* design_;
  Units unit_;
  std::vector<Rider> riders_;
  const RealChain* reference_ = nullptr;
  RealChain* passenger_ = nullptr;
  bounds::Coverage coverage_;
  bool covers_ = false;
  std::deque<std::int16_t> window_;  ///< travel of the last m1 ticks
  int largest_counts_ = 0;
  SceneLaw* law_ = nullptr;
  std::unique_ptr<LawWatch> watch_;
  std::int64_t law_changes_ = 1;  ///< sets of parameters that the riders know; the first loads
  bool law_entered_ = false;
  std::deque<HostWrite> pending_;
  std::vector<HostWrite>* log_ = nullptr;
  HostBeside host_;
  std::int64_t writes_applied_ = 0;
  EngineFigures lead_figures_;
  SampledWatch lead_watch_;
};

}  // namespace feltgate
