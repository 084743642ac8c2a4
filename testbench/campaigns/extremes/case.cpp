// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Verdicts and the list of all cases. Documentation: docs/extremes.md
#include "campaigns/extremes/case.hpp"

#include <cmath>
#include <limits>

#include "campaigns/extremes/table.hpp"

namespace feltgate::extremes {

Expected exactly(double value) { return {value, value, number(value)}; }

Expected near(double value, double tolerance) {
  return {value - tolerance, value + tolerance, number(value) + " ± " + number(tolerance)};
}

Expected between(double low, double high) {
  return {low, high, number(low) + " to " + number(high)};
}

Expected at_most(double value) {
  return {-std::numeric_limits<double>::infinity(), value, "≤ " + number(value)};
}

Expected at_least(double value) {
  return {value, std::numeric_limits<double>::infinity(), "≥ " + number(value)};
}

bool Finding::holds() const {
  const auto inside = [this](const std::optional<double>& v) {
    return !v || (*v >= expected.low && *v <= expected.high);
  };
  if (!rtl && !twin && !real) return false;
  return inside(rtl) && inside(twin) && (real_may_differ || inside(real));
}

bool Outcome::holds() const {
  if (mismatches != 0 || findings.empty()) return false;
  for (const Finding& f : findings) {
    if (!f.holds()) return false;
  }
  return true;
}

std::vector<Case> cases() {
  std::vector<Case> all;
  for (const auto group : {encoder_cases, velocity_cases, filter_cases, observer_cases, scene_cases,
                           loop_cases, engine_cases, axes_cases, day_cases}) {
    for (const Case& c : group()) all.push_back(c);
  }
  return all;
}

}  // namespace feltgate::extremes
