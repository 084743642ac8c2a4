// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// A design as run-time information: rates, formats, parameters, and the data that the twin is made
// of. Documentation: docs/library.md
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "feltgate/axis/absolute.hpp"
#include "feltgate/axis/design.hpp"
#include "feltgate/generated/map.hpp"
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

/// A design. design_info<Lever>() gives that of a generated header; feltgate::design::info_of()
/// that of a file.
struct DesignInfo {
  std::string name;
  axis::Design data;  ///< what the twin is made of
  std::int64_t clock_hz = 0, tick_hz = 0;
  int clocks_per_tick = 0, pwm_period = 0, dead_clocks = 0, shortest_clocks = 1, pwm_mode = 0;
  int phases = 2;                  ///< 3: the bridge has three legs, and turns the voltage
  int m1 = 0;                      ///< window of the N-method, in ticks; 0: M/T
  double rad_s_per_count = 0;      ///< velocity that one count in that window stands for
  double velocity_gain_rad_s = 0;  ///< exact, of a count in the window; 0: what the data say
  double count_rad = 0, supply_v = 0;
  Format velocity{}, torque{}, current{}, voltage{};
  double torque_constant_nm_a = 0;
  double current_full_scale_a = 0;  ///< of the current loop's modulator; 0: no loop
  std::optional<AbsoluteEncoder::Parameters> absolute;  ///< nothing: the encoder is incremental
  bool hall = false;    ///< Hall lines give the electrical angle at power-up
  int axes = 1;         ///< motors with an encoder each
  bool engine = false;  ///< programs give the torque of the scene law
  std::vector<ParameterInfo> parameters;
  int control_address = Map::C::control, command_address = Map::C::command;
  ControlBits control;
  CommandBits command;
  std::uint32_t control_reset = 0;
  std::uint32_t design_crc = 0;     ///< identifies the design for a host, docs/link.md
  std::vector<std::string> scenes;  ///< the scenes that are built, in the order of their numbers

  /// The number of a scene; -1: unknown, or not built.
  int scene_number(const std::string& scene) const {
    const int n = Map::scene_number(scene);
    return n >= 0 && data.has_scene(n) ? n : -1;
  }
  /// When a request to arm may rise: as wanted, or once the offset of a current is known, after 512
  /// PWM periods, if that is longer than a request may wait for it.
  std::int64_t request_at(std::int64_t wanted) const {
    const std::int64_t offset = std::int64_t{513} * pwm_period;
    const bool waits = current_full_scale_a == 0 || offset < clock_hz / 1000 * Map::arm_wait_ms;
    return waits ? wanted : std::max(wanted, offset);
  }
  /// The parameter of that name; nullptr where the design has none.
  const ParameterInfo* find(std::string_view parameter) const {
    for (const ParameterInfo& p : parameters) {
      if (parameter == p.name) return &p;
    }
    return nullptr;
  }
  /// The parameter at this address. Errors: std::invalid_argument where there is none.
  const ParameterInfo& at(int address) const {
    for (const ParameterInfo& p : parameters) {
      if (p.address == address) return p;
    }
    throw std::invalid_argument("design " + name + " has no parameter at address " +
                                std::to_string(address) + "; docs/registers.md lists them");
  }
  /// Error message for a name that find() does not know: the nearest name, and where all are
  /// listed.
  std::string unknown(const std::string& parameter) const {
    std::vector<std::string> names;
    for (const ParameterInfo& p : parameters) names.emplace_back(p.name);
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

/// What of a design is no integer of its data.
struct DesignReals {
  double count_rad = 0, velocity_gain_rad_s = 0, supply_v = 0;
};

/// A design of its data. Errors: std::out_of_range where a constant is missing.
inline DesignInfo design_info(std::string name, axis::Design data,
                              std::vector<ParameterInfo> parameters, const DesignReals& reals) {
  using C = Map::C;
  const axis::Design& d = data;
  const auto signal = [&d](const std::string& signal) {
    const int width = d[signal + "_W"], fraction = d[signal + "_F"];
    return Format{1, width - 1 - fraction, fraction};
  };
  DesignInfo i;
  i.name = std::move(name);
  i.clock_hz = d.wide("CLOCK_HZ");
  i.clocks_per_tick = d["CLOCKS_PER_TICK"];
  i.tick_hz = i.clock_hz / i.clocks_per_tick;
  i.pwm_period = d["PWM_PERIOD"];
  i.dead_clocks = d["DEAD_CLOCKS"];
  i.shortest_clocks = d["SHORTEST_CLOCKS"];
  i.control_reset = static_cast<std::uint32_t>(d["CONTROL_RESET"]);
  i.pwm_mode = i.control_reset >> C::control_pwm_mode & 1;
  i.phases = d["PHASES"];
  i.hall = d["HALL"] != 0;
  i.axes = d["AXES"];
  i.engine = d["ENGINE"] != 0;
  i.m1 = d["M1"];
  i.rad_s_per_count = d["VELOCITY_GAIN"] == 0
                          ? std::ldexp(1.0, d["VELOCITY_SHIFT"])
                          : std::ldexp(d["VELOCITY_GAIN"], -d["VELOCITY_GAIN_F"]);
  i.velocity_gain_rad_s = reals.velocity_gain_rad_s;
  i.count_rad = reals.count_rad;
  i.supply_v = reals.supply_v;
  i.velocity = signal("VELOCITY");
  i.torque = signal("TORQUE");
  i.current = signal("CURRENT");
  i.voltage = signal("VOLTAGE");
  // An LSB of the measured current is 2^current_drop of the reference.
  if (d["CURRENT_LOOP"] != 0) {
    i.current_full_scale_a = std::ldexp(1.0, 17 + d["CURRENT_DROP"] - i.current.fraction);
  }
  if (d["ABSOLUTE_ENCODER"] != 0) i.absolute = axis::Absolute::parameters(d);
  i.control = {C::control_host, C::control_arm, C::control_scene, C::control_mode};
  i.command = {C::command_set_zero, C::command_clear_faults, C::command_kick};
  i.design_crc = static_cast<std::uint32_t>(d.wide("DESIGN_CRC"));
  for (const std::string_view scene : Map::scene_names) {
    const int n = Map::scene_number(scene);
    if (n >= 0 && d.has_scene(n)) i.scenes.emplace_back(scene);
  }
  i.parameters = std::move(parameters);
  i.torque_constant_nm_a = i.find("torque_constant")->si;
  i.data = std::move(data);
  return i;
}

/// The design of a generated header, such as feltgate/generated/lever.hpp.
template <class D>
const DesignInfo& design_info() {
  static const DesignInfo info = design_info(D::name, axis::Design::of<D>(),
                                             {std::begin(D::parameters), std::end(D::parameters)},
                                             {D::count_rad, D::velocity_gain_rad_s, D::supply_v});
  return info;
}

}  // namespace feltgate
