// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Engines with two or three axes and the engine of their laws: the twin, or RTL and twin in
// lock-step. Documentation: docs/architecture.md
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "backend.hpp"
#include "input_queues.hpp"

namespace feltgate {

/// The snapshots of all axes in one tick; axis 0 holds the information about the law.
using AxesSnapshot = std::array<Snapshot, most_axes>;

/// Common interface of these back-ends; holds the queues of writes and pin events.
class AxesCores : public AnyBackend {
 public:
  using Pins = std::array<EncoderPins, most_axes>;

  const DesignInfo& design() const override { return info_; }
  int axes() const override { return axes_; }

  /// Power-up and reset; `seed` fills the state that reset does not define.
  virtual void reset(std::uint64_t seed, const Pins& pins) = 0;
  void write(int address, std::uint32_t data) override { writes_.push(address, data); }
  void stop(bool pressed) override { stop_ = pressed; }
  /// Adds a pin event of an axis; events must be in order and not before now().
  void edge(std::size_t axis, const EncoderEvent& event) { events_[axis].push(&event, &event + 1); }

  /// Advances `clocks` clocks from now().
  virtual void advance(Clock clocks) = 0;
  Clock now() const override { return now_; }
  /// Snapshots that became valid during the last advance().
  const std::vector<AxesSnapshot>& snapshots() const { return snapshots_; }
  /// Duty in force in a bridge, in clocks of the PWM period, and whether its gates are enabled.
  virtual int duty(std::size_t axis) const = 0;
  virtual bool gates_enabled(std::size_t axis) const = 0;

  std::int64_t mismatches() const override { return mismatches_; }
  std::string first_mismatch() const override { return first_mismatch_; }
  Clock first_mismatch_clock() const override { return first_mismatch_clock_; }

 protected:
  AxesCores(DesignInfo info, int axes) : info_(std::move(info)), axes_(axes) {}

  DesignInfo info_;
  int axes_;
  WriteQueue writes_;
  std::array<EventQueue, most_axes> events_;
  bool stop_ = false;
  Clock now_ = 0;
  std::vector<AxesSnapshot> snapshots_;
  std::int64_t mismatches_ = 0;
  std::string first_mismatch_;
  Clock first_mismatch_clock_ = 0;
};

/// Makes the back-end "twin" of a design with several axes, or "lockstep" where the program has its
/// Verilated axes. Errors: std::invalid_argument that names the choices.
std::unique_ptr<AxesCores> make_axes_cores(const std::string& design, const std::string& kind);

/// Adds the Verilated axes of a design, before main(), as add_rtl().
using RtlAxesMaker = std::unique_ptr<AxesCores> (*)(const DesignInfo& design);
bool add_rtl_axes(const std::string& design, std::uint32_t design_crc, RtlAxesMaker maker);

}  // namespace feltgate
