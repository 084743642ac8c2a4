// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Reader of vectors/plants/NAME.toml. Documentation: docs/plant.md
#include "sim/plant/plant_file.hpp"
#include "sim/plant/plant_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace feltgate::plant {
namespace {

// With offsets and 4-sigma jitter below one count, the edges keep their order on the circle.
constexpr config::Range kEdgeOffset{-0.25, 0.25};
constexpr config::Range kLineJitter{0.0, 0.05};
constexpr config::Range kAbsoluteError{-200.0, 200.0};
// Beyond half a sector the order of a sensor's edges is another.
constexpr config::Range kHallError{-0.5, 0.5};

LeverParameters read_lever(config::TomlReader table) {
  LeverParameters lever;
  lever.inertia_kg_m2 = table.number("inertia_kg_m2", config::kPositive);
  lever.viscous_nm_s_rad = table.number("viscous_nm_s_rad", config::kNotNegative);
  lever.radius_m = table.number("radius_m", config::kPositive);
  table.finish();
  return lever;
}

EndStops read_end_stops(config::TomlReader table) {
  EndStops stops;
  stops.low_rad = table.number("low_rad", {-1e3, 1e3});
  stops.high_rad = table.number("high_rad", {-1e3, 1e3});
  stops.stiffness_nm_rad = table.number("stiffness_nm_rad", config::kPositive);
  stops.restitution = table.number("restitution", {0.0, 1.0});
  if (stops.high_rad <= stops.low_rad) {
    table.fail("high_rad", "\"high_rad\" is not above \"low_rad\"",
               "leave the lever a way: raise it");
  }
  table.finish();
  return stops;
}

// Reads the flags; without a base every flag is required.
Effects read_flags(config::TomlReader table, const Effects* base) {
  Effects effects = base != nullptr ? *base : Effects{};
  for (const EffectName& e : effect_names) {
    // The dynamics of a hand belong to scenes, so a plant file may omit them.
    const bool optional = base != nullptr || e.flag == &Effects::hand_dynamics;
    effects.*e.flag = optional ? table.flag_or(e.name, effects.*e.flag) : table.flag(e.name);
  }
  table.finish();
  return effects;
}

JointParameters read_joint(config::TomlReader table) {
  JointParameters j;
  j.rotor_inertia_kg_m2 = table.number("rotor_inertia_kg_m2", config::kPositive);
  j.drum_inertia_kg_m2 = table.number("drum_inertia_kg_m2", config::kNotNegative);
  j.pulley_radius_m = table.number("pulley_radius_m", config::kPositive);
  j.drum_radius_m = table.number("drum_radius_m", config::kPositive);
  j.viscous_nm_s_rad = table.number("viscous_nm_s_rad", config::kNotNegative);
  j.encoder_on_motor = table.choice("encoder", {"joint", "motor"}) == 1;
  table.finish();
  return j;
}

MotorParameters read_motor(config::TomlReader table) {
  MotorParameters motor;
  motor.torque_constant_nm_a = table.number("torque_constant_nm_a", config::kPositive);
  motor.back_emf_constant_v_s_rad = table.number("back_emf_constant_v_s_rad", config::kPositive);
  motor.resistance_ohm = table.number("resistance_ohm", config::kPositive);
  motor.inductance_h = table.number("inductance_h", config::kPositive);
  motor.dead_voltage_v = table.number("dead_voltage_v", config::kNotNegative);
  table.finish();
  return motor;
}

// [motor] with phases = 3, and [[emf_harmonic]].
PhaseParameters read_phases(config::TomlReader table, std::vector<config::TomlReader> harmonics) {
  PhaseParameters motor;
  (void)table.integer("phases", 2, 3);
  motor.pole_pairs = static_cast<int>(table.integer("pole_pairs", 1, 1000));
  motor.offset_rad = table.number("offset_rad", {-kTwoPi, kTwoPi});
  motor.back_emf_v_s_rad = table.number("back_emf_v_s_rad", config::kPositive);
  motor.resistance_ohm = table.number("resistance_ohm", config::kPositive);
  motor.inductance_h = table.number("inductance_h", config::kPositive);
  if (table.has("hall_rad")) {
    HallLines hall;
    hall.begin_rad = table.number("hall_rad", {-kTwoPi, kTwoPi});
    const auto errors = table.numbers("hall_error_rad", kHallError);
    if (errors.size() != hall.error_rad.size()) {
      table.fail("hall_error_rad", "\"hall_error_rad\" does not hold three numbers",
                 "write one for each Hall line");
    }
    std::copy(errors.begin(), errors.end(), hall.error_rad.begin());
    motor.hall = hall;
  }
  table.finish();
  for (config::TomlReader& of : harmonics) {
    EmfHarmonic h;
    h.order = static_cast<int>(of.integer("order", 2, 1000));
    h.share = of.number("share", {-1.0, 1.0});
    of.finish();
    motor.harmonics.push_back(h);
  }
  return motor;
}

LugreParameters read_lugre(config::TomlReader table) {
  LugreParameters lugre;
  lugre.stiffness_nm_rad = table.number("stiffness_nm_rad", config::kPositive);
  lugre.damping_nm_s_rad = table.number("damping_nm_s_rad", config::kNotNegative);
  lugre.viscous_nm_s_rad = table.number("viscous_nm_s_rad", config::kNotNegative);
  lugre.coulomb_nm = table.number("coulomb_nm", config::kPositive);
  lugre.static_nm = table.number("static_nm", config::kPositive);
  lugre.stribeck_rad_s = table.number("stribeck_rad_s", config::kPositive);
  if (lugre.static_nm < lugre.coulomb_nm) {
    table.fail("static_nm", "\"static_nm\" is less than \"coulomb_nm\"",
               "breaking away takes at least the sliding torque: raise it");
  }
  table.finish();
  return lugre;
}

SupplyParameters read_supply(config::TomlReader table) {
  SupplyParameters supply;
  supply.voltage_v = table.number("voltage_v", config::kPositive);
  supply.current_limit_a = table.number("current_limit_a", config::kPositive);
  supply.bus_capacitance_f = table.number("bus_capacitance_f", config::kPositive);
  supply.diode_drop_v = table.number("diode_drop_v", config::kNotNegative);
  table.finish();
  return supply;
}

EncoderParameters read_encoder(config::TomlReader table) {
  EncoderParameters encoder;
  encoder.lines = static_cast<int>(table.integer("lines", 1, 1 << 20));
  const auto offsets = table.numbers("edge_offset_counts", kEdgeOffset);
  if (offsets.size() != encoder.edge_offset_counts.size()) {
    table.fail("edge_offset_counts", "\"edge_offset_counts\" does not hold four numbers",
               "write one for each edge of a cycle");
  }
  std::copy(offsets.begin(), offsets.end(), encoder.edge_offset_counts.begin());
  encoder.line_jitter_counts_rms = table.number("line_jitter_counts_rms", kLineJitter);
  encoder.seed = static_cast<std::uint64_t>(
      table.integer("seed", 0, std::numeric_limits<std::int64_t>::max()));
  if (table.has("absolute_error_mrad")) {
    encoder.absolute_error_mrad = table.numbers("absolute_error_mrad", kAbsoluteError);
  }
  table.finish();
  return encoder;
}

// [[cogging]]: harmonics, each a table of its own.
std::vector<CoggingHarmonic> read_cogging(std::vector<config::TomlReader> tables) {
  std::vector<CoggingHarmonic> harmonics;
  for (config::TomlReader& table : tables) {
    CoggingHarmonic h;
    h.per_turn = static_cast<int>(table.integer("per_turn", 1, 1000));
    h.amplitude_nm = table.number("amplitude_nm", config::kNotNegative);
    h.phase_rad = table.number("phase_rad", config::kAnyNumber);
    table.finish();
    harmonics.push_back(h);
  }
  return harmonics;
}

/// [gear]: from here on the plant is the motor without a gear that does the same at the lever.
void read_gear(config::TomlReader table, Parameters* p) {
  const double ratio = table.number("ratio", {1e-3, 1e3});
  const double rotor = table.number("rotor_inertia_kg_m2", config::kNotNegative);
  const bool on_motor = table.choice("encoder", {"lever", "motor"}) == 1;
  const auto whole = [&](int* count, const char* what) {
    const double turned = ratio * *count;
    // A ratio is written with a few digits.
    if (std::abs(turned - std::round(turned)) > 1e-3 || std::round(turned) > 1 << 20) {
      table.fail(
          "ratio",
          fmt::format("{} {} of the motor are {:g} in a turn of the lever", *count, what, turned),
          fmt::format("take the nearest ratio for which they are whole, {:.12g}, and at "
                      "most 2^20",
                      std::max(1.0, std::round(turned)) / *count));
    }
    *count = static_cast<int>(std::lround(turned));
  };
  if (on_motor) whole(&p->encoder.lines, "lines");
  p->lever.inertia_kg_m2 += ratio * ratio * rotor;
  if (p->phases) {
    whole(&p->phases->pole_pairs, "pole pairs");
    p->phases->back_emf_v_s_rad *= ratio;
    p->motor = p->phases->as_brushed();
  } else {
    p->motor.torque_constant_nm_a *= ratio;
    p->motor.back_emf_constant_v_s_rad *= ratio;
  }
  table.finish();
}

Effects read_all_effects(config::TomlReader table) { return read_flags(std::move(table), nullptr); }

}  // namespace

void read_axes(config::TomlReader& root, AxesParameters& p) {
  p.joint = read_joint(root.section("joint"));
  p.motor = read_motor(root.section("motor"));
  p.lugre = read_lugre(root.section("lugre"));
  p.supply = read_supply(root.section("supply"));
  p.encoder = read_encoder(root.section("encoder"));
  p.effects = read_all_effects(root.section("effects"));
}

Effects read_effects(config::TomlReader table, const Effects& base) {
  return read_flags(std::move(table), &base);
}

Parameters read_plant(const toml::table& root, const std::string& file) {
  config::TomlReader reader(root, file, "the file");
  Parameters parameters;
  parameters.name = reader.text("name");
  config::TomlReader motor = reader.section("motor");
  if (motor.has("phases") && motor.integer("phases", 2, 3) == 3) {
    parameters.phases = read_phases(std::move(motor), reader.sections("emf_harmonic"));
    parameters.motor = parameters.phases->as_brushed();
  } else {
    parameters.motor = read_motor(std::move(motor));
  }
  config::TomlReader lever = reader.section("lever");
  parameters.place = fmt::format("{}:{}", file, lever.line("inertia_kg_m2"));
  parameters.lever = read_lever(std::move(lever));
  parameters.lugre = read_lugre(reader.section("lugre"));
  parameters.supply = read_supply(reader.section("supply"));
  parameters.encoder = read_encoder(reader.section("encoder"));
  if (reader.has("gear")) read_gear(reader.section("gear"), &parameters);
  if (reader.has("end_stops")) parameters.end_stops = read_end_stops(reader.section("end_stops"));
  parameters.cogging = read_cogging(reader.sections("cogging"));
  parameters.effects = read_all_effects(reader.section("effects"));
  if (parameters.phases && parameters.effects.dead_voltage) {
    reader.section("effects").fail("dead_voltage", "a motor with three phases has no brushes",
                                   "write dead_voltage = false");
  }
  reader.finish();
  return parameters;
}

Parameters read_plant_file(const std::string& path) {
  return read_plant(config::parse_toml_file(path), path);
}

}  // namespace feltgate::plant
