// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Documentation: docs/speed-for-accuracy.md
#include "studies/explore/measurement.hpp"

#include <cmath>
#include <fstream>
#include <sstream>
#include <stdexcept>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace feltgate::explore {

std::vector<Value> read_values(const std::string& path) {
  std::ifstream in(path);
  if (!in) throw std::runtime_error(path + ": cannot be read; run feltgate_generate --output");
  std::vector<Value> values;
  std::string line;
  for (int number = 1; std::getline(in, line); ++number) {
    std::istringstream words(line);
    Value v;
    if (!(words >> v.name >> v.address >> v.raw >> v.si)) {
      throw std::runtime_error(
          fmt::format("{}:{}: no parameter; write name, address, integer, value", path, number));
    }
    values.push_back(v);
  }
  return values;
}

const Value& value(const std::vector<Value>& values, const std::string& name) {
  for (const Value& v : values) {
    if (v.name == name) return v;
  }
  throw std::runtime_error("values.txt: no parameter " + name);
}

namespace {

void put(nlohmann::ordered_json* j, const std::string& name, const std::string& unit,
         const Error& e) {
  (*j)[name + "_error_max_" + unit] = e.worst;
  (*j)[name + "_error_rms_" + unit] = e.rms();
  (*j)[name + "_error_max_in"] = e.worst_in;
}

}  // namespace

std::string measurement_json(const Measurement& m) {
  nlohmann::ordered_json j;
  const bool equal = m.mismatches == 0;
  j["status"] = equal ? "ok" : "mismatch";
  j["clocks_compared"] = m.clocks_compared;
  j["clocks_armed"] = m.clocks_armed;
  j["mismatches"] = m.mismatches;
  if (!equal) {
    j["first_mismatch"] = m.first_mismatch;
    return j.dump();
  }
  j["ticks"] = m.ticks;
  j["ticks_left_out"] = m.ticks_left_out;
  put(&j, "torque", "nm", m.torque);
  put(&j, "tau_ref", "nm", m.tau_ref);
  put(&j, "tau_hat", "nm", m.tau_hat);
  put(&j, "velocity", "rad_s", m.velocity);
  put(&j, "voltage", "v", m.voltage);
  const char* const bits[] = {"torque", "ramp",     "current", "voltage",
                              "duty",   "velocity", "tau_hat"};
  for (std::size_t k = 0; k < m.limited.size(); ++k) j["ticks_limited"][bits[k]] = m.limited[k];
  j["raw_velocity_max_rad_s"] = m.raw_velocity_rad_s;
  j["delay_s"] = m.estimator_delay_s;
  j["latency_clocks"] = m.latency_clocks;
  j["latency_us"] = 1e6 * m.latency_clocks / m.clock_hz;
  if (m.torque_settling_s >= 0) j["torque_settling_s"] = m.torque_settling_s;
  return j.dump();
}

namespace {

constexpr double pi = 3.14159265358979323846;

/// From low to high and back in one cosine.
double there_and_back(double t_s, double duration_s, double low_rad, double high_rad) {
  return low_rad + (high_rad - low_rad) * 0.5 * (1.0 - std::cos(2.0 * pi * t_s / duration_s));
}

double sine(double t_s, double frequency_hz, double amplitude_rad) {
  return amplitude_rad * std::sin(2.0 * pi * frequency_hz * t_s);
}

/// 1 to 150 Hz in 0.2 s; the amplitude falls so that the speed stays below 40 rad/s.
double chirp(double t_s) {
  const double rate_hz_s = 149.0 / 0.2;
  const double frequency_hz = 1.0 + rate_hz_s * t_s;
  const double phase = 2.0 * pi * (t_s + 0.5 * rate_hz_s * t_s * t_s);
  return 0.3 / (1.0 + frequency_hz / 15.0) * std::sin(phase);
}

constexpr double scene_s = 0.12;

}  // namespace

const std::vector<Motion>& motions() {
  static const std::vector<Motion> all{
      {"membrane", "membrane", scene_s,
       [](double t) { return there_and_back(t, scene_s, 0.45, 0.75); }, 0, 0.026},
      {"compression", "spring_compression", scene_s,
       [](double t) { return there_and_back(t, scene_s, 0.55, 0.15); }, 0, 0.008},
      {"tension", "spring_tension", scene_s, [](double t) { return sine(t, 1.0 / scene_s, 0.45); },
       0, 0.058},
      {"wall", "wall", scene_s, [](double t) { return there_and_back(t, scene_s, 0.4, 0.6); }, 0,
       0.026},
      {"damper", "damper", scene_s, [](double t) { return sine(t, 20.0, 0.15); }, 0, 0.021},
      {"charge_attract", "charge_attract", scene_s,
       [](double t) { return there_and_back(t, scene_s, 1.0, 0.05); }, 0, 0.042},
      {"charge_repel", "charge_repel", scene_s,
       [](double t) { return 0.6 * std::cos(pi * t / scene_s); }, 0, 0.056},
      {"small_torque", "setpoint", 0.05, [](double) { return 0.0; }, 0.00037, 0.0},
      {"half_torque", "setpoint", 0.05, [](double) { return 0.0; }, 0.25, 0.0},
      // One count in 3.8 ms: a rounding filter stops where a step has become too small for it.
      {"creep_spring", "spring_tension", 0.1, [](double t) { return 0.02 + 0.4 * t; }, 0, 0.04},
      {"creep_damper", "damper", 0.1, [](double t) { return -0.2 * t; }, 0, 0.04},
      {"chirp_spring", "spring_tension", 0.2, chirp, 0, 0.15},
      {"chirp_damper", "damper", 0.2, chirp, 0, 0.15},
      // Torque and voltage at their limits; below the overspeed of the shipped designs.
      {"fast", "damper", 0.04, [](double t) { return 500.0 * t; }, 0, 0.0},
  };
  return all;
}

}  // namespace feltgate::explore
