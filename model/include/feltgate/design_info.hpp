// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The constants of a generated design as run-time information. Documentation: docs/library.md
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <iterator>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "feltgate/axis/absolute.hpp"
#include "feltgate/nearest.hpp"
#include "feltgate/parameter.hpp"

namespace feltgate {

/// Bits of the control word.
struct ControlBits {
  int host = 0, arm = 0, scene = 0, mode = 0;
};

/// Bits of the command word.
struct CommandBits {
  int set_zero = 0, clear_faults = 0, kick = 0;
};

/// The constants of a design.
struct DesignInfo {
  const char* name = "";
  std::int64_t clock_hz = 0, tick_hz = 0;
  int clocks_per_tick = 0, pwm_period = 0, dead_clocks = 0, shortest_clocks = 1, pwm_mode = 0;
  int phases = 2;              ///< 3: the bridge has three legs, and turns the voltage
  int m1 = 0;                  ///< window of the N-method, in ticks; 0: M/T
  double rad_s_per_count = 0;  ///< velocity that one count in that window stands for
  double count_rad = 0, supply_v = 0;
  Format velocity{}, torque{}, current{}, voltage{};
  double torque_constant_nm_a = 0;
  double current_full_scale_a = 0;  ///< of the current loop's modulator; 0: no loop
  std::optional<AbsoluteEncoder::Parameters> absolute;  ///< nothing: the encoder is incremental
  bool hall = false;  ///< Hall lines give the electrical angle at power-up
  const ParameterInfo* parameters = nullptr;
  int parameter_count = 0;
  int control_address = 0, command_address = 0;
  ControlBits control;
  CommandBits command;
  std::uint32_t control_reset = 0;
  std::uint32_t design_crc = 0;  ///< identifies the design for a host, docs/link.md
  std::uint32_t file_sum = 0;    ///< of the file in rtl/designs that it was generated from
  std::function<int(const std::string&)> scene_number;  ///< -1: unknown, or not built
  std::vector<std::string> scenes;  ///< the scenes that are built, in the order of their numbers

  /// When a request to arm may rise: as wanted, or once the offset of a current is known, after 512
  /// PWM periods, if that is longer than a request may wait for it.
  std::int64_t request_at(std::int64_t wanted) const {
    const std::int64_t offset = std::int64_t{513} * pwm_period;
    const bool waits = current_full_scale_a == 0 || offset < clock_hz / 1000 * Map::arm_wait_ms;
    return waits ? wanted : std::max(wanted, offset);
  }
  /// The parameter of that name; nullptr where the design has none.
  const ParameterInfo* find(std::string_view parameter) const {
    for (int i = 0; i < parameter_count; ++i) {
      if (parameter == parameters[i].name) return &parameters[i];
    }
    return nullptr;
  }
  /// Error message for a name that find() does not know: the nearest name, and where all are
  /// listed.
  std::string unknown(const std::string& parameter) const {
    std::vector<std::string> names;
    for (int i = 0; i < parameter_count; ++i) names.emplace_back(parameters[i].name);
    return "parameter \"" + parameter + "\" is unknown; " + config::did_you_mean(parameter, names) +
           "`feltgate design " + name + "` lists them";
  }
  /// Error message for a name that scene_number() does not know: the nearest name, and the choices.
  std::string unknown_scene(const std::string& scene) const {
    std::string list;
    for (const std::string& built : scenes) list += (list.empty() ? "" : ", ") + built;
    return "scene \"" + scene + "\" is not built in design " + name + "; " +
           config::did_you_mean(scene, scenes) + "choose one of " + list +
           ", or a design that lists it";
  }
};

/// Range and step of the values that a parameter's word can hold, in its unit.
struct ValueRange {
  double low = 0, high = 0, step = 0;
};
/// Range and step of a parameter's word.
inline ValueRange range_of(const ParameterInfo& p) {
  const double words = std::ldexp(1.0, p.format.width() - p.format.sign);
  const double step = std::ldexp(1.0, -p.format.fraction);
  return {p.format.sign == 1 ? -words * step : 0.0, (words - 1) * step, step};
}

/// The integer of a parameter for a value in its unit, rounded to nearest, ties away from zero;
/// nothing where it does not fit.
inline std::optional<std::int64_t> quantised(const ParameterInfo& p, double value) {
  const ValueRange range = range_of(p);
  const double steps = std::round(value / range.step);
  if (!(value >= range.low && steps <= range.high / range.step)) return {};
  return static_cast<std::int64_t>(steps);
}

/// Whether design D has scene number `scene`.
template <class D>
constexpr bool scene_built(int scene) {
  return scene >= 0 && scene < 16 && ((D::scene_mask >> scene) & 1) != 0;
}

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
  i.shortest_clocks = D::shortest_clocks;
  i.pwm_mode = (D::control_reset >> D::C::control_pwm_mode) & 1;
  i.phases = D::phases;
  i.hall = D::hall != 0;
  i.m1 = D::m1;
  i.rad_s_per_count = D::velocity_gain == 0
                          ? std::ldexp(1.0, D::velocity_shift)
                          : std::ldexp(static_cast<double>(D::velocity_gain), -D::velocity_gain_f);
  i.count_rad = D::count_rad;
  i.supply_v = D::supply_v;
  i.velocity = D::f.velocity;
  i.torque = D::f.torque;
  i.current = D::f.current;
  i.voltage = D::f.voltage;
  // An LSB of the measured current is 2^current_drop of the reference.
  if (D::current_loop != 0) {
    i.current_full_scale_a = std::ldexp(1.0, 17 + D::current_drop - D::f.current.fraction);
  }
  if (D::absolute_encoder != 0) i.absolute = absolute_parameters<D>();
  i.parameters = D::parameters;
  i.parameter_count = static_cast<int>(std::size(D::parameters));
  i.torque_constant_nm_a = i.find("torque_constant")->si;
  i.control_address = D::C::control;
  i.command_address = D::C::command;
  i.control = {D::C::control_host, D::C::control_arm, D::C::control_scene, D::C::control_mode};
  i.command = {D::C::command_set_zero, D::C::command_clear_faults, D::C::command_kick};
  i.control_reset = static_cast<std::uint32_t>(D::control_reset);
  i.design_crc = D::design_crc;
  i.file_sum = D::file_sum;
  i.scene_number = [](const std::string& name) {
    const int n = D::scene_number(name);
    return scene_built<D>(n) ? n : -1;
  };
  for (const std::string_view scene : D::scene_names) {
    if (i.scene_number(std::string(scene)) >= 0) i.scenes.emplace_back(scene);
  }
  return i;
}

}  // namespace feltgate
