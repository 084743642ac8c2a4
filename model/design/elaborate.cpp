// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// From SI values to integers: the value of every parameter, its format, and the checks that refuse
// a design which cannot work. Documentation: docs/designs.md
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>

#include "config/toml_reader.hpp"
#include "design/design.hpp"

namespace feltgate::design {

namespace {

double low_pass_a1(double cutoff_rad_s, double tick_s) {
  return -std::expm1(-cutoff_rad_s * tick_s);
}

/// A parameter's value in its unit and the key of the design file that decides it.
struct Value {
  double si;
  const char* key;
};

std::map<std::string, Value> parameter_values(const Design& d) {
  const double q = d.count_rad();
  const bool model = d.voltage_law == "motor_model";
  const double jk = d.inertia_kg_m2 * d.kp_1_kg_m2;
  const double one_ohm = 1.0;
  const double tick_hz = static_cast<double>(d.tick_hz);
  const double observer_part = 1.0 - jk;
  // Each leg that switches turns on late by the dead time, and meanwhile the current flows through
  // diodes; the lost voltage opposes the current like a brush drop: the same law gives it back.
  const double legs = d.pwm_mode == 1 ? 2.0 : 1.0;
  const double lost_v =
      legs * (d.supply_v + 2 * d.diode_drop_v) * d.dead_clocks() / d.pwm_period_clocks();
  const double dead_v = (model ? d.dead_voltage_v : 0.0) + (d.compensate_dead_time ? lost_v : 0.0);
  const double core_slope =
      d.charge_core_rad > 0 ? d.charge_nm_rad2 / std::pow(d.charge_core_rad, 3) * q : 0.0;
  const double charge = d.charge_nm_rad2 / (q * q);
  // |x| < core on whole counts is |x| < ceil(core).
  const double core = std::ceil(d.charge_core_rad / q);
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
      {"emf_constant", {model ? d.emf_constant_v_s_rad : 0.0, "motor.emf_constant_v_s_rad"}},
      {"observer_gain",
       {std::abs(observer_part) < 1e-12 ? 0.0 : observer_part / d.torque_constant_nm_a,
        "observer.torque_constant_nm_a"}},
      {"voltage_setpoint", {0.0, "voltage.law"}},
      {"torque_limit", {d.torque_limit_nm, "control.torque_limit_nm"}},
      {"ramp_step", {d.ramp_nm_s / tick_hz, "control.ramp_nm_s"}},
      {"voltage_to_current",
       {model ? 1.0 / d.resistance_ohm : 1.0 / one_ohm, "motor.resistance_ohm"}},
      {"torque_gain", {jk / d.torque_constant_nm_a, "control.kp_1_kg_m2"}},
      {"dead_voltage_slope", {dead_v / d.dead_voltage_linear_nm, "voltage.dead_voltage_linear_nm"}},
      {"region_torque", {model ? d.torque_limit_nm : d.region_nm, "voltage.region_nm"}},
      {"current_limit", {d.current_limit_a, "control.current_limit_a"}},
      {"voltage_gain",
       {model ? d.resistance_ohm : d.kv_low * one_ohm,
        model ? "motor.resistance_ohm" : "voltage.kv_low"}},
      {"voltage_gain_high",
       {model ? d.resistance_ohm : d.kv_high * one_ohm,
        model ? "motor.resistance_ohm" : "voltage.kv_high"}},
      {"dead_voltage", {dead_v, "voltage.dead_voltage_v"}},
      {"voltage_limit", {d.supply_v, "pwm.supply_v"}},
      {"duty_gain", {d.pwm_period_clocks() / d.supply_v, "pwm.supply_v"}},
      {"duty_limit", {static_cast<double>(d.pwm_period_clocks()), "pwm.frequency_hz"}},
      {"watchdog_ticks", {std::ceil(d.watchdog_s * tick_hz), "supervisor.watchdog_s"}},
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

Format signal_format(const Design& d, const Parameter& p) {
  const Formats f = derive(BaseFormats{});
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
    throw config::ConfigError(p.place + ": signal format \"" + p.signal +
                              "\" is unknown; use that of a signal of the chain");
  }
  return it->second;
}

std::string text(double v) {
  char text[32];
  std::snprintf(text, sizeof text, "%.6g", v);
  return text;
}

std::string text(Format f) {
  return "[" + std::to_string(f.sign) + "," + std::to_string(f.integer) + "," +
         std::to_string(f.fraction) + "]";
}

void check_resolution(const Elaborated& e) {
  const Design& d = e.design;
  const auto coarse = [&](const char* key, Format f, int wanted, const char* unit) {
    if (f.fraction >= wanted) return;
    d.fail(key, "an LSB of 2^-" + std::to_string(f.fraction) + " " + unit + " is too coarse",
           "use at least " + std::to_string(wanted) + " fraction bits");
  };
  coarse("formats.velocity", d.velocity, 10, "rad/s");
  coarse("formats.torque", d.torque, 16, "Nm");
  // A rounding filter stands still within half an LSB over a1: that must stay below half an LSB of
  // what the filter promises.
  const auto guard = [&](const char* key, const Word& pole, int fraction, int wanted) {
    const int need = wanted + static_cast<int>(std::ceil(-std::log2(pole.si)));
    if (fraction >= need) return;
    d.fail(key,
           "the filter's state has " + std::to_string(fraction) + " fraction bits and its pole " +
               text(pole.si) + " needs " + std::to_string(need),
           "add fraction bits or raise " + pole.key);
  };
  guard("formats.velocity", e.word("velocity_a1"), d.velocity.fraction, 10);
  guard("formats.observer_fraction", e.word("observer_a1"), d.observer_fraction, d.torque.fraction);
}

void check_widths(const Elaborated& e) {
  const Design& d = e.design;
  const Formats& f = e.formats;
  if (d.torque.fraction >= f.ramp.fraction) {
    d.fail("formats.torque",
           "the torque has " + std::to_string(d.torque.fraction) +
               " fraction bits and the ramp moves in steps of 2^-" +
               std::to_string(f.ramp.fraction),
           "use at most " + std::to_string(f.ramp.fraction - 1));
  }
  if (d.torque.integer < 0) {
    d.fail("formats.torque", "a charge pushes with up to 1 Nm", "use at least 0 integer bits");
  }
  if (d.velocity.integer - (d.exact_gain ? 0 : d.n) > fabric::travel_bits - 1) {
    d.fail("formats.velocity", "no count reaches the velocity's top bits",
           "use fewer integer bits");
  }
  if (f.observed.integer + 1 < d.torque.integer) {
    d.fail("formats.torque", "nothing that is observed reaches the torque's top bits",
           "use fewer integer bits of torque");
  }
  const auto fits = [&](const char* key, const char* what, int width, int bits) {
    if (width <= bits) return;
    d.fail(key,
           std::string(what) + " takes " + std::to_string(width) + " bits and the fabric has " +
               std::to_string(bits),
           "use fewer integer or fraction bits");
  };
  fits("formats.velocity", "the velocity", d.velocity.width(), fabric::word_bits);
  fits("formats.torque", "the ramped torque", f.ramp.width(), fabric::word_bits);
  fits("formats.current", "the current", d.current.width(), fabric::word_bits);
  fits("formats.voltage", "the voltage", d.voltage.width(), fabric::word_bits);
  fits("formats.observer_fraction", "the observer's state", f.observer.width(), 62);
  fits("motor.resistance_ohm", "the current estimate", f.current_estimate.width(),
       fabric::multiplier_b_bits);
  fits("motor.resistance_ohm", "the square of the current estimate's integer part",
       2 * f.current_estimate.integer, f.current_squared.integer);
  // One limiter, as wide as the current, limits torque, voltage and duty too.
  for (const auto& [what, format] :
       {std::pair{"torque", d.torque}, {"voltage", d.voltage}, {"duty", f.duty}}) {
    if (format.width() <= d.current.width()) continue;
    d.fail("formats.current",
           "the limiter is as wide as the current, " + std::to_string(d.current.width()) +
               " bits, and the " + what + " has " + std::to_string(format.width()),
           "add bits to the current");
  }
}

/// Narrowing drops bits, it never invents them.
void check_drops(const Elaborated& e) {
  const Design& d = e.design;
  const Formats& f = e.formats;
  const auto drops = [&](const char* key, Format a, const Word& b, int wanted) {
    const int fraction = a.fraction + b.format.fraction;
    if (fraction >= wanted) return;
    d.fail(key,
           "the product with " + b.parameter.name + " has " + std::to_string(fraction) +
               " fraction bits and its sum takes " + std::to_string(wanted),
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
  // Where it rounds, there is a bit to round off.
  drops("formats.observer_fraction", f.observer_difference, e.word("observer_a1"),
        d.observer_fraction + 1);
  drops("formats.velocity", f.velocity_difference, e.word("velocity_a1"), d.velocity.fraction + 1);
  drops("formats.voltage", d.voltage, e.word("duty_gain"), 1);
  drops("formats.torque", f.scene_offset, e.word("compression_stiffness"), d.torque.fraction + 1);
  drops("formats.torque", f.scene_offset, e.word("tension_stiffness"), d.torque.fraction + 1);
  drops("formats.torque", d.velocity, e.word("damper_damping"), d.torque.fraction + 1);
  drops("formats.torque", f.scene_offset, e.word("wall_stiffness"),
        d.torque.fraction + fabric::wall_guard_bits);
  drops("formats.torque", d.velocity, e.word("wall_damping"),
        d.torque.fraction + fabric::wall_guard_bits);
  drops("formats.coefficient_bits", f.scene_offset, e.word("attract_core_slope"),
        f.charge.fraction + 1);
  drops("formats.coefficient_bits", f.scene_offset, e.word("repel_core_slope"),
        f.charge.fraction + 1);
  if (d.observer_fraction <= d.torque.fraction) {
    d.fail("formats.observer_fraction",
           "the observer has " + std::to_string(d.observer_fraction) +
               " fraction bits and its torque takes " + std::to_string(d.torque.fraction),
           "add fraction bits");
  }
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
  const std::int64_t high = (std::int64_t{1} << (w.format.width() - w.format.sign)) - 1;
  const std::int64_t low = w.format.sign == 1 ? -high - 1 : 0;
  if (w.raw > high || w.raw < low || (coefficient && w.format.fraction < 0)) {
    d.fail(w.key,
           w.parameter.name + " = " + text(w.si) + " " + w.parameter.unit +
               " does not fit its word " + text(w.format),
           std::string("choose a value that makes it ") + (w.si < 0 ? "larger" : "smaller"));
  }
}

void check(const Elaborated& e) {
  const Design& d = e.design;
  for (const Word& w : e.words) check_word(d, w);
  if (d.clocks_per_tick() < chain_clocks) {
    d.fail("clock.tick_hz",
           "the chain takes " + std::to_string(chain_clocks) + " clocks and a tick has " +
               std::to_string(d.clocks_per_tick()),
           "lower tick_hz or raise clock_hz");
  }
  if (!d.allow_coarse) check_resolution(e);
  check_widths(e);
  check_drops(e);
}

}  // namespace

Format coefficient_format(double value, bool is_signed, int bits) {
  const int mantissa = bits;
  const int least_integer = mantissa - coefficient_fraction_max;
  const double magnitude = std::abs(value);
  if (magnitude == 0) return {is_signed ? 1 : 0, 0, mantissa};
  int integer = std::max(least_integer, std::ilogb(magnitude) + 1);
  // A value that would round up to the next power of two needs that power's place.
  if (std::llround(std::ldexp(magnitude, mantissa - integer)) >> mantissa != 0) ++integer;
  return {is_signed ? 1 : 0, integer, mantissa - integer};
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
  throw config::ConfigError("rtl/registers.toml:0: parameter " + name + " is missing; add it");
}

Elaborated elaborate(const Design& design, const RegisterMap& registers) {
  Elaborated e;
  e.design = design;
  e.registers = registers;
  for (const std::string& scene : design.scenes) {
    if (registers.scene_number(scene) >= 0) continue;
    std::string known;
    for (const Scene& s : registers.scenes) known += (known.empty() ? "" : ", ") + s.name;
    design.fail("scenes.include", "scene \"" + scene + "\" is unknown", "choose among " + known);
  }
  const auto values = parameter_values(design);
  const auto value_of = [&](const Parameter& p, const std::string& name) {
    const auto it = values.find(name);
    if (it != values.end()) return it->second;
    throw config::ConfigError(p.place + ": no design gives a value to \"" + name +
                              "\"; add it to model/design/elaborate.cpp");
  };
  for (const Parameter& p : registers.parameters) {
    const Value value = value_of(p, p.name);
    Word w{p, value.key, {}, value.si, 0};
    if (p.kind == "coefficient" || p.kind == "signed") {
      // Parameters that share a format share the larger one's.
      double largest = w.si;
      if (!p.same_format_as.empty()) {
        largest = std::max(largest, value_of(p, p.same_format_as).si);
      }
      for (const Parameter& o : registers.parameters) {
        if (o.same_format_as == p.name) largest = std::max(largest, value_of(o, o.name).si);
      }
      w.format = coefficient_format(std::ldexp(largest, p.headroom_bits), p.kind == "signed",
                                    design.coefficient_bits);
    } else if (p.kind == "signal") {
      w.format = signal_format(design, p);
    } else if (p.kind == "counts") {
      w.format = {1, 17, 8};
    } else {
      w.format = {0, 31, 0};
    }
    w.raw = std::llround(std::ldexp(w.si, w.format.fraction));
    e.words.push_back(w);
  }
  const auto f = [&](const char* name) { return e.word(name).format; };
  Format gain{0, 0, design.coefficient_bits};
  if (design.exact_gain) {
    gain = coefficient_format(design.velocity_gain_rad_s(), false, design.coefficient_bits);
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
            f("emf_over_resistance")};
  e.formats = derive(e.base);
  check(e);
  return e;
}

}  // namespace feltgate::design
