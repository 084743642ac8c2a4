// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The constants of a design, its C++ header and its memory file. Documentation:
// docs/designs.md
#include "design/generate.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <sstream>
#include <stdexcept>

#include "design/generate_cfg.hpp"
#include "design/text_edit.hpp"
#include "feltgate/axis/params.hpp"
#include "feltgate/crc32.hpp"
#include "feltgate/current_control.hpp"
#include "feltgate/current_sense.hpp"

namespace feltgate::design {

namespace {

std::string triple(Format f) {
  return fmt::format("{{{}, {}, {}}}", f.sign, f.integer, f.fraction);
}

unsigned scene_mask(const Elaborated& e) {
  unsigned mask = 0;
  for (const std::string& s : e.design.scenes) mask |= 1u << e.registers.scene_number(s);
  return mask;
}

/// The names of a rounding mode in RTL and twin.
struct RoundingName {
  int number;
  const char* name;
};
RoundingName rounding(Round mode) {
  if (mode == Round::truncate) return {1, "truncate"};
  if (mode == Round::convergent) return {2, "convergent"};
  return {0, "half_up"};
}

std::string banner(const Elaborated& e, const std::string& what) {
  return generated_banner("rtl/designs/" + e.design.name + ".toml and rtl/registers.toml", what);
}

std::vector<Constant> constants(const Elaborated& e) {
  const Design& d = e.design;
  return {
      {"clocks_per_tick", d.clocks_per_tick(), "clocks"},
      {"m1", d.m1, "ticks between the two positions of the velocity estimator"},
      {"velocity_shift", d.n, "raw velocity = 2^n * counts"},
      {"velocity_gain", e.velocity_gain, "mantissa of the gain that stands for 2^n; 0: none"},
      {"velocity_gain_f", e.base.velocity_gain.fraction, "its fraction bits"},
      {"index_counts", d.has_index ? 4 * d.lines : 0, "counts from index to index; 0: not checked"},
      {"pwm_period", d.pwm_period_clocks(), "clocks"},
      {"dead_clocks", d.dead_clocks(), "clocks"},
      {"shortest_clocks", d.shortest_clocks(), "clocks, of a pulse at a gate"},
      {"scene_mask", scene_mask(e), "bit n: scene n is built"},
      {"control_reset", control_reset(e), "control word after reset"},
      {"scene_guard_bits", fabric::scene_guard_bits,
       "bits that a scene's terms keep below a torque step"},
      {"require_watchdog", d.require_watchdog ? 1 : 0, "1: arming waits for the first kick"},
      {"emf_in_law", d.emf_in_law() ? 1 : 0, "1: the voltage law gives back the back-EMF"},
      {"i2t_start", e.word("i2t_budget").raw / 2,
       "I2t sum after power-up: half the budget, for nobody knows how hot the motor is"},
  };
}

}  // namespace

std::uint32_t control_reset(const Elaborated& e) {
  const auto at = [&](const char* field, int value) {
    return static_cast<std::uint32_t>(value) << e.registers.control_bit("control", field);
  };
  const Design& d = e.design;
  return at("motor_polarity", d.motor_polarity) | at("encoder_polarity", d.encoder_polarity) |
         at("pwm_mode", d.pwm_mode) | at("filter", d.filter_samples);
}

std::vector<std::pair<std::string, Format>> named_formats(const Formats& f) {
  return {{"position", f.position},
          {"scene_position", f.scene_position},
          {"scene_offset", f.scene_offset},
          {"scene_distance", f.scene_distance},
          {"scene_part", f.scene_part},
          {"scene_torque", f.scene_torque},
          {"travel_difference", f.travel_difference},
          {"velocity_raw", f.velocity_raw},
          {"velocity", f.velocity},
          {"velocity_difference", f.velocity_difference},
          {"inertia_torque", f.inertia_torque},
          {"drive_torque", f.drive_torque},
          {"observer", f.observer},
          {"observer_difference", f.observer_difference},
          {"observed", f.observed},
          {"torque", f.torque},
          {"ramp", f.ramp},
          {"current", f.current},
          {"current_part", f.current_part},
          {"current_sum", f.current_sum},
          {"voltage", f.voltage},
          {"voltage_part", f.voltage_part},
          {"voltage_sum", f.voltage_sum},
          {"emf", f.emf},
          {"applied", f.applied},
          {"duty", f.duty},
          {"duty_sum", f.duty_sum},
          {"limiter", f.limiter},
          {"with_addend", f.with_addend},
          {"limiter_input", f.limiter_input},
          {"current_estimate_part", f.current_estimate_part},
          {"current_estimate", f.current_estimate},
          {"current_squared", f.current_squared},
          {"i2t", f.i2t},
          {"charge", f.charge}};
}

namespace {

/// Constants of options that most designs lack. Without the option they are left out, so the CRC of
/// those designs stays the same.
std::vector<Constant> further(const Design& d) {
  return {
      {"axes", d.axes, "motors with an encoder each"},
      {"engine", d.engine ? 1 : 0, "1: programs give the torque of the scene law"},
      {"engine_max_age", d.engine_max_age_ticks(), "ticks without a fresh torque that are borne"}};
}

std::vector<Constant> of_estimator(const Design& d) {
  return {{"mt_counts", d.mt ? 4 * d.lines : 0,
           "velocity by M/T of an encoder with so many counts in a turn; 0: by the N-method"},
          {"mt_window", d.mt_window_clocks(), "clocks: of a shorter span twice the cycles"},
          {"mt_doublings", std::ilogb(d.mt_cycles), "the span has at most 2^n cycles"}};
}

/// Words of the current loop; 0 without it.
std::vector<Constant> of_current_loop(const Elaborated& e) {
  const Design& d = e.design;
  const double full_a = d.current_loop ? d.current_full_scale_a : 1;
  const CurrentGains gains = d.current_loop ? d.current_loop_gains() : CurrentGains{};
  const CurrentCheckWords check = d.current_loop ? d.current_loop_check() : CurrentCheckWords{};
  // Nine bits: within 0.2 %, and the integrator gives the rest.
  const double per_lsb = std::ldexp(CurrentControl::kSupply / d.full_duty_v(), -d.voltage.fraction);
  const int drop = 8 - std::ilogb(per_lsb);
  const auto given = [&d](auto value) { return d.current_loop ? value : 0; };
  return {
      {"current_loop", given(1), "1: a measured current is controlled"},
      {"current_drop", given(d.current.fraction + std::ilogb(full_a) - kCurrentControlBits),
       "fraction bits of the current reference below an LSB of the measured current"},
      {"current_proportional", gains.proportional, "[0,4,13], supply per full scale"},
      {"current_integral", gains.integral, "[0,0,17]"},
      {"current_resistance", check.resistance, "[0,4,13], supply per full scale"},
      {"current_margin", check.margin, "[0,0,17] of the supply: half of the largest current's"},
      {"current_overcurrent",
       given(std::llround(d.overcurrent_a / full_a * CurrentSense::Parameters{}.fast_full_scale())),
       "[0,0,8] of full scale"},
      {"current_strobe", given(d.current_strobe_clock()),
       "clock of the PWM period in which a window begins"},
      {"feed_gain", given(std::lround(std::ldexp(per_lsb, drop))),
       "mantissa: parts of the supply per LSB of the voltage"},
      {"feed_drop", given(drop), "its fraction bits"},
      {"driver_fault", given(d.driver_fault ? 1 : 0), "1: the driver tells of its faults"},
      {"heartbeat", given(d.heartbeat ? 512 : 0),
       "ticks between changes of the pin for a watchdog outside, a power of two; 0: no pin"}};
}

/// Words of the absolute encoder; 0 without it.
std::vector<Constant> of_absolute_encoder(const Design& d) {
  const AbsoluteEncoder::Parameters p =
      d.absolute ? d.absolute_parameters() : AbsoluteEncoder::Parameters{0, 0, 0, 0, 0, 0, 0, 0, 0};
  return {
      {"absolute_encoder", d.absolute ? 1 : 0, "1: the position is of an absolute encoder"},
      {"absolute_framing", p.framing, "0 SPI with parity, 1 SSI with CRC-6"},
      {"absolute_bits", p.bits, "of a turn"},
      {"absolute_half_clocks", p.half_clocks, "clocks: half a serial clock"},
      {"absolute_gap_clocks", p.gap_clocks, "clocks before the serial clock and between readings"},
      {"absolute_period", d.absolute ? d.absolute_period_ticks() : 0,
       "ticks from reading to reading"},
      {"absolute_jump_step", p.jump_step, "counts of the fastest motion in a reading"},
      {"absolute_diagnosis", p.diag_address, "SPI: address of the diagnosis"}};
}

/// What the checks of the encoder take from its counts; not in the CRC where it is as with 4096.
std::vector<Constant> of_encoder(const Design& d) {
  return {{"edge_unit_bits", d.edge_unit_bits(),
           "bits of the ticks in which the time between edges is counted"},
          {"fast_edges", d.fast_edges() ? 1 : 0,
           "1: at the fastest motion several counts come in a tick"},
          {"self_test_drop", d.self_test_drop(), "the self-test takes 2^n counts for one"}};
}
bool as_of_4096_counts(const Design& d) {
  return d.edge_unit_bits() == 6 && !d.fast_edges() && d.self_test_drop() == 0;
}

/// Hall lines; not in the CRC of designs without them.
std::vector<Constant> of_angle(const Design& d) {
  return {{"hall", d.hall ? 1 : 0, "1: Hall lines give the electrical angle at power-up"}};
}

std::vector<Constant> of_phases(const Design& d) {
  return {{"phases", d.phases, "legs of the bridge: 2 of one motor current, 3 of three"}};
}

/// The constants of all options, in the order of the files.
std::vector<Constant> of_options(const Elaborated& e) {
  std::vector<Constant> all;
  for (const auto& list :
       {further(e.design), of_estimator(e.design), of_encoder(e.design), of_current_loop(e),
        of_absolute_encoder(e.design), of_angle(e.design), of_phases(e.design)}) {
    all.insert(all.end(), list.begin(), list.end());
  }
  return all;
}

}  // namespace

std::vector<Constant> design_constants(const Elaborated& e) {
  std::vector<Constant> all = constants(e);
  for (const Constant& c : of_options(e)) all.push_back(c);
  all.push_back({"rounding", rounding(e.design.rounding).number,
                 "where the chain rounds: 0 half up, 1 floor, 2 convergent"});
  return all;
}

std::uint32_t design_crc(const Elaborated& e) {
  std::string text = fmt::format("clock_hz {}\ntick_hz {}\n", e.design.clock_hz, e.design.tick_hz);
  const auto add = [&text](const std::vector<Constant>& list) {
    for (const Constant& c : list) text += fmt::format("{} {}\n", c.name, c.value);
  };
  add(constants(e));
  if (e.design.axes != 1 || e.design.engine) add(further(e.design));
  if (e.design.mt) add(of_estimator(e.design));
  if (!as_of_4096_counts(e.design)) add(of_encoder(e.design));
  if (e.design.current_loop) add(of_current_loop(e));
  if (e.design.absolute) add(of_absolute_encoder(e.design));
  if (e.design.phases == 3) add(of_phases(e.design));
  if (e.design.hall) text += "hall 1\n";
  for (const auto& [name, f] : named_formats(e.formats)) {
    text += fmt::format("{} {} {} {}\n", name, f.sign, f.integer, f.fraction);
  }
  for (const Word& w : e.words) {
    text += fmt::format("{} {} {} {} {} {}\n", w.parameter.name, w.parameter.address, w.format.sign,
                        w.format.integer, w.format.fraction, static_cast<std::uint32_t>(w.raw));
  }
  return crc32(text.data(), text.size());
}

std::string cpp_header(const Elaborated& e) {
  const Design& d = e.design;
  std::ostringstream s;
  s << banner(e, "")
    << "#pragma once\n\n#include <cstdint>\n#include <string_view>\n\n#include "
       "\"feltgate/chain_formats.hpp\"\n"
    << "#include \"feltgate/fixed.hpp\"\n#include \"feltgate/generated/map.hpp\"\n#include "
       "\"feltgate/parameter.hpp\"\n\nnamespace feltgate "
       "{\n\n"
    << "/// " << d.description << ".\nstruct " << camel(d.name) << " {\n"
    << "  static constexpr const char* name = \"" << d.name << "\";\n"
    << "  static constexpr std::int64_t clock_hz = " << d.clock_hz << ";\n"
    << "  static constexpr std::int64_t tick_hz = " << d.tick_hz << ";\n"
    << "  static constexpr double count_rad = " << real_literal(d.count_rad()) << ";\n"
    << "  static constexpr double velocity_gain_rad_s = "
    << real_literal(d.exact_gain ? d.velocity_gain_rad_s() : 0.0) << ";\n"
    << "  static constexpr double supply_v = " << real_literal(d.full_duty_v()) << ";\n";
  for (const Constant& c : constants(e)) {
    s << "  static constexpr int " << c.name << " = " << c.value << ";  // " << c.doc << "\n";
  }
  for (const Constant& c : of_options(e)) {
    s << "  static constexpr int " << c.name << " = " << c.value << ";  // " << c.doc << "\n";
  }
  s << "  static constexpr Round rounding = Round::" << rounding(d.rounding).name
    << ";  // where the chain rounds\n";
  s << fmt::format(
      "  static constexpr std::uint32_t design_crc = 0x{:08x};  // by which a host knows the "
      "design\n",
      design_crc(e));
  s << "\n  /// Formats of the parameters.\n  struct P {\n";
  for (const Word& w : e.words) {
    s << "    static constexpr Format " << w.parameter.name << triple(w.format) << ";\n";
  }
  s << "  };\n\n  // Equal in all designs.\n"
    << "  using A = Map::A;\n  using S = Map::S;\n  using C = Map::C;\n"
    << "  static constexpr int scene_number(std::string_view scene) {\n"
    << "    return Map::scene_number(scene);\n  }\n"
    << "  static constexpr const auto& scene_names = Map::scene_names;\n\n";
  s << "  static constexpr BaseFormats base{\n"
    << "      " << triple(d.velocity) << ", " << triple(d.torque) << ", " << triple(d.current)
    << ", " << triple(d.voltage) << ",\n      " << d.observer_fraction
    << ", velocity_shift, velocity_gain != 0, " << triple(e.base.velocity_gain) << ",\n"
    << "      P::velocity_a1, P::torque_constant, P::inertia_gain, P::observer_a1,\n"
    << "      P::torque_gain, P::observer_gain, P::voltage_gain, P::emf_constant,\n"
    << "      P::dead_voltage_slope, P::voltage_to_current, P::duty_gain,\n"
    << "      P::inverse_resistance, P::emf_over_resistance, P::compression_stiffness,\n"
    << "      P::tension_stiffness, P::attract_core_slope, P::repel_core_slope, "
       "P::wall_stiffness,\n"
    << "      P::damper_damping, P::wall_damping};\n"
    << "  static constexpr Formats f = derive(base);\n\n"
    << "  /// Parameters: name, unit, address, format, exact value, integer, format of its\n"
       "  /// register.\n"
    << "  static constexpr ParameterInfo parameters[] = {\n";
  for (const Word& w : e.words) {
    s << "      {\"" << w.parameter.name << "\", \"" << w.parameter.unit
      << "\", A::" << w.parameter.name << ", P::" << w.parameter.name << ",\n       "
      << real_literal(w.si) << ", " << w.raw << ", " << triple(w.field()) << "},\n";
  }
  s << "  };\n\n  /// The constants of the package cfg.\n"
    << "  static constexpr NamedConstant constants[] = {\n";
  for (const Constant& c : cfg_constants(e)) {
    s << "      {\"" << c.name << "\", " << c.value << "},\n";
  }
  s << "  };\n};\n\n}  // namespace feltgate\n";
  return s.str();
}

std::string memory_text(const Elaborated& e) {
  std::vector<std::uint32_t> words(512, 0);
  for (const Word& w : e.words) {
    words[static_cast<std::size_t>(w.parameter.address)] = static_cast<std::uint32_t>(w.raw);
  }
  std::string text = banner(e, "");
  for (const std::uint32_t word : words) {
    text += fmt::format("{:09x}\n", axis::ParamsMemory::checked(word));
  }
  return text;
}

std::string values_text(const Elaborated& e) {
  std::ostringstream s;
  for (const Word& w : e.words) {
    s << w.parameter.name << " " << w.parameter.address << " " << w.raw << " " << real_literal(w.si)
      << "\n";
  }
  return s.str();
}

}  // namespace feltgate::design
