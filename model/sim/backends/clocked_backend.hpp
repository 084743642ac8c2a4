// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Common part of the clocked back-ends: pin events at their clocks, one register write per tick,
// collection of snapshots and gate times. Documentation: docs/architecture.md
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "absolute_sensor.hpp"
#include "backend.hpp"
#include "feltgate/feltgate_core.hpp"
#include "input_queues.hpp"

namespace feltgate {

/// Passes pins, panel and register writes to a core, and collects snapshots and gate times. A
/// derived class supplies reset_core(seed, pins), run(first clock, inputs) and name().
class ClockedBackend : public Backend {
 public:
  explicit ClockedBackend(DesignInfo info) : info_(std::move(info)) { mount_sensor(); }

  const DesignInfo& design() const override { return info_; }
  void reset(std::uint64_t seed, EncoderPins pins) override {
    now_ = 0;
    events_.reset(pins);
    writes_.clear();
    panel_ = {};
    current_bits_ = 0;
    hall_ = {};
    mount_sensor();
    snapshots_.clear();
    gates_ = {};
    last_ = {};
    reg_addr_ = 0;
    reset_core(seed, pins);
  }
  void set_panel(const Panel& panel) override { panel_ = panel; }
  void set_current_bits(std::uint8_t bits) override { current_bits_ = bits; }
  void set_hall(const HallChange& lines) override { hall_ = lines; }
  void turn_encoder(double from_rad, double to_rad, Clock clocks) override {
    if (sensor_) sensor_->turn(from_rad, to_rad, now_, clocks);
  }
  void break_encoder(const std::string& defect) override {
    const auto& names = AbsoluteSensor::defects;
    const auto* it = std::find(names.begin(), names.end(), defect);
    if (!sensor_ || it == names.end()) return Backend::break_encoder(defect);
    sensor_->set(static_cast<AbsoluteSensor::Defect>(it - names.begin()));
  }
  void write(int address, std::uint32_t data) override { writes_.push(address, data); }
  Clock now() const override { return now_; }
  const std::vector<Snapshot>& snapshots() const override { return snapshots_; }
  GateClocks gates() const override { return gates_; }
  int duty() const override { return last_.duty_active; }
  bool gates_enabled() const override { return last_.gates_enable; }

 protected:
  virtual void reset_core(std::uint64_t seed, EncoderPins pins) = 0;

  /// Calls `each(inputs)` for every clock of an advance(); it returns the outputs after the clock.
  template <class EachClock>
  void run(Clock clocks, const EncoderEvent* first, const EncoderEvent* last, EachClock&& each) {
    snapshots_.clear();
    gates_ = {};
    events_.push(first, last);
    CoreIn in = inputs();
    int clock_of_tick = static_cast<int>(now_ % info_.clocks_per_tick);
    for (const Clock end = now_ + clocks; now_ < end; ++now_) {
      in.encoder = events_.at(now_);
      sense(&in, now_, last_.serial);
      in.reg_write = false;
      if (clock_of_tick == host_write_clock && !writes_.empty() && !last_.reg_busy) {
        issue_write(&in);
      }
      if (++clock_of_tick == info_.clocks_per_tick) clock_of_tick = 0;
      each(in);
    }
  }

  /// The inputs that hold between events: panel, and the address used last.
  CoreIn inputs() const {
    CoreIn in;
    in.current_data = current_bits_;
    in.hall = hall_.code(now_);
    in.arm = panel_.arm;
    in.stop = panel_.stop;
    in.scene = panel_.scene;
    in.reg_addr = reg_addr_;
    return in;
  }
  /// Hall lines and the data of an absolute encoder in clock `now`, whose lines the core has set.
  /// Returns the end of the clocks for which they hold, at most `until`.
  Clock sense(CoreIn* in, Clock now, unsigned lines, Clock until = 0) {
    in->hall = hall_.code(now);
    if (!sensor_) return now < hall_.at ? std::min(until, hall_.at) : until;
    in->encoder_data = sensor_->pin(now, lines);
    return now + 1;
  }
  void mount_sensor() {
    if (info_.absolute) sensor_.emplace(*info_.absolute);
  }
  void issue_write(CoreIn* in) {
    const auto w = writes_.pop();
    in->reg_addr = reg_addr_ = w.first;
    in->reg_wdata = w.second;
    in->reg_write = true;
  }

  /// Evaluates the outputs after a clock.
  void note(const CoreOut& out) {
    gates_.add(out.gates);
    last_ = out;
  }
  void keep(const CoreOut& out, std::int16_t travel, std::int64_t writes) {
    snapshots_.emplace_back(out, travel, writes);
  }

  DesignInfo info_;
  Clock now_ = 0;
  Panel panel_;
  std::uint8_t current_bits_ = 0;
  HallChange hall_;
  std::optional<AbsoluteSensor> sensor_;
  EventQueue events_;
  WriteQueue writes_;
  std::uint16_t reg_addr_ = 0;
  std::vector<Snapshot> snapshots_;
  GateClocks gates_;
  CoreOut last_;
};

}  // namespace feltgate
