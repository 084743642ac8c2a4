// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The closed-loop calibration. Documentation: docs/calibration.md
#include "host/calibrate/closed_loop.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "feltgate/largest.hpp"

namespace feltgate::host {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

Combination line(double constant, double of_offset, double of_slope) {
  VectorXd w(2);
  w << of_offset, of_slope;
  return {constant, w};
}

/// Line through the readings of torque over command; readings of both signs are already folded onto
/// one.
Regression torque_line(const std::vector<Reading>& readings, double confidence) {
  const auto n = static_cast<Index>(readings.size());
  MatrixXd x(n, 2);
  VectorXd y(n);
  for (Index k = 0; k < n; ++k) {
    const Reading& r = readings[static_cast<std::size_t>(k)];
    x(k, 0) = 1;
    x(k, 1) = r.command;
    y[k] = r.torque_nm;
  }
  return {x, y, confidence};
}

/// Model: torque = offset + (K/gain)*slope*asked. Returns the gain K with the smallest sum of
/// squared relative errors over the torques `asked`: (1 - offset*mean(1/asked))/(slope/gain).
Interval best_gain(const Regression& fit, const std::vector<double>& asked, double gain) {
  double mean = 0;
  for (const double a : asked) mean += 1 / a / static_cast<double>(asked.size());
  const auto k = fit.quotient(line(1, -mean, 0), line(0, 0, 1 / gain));
  if (!k) throw MeasurementError("the torque does not follow what was asked for; check the gauge");
  return *k;
}

Regions fit_regions(const Regression& fit, const std::vector<Reading>& readings, double gain,
                    std::vector<std::string>* warnings) {
  Regions regions;
  std::vector<double> below, above;
  // The torque at which the error changes its sign: offset + slope*torque = torque.
  const auto border = fit.quotient(line(0, 1, 0), line(1, 0, -1));
  const double smallest = readings.front().command, largest = readings.back().command;
  const bool inside = border && border->value > smallest && border->value < largest;
  for (const Reading& r : readings) {
    (inside && r.command > border->value ? above : below).push_back(r.command);
  }
  regions.low = best_gain(fit, below, gain);
  regions.high = inside ? best_gain(fit, above, gain) : regions.low;
  if (inside) regions.border_nm = border;
  if (!inside) {
    warnings->push_back(fmt::format(
        "the error does not change its sign between {:g} and {:g} Nm: one gain does for all of it, "
        "and both get the same",
        smallest, largest));
  }
  for (const Reading& r : readings) {
    const bool high = inside && r.command > border->value;
    const double k = high ? regions.high.value : regions.low.value;
    const double torque = fit.value(0) + fit.value(1) * k / gain * r.command;
    regions.worst_error = larger(regions.worst_error, std::abs(torque / r.command - 1));
  }
  if (inside && regions.low.value > regions.high.value) {
    const double step = fit.value(1) * (regions.high.value - regions.low.value) / gain;
    warnings->push_back(
        fmt::format("at the border the torque falls by {:.2g} Nm although more is asked for; the "
                    "law of the motor, voltage.law = \"motor_model\", has no border",
                    -step * border->value));
  }
  return regions;
}

ModelConstants fit_model(const Regression& fit, const design::Design& d, double dead_v) {
  // torque = (V - V0)*Kt/R with V = Rd*asked/Kt + V0d, so slope = Rd/R, offset = (V0d - V0)*Kt/R.
  ModelConstants m;
  m.resistance_ohm = fit.coefficient(1).under(d.resistance_ohm);
  const auto off = fit.quotient(line(0, 1, 0), line(0, 0, 1));
  const double volts_per_nm = d.resistance_ohm / d.torque_constant_nm_a;
  m.dead_voltage_v = off->times(-volts_per_nm).plus(dead_v);
  return m;
}

}  // namespace

Interval slope_ratio(const OpenLoop& open) {
  return open.slope_nm_v.times(1 / open.observer_slope_nm_v->value);
}

ClosedLoop fit_closed_loop(std::vector<Reading> readings, const design::Elaborated& e, double gain,
                           double confidence) {
  const design::Design& d = e.design;
  for (Reading& r : readings) {
    if (r.command < 0) r.torque_nm = -r.torque_nm;
    r.command = std::abs(r.command);
  }
  std::sort(readings.begin(), readings.end(),
            [](const Reading& a, const Reading& b) { return a.command < b.command; });
  const std::size_t all = readings.size();
  // Below this torque the dead voltage acts only in part, which would be another line.
  readings.erase(std::remove_if(readings.begin(), readings.end(),
                                [&d](const Reading& r) {
                                  return r.command < d.dead_voltage_linear_nm || r.command == 0;
                                }),
                 readings.end());
  if (readings.size() < 3) {
    throw MeasurementError(fmt::format(
        "{} readings of {:g} Nm and more; take at least 3, as the paper's 0.05, 0.1, 0.2, 0.3 and "
        "0.5 Nm",
        readings.size(), d.dead_voltage_linear_nm));
  }
  if (readings.front().command == readings.back().command) {
    throw MeasurementError("all readings are of one torque; take some between 0.05 and 0.5 Nm");
  }
  const Regression fit = torque_line(readings, confidence);
  ClosedLoop result;
  result.confidence = confidence;
  result.offset_nm = fit.coefficient(0);
  result.slope = fit.coefficient(1);
  if (result.slope.low <= 0) {
    throw MeasurementError(fmt::format(
        "the torque does not rise with what is asked for, but for noise of {:.2g} Nm; check the "
        "gauge's sign, and that the motor is armed",
        fit.sigma()));
  }
  result.noise_nm = fit.sigma();
  result.freedom = fit.freedom();
  if (all > readings.size()) {
    result.warnings.push_back(fmt::format(
        "{} readings below {:g} Nm were left out: there the dead voltage is only partly "
        "given",
        all - readings.size(), d.dead_voltage_linear_nm));
  }
  if (d.emf_in_law()) {
    result.model = fit_model(fit, d, e.word("dead_voltage").si);
  } else {
    result.regions = fit_regions(fit, readings, gain, &result.warnings);
  }
  for (std::size_t k = 0; k < readings.size(); ++k) {
    const Reading& r = readings[k];
    const auto row = static_cast<Index>(k);
    result.residuals.push_back(
        {r.command, r.torque_nm, r.torque_nm - fit.residuals()[row], fit.studentised(row), false});
  }
  return result;
}

}  // namespace feltgate::host
