// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The design of a plant. Documentation: docs/designs.md
#include "studies/stability/for_plant.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "design/text_edit.hpp"
#include "feltgate/generated/map.hpp"
#include "files/toml/toml_reader.hpp"
#include "studies/stability/loop_poles.hpp"

namespace feltgate::stability {

using namespace design;

namespace {

using plant::Effects;
using plant::Parameters;

constexpr double pi = 3.14159265358979323846;

/// As TOML: a float keeps its point.
std::string number(double value) {
  std::string text = fmt::format("{}", value);
  if (text.find_first_of(".e") == std::string::npos) text += ".0";
  return text;
}

/// A name that can stand in a comment and between quotes.
std::string plain(std::string name) {
  for (char& c : name) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte < ' ' || byte >= 127 || c == '"' || c == '\\') c = '_';
  }
  return name;
}

/// Shorter numbers for what is derived; up or down, never beyond.
double three_digits(double value, double (*direction)(double)) {
  if (value == 0) return 0;
  const double unit = std::pow(10.0, std::floor(std::log10(std::abs(value))) - 2);
  return direction(value / unit) * unit;
}

void set_encoder(const Design& d, int lines, TextEdit& edit) {
  edit.set("encoder", "lines", fmt::format("{}", lines));
  if (lines == d.lines) return;
  if (!d.exact_gain) {
    // A power of two moves the binary point; any other number needs the exact factor.
    const double shift = std::log2(static_cast<double>(d.lines) / lines);
    if (shift == std::floor(shift) && d.n + shift >= 0 && d.n + shift <= 12) {
      edit.set("velocity", "n", fmt::format("{:.0f}", d.n + shift));
    } else {
      edit.replace("velocity", "n", "gain", "\"exact\"");
    }
  }
  const double fastest = d.overspeed_rad_s * d.lines / lines;
  if (lines > d.lines) edit.set("supervisor", "overspeed_rad_s", number(fastest));
}

/// The stiffest wall that friction still quietens is 2*friction/count (docs/stability.md).
std::optional<double> wall_for(const Design& d, const Parameters& p) {
  if (!p.effects.lugre || p.lugre.coulomb_nm <= 0) return {};
  const double stiffest = 2 * p.lugre.coulomb_nm / (2 * pi / (4.0 * p.encoder.lines));
  if (d.wall_nm_rad <= stiffest) return {};
  constexpr double margin = 0.875;  // 4 of 4.56, as in lever
  return three_digits(margin * stiffest, std::floor);
}

/// The same counts of answer to the self-test's pulse: a heavier lever gets a longer pulse, which
/// stays gentle, and a stronger one only where it cannot be longer; a light one a weaker pulse.
void self_test_for(const Design& d, const Parameters& p, TextEdit& edit,
                   std::vector<std::string>* notes) {
  const double more = p.lever.inertia_kg_m2 / d.inertia_kg_m2 * d.lines / p.encoder.lines;
  if (!edit.text_of("self_test", "torque_nm") || std::abs(more - 1) <= noticeable) return;
  constexpr double most_units = (1 << Map::self_test_count_bits) - 1;
  const double own_ms = 1e3 * d.self_test_pulse_s;
  const double longest_ms = std::floor(1e4 * most_units / d.self_test_units(1)) / 10;
  const double pulse_ms =
      more > 1 ? std::min(three_digits(own_ms * std::sqrt(more), std::ceil), longest_ms) : own_ms;
  const double rest = more * (own_ms / pulse_ms) * (own_ms / pulse_ms);
  const double torque =
      std::min(three_digits(d.self_test_nm * std::min(rest, more), std::ceil), d.torque_limit_nm);
  if (pulse_ms > own_ms) edit.set("self_test", "pulse_ms", number(pulse_ms));
  if (torque > d.self_test_nm || more < 1) edit.set("self_test", "torque_nm", number(torque));
  notes->push_back(fmt::format(
      "self_test: a pulse of {:g} Nm for {:g} ms each way instead of {:g} Nm for {:g} ms, for the "
      "same answer of the encoder to this inertia",
      more < 1 ? torque : std::max(torque, d.self_test_nm), pulse_ms, d.self_test_nm, own_ms));
}

/// Integer bits of a signed format that hold `value`.
Format wide_enough(Format f, double value) {
  while (std::ldexp(1.0, f.integer) <= value) ++f.integer;
  return f;
}

std::string edited(const std::string& base, const Design& d, const Parameters& p,
                   const std::string& plant_name, double emf, std::vector<std::string>* notes) {
  TextEdit edit(base, fmt::format("of the plant {}", plant_name));
  edit.set_description(fmt::format("{} with the constants of the plant {}", d.name, plant_name));
  edit.set("observer", "torque_constant_nm_a", number(p.motor.torque_constant_nm_a));
  edit.set("observer", "inertia_kg_m2", number(p.lever.inertia_kg_m2));
  edit.set("motor", "resistance_ohm", number(p.motor.resistance_ohm));
  edit.set("motor", "emf_constant_v_s_rad", number(emf));
  edit.set("voltage", "dead_voltage_v",
           number(p.effects.dead_voltage ? p.motor.dead_voltage_v : 0));
  edit.set("pwm", "supply_v", number(p.supply.voltage_v));
  edit.set("pwm", "diode_drop_v", number(p.supply.diode_drop_v));
  set_encoder(d, p.encoder.lines, edit);
  edit.because("follows from the plant");
  const double current = three_digits(d.torque_limit_nm / p.motor.torque_constant_nm_a, std::ceil);
  edit.set("control", "current_limit_a", number(current));
  if (edit.text_of("motor", "motor_current_limit_a")) {
    const double above = d.motor_current_limit_a / d.current_limit_a;  // as far as in the base
    edit.set("motor", "motor_current_limit_a", number(three_digits(above * current, std::ceil)));
  }
  if (edit.text_of("control", "kp_1_kg_m2")) {
    edit.set("control", "kp_1_kg_m2",
             number(d.kp_1_kg_m2 * d.inertia_kg_m2 / p.lever.inertia_kg_m2));
  }
  self_test_for(d, p, edit, notes);
  const bool power_of_two = (p.encoder.lines & (p.encoder.lines - 1)) == 0;
  if (edit.text_of("encoder", "index") && (!power_of_two || p.encoder.lines < 16)) {
    edit.set("encoder", "index", "0");
    notes->push_back(
        fmt::format("encoder.index is 0: the count at the index cannot be checked against {} lines",
                    p.encoder.lines));
  }
  const Format f = wide_enough(d.current, current);
  if (f.integer != d.current.integer) {
    edit.set("formats", "current", fmt::format("[1, {}, {}]", f.integer, f.fraction));
  }
  if (const auto wall = wall_for(d, p)) {
    edit.set("scenes", "wall_nm_rad", number(*wall));
    notes->push_back(fmt::format(
        "scenes.wall_nm_rad is {} instead of {}: a stiffer wall would buzz with this friction and "
        "encoder",
        *wall, d.wall_nm_rad));
  }
  notes->push_back(
      "supervisor.nominal_current_a and i2t_budget_a2_s are still the base's: no plant file says "
      "what current a motor can carry; take them from its data sheet");
  const double needed = p.motor.resistance_ohm * current + p.motor.dead_voltage_v;
  if (needed > p.supply.voltage_v) {
    notes->push_back(fmt::format(
        "control.torque_limit_nm = {} takes {:.3g} V at standstill, more than the supply's {} V; "
        "lower it or expect less torque",
        d.torque_limit_nm, needed, p.supply.voltage_v));
  }
  return fmt::format("# Written by: feltgate design {} --for-plant {}\n{}", d.name, plant_name,
                     edit.text());
}

}  // namespace

PlantDesign design_for_plant(const std::string& base, const Parameters& p,
                             const std::string& as_named, const std::string& path,
                             const RegisterMap& registers) {
  const std::string plant_name = plain(as_named);
  const Design d = read_design(base);
  if (d.voltage_law != "motor_model") {
    d.fail("voltage.law",
           "the gains of the law \"" + d.voltage_law + "\" are not a plant's constants",
           "take a base with law = \"motor_model\", such as lever");
  }
  if (p.phases.has_value() != (d.phases == 3)) {
    d.fail("pwm.phases",
           fmt::format("the motor of plant {} has {}", plant_name,
                       p.phases ? "three phases" : "brushes"),
           "take a base that drives such a motor");
  }
  PlantDesign made;
  // Where the quantised compensation of the back-EMF would exceed it, the lever speeds up by
  // itself.
  for (const double share : {1.0, 0.999, 0.99, 0.97}) {
    made.notes.clear();
    const double emf = share * p.motor.back_emf_constant_v_s_rad;
    made.text = edited(base, d, p, plant_name, emf, &made.notes);
    try {
      made.design = elaborate(design_from_text(made.text, path), registers);
    } catch (const config::ConfigError& e) {
      // The file of these lines is not written.
      const std::string told = e.what();
      const std::size_t place = told.find(": ");
      throw std::invalid_argument(
          fmt::format("{} with the constants of the plant {} is no design: {}", d.name, plant_name,
                      place == std::string::npos ? told : told.substr(place + 2)));
    }
    if (share < 1) {
      made.notes.push_back(fmt::format(
          "motor.emf_constant_v_s_rad is {} of the plant's: with all of it the loop is unstable",
          share));
    }
    if (closed_loop(made.design, p).stable()) break;
  }
  refuse_unstable(made.design, p);
  Effects all;
  made.changed = shared_constants(d, p, all);
  const auto same = [](const Constant& c) { return c.of_design == c.of_plant; };
  made.changed.erase(std::remove_if(made.changed.begin(), made.changed.end(), same),
                     made.changed.end());
  return made;
}

}  // namespace feltgate::stability
