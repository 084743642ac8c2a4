// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The core's twin closed over motor, lever and hand, with an encoder whose channels may fail.
// Documentation: docs/blocks/encoder.md
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "feltgate/design_info.hpp"
#include "feltgate/feltgate_core.hpp"
#include "feltgate/generated/causes.hpp"
#include "feltgate/largest.hpp"
#include "sim/plant/drive.hpp"
#include "sim/plant/plant.hpp"

namespace feltgate::test {

/// The defect of the channels A and B.
enum class Break {
  none,
  a_low,
  a_high,
  a_held,
  b_low,
  b_high,
  b_held,
  both_a,  ///< shorted, A the stronger
  both_b,
  both_and,
  both_or,
};
inline constexpr std::array<const char*, 11> break_names{
    "none",   "A low",   "A high",  "A open",    "B low",   "B high",
    "B open", "short A", "short B", "short and", "short or"};

inline EncoderPins broken(Break how, EncoderPins now, EncoderPins held) {
  switch (how) {
    case Break::none:
      break;
    case Break::a_low:
      now.a = false;
      break;
    case Break::a_high:
      now.a = true;
      break;
    case Break::a_held:
      now.a = held.a;
      break;
    case Break::b_low:
      now.b = false;
      break;
    case Break::b_high:
      now.b = true;
      break;
    case Break::b_held:
      now.b = held.b;
      break;
    case Break::both_a:
      now.b = now.a;
      break;
    case Break::both_b:
      now.a = now.b;
      break;
    case Break::both_and:
      now.a = now.b = now.a && now.b;
      break;
    case Break::both_or:
      now.a = now.b = now.a || now.b;
      break;
  }
  return now;
}

/// One run.
struct Press {
  std::string scene = "wall";
  std::vector<std::pair<std::string, double>> parameters;  ///< in their units; angles in counts
  plant::Hand hand;
  double seconds = 1.0;
  Break how = Break::none;
  double broken_s = 1e9;   ///< when
  double limit_rad = 1e9;  ///< true travel after the break at which the run ends
  int filter = 0;          ///< the decoder's
  int bounce_clocks = 0;   ///< after each edge the channel goes back and comes again, each so long
};

/// The result of a run. Values "after the break" end when the gates close.
struct Pressed {
  unsigned faults = 0;
  Fault first = Fault::none;
  double fault_s = 0, travel_rad = 0;  ///< since the break
  std::int64_t steps = 0;              ///< of the count, after the break
  int chatter = 0;                     ///< times that the torque was frozen
  double frozen_s = 0, longest_s = 0;  ///< in all; the longest time
  double hand_nm = 0, hand_nm_s = 0;   ///< at the hand after the break: peak, integral
};

/// Runs it on the twin of design D.
template <class D>
Pressed press(const plant::Parameters& parameters, const Press& what) {
  const DesignInfo info = design_info<D>();
  plant::Plant lever(parameters, parameters.effects, plant::drive_of(info), what.hand);
  FeltgateCore<D, false> core;
  CoreIn in;
  constexpr Clock kStep = 25;
  in.encoder = lever.encoder().pins();
  const auto write = [&](int address, std::uint32_t data) {
    in.reg_write = true;
    in.reg_addr = static_cast<std::uint16_t>(address);
    in.reg_wdata = data;
    core.clock(in);
    in.reg_write = false;
    while (core.out().reg_busy || core.clock_of_tick() != 0) core.clock(in);
  };
  for (int k = 0; k < 4 * D::clocks_per_tick; ++k) core.clock(in);
  for (const auto& [name, value] : what.parameters) {
    const ParameterInfo* p = info.find(name);
    write(p->address, static_cast<std::uint32_t>(*quantised(*p, value)));
  }
  in.scene = static_cast<std::uint8_t>(info.scene_number(what.scene));
  using C = typename D::C;
  const std::uint32_t control = static_cast<std::uint32_t>(D::control_reset) |
                                1u << C::control_host |
                                std::uint32_t{in.scene} << C::control_scene |
                                static_cast<std::uint32_t>(what.filter) << C::control_filter;
  write(C::control, control);
  write(C::control, control | 1u << C::control_arm);
  Pressed seen;
  const double step_s = kStep / static_cast<double>(D::clock_hz);
  bool is_broken = false;
  EncoderPins pins = in.encoder, held = pins;
  double before_rad = lever.observables().theta_rad, frozen_s = 0;
  std::int32_t position = core.out().position;
  Clock at = 0;
  // The core runs one step behind the lever, so that bounce may last longer than the step.
  const auto until = [&](Clock clock) {
    if (clock > at) core.run(in, clock - at, [] {});
    at = std::max(at, clock);
  };
  for (std::int64_t k = 0; static_cast<double>(k) * step_s < what.seconds; ++k) {
    const CoreOut& o = core.out();
    const bool gates = o.gates_enable;
    lever.advance(
        plant::Bridge::averaged(o.duty_active / static_cast<double>(D::pwm_period), gates), kStep);
    if (!is_broken && static_cast<double>(k) * step_s >= what.broken_s) {
      is_broken = true;
      held = pins;
      in.encoder = broken(what.how, pins, held);
    }
    for (const EncoderEvent& e : lever.events()) {
      const EncoderPins before = in.encoder;
      pins = e.pins;
      until(e.clock - 1);
      in.encoder = is_broken ? broken(what.how, pins, held) : pins;
      if (what.bounce_clocks == 0) continue;
      const EncoderPins after = in.encoder;
      until(at + what.bounce_clocks);
      in.encoder = before;
      until(at + what.bounce_clocks);
      in.encoder = after;
    }
    until(lever.now());
    const auto& s = lever.observables();
    if (is_broken) {
      seen.steps += o.position != position;
      seen.travel_rad += std::abs(s.theta_rad - before_rad);
      if (gates) {
        seen.hand_nm = larger(seen.hand_nm, std::abs(s.hand_torque_nm));
        seen.hand_nm_s += std::abs(s.hand_torque_nm) * step_s;
      }
    }
    position = o.position;
    before_rad = s.theta_rad;
    const bool frozen = (o.limits & limit::chatter) != 0;
    seen.chatter += frozen && frozen_s == 0;
    frozen_s = frozen ? frozen_s + step_s : 0;
    seen.longest_s = std::max(seen.longest_s, frozen_s);
    seen.frozen_s += frozen ? step_s : 0;
    if (o.faults != 0) {
      seen.faults = o.faults;
      seen.first = static_cast<Fault>(o.first_fault);
      seen.fault_s = static_cast<double>(k + 1) * step_s - what.broken_s;
      break;
    }
    if (seen.travel_rad > what.limit_rad) break;
  }
  return seen;
}

}  // namespace feltgate::test
