// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Two or three axes with the engine of their laws that can be run: the twin, or RTL and twin in
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

/// The snapshots of all axes of one tick; what they say of the law is in that of axis 0.
using AxesSnapshot = std::array<Snapshot, most_axes>;

class AxesCores {
 public:
  using Pins = std::array<EncoderPins, most_axes>;
  using Edges = std::array<std::deque<EncoderEvent>, most_axes>;

  virtual ~AxesCores() = default;
  const DesignInfo& design() const { return info_; }
  int axes() const { return axes_; }

  /// Power-up and reset; `seed` fills what reset leaves open.
  virtual void reset(std::uint64_t seed, const Pins& pins) = 0;
  /// Queues a register write; one is carried out per tick, in order.
  void write(int address, std::uint32_t data) {
    writes_.emplace_back(static_cast<std::uint16_t>(address), data);
  }
  bool writes_wait() const { return !writes_.empty(); }
  void stop(bool pressed) { stop_ = pressed; }
  /// A pin event of an axis, in order, not before now().
  void edge(std::size_t axis, const EncoderEvent& event) { edges_[axis].push_back(event); }

  /// Runs `clocks` clocks from now().
  virtual void advance(Clock clocks) = 0;
  Clock now() const { return now_; }
  /// Shown during the last advance().
  const std::vector<AxesSnapshot>& snapshots() const { return snapshots_; }
  /// Duty in force in a bridge, in clocks of the PWM period, and whether its gates are open.
  virtual int duty(std::size_t axis) const = 0;
  virtual bool gates_enabled(std::size_t axis) const = 0;

  /// Writes a waveform of the clocks [from, to] of the next run; before reset(). Throws
  /// std::invalid_argument where there is no RTL to look into.
  virtual void trace(const std::string& path, Clock from, Clock to) = 0;

  /// Lock-step: number of clocks in which any output differed, and the first difference.
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

/// A design of several axes that a program has: makes the kinds "twin" and "lockstep".
struct AxesDesignMakers {
  std::string name;
  std::unique_ptr<AxesCores> (*cores)(const std::string& kind);
  DesignInfo (*info)();
};
/// Before main().
void add_axes_design(const AxesDesignMakers& design);
/// nullptr where this program has no such design.
const AxesDesignMakers* find_axes_design(const std::string& design);

}  // namespace feltgate
