// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Step response figures. Documentation: docs/json.md
#include "loop/figures.hpp"

#include <algorithm>

namespace feltgate {

StepResponse step_response(const std::vector<double>& samples, double sample_s, double before_nm,
                           double tau_ref_nm) {
  StepResponse r;
  r.tau_ref_nm = tau_ref_nm;
  if (samples.empty()) return r;
  const std::size_t tail = std::max<std::size_t>(1, samples.size() / 10);
  const auto first_of_tail = samples.end() - static_cast<std::ptrdiff_t>(tail);
  double sum = 0;
  for (auto it = first_of_tail; it != samples.end(); ++it) sum += *it;
  r.final_value_nm = sum / static_cast<double>(tail);
  double squares = 0;
  for (auto it = first_of_tail; it != samples.end(); ++it) {
    squares += (*it - r.final_value_nm) * (*it - r.final_value_nm);
  }
  r.ripple_nm = std::sqrt(squares / static_cast<double>(tail));
  const double step = r.final_value_nm - before_nm;
  const double band = 0.02 * std::abs(step);
  std::size_t settled = 0;
  double beyond = 0;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const double error = samples[i] - r.final_value_nm;
    if (std::abs(error) > band) settled = i + 1;
    beyond = std::max(beyond, step >= 0 ? error : -error);
  }
  r.settling_ms = 1e3 * sample_s * static_cast<double>(settled);
  r.overshoot_pct = step == 0 ? 0.0 : 100.0 * beyond / std::abs(step);
  r.final_error_pct = tau_ref_nm == 0 ? 0.0 : 100.0 * (r.final_value_nm / tau_ref_nm - 1.0);
  return r;
}

}  // namespace feltgate
