// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Engines with two or three axes and the engine of their laws: the twin, or RTL and twin in
// lock-step. Documentation: docs/architecture.md
#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <memory>
#include <string>
#include <vector>

#include "engine.hpp"

namespace feltgate {

constexpr std::size_t most_axes = 3;

/// The snapshots of all axes in one tick; axis 0 holds the information about the law.
using AxesSnapshot = std::array<Snapshot, most_axes>;

/// Common interface of these engines; holds the queues of writes and pin events.
class AxesCores {
 public:
  using Pins = std::array<EncoderPins, most_axes>;
  using Edges = std::array<std::deque<EncoderEvent>, most_axes>;

  virtual ~AxesCores() = default;
  const DesignInfo& design() const { return info_; }
  int axes() const { return axes_; }

  /// Power-up and reset; `seed` fills the state that reset does not define.
  virtual void reset(std::uint64_t seed, const Pins& pins) = 0;
  /// Queues a register write; one is executed per tick, in order.
  void write(int address, std::uint32_t data) {
    writes_.emplace_back(static_cast<std::uint16_t>(address), data);
  }
  bool writes_wait() const { return !writes_.empty(); }
  void stop(bool pressed) { stop_ = pressed; }
  /// Adds a pin event of an axis; events must be in order and not before now().
  void edge(std::size_t axis, const EncoderEvent& event) { edges_[axis].push_back(event); }

  /// Advances `clocks` clocks from now().
  virtual void advance(Clock clocks) = 0;
  Clock now() const { return now_; }
  /// Snapshots that became valid during the last advance().
  const std::vector<AxesSnapshot>& snapshots() const { return snapshots_; }
  /// Duty in force in a bridge, in clocks of the PWM period, and whether its gates are enabled.
  virtual int duty(std::size_t axis) const = 0;
  virtual bool gates_enabled(std::size_t axis) const = 0;

  /// Writes a waveform of the clocks [from, to] of the next run; call it before reset(). Errors:
  /// std::invalid_argument for an engine without RTL.
  virtual void trace(const std::string& path, Clock from, Clock to) = 0;

  /// Lock-step: number of clocks in which an output differed, and the first difference.
  std::int64_t mismatches() const { return mismatches_; }
  const std::string& first_mismatch() const { return first_mismatch_; }
  Clock first_mismatch_clock() const { return first_mismatch_clock_; }

 protected:
  AxesCores(DesignInfo info, int axes) : info_(std::move(info)), axes_(axes) {}

  DesignInfo info_;
  int axes_;
  std::deque<std::pair<std::uint16_t, std::uint32_t>> writes_;
  Edges edges_;
  Pins pins_{};
  bool stop_ = false;
  Clock now_ = 0;
  std::vector<AxesSnapshot> snapshots_;
  std::int64_t mismatches_ = 0;
  std::string first_mismatch_;
  Clock first_mismatch_clock_ = 0;
};

/// The engines of a design with several axes: "twin" and "lockstep".
struct AxesDesignMakers {
  std::string name;
  std::unique_ptr<AxesCores> (*cores)(const std::string& kind);
  DesignInfo (*info)();
};
/// Registers a design; call it before main().
void add_axes_design(const AxesDesignMakers& design);
/// nullptr if the program does not contain the design.
const AxesDesignMakers* find_axes_design(const std::string& design);

}  // namespace feltgate
