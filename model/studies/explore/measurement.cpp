// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Documentation: docs/speed-for-accuracy.md
#include "studies/explore/measurement.hpp"

#include <fmt/format.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <stdexcept>

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

}  // namespace feltgate::explore
