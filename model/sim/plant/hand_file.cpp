// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Reader of the [hand] table of a scene. Documentation: docs/plant.md
#include "sim/plant/profile.hpp"

#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <system_error>
#include <utility>

#include "sim/plant/plant_table.hpp"
#include "sim/traces/table.hpp"
#include "sim/traces/text.hpp"

namespace feltgate::plant {
namespace {

using Kind = HandPhase::Kind;

constexpr config::Range kPhase{-7.0, 7.0};
constexpr config::Range kFrequency{1e-6, 1e5};
/// Range of angles in rad (160 000 turns) and torques in Nm: far beyond any lever, well within a
/// double.
constexpr config::Range kWay{-1e6, 1e6};

// `unit` is the suffix of the keys: rad or nm.
Segment read_segment(config::TomlReader table, const std::string& unit, bool steps_allowed) {
  Segment segment;
  segment.kind = static_cast<Segment::Kind>(
      table.choice("kind", {"hold", "step", "ramp", "minimum_jerk", "sine"}));
  if (segment.kind == Segment::Kind::kStep && !steps_allowed) {
    table.fail("kind", fmt::format("an imposed {} cannot step", unit == "m" ? "place" : "angle"),
               "use ramp or minimum_jerk");
  }
  segment.line = table.line("kind");
  segment.duration_s = table.number("duration_s", config::kPositive);
  if (segment.kind == Segment::Kind::kSine) {
    segment.amplitude = table.number("amplitude_" + unit, kWay);
    segment.frequency_hz = table.number("frequency_hz", kFrequency);
    segment.phase_rad = table.number_or("phase_rad", 0.0, kPhase);
  } else if (segment.kind != Segment::Kind::kHold) {
    segment.to = table.number("to_" + unit, kWay);
  }
  if (segment.kind == Segment::Kind::kRamp) {
    segment.ease_s = table.number_or("ease_s", 0.0, {0.0, segment.duration_s / 2});
  }
  table.finish();
  return segment;
}

}  // namespace

Profile read_profile(config::TomlReader& table, const std::string& key, const std::string& unit,
                     bool steps_allowed) {
  Profile profile;
  for (config::TomlReader& segment : table.sections(key)) {
    profile.push_back(read_segment(std::move(segment), unit, steps_allowed));
  }
  if (profile.empty()) {
    table.fail(key, "\"" + key + "\" is missing or empty",
               "write " + key + " = [{kind = \"hold\", duration_s = 1.0}, ...]");
  }
  return profile;
}

double read_duration(config::TomlReader& table, double motion_s, bool last) {
  if (!table.has("duration_s")) {
    if (last) return std::numeric_limits<double>::infinity();
    if (motion_s > 0.0) return motion_s;
  }
  return table.number("duration_s", config::kPositive);
}

Impedance read_impedance(config::TomlReader& table) {
  Impedance i;
  i.mass_kg = table.number_or("mass_kg", i.mass_kg, config::kPositive);
  i.damping_ns_m = table.number_or("damping_ns_m", i.damping_ns_m, config::kNotNegative);
  i.stiffness_n_m = table.number_or("stiffness_n_m", i.stiffness_n_m, config::kNotNegative);
  i.grip_stiffness_n_m =
      table.number_or("grip_stiffness_n_m", i.grip_stiffness_n_m, config::kNotNegative);
  i.grip_damping_ns_m =
      table.number_or("grip_damping_ns_m", i.grip_damping_ns_m, config::kNotNegative);
  return i;
}

namespace {

std::string beside(const std::string& file, const std::string& name) {
  const auto slash = file.find_last_of('/');
  if (slash == std::string::npos || (!name.empty() && name[0] == '/')) return name;
  return file.substr(0, slash + 1) + name;
}

void check_trace(const config::TomlReader& table, const std::string& key, const Trace& trace) {
  if (trace.time_s.size() != trace.theta_rad.size() || trace.time_s.size() < 2) {
    table.fail(key,
               fmt::format("the trace holds {} times and {} angles", trace.time_s.size(),
                           trace.theta_rad.size()),
               "give as many times as angles, two at least");
  }
  for (std::size_t i = 1; i < trace.time_s.size(); ++i) {
    if (trace.time_s[i] > trace.time_s[i - 1]) continue;
    table.fail(key, fmt::format("time does not increase at sample {}", i),
               "sort the samples and drop repeated times");
  }
}

Trace read_trace(config::TomlReader& table) {
  Trace trace;
  if (table.has("file")) {
    const std::string file = beside(table.file(), table.text("file"));
    std::error_code ignored;
    // The trace reader reports errors inside the file, with their own lines.
    if (!std::filesystem::is_regular_file(file, ignored) ||
        std::ifstream(file).peek() == std::ifstream::traits_type::eof()) {
      table.fail("file", fmt::format("{}: cannot be opened, or is empty", file),
                 "check the path and the rights");
    }
    trace = read_trace_file(file);
    trace.file = file;
    check_trace(table, "file", trace);
  } else {
    trace.time_s = table.numbers("time_s", config::kNotNegative);
    trace.theta_rad = table.numbers("theta_rad", kWay);
    check_trace(table, "time_s", trace);
  }
  return trace;
}

Cord read_cord(config::TomlReader& table) {
  Cord cord;
  cord.stiffness_nm_rad =
      table.number_or("stiffness_nm_rad", cord.stiffness_nm_rad, config::kNotNegative);
  cord.damping_nm_s_rad =
      table.number_or("damping_nm_s_rad", cord.damping_nm_s_rad, config::kNotNegative);
  return cord;
}

HandPhase read_phase(config::TomlReader table, bool last) {
  HandPhase phase;
  phase.kind = static_cast<Kind>(table.choice(
      "kind", {"free", "locked", "prescribed", "trace", "impedance", "cord", "torque"}));
  phase.line = table.line("kind");
  double natural_s = 0.0;
  if (phase.kind == Kind::kPrescribed || phase.kind == Kind::kImpedance) {
    phase.profile = read_profile(table, "motion", "rad", phase.kind == Kind::kImpedance);
    natural_s = duration_s(phase.profile);
  } else if (phase.kind == Kind::kTorque) {
    phase.profile = read_profile(table, "torque", "nm", true);
    natural_s = duration_s(phase.profile);
  } else if (phase.kind == Kind::kTrace) {
    phase.trace = read_trace(table);
    natural_s = phase.trace.time_s.back();
  }
  if (phase.kind == Kind::kImpedance) phase.impedance = read_impedance(table);
  if (phase.kind == Kind::kCord) phase.cord = read_cord(table);
  phase.duration_s = read_duration(table, natural_s, last);
  table.finish();
  return phase;
}

}  // namespace

Trace read_trace_file(const std::string& path) try {
  traces::Options options;
  options.time_column = "time_s";
  traces::Table table(path, options);
  const std::size_t time = table.use_time(), angle = table.find("theta_rad");
  if (angle == table.columns().size()) {
    table.fail("no column 'theta_rad'", table.columns_there("theta_rad"));
  }
  Trace trace;
  while (table.read()) {
    const auto time_s = traces::parse_real(table.field(time));
    const auto theta_rad = traces::parse_real(table.field(angle));
    if (!time_s || !theta_rad || std::abs(*theta_rad) > kWay.max) {
      table.fail("not two finite numbers, an angle up to 1e6 rad", "give seconds and radians");
    }
    trace.time_s.push_back(*time_s);
    trace.theta_rad.push_back(*theta_rad);
  }
  return trace;
} catch (const traces::TraceError& error) {
  throw config::ConfigError(error.what());
}

Hand read_hand(config::TomlReader table) {
  Hand hand;
  if (table.has("start_rad")) hand.start_rad = table.number("start_rad", kWay);
  if (table.has("radius_m")) hand.radius_m = table.number("radius_m", config::kPositive);
  auto phases = table.sections("phase");
  for (std::size_t i = 0; i < phases.size(); ++i) {
    hand.phases.push_back(read_phase(std::move(phases[i]), i + 1 == phases.size()));
  }
  if (hand.start_rad && !hand.phases.empty() && hand.phases.front().kind == Kind::kTrace &&
      *hand.start_rad != hand.phases.front().trace.theta_rad.front()) {
    table.fail("start_rad", "\"start_rad\" is not the first angle of the leading trace",
               "remove it");
  }
  table.finish();
  return hand;
}

}  // namespace feltgate::plant
