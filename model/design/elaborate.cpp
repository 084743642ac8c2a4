// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// From SI values to integers: the value of every parameter, its format, and the checks that refuse
// a design which cannot work. Documentation: docs/designs.md
#include <cmath>
#include <functional>
#include <map>

#include "design/design.hpp"

namespace feltgate::design {

namespace {

double low_pass_a1(double cutoff_rad_s, double tick_s) { return -std::expm1(-cutoff_rad_s * tick_s); }

/// Value of every parameter in its unit, by name.
std::map<std::string, double> parameter_values(const Design& d) {
  const double q = d.count_rad();
  const bool model = d.voltage_law == "motor_model";
  const double jk = d.inertia_kg_m2 * d.kp_1_kg_m2;
  const double one_ohm = 1.0;
  const double tick_hz = static_cast<double>(d.tick_hz);
  const double observer_part = 1.0 - jk;
  // Each leg that switches turns on late by the dead time, and meanwhile the current flows through
  // diodes; the lost voltage opposes the current like a brush drop and is given back by the same law.
  const double legs = d.pwm_mode == 1 ? 2.0 : 1.0;
  const double dead_v = (model ? d.dead_voltage_v : 0.0) +
                        (d.compensate_dead_time ? legs * (d.supply_v + 2 * d.diode_drop_v) * d.dead_clocks() / d.pwm_period_clocks() : 0.0);
  const double core_slope =
      d.charge_core_rad > 0 ? d.charge_nm_rad2 / std::pow(d.charge_core_rad, 3) * q : 0.0;
  const double charge = d.charge_nm_rad2 / (q * q);
  // |x| < core on whole counts is |x| < ceil(core).
  const double core = std::ceil(d.charge_core_rad / q);
  return {
      {"velocity_a1", low_pass_a1(d.velocity_cutoff_rad_s, d.tick_s())},
      {"observer_a1", low_pass_a1(d.observer_cutoff_rad_s, d.tick_s())},
      {"inverse_resistance", 1.0 / d.resistance_ohm},
      {"emf_over_resistance", d.emf_constant_v_s_rad / d.resistance_ohm},
      {"torque_constant", d.torque_constant_nm_a},
      {"inertia_gain", d.observer_cutoff_rad_s * d.inertia_kg_m2},
      {"nominal_current_squared", d.nominal_current_a * d.nominal_current_a},
      {"overspeed", d.overspeed_rad_s},
      {"i2t_budget", d.i2t_budget_a2_s * tick_hz},
      {"polarity_speed", d.polarity_speed_rad_s},
      {"polarity_current", d.polarity_current_a},
      {"polarity_ticks", std::ceil(d.polarity_time_s * tick_hz)},
      {"emf_constant", model ? d.emf_constant_v_s_rad : 0.0},
      {"observer_gain", std::abs(observer_part) < 1e-12 ? 0.0 : observer_part / d.torque_constant_nm_a},
      {"voltage_setpoint", 0.0},
      {"torque_limit", d.torque_limit_nm},
      {"ramp_step", d.ramp_nm_s / tick_hz},
      {"voltage_to_current", model ? 1.0 / d.resistance_ohm : 1.0 / one_ohm},
      {"torque_gain", jk / d.torque_constant_nm_a},
      {"dead_voltage_slope", dead_v / d.dead_voltage_linear_nm},
      {"region_torque", model ? d.torque_limit_nm : d.region_nm},
      {"current_limit", d.current_limit_a},
      {"voltage_gain", model ? d.resistance_ohm : d.kv_low * one_ohm},
      {"voltage_gain_high", model ? d.resistance_ohm : d.kv_high * one_ohm},
      {"dead_voltage", dead_v},
      {"voltage_limit", d.supply_v},
      {"duty_gain", d.pwm_period_clocks() / d.supply_v},
      {"duty_limit", static_cast<double>(d.pwm_period_clocks())},
      {"watchdog_ticks", std::ceil(d.watchdog_s * tick_hz)},
      {"setpoint_torque", d.setpoint_nm},
      {"membrane_lower", d.membrane_lower_rad / q},
      {"membrane_upper", d.membrane_upper_rad / q},
      {"membrane_torque", d.membrane_nm},
      {"compression_contact", d.compression_contact_rad / q},
      {"compression_stiffness", d.compression_nm_rad * q},
      {"tension_rest", d.tension_rest_rad / q},
      {"tension_stiffness", d.tension_nm_rad * q},
      {"damper_damping", d.damper_nm_s_rad},
      {"attract_centre", std::round(d.charge_centre_rad / q)},
      {"attract_strength", charge},
      {"attract_core", core},
      {"attract_core_slope", core_slope},
      {"repel_centre", std::round(d.charge_centre_rad / q)},
      {"repel_strength", charge},
      {"repel_core", core},
      {"repel_core_slope", core_slope},
  };
}

Format signal_format(const Design& d, const std::string& name) {
  const Formats f = derive(BaseFormats{});
  const std::map<std::string, Format> signals{
      {"velocity", d.velocity}, {"torque", d.torque}, {"current", d.current},
      {"voltage", d.voltage}, {"ramp", growth::with_fraction(d.torque, f.ramp.fraction)},
      {"current_squared", f.current_squared}, {"i2t", f.i2t}, {"charge", f.charge}};
  const auto it = signals.find(name);
  if (it == signals.end()) throw DesignError("rtl/registers.toml: unknown signal format " + name);
  return it->second;
}

std::int64_t quantise(double si, Format f) {
  return std::llround(std::ldexp(si, f.fraction));
}

void refuse(const Design& d, const std::string& what) { throw DesignError(d.path + ": " + what); }

void check(const Elaborated& e) {
  const Design& d = e.design;
  for (const char* pole : {"velocity_a1", "observer_a1"}) {
    if (e.word(pole).raw == 0) {
      refuse(d, std::string("the pole of ") + pole + " quantises to 0 and the filter would stand "
                "still; raise the cut-off or lower the tick rate");
    }
  }
  if (d.clocks_per_tick() < latency_clocks + 4) {
    refuse(d, "the chain takes " + std::to_string(latency_clocks + 4) + " clocks and a tick has " +
                  std::to_string(d.clocks_per_tick()) + "; lower tick_hz or raise clock_hz");
  }
  if (d.velocity.fraction < 10) refuse(d, "velocity is coarser than 2^-10 rad/s; raise its fraction bits");
  if (d.torque.fraction < 16) refuse(d, "torque is coarser than 2^-16 Nm; raise its fraction bits");
  const auto guard = [&](const char* name, double a1, int fraction, int wanted) {
    const int need = wanted + static_cast<int>(std::ceil(-std::log2(a1)));
    if (fraction < need) {
      refuse(d, std::string(name) + " has " + std::to_string(fraction) + " fraction bits and its pole "
                "needs " + std::to_string(need) + " (a dead band under half an LSB); add the bits");
    }
  };
  guard("formats.velocity", e.word("velocity_a1").si, d.velocity.fraction, 10);
  guard("formats.observer_fraction", e.word("observer_a1").si, d.observer_fraction, d.torque.fraction);
  const auto fits = [&](const char* name, Format f, int bits) {
    if (f.width() > bits) {
      refuse(d, std::string(name) + " would take " + std::to_string(f.width()) + " bits and the fabric has " +
                    std::to_string(bits) + "; use fewer integer or fraction bits");
    }
  };
  fits("velocity", d.velocity, fabric::word_bits);
  fits("torque", d.torque, fabric::multiplier_a_bits);
  fits("the observer's state", e.formats.observer, 62);
  fits("the current estimate", e.formats.current_estimate, fabric::multiplier_b_bits);
  for (const Word& w : e.words) {
    const bool negative_ok = w.format.sign == 1;
    const std::int64_t high = (std::int64_t{1} << (w.format.width() - w.format.sign)) - 1;
    if (w.raw > high || w.raw < (negative_ok ? -high - 1 : 0)) {
      refuse(d, w.parameter.name + " = " + std::to_string(w.si) + " " + w.parameter.unit +
                    " does not fit its word; choose a smaller value");
    }
  }
}

}  // namespace

Format coefficient_format(double value, bool is_signed) {
  constexpr int mantissa = fabric::multiplier_b_bits - 1;
  const double magnitude = std::abs(value);
  int integer = magnitude > 0 ? static_cast<int>(std::floor(std::log2(magnitude))) + 1 : 0;
  // A value that would round up to the next power of two needs that power's place.
  if (magnitude > 0 && std::llround(std::ldexp(magnitude, mantissa - integer)) >> mantissa != 0) {
    ++integer;
  }
  return {is_signed ? 1 : 0, integer, mantissa - integer};
}

double Word::quantised() const { return std::ldexp(static_cast<double>(raw), -format.fraction); }

double Word::relative_error() const { return si == 0 ? 0.0 : (quantised() - si) / si; }

const Word& Elaborated::word(const std::string& name) const {
  for (const Word& w : words) {
    if (w.parameter.name == name) return w;
  }
  throw DesignError("rtl/registers.toml: no parameter is called " + name);
}

Elaborated elaborate(const Design& design, const RegisterMap& registers) {
  Elaborated e;
  e.design = design;
  e.registers = registers;
  for (const std::string& scene : design.scenes) {
    if (registers.scene_number(scene) < 0) {
      refuse(design, "scene \"" + scene + "\" is unknown; see [[scene]] in rtl/registers.toml");
    }
  }
  const auto values = parameter_values(design);
  for (const Parameter& p : registers.parameters) {
    const auto it = values.find(p.name);
    if (it == values.end()) throw DesignError("no value is defined for parameter " + p.name);
    Word w;
    w.parameter = p;
    w.si = it->second;
    if (!p.same_format_as.empty()) {
      w.format = coefficient_format(std::max(w.si, values.at(p.same_format_as)), false);
    } else if (p.kind == "coefficient" || p.kind == "signed") {
      double largest = w.si;
      for (const Parameter& o : registers.parameters) {
        if (o.same_format_as == p.name) largest = std::max(largest, values.at(o.name));
      }
      w.format = coefficient_format(largest, p.kind == "signed");
    } else if (p.kind == "signal") {
      w.format = signal_format(design, p.signal);
    } else if (p.kind == "counts") {
      w.format = {1, 17, 8};
    } else {
      w.format = {0, 31, 0};
    }
    w.raw = quantise(w.si, w.format);
    e.words.push_back(w);
  }
  const auto f = [&](const char* name) { return e.word(name).format; };
  e.base = {design.velocity, design.torque, design.current, design.voltage,
            design.observer_fraction, design.n, f("velocity_a1"), f("torque_constant"),
            f("inertia_gain"), f("observer_a1"), f("torque_gain"), f("observer_gain"),
            f("voltage_gain"), f("emf_constant"), f("dead_voltage_slope"), f("voltage_to_current"),
            f("duty_gain"), f("inverse_resistance"), f("emf_over_resistance")};
  e.formats = derive(e.base);
  check(e);
  return e;
}

}  // namespace feltgate::design
