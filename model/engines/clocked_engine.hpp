// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// What every clocked engine does alike: pin events at their clocks, one register write per tick,
// snapshots and gate times collected. Documentation: docs/architecture.md
#pragma once

#include <cstdint>
#include <deque>
#include <utility>
#include <vector>

#include "engines/engine.hpp"

namespace feltgate {

/// Inputs of the core in one clock.
struct CoreIn {
  EncoderPins encoder;
  bool arm = false, stop = false, set_zero = false;
  std::uint8_t scene = 0;
  std::uint16_t reg_addr = 0;
  std::uint32_t reg_wdata = 0;
  bool reg_write = false;
};

/// Register writes wait here; one is issued in an early clock of each tick.
class WriteQueue {
 public:
  void clear() { writes_.clear(); }
  void push(int address, std::uint32_t data) {
    writes_.emplace_back(static_cast<std::uint16_t>(address), data);
  }
  bool empty() const { return writes_.empty(); }
  std::pair<std::uint16_t, std::uint32_t> pop() {
    const auto w = writes_.front();
    writes_.pop_front();
    return w;
  }
  /// Clock of a tick in which a write is issued: early, so that it is committed with this tick.
  static constexpr int issue_clock = 5;

 private:
  std::deque<std::pair<std::uint16_t, std::uint32_t>> writes_;
};

/// Encoder events that lie ahead.
class EventQueue {
 public:
  void reset(EncoderPins pins) {
    pins_ = pins;
    events_.clear();
  }
  void push(const EncoderEvent* first, const EncoderEvent* last) {
    events_.insert(events_.end(), first, last);
  }
  /// Pins in the clock `now`.
  const EncoderPins& at(Clock now) {
    while (!events_.empty() && events_.front().clock <= now) {
      pins_ = events_.front().pins;
      events_.pop_front();
    }
    return pins_;
  }
  const EncoderPins& pins() const { return pins_; }
  /// Clock of the next event, or `none`.
  Clock next(Clock none) const { return events_.empty() ? none : events_.front().clock; }

 private:
  EncoderPins pins_;
  std::deque<EncoderEvent> events_;
};

/// Derived supplies: void reset_core(seed); void clock_core(const CoreIn&) ; and after it
/// snapshot_valid(), snapshot(), gate bits (a_hi, a_lo, b_hi, b_lo from bit 0), duty(),
/// gates_enabled().
template <class Derived>
class ClockedEngine : public Engine {
 public:
  void reset(std::uint64_t seed, EncoderPins pins) override {
    now_ = 0;
    events_.reset(pins);
    writes_.clear();
    panel_ = {};
    snapshots_.clear();
    self().reset_core(seed, pins);
  }
  void set_panel(const Panel& panel) override { panel_ = panel; }
  void write(int address, std::uint32_t data) override { writes_.push(address, data); }

  void advance(Clock clocks, const EncoderEvent* first, const EncoderEvent* last) override {
    snapshots_.clear();
    gates_ = {};
    events_.push(first, last);
    const int per_tick = design().clocks_per_tick;
    CoreIn in;
    in.arm = panel_.arm;
    in.stop = panel_.stop;
    in.scene = panel_.scene;
    for (const Clock end = now_ + clocks; now_ < end; ++now_) {
      in.encoder = events_.at(now_);
      in.reg_write = false;
      if (!writes_.empty() && now_ % per_tick == WriteQueue::issue_clock) {
        const auto w = writes_.pop();
        in.reg_addr = w.first;
        in.reg_wdata = w.second;
        in.reg_write = true;
      }
      self().clock_core(in);
      const unsigned bits = self().gate_bits();
      gates_.a_hi += bits & 1u;
      gates_.a_lo += (bits >> 1) & 1u;
      gates_.b_hi += (bits >> 2) & 1u;
      gates_.b_lo += (bits >> 3) & 1u;
      if (self().snapshot_valid()) snapshots_.push_back(self().snapshot());
    }
  }

  Clock now() const override { return now_; }
  const std::vector<Snapshot>& snapshots() const override { return snapshots_; }
  GateClocks gates() const override { return gates_; }

 protected:
  Clock now_ = 0;
  Panel panel_;
  EventQueue events_;
  WriteQueue writes_;
  std::vector<Snapshot> snapshots_;
  GateClocks gates_;

 private:
  Derived& self() { return static_cast<Derived&>(*this); }
};

/// The generated constants of design D as run-time information.
template <class D>
DesignInfo design_info() {
  DesignInfo i;
  i.name = D::name;
  i.clock_hz = D::clock_hz;
  i.tick_hz = D::tick_hz;
  i.clocks_per_tick = D::clocks_per_tick;
  i.pwm_period = D::pwm_period;
  i.dead_clocks = D::dead_clocks;
  i.pwm_mode = (D::control_reset >> D::C::control_pwm_mode) & 1;
  i.count_rad = D::count_rad;
  i.supply_v = D::supply_v;
  i.velocity = D::f.velocity;
  i.torque = D::f.torque;
  i.current = D::f.current;
  i.voltage = D::f.voltage;
  i.parameters = D::parameters;
  i.parameter_count = static_cast<int>(std::size(D::parameters));
  i.torque_constant_nm_a = i.find("torque_constant")->si;
  i.control_address = D::C::control;
  i.command_address = D::C::command;
  i.control = {D::C::control_host, D::C::control_arm, D::C::control_scene, D::C::control_mode};
  i.control_reset = static_cast<std::uint32_t>(D::control_reset);
  i.scene_number = [](const std::string& name) {
    const int n = D::scene_number(name);
    return n >= 0 && ((D::scene_mask >> n) & 1) != 0 ? n : -1;
  };
  return i;
}

}  // namespace feltgate
