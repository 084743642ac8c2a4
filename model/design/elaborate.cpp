// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Converts SI values to integers: computes value and format of every parameter, and refuses a
// design that cannot work. Documentation: docs/designs.md
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "design/design.hpp"
#include "feltgate/nearest.hpp"
#include "files/toml/toml_reader.hpp"

namespace feltgate::design {

namespace {

constexpr double kPi = 3.14159265358979323846;

double low_pass_a1(double cutoff_rad_s, double tick_s) {
  return -std::expm1(-cutoff_rad_s * tick_s);
}

// Largest duty. A bootstrap driver is charged by the pulses of the low gate: the low gate of each
// switching leg gets its shortest pulse in every period. If the period is too short, the limit is
// half a period. Of three legs the highest is on for half a period and half the amplitude.
double duty_limit(const Design& d) {
  const int period = d.pwm_period_clocks(), legs = d.pwm_mode == 1 || d.phases == 3 ? 2 : 1;
  return std::max(period / 2, period - legs * (d.dead_clocks() + d.shortest_clocks()));
}

}  // namespace

std::map<std::string, Value> parameter_values(const Design& d) {
  const double q = d.count_rad();
  const bool model = d.voltage_law == "motor_model";
  const double jk = d.inertia_kg_m2 * d.kp_1_kg_m2;
  const double one_ohm = 1.0;
  const double tick_hz = static_cast<double>(d.tick_hz);
  const double observer_part = 1.0 - jk;
  // Each switching leg turns on late by the dead time; until then the current flows through diodes.
  // The lost voltage opposes the current like a brush drop, so the same law compensates it.
  // Of three legs the sum of the three signs turns with the current: 4/pi on average.
  const double legs = d.phases == 3 ? 4 / kPi : d.pwm_mode == 1 ? 2.0 : 1.0;
  const double lost_v =
      legs * (d.supply_v + 2 * d.diode_drop_v) * d.dead_clocks() / d.pwm_period_clocks();
  const double dead_v = (model ? d.dead_voltage_v : 0.0) + (d.compensate_dead_time ? lost_v : 0.0);
  const double core_slope =
      d.charge_core_rad > 0 ? d.charge_nm_rad2 / std::pow(d.charge_core_rad, 3) * q : 0.0;
  const double charge = d.charge_nm_rad2 / (q * q);
  // For whole counts, |x| < core means |x| <= ceil(core) - 1.
  const double core = std::max(0.0, std::ceil(d.charge_core_rad / q) - 1);
  // Without a current limit of the motor: the current that the law demands at stall.
  const double law_a =
      model ? d.current_limit_a
            : std::max(d.kv_low, d.kv_high) * one_ohm * d.current_limit_a / d.resistance_ohm;
  const double current_a = d.motor_current_limit_a > 0 ? d.motor_current_limit_a : law_a;
  const double offset_turns = d.commutation_offset_rad / (2 * kPi);
  // A whole number of LSB, at least one, is exact in every engine.
  const double step_v = std::ldexp(
      std::max(1.0, std::round(std::ldexp(d.voltage_ramp_v_s / tick_hz, d.voltage.fraction))),
      -d.voltage.fraction);
  return {
      {"velocity_a1", {low_pass_a1(d.velocity_cutoff_rad_s, d.tick_s()), "velocity.cutoff_rad_s"}},
      {"observer_a1", {low_pass_a1(d.observer_cutoff_rad_s, d.tick_s()), "observer.cutoff_rad_s"}},
      {"inverse_resistance", {1.0 / d.resistance_ohm, "motor.resistance_ohm"}},
      {"emf_over_resistance",
       {d.emf_constant_v_s_rad / d.resistance_ohm, "motor.emf_constant_v_s_rad"}},
      {"torque_constant", {d.torque_constant_nm_a, "observer.torque_constant_nm_a"}},
      {"inertia_gain", {d.observer_cutoff_rad_s * d.inertia_kg_m2, "observer.inertia_kg_m2"}},
      {"nominal_current_squared",
       {d.nominal_current_a * d.nominal_current_a, "supervisor.nominal_current_a"}},
      {"overspeed", {d.overspeed_rad_s, "supervisor.overspeed_rad_s"}},
      {"i2t_budget", {d.i2t_budget_a2_s * tick_hz, "supervisor.i2t_budget_a2_s"}},
      {"polarity_speed", {d.polarity_speed_rad_s, "supervisor.polarity_speed_rad_s"}},
      {"polarity_current", {d.polarity_current_a, "supervisor.polarity_current_a"}},
      {"polarity_ticks", {std::ceil(d.polarity_time_s * tick_hz), "supervisor.polarity_time_s"}},
      {"emf_constant", {d.emf_constant_v_s_rad, "motor.emf_constant_v_s_rad"}},
      {"observer_gain",
       {std::abs(observer_part) < 1e-12 ? 0.0 : observer_part / d.torque_constant_nm_a,
        "observer.torque_constant_nm_a"}},
      {"voltage_setpoint", {0.0, "voltage.law"}},
      {"voltage_step", {step_v, "voltage.ramp_v_s"}},
      {"torque_limit", {d.torque_limit_nm, "control.torque_limit_nm"}},
      {"ramp_step", {d.ramp_nm_s / tick_hz, "control.ramp_nm_s"}},
      {"voltage_to_current",
       {model ? 1.0 / d.resistance_ohm : 1.0 / one_ohm, "motor.resistance_ohm"}},
      {"torque_gain", {jk / d.torque_constant_nm_a, "control.kp_1_kg_m2"}},
      {"dead_voltage_slope", {dead_v / d.dead_voltage_linear_nm, "voltage.dead_voltage_linear_nm"}},
      {"region_torque", {model ? d.torque_limit_nm : d.region_nm, "voltage.region_nm"}},
      {"hold_torque", {d.hold_torque_nm, "supervisor.hold_torque_nm"}},
      {"hold_time",
       {std::ceil(d.hold_s * tick_hz / (1 << Map::hold_unit_bits)), "supervisor.hold_s"}},
      {"hold_limit", {d.hold_limit_nm, "supervisor.hold_limit_nm"}},
      {"current_limit", {d.current_limit_a, "control.current_limit_a"}},
      {"voltage_gain",
       {model ? d.resistance_ohm : d.kv_low * one_ohm,
        model ? "motor.resistance_ohm" : "voltage.kv_low"}},
      {"voltage_gain_high",
       {model ? d.resistance_ohm : d.kv_high * one_ohm,
        model ? "motor.resistance_ohm" : "voltage.kv_high"}},
      {"dead_voltage", {dead_v, "voltage.dead_voltage_v"}},
      {"voltage_window",
       {std::min(d.resistance_ohm * current_a + dead_v, d.full_duty_v()), "motor.resistance_ohm"}},
      {"duty_gain", {d.pwm_period_clocks() / d.full_duty_v(), "pwm.supply_v"}},
      {"duty_limit", {duty_limit(d), "pwm.frequency_hz"}},
      {"watchdog_ticks", {std::ceil(d.watchdog_s * tick_hz), "supervisor.watchdog_s"}},
      {"self_test_torque", {d.self_test_nm, "self_test.torque_nm"}},
      {"self_test_quiet",
       {std::ceil(d.self_test_units(d.self_test_quiet_s)), "self_test.quiet_ms"}},
      {"self_test_pulse",
       {d.self_test ? std::round(d.self_test_units(d.self_test_pulse_s)) : 0.0,
        "self_test.pulse_ms"}},
      {"self_test_arms",
       {static_cast<double>(d.arm_when_held << Map::self_test_held_bit |
                            d.arm_when_moving << Map::self_test_moving_bit),
        "self_test.arm_when_held"}},
      {"commutation_gain", {d.pole_pairs / (4.0 * std::max(1, d.lines)), "commutation.pole_pairs"}},
      {"commutation_offset", {offset_turns - std::floor(offset_turns), "commutation.offset_rad"}},
      {"setpoint_torque", {d.setpoint_nm, "scenes.setpoint_nm"}},
      {"membrane_lower", {d.membrane_lower_rad / q, "scenes.membrane_lower_rad"}},
      {"membrane_upper", {d.membrane_upper_rad / q, "scenes.membrane_upper_rad"}},
      {"membrane_torque", {d.membrane_nm, "scenes.membrane_nm"}},
      {"compression_contact", {d.compression_contact_rad / q, "scenes.compression_contact_rad"}},
      {"compression_stiffness", {d.compression_nm_rad * q, "scenes.compression_nm_rad"}},
      {"tension_rest", {d.tension_rest_rad / q, "scenes.tension_rest_rad"}},
      {"tension_stiffness", {d.tension_nm_rad * q, "scenes.tension_nm_rad"}},
      {"damper_damping", {d.damper_nm_s_rad, "scenes.damper_nm_s_rad"}},
      {"attract_centre", {std::round(d.charge_centre_rad / q), "scenes.charge_centre_rad"}},
      {"attract_strength", {charge, "scenes.charge_nm_rad2"}},
      {"attract_core", {core, "scenes.charge_core_rad"}},
      {"attract_core_slope", {core_slope, "scenes.charge_core_rad"}},
      {"repel_centre", {std::round(d.charge_centre_rad / q), "scenes.charge_centre_rad"}},
      {"repel_strength", {charge, "scenes.charge_nm_rad2"}},
      {"repel_core", {core, "scenes.charge_core_rad"}},
      {"repel_core_slope", {core_slope, "scenes.charge_core_rad"}},
      {"wall_contact", {d.wall_contact_rad / q, "scenes.wall_contact_rad"}},
      {"wall_stiffness", {d.wall_nm_rad * q, "scenes.wall_nm_rad"}},
      {"wall_damping", {d.wall_nm_s_rad, "scenes.wall_nm_s_rad"}},
  };
}

namespace {

/// Of a word that has a signal's format. The heat's follow from the current's estimate, whose
/// coefficients are before them in the register map.
Format signal_format(const Elaborated& e, const Parameter& p) {
  const Design& d = e.design;
  BaseFormats base{};
  if (p.signal == "current_squared" || p.signal == "i2t") {
    base.velocity = d.velocity;
    base.current = d.current;
    base.voltage = d.voltage;
    base.inverse_resistance = e.word("inverse_resistance").format;
    base.emf_over_resistance = e.word("emf_over_resistance").format;
  }
  const Formats f = derive(base);
  const std::map<std::string, Format> signals{
      {"velocity", d.velocity},
      {"torque", d.torque},
      {"current", d.current},
      {"voltage", d.voltage},
      {"ramp", growth::with_fraction(d.torque, f.ramp.fraction)},
      {"current_squared", f.current_squared},
      {"i2t", f.i2t},
      {"charge", f.charge}};
  const auto it = signals.find(p.signal);
  if (it == signals.end()) {
    throw config::ConfigError(
        fmt::format("{}: signal format \"{}\" is unknown; use that of a signal of the chain",
                    p.place, p.signal));
  }
  return it->second;
}

std::string text(double v) { return fmt::format("{:.6g}", v); }

std::string text(Format f) { return fmt::format("[{},{},{}]", f.sign, f.integer, f.fraction); }

void check_fits(const Design& d, const char* key, const char* what, int width, int bits) {
  if (width <= bits) return;
  d.fail(key, fmt::format("{} takes {} bits and the fabric has {}", what, width, bits),
         "use fewer integer or fraction bits");
}

/// Checks the widths of the signals first, because the arithmetic holds no wider ones.
void check_signal_widths(const Design& d) {
  check_fits(d, "formats.velocity", "the velocity", d.velocity.width(), fabric::word_bits);
  check_fits(d, "formats.torque", "the torque", d.torque.width(), fabric::word_bits);
  check_fits(d, "formats.current", "the current", d.current.width(), fabric::word_bits);
  check_fits(d, "formats.voltage", "the voltage", d.voltage.width(), fabric::word_bits);
  if (d.supply_v >= std::ldexp(1.0, d.voltage.integer)) {
    d.fail("pwm.supply_v",
           fmt::format("the supply of {} V does not fit the voltage's format {}", text(d.supply_v),
                       text(d.voltage)),
           "lower it, or use more integer bits");
  }
}

void check_resolution(const Elaborated& e) {
  const Design& d = e.design;
  const auto coarse = [&](const char* key, Format f, int wanted, const char* unit) {
    if (f.fraction >= wanted) return;
    d.fail(key, fmt::format("an LSB of 2^-{} {} is too coarse", f.fraction, unit),
           fmt::format("use at least {} fraction bits", wanted));
  };
  coarse("formats.velocity", d.velocity, 10, "rad/s");
  coarse("formats.torque", d.torque, 16, "Nm");
  // A rounding filter stops within half an LSB divided by a1 of its final value. That must be less
  // than half an LSB of the promised resolution.
  const auto guard = [&](const char* key, const Word& pole, int fraction, int wanted) {
    const int need = wanted + static_cast<int>(std::ceil(-std::log2(pole.si)));
    if (fraction >= need) return;
    d.fail(key,
           fmt::format("the filter's state has {} fraction bits and its pole {} needs {}", fraction,
                       text(pole.si), need),
           "add fraction bits or raise " + pole.key);
  };
  guard("formats.velocity", e.word("velocity_a1"), d.velocity.fraction, 10);
  guard("formats.observer_fraction", e.word("observer_a1"), d.observer_fraction, d.torque.fraction);
  constexpr int fewest_steps = 4;
  if (e.word("nominal_current_squared").raw < fewest_steps) {
    d.fail("supervisor.nominal_current_a",
           fmt::format(
               "the square of the nominal current is below {} steps of {} A^2, those of a motor "
               "with currents of up to {} A",
               fewest_steps, text(std::ldexp(1.0, -e.formats.current_squared.fraction)),
               text(std::ldexp(1.0, e.formats.current_estimate.integer))),
           "use fewer integer bits of the velocity or the current");
  }
}

double pi_over(double n) { return 3.14159265358979323846 / n; }

void check_widths(const Elaborated& e) {
  const Design& d = e.design;
  const Formats& f = e.formats;
  if (d.torque.fraction >= f.ramp.fraction) {
    d.fail("formats.torque",
           fmt::format("the torque has {} fraction bits and the ramp moves in steps of 2^-{}",
                       d.torque.fraction, f.ramp.fraction),
           fmt::format("use at most {}", f.ramp.fraction - 1));
  }
  if (d.torque.integer < 0) {
    d.fail("formats.torque", "a charge pushes with up to 1 Nm", "use at least 0 integer bits");
  }
  if (d.mt) {
    // The dividend of span_meter.sv: up to 8 half counts of each cycle, 26 bits of time stamps.
    const double half =
        std::ldexp(pi_over(4.0 * d.lines) * static_cast<double>(d.clock_hz), d.velocity.fraction);
    if (half * 8 * d.mt_cycles >= std::ldexp(1.0, 25 + d.velocity.width())) {
      d.fail("formats.velocity", "the quotient of M/T has more bits than the velocity",
             "use more integer bits, or fewer velocity.cycles");
    }
  } else if (d.velocity.integer - (d.exact_gain ? 0 : d.n) > fabric::travel_bits - 1) {
    d.fail("formats.velocity", "no count reaches the velocity's top bits",
           "use fewer integer bits");
  }
  constexpr double most_counts = 60;
  if (!d.absolute && d.counts_per_tick() > most_counts) {
    d.fail("supervisor.overspeed_rad_s",
           fmt::format("at this speed {:.3g} counts come in a tick, and {:g} may",
                       d.counts_per_tick(), most_counts),
           fmt::format("choose {:.4g} or less",
                       d.overspeed_rad_s * most_counts / d.counts_per_tick()));
  }
  if (f.observed.integer + 1 < d.torque.integer) {
    d.fail("formats.torque", "nothing that is observed reaches the torque's top bits",
           "use fewer integer bits of torque");
  }
  const auto fits = [&](const char* key, const char* what, int width, int bits) {
    check_fits(d, key, what, width, bits);
  };
  fits("formats.torque", "the ramped torque", f.ramp.width(), fabric::word_bits);
  fits("formats.observer_fraction", "the observer's state", f.observer.width(), 62);
  // One limiter of the current's width also limits torque, voltage and duty.
  for (const auto& [what, format] :
       {std::pair{"torque", d.torque}, {"voltage", d.voltage}, {"duty", f.duty}}) {
    if (format.width() <= d.current.width()) continue;
    d.fail("formats.current",
           fmt::format("the limiter is as wide as the current, {} bits, and the {} has {}",
                       d.current.width(), what, format.width()),
           "add bits to the current");
  }
}

/// Checks that every narrowing drops bits and never has to add any.
void check_drops(const Elaborated& e) {
  const Design& d = e.design;
  const Formats& f = e.formats;
  const auto drops = [&](const char* key, Format a, const Word& b, int wanted) {
    const int fraction = a.fraction + b.format.fraction;
    if (fraction >= wanted) return;
    d.fail(key,
           fmt::format("the product with {} has {} fraction bits and its sum takes {}",
                       b.parameter.name, fraction, wanted),
           "lower this, or the value of " + b.key);
  };
  drops("formats.observer_fraction", d.current, e.word("torque_constant"), d.observer_fraction);
  drops("formats.observer_fraction", d.velocity, e.word("inertia_gain"), d.observer_fraction);
  drops("formats.current", d.torque, e.word("torque_gain"), d.current.fraction);
  drops("formats.current", d.torque, e.word("observer_gain"), d.current.fraction);
  drops("formats.voltage", d.current, e.word("voltage_gain"), d.voltage.fraction);
  drops("formats.voltage", d.velocity, e.word("emf_constant"), d.voltage.fraction);
  drops("formats.voltage", d.torque, e.word("dead_voltage_slope"), d.voltage.fraction);
  drops("formats.current", d.voltage, e.word("voltage_to_current"), d.current.fraction);
  drops("formats.voltage", d.voltage, e.word("inverse_resistance"),
        f.current_estimate_part.fraction);
  drops("formats.velocity", d.velocity, e.word("emf_over_resistance"),
        f.current_estimate_part.fraction);
  // A rounding step needs at least one bit to round off.
  drops("formats.observer_fraction", f.observer_difference, e.word("observer_a1"),
        d.observer_fraction + 1);
  drops("formats.velocity", f.velocity_difference, e.word("velocity_a1"), d.velocity.fraction + 1);
  drops("formats.voltage", d.voltage, e.word("duty_gain"), 1);
  const int scene_fraction = f.scene_part.fraction;
  for (const char* stiffness : {"compression_stiffness", "tension_stiffness", "wall_stiffness",
                                "attract_core_slope", "repel_core_slope"}) {
    drops("formats.torque", f.scene_distance, e.word(stiffness), scene_fraction);
  }
  for (const char* damping : {"damper_damping", "wall_damping"}) {
    drops("formats.torque", d.velocity, e.word(damping), scene_fraction);
  }
  if (d.observer_fraction <= d.torque.fraction) {
    d.fail("formats.observer_fraction",
           fmt::format("the observer has {} fraction bits and its torque takes {}",
                       d.observer_fraction, d.torque.fraction),
           "add fraction bits");
  }
}

[[noreturn]] void refuse(const Design& d, const Word& w) {
  d.fail(w.key,
         fmt::format("{} = {} {} does not fit its word {}", w.parameter.name, text(w.si),
                     w.parameter.unit, text(w.format)),
         fmt::format("choose a value that makes it {}", w.si < 0 ? "larger" : "smaller"));
}

/// The integer of a word; a value that does not lie far inside 64 bits is refused.
std::int64_t quantised_word(const Design& d, const Word& w) {
  const double scaled = std::ldexp(w.si, w.format.fraction);
  if (!(std::abs(scaled) < 0x1p62)) refuse(d, w);
  return std::llround(scaled);
}

void check_word(const Design& d, const Word& w) {
  const bool coefficient = w.parameter.kind == "coefficient" || w.parameter.kind == "signed";
  if (coefficient && w.raw == 0 && w.si != 0) {
    const bool pole = w.parameter.name == "velocity_a1" || w.parameter.name == "observer_a1";
    d.fail(w.key,
           w.parameter.name + " = " + text(w.si) + " quantises to 0" +
               (pole ? " and the filter would stand still" : ""),
           pole ? "raise the cut-off or lower tick_hz" : "raise it, or set it to 0");
  }
  for (const Format f : {w.format, w.field()}) {
    const std::int64_t high = (std::int64_t{1} << (f.width() - f.sign)) - 1;
    const std::int64_t low = f.sign == 1 ? -high - 1 : 0;
    if (w.raw > high || w.raw < low) refuse(d, w);
  }
  if (coefficient && w.format.fraction < 0) refuse(d, w);
}

void check(const Elaborated& e) {
  const Design& d = e.design;
  for (const Word& w : e.words) check_word(d, w);
  if (d.clocks_per_tick() < least_tick_clocks) {
    d.fail("clock.tick_hz",
           fmt::format("the chain takes {} clocks and a tick has {}", least_tick_clocks,
                       d.clocks_per_tick()),
           "lower tick_hz or raise clock_hz");
  }
  if (!d.allow_coarse) check_resolution(e);
  check_widths(e);
  if (d.current_loop) check_current_loop(d);
  if (d.absolute) check_absolute_encoder(d);
  check_commutation(d);
  check_drops(e);
}

}  // namespace

Format coefficient_format(double value, bool is_signed) {
  constexpr int mantissa = coefficient_bits;
  const int least_integer = mantissa - coefficient_fraction_max;
  const double magnitude = std::abs(value);
  if (magnitude == 0) return {is_signed ? 1 : 0, 0, mantissa};
  int integer = std::max(least_integer, std::ilogb(magnitude) + 1);
  // A value that rounds up to the next power of two needs one more integer bit.
  if (std::llround(std::ldexp(magnitude, mantissa - integer)) >> mantissa != 0) ++integer;
  return {is_signed ? 1 : 0, integer, mantissa - integer};
}

Format Word::field() const {
  const Parameter& p = parameter;
  if (p.kind == "coefficient" || p.kind == "signed") {
    return {format.sign, coefficient_bits - format.fraction, format.fraction};
  }
  // The top bit says that a word is negative, also of a format without a sign.
  if (p.kind == "limit") return {0, format.width() - 1 - format.fraction, format.fraction};
  if (p.kind == "integer") return {0, p.bits, 0};
  return format;
}

double Word::quantised() const { return std::ldexp(static_cast<double>(raw), -format.fraction); }

double Word::relative_error() const { return si == 0 ? 0.0 : (quantised() - si) / si; }

double Elaborated::rad_s_per_count() const {
  return velocity_gain == 0
             ? std::ldexp(1.0, design.n)
             : std::ldexp(static_cast<double>(velocity_gain), -base.velocity_gain.fraction);
}

const Word& Elaborated::word(const std::string& name) const {
  for (const Word& w : words) {
    if (w.parameter.name == name) return w;
  }
  throw config::ConfigError(
      fmt::format("{}:0: parameter \"{}\" is missing; add it", registers.path, name));
}

Elaborated elaborate(const Design& design, const RegisterMap& registers) {
  Elaborated e;
  e.design = design;
  e.registers = registers;
  check_signal_widths(design);
  for (const std::string& scene : design.scenes) {
    if (registers.scene_number(scene) >= 0) continue;
    const auto known = registers.scene_names();
    design.fail("scenes.include", fmt::format("scene \"{}\" is unknown", scene),
                fmt::format("{}choose among {}", config::did_you_mean(scene, known),
                            fmt::join(known, ", ")));
  }
  const auto values = parameter_values(design);
  const auto value_of = [&](const Parameter& p, const std::string& name) {
    const auto it = values.find(name);
    if (it != values.end()) return it->second;
    throw config::ConfigError(
        fmt::format("{}: no design gives a value to \"{}\"; add it to model/design/elaborate.cpp",
                    p.place, name));
  };
  for (const Parameter& p : registers.parameters) {
    if (p.option == "three_phases" && design.phases != 3) continue;
    const Value value = value_of(p, p.name);
    Word w{p, value.key, {}, value.si, 0};
    if (p.kind == "coefficient" || p.kind == "signed") {
      // Parameters that share a format use the format of the largest value.
      double largest = w.si;
      if (!p.same_format_as.empty()) {
        largest = std::max(largest, value_of(p, p.same_format_as).si);
      }
      for (const Parameter& o : registers.parameters) {
        if (o.same_format_as == p.name) largest = std::max(largest, value_of(o, o.name).si);
      }
      if (!(std::abs(largest) < 1e30)) {
        design.fail(w.key, fmt::format("{} = {} fits no word", p.name, text(largest)),
                    "choose a value that makes it smaller");
      }
      w.format = coefficient_format(std::ldexp(largest, p.headroom_bits), p.kind == "signed");
    } else if (p.kind == "signal" || p.kind == "limit") {
      w.format = signal_format(e, p);
    } else if (p.kind == "counts") {
      w.format = {1, 17, 8};
    } else if (p.kind == "angle") {
      w.format = {0, 0, 32};
    } else {
      // The block judges what saturates; the limiter takes the others, as wide as the current.
      w.format = {0, p.saturates ? 31 : std::min(p.bits, design.current.width() - 1), 0};
    }
    w.raw = quantised_word(design, w);
    if (p.saturates) w.raw = std::min(w.raw, (std::int64_t{1} << p.bits) - 1);
    e.words.push_back(w);
  }
  const auto f = [&](const char* name) { return e.word(name).format; };
  Format gain{0, 0, coefficient_bits};
  if (design.exact_gain) {
    gain = coefficient_format(design.velocity_gain_rad_s(), false);
    e.velocity_gain = std::llround(std::ldexp(design.velocity_gain_rad_s(), gain.fraction));
  }
  e.base = {design.velocity,          design.torque,
            design.current,           design.voltage,
            design.observer_fraction, design.n,
            design.exact_gain,        gain,
            f("velocity_a1"),         f("torque_constant"),
            f("inertia_gain"),        f("observer_a1"),
            f("torque_gain"),         f("observer_gain"),
            f("voltage_gain"),        f("emf_constant"),
            f("dead_voltage_slope"),  f("voltage_to_current"),
            f("duty_gain"),           f("inverse_resistance"),
            f("emf_over_resistance"), f("compression_stiffness"),
            f("tension_stiffness"),   f("attract_core_slope"),
            f("repel_core_slope"),    f("wall_stiffness"),
            f("damper_damping"),      f("wall_damping")};
  e.formats = derive(e.base);
  check(e);
  return e;
}

}  // namespace feltgate::design
