// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Implementation of Device: requests become pins and register writes, angles become edges. Included
// by device.hpp. Documentation: docs/library.md
#pragma once

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "feltgate/device.hpp"

namespace feltgate {

inline Device::Device(DesignInfo design) : design_(std::move(design)) {
  for (const ParameterInfo& p : design_.parameters) raw_.push_back(p.raw);
}

/// Sets the arm pin; arming needs a request that was low at the end of the tick before. A request
/// that a fault or a stop has ended is not repeated.
inline void Device::begin_tick(const CoreOut& now) {
  if ((now.faults != 0 && !clearing_) || in_.stop) wanted_ = false;
  in_.arm = wanted_ && !clearing_ && held_ == 0 && (now.armed || low_before_);
}

/// Advances to the clock `until` with the pins unchanged.
inline void Device::advance(Clock until) {
  const CoreOut& core = out();
  while (now_ < until) {
    const int clock = clock_of_tick();
    if (clock == 0) begin_tick(core);
    if (clock == host_write_clock && !writes_.empty() && !core.reg_busy &&
        !(core.armed && holds(writes_.front().first))) {
      in_.reg_addr = writes_.front().first;
      in_.reg_wdata = writes_.front().second;
      cleared_ = in_.reg_addr == design_.command_address &&
                 in_.reg_wdata == 1u << design_.command.clear_faults;
      if (holds(in_.reg_addr)) --held_;
      writes_.pop_front();
      in_.reg_write = true;
      step(in_);
      ++now_;
    } else {
      const bool whole = writes_.empty() || clock >= host_write_clock;
      const Clock next = (whole ? design_.clocks_per_tick : host_write_clock) - clock;
      const Clock clocks = std::min(until - now_, next);
      in_.reg_write = false;
      stretch(in_, clocks);
      now_ += clocks;
    }
    if (clock_of_tick() == 0) {
      low_before_ = !in_.arm;
      clearing_ = clearing_ && !cleared_;
      cleared_ = false;
    }
  }
}

inline const CoreOut& Device::clock(EncoderPins encoder) {
  in_.encoder = encoder;
  advance(now_ + 1);
  return out();
}

inline const Reading& Device::tick(EncoderPins encoder) {
  in_.encoder = encoder;
  advance(end_of_tick());
  return reading_;
}

inline void Device::run(Clock clocks, const std::vector<EncoderEvent>& events) {
  const Clock end = now_ + clocks;
  for (const EncoderEvent& e : events) {
    if (e.clock > end) {
      throw std::invalid_argument("a pin change at clock " + std::to_string(e.clock) +
                                  " lies after the end of the stretch at clock " +
                                  std::to_string(end) + "; give it with the next one");
    }
    advance(e.clock);
    in_.encoder = e.pins;
  }
  advance(end);
}

inline const Reading& Device::tick_to(double angle_rad) {
  const Clock clocks = end_of_tick() - now_;
  const double position = std::floor(counts(angle_rad));
  if (!(std::abs(position - static_cast<double>(count_)) <= static_cast<double>(clocks))) {
    std::ostringstream text;
    text << "the lever cannot move to " << angle_rad << " rad in this tick: from "
         << static_cast<double>(count_) * design_.count_rad << " rad it can move by "
         << static_cast<double>(clocks) * design_.count_rad
         << " rad, an edge in each clock; move it in smaller steps";
    throw std::invalid_argument(text.str());
  }
  const auto edges = static_cast<std::int64_t>(position) - count_;
  const std::int64_t magnitude = edges < 0 ? -edges : edges;
  const Clock begin = now_;
  for (std::int64_t edge = 0; edge < magnitude; ++edge) {
    advance(begin + clocks * edge / magnitude);
    count_ += edges < 0 ? -1 : 1;
    const auto phase = static_cast<unsigned>(count_) & 3u;
    in_.encoder = {phase >= 2, phase == 1 || phase == 2, false};
  }
  advance(begin + clocks);
  return reading_;
}

inline void Device::arm() {
  if (out().faults != 0 && !clearing_) {
    throw std::runtime_error("cannot arm: the fault " + reading_of(design_, out()).fault_names() +
                             " is latched; clear_faults() once its cause is gone");
  }
  if (in_.stop) throw std::runtime_error("cannot arm: the stop is pressed; stop(false) first");
  wanted_ = true;
}

inline void Device::disarm() { wanted_ = in_.arm = false; }

inline void Device::stop(bool pressed) { in_.stop = pressed; }

inline void Device::clear_faults() {
  disarm();
  clearing_ = true;
  write(design_.command_address, 1u << design_.command.clear_faults);
}

inline void Device::select(const std::string& scene) {
  const int number = design_.scene_number(scene);
  if (number >= 0) {
    in_.scene = static_cast<std::uint8_t>(number);
    return;
  }
  throw std::invalid_argument(design_.unknown_scene(scene));
}

inline bool Device::holds(int address) const {
  return address == design_.control_address ||
         (address < 512 && while_armed(address, 0) == WhileArmed::refused);
}

inline void Device::write(int address, std::uint32_t data) {
  writes_.emplace_back(static_cast<std::uint16_t>(address), data);
  if (holds(address)) ++held_;
}

inline void Device::refuse_while_armed(const std::string& what) const {
  if (!wanted_) return;
  throw std::runtime_error(what +
                           " cannot change while armed: the torque could jump; disarm() first");
}

inline void Device::set_control(Control how) {
  const std::uint32_t others = design_.control_reset & ~(3u << design_.control.mode);
  refuse_while_armed("the control");
  write(design_.control_address, others | static_cast<std::uint32_t>(how) << design_.control.mode);
}

inline const ParameterInfo& Device::find(const std::string& name) const {
  if (const ParameterInfo* p = design_.find(name)) return *p;
  throw std::invalid_argument(design_.unknown(name));
}

inline void Device::set(const std::string& parameter, double value) {
  const ParameterInfo& p = find(parameter);
  const auto raw = quantised(p, value);
  if (!raw) {
    const ValueRange range = range_of(p);
    std::ostringstream text;
    text << parameter << " = " << value << " " << p.unit << " does not fit design " << design_.name
         << "; choose a value from " << range.low << " to " << range.high << " " << p.unit;
    throw std::invalid_argument(text.str());
  }
  if (holds(p.address)) refuse_while_armed(parameter);
  raw_[static_cast<std::size_t>(&p - design_.parameters.data())] = *raw;
  write(p.address, static_cast<std::uint32_t>(*raw));
}

inline Parameter Device::parameter(const std::string& name) const {
  const ParameterInfo& p = find(name);
  const ValueRange range = range_of(p);
  const std::int64_t raw = raw_[static_cast<std::size_t>(&p - design_.parameters.data())];
  return {p.name, p.unit, static_cast<double>(raw) * range.step, range.low, range.high, range.step};
}

inline std::vector<Parameter> Device::parameters() const {
  std::vector<Parameter> all;
  for (const ParameterInfo& p : design_.parameters) all.push_back(parameter(p.name));
  return all;
}

}  // namespace feltgate
