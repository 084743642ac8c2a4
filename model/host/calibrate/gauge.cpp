// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The calibrations with a gauge. Documentation: docs/calibration.md
#include "host/calibrate/gauge.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "feltgate/largest.hpp"

namespace feltgate::host {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kFar = 4;  ///< a reading beyond so many standard deviations is reported

double sign(double x) { return x < 0 ? -1.0 : 1.0; }

Combination combination(std::initializer_list<double> weights, double constant = 0) {
  VectorXd w(static_cast<Index>(weights.size()));
  std::copy(weights.begin(), weights.end(), w.data());
  return {constant, w};
}

std::vector<Reading> readings_of(const ColumnTable& table, const std::vector<std::string>& command,
                                 const std::string& what, double arm_m) {
  const std::size_t at = table.need(command, what);
  const auto force = table.find({"force_n", "force"});
  const std::size_t torque =
      force && !table.find({"torque_nm", "torque", "gauge_nm"})
          ? *force
          : table.need({"torque_nm", "torque", "gauge_nm", "force_n"}, "the gauge's torque");
  const auto tau_hat = table.find({"tau_hat_nm", "tau_hat"});
  if (force && torque == *force && !(arm_m > 0)) {
    throw MeasurementError(table.file() +
                           ":1: forces need the arm of the pulley; give it as --arm 0.011 (m)");
  }
  std::vector<Reading> readings;
  for (std::size_t row = 0; row < table.rows(); ++row) {
    Reading r;
    r.command = table.at(row, at);
    r.torque_nm = table.at(row, torque) * (force && torque == *force ? arm_m : 1.0);
    r.line = table.line(row);
    if (std::isnan(r.command) || std::isnan(r.torque_nm)) {
      table.fail(row, "a reading is empty", "fill it in or take the row out");
    }
    if (tau_hat && !std::isnan(table.at(row, *tau_hat))) r.tau_hat_nm = table.at(row, *tau_hat);
    readings.push_back(r);
  }
  return readings;
}

class OpenLoopFit {
 public:
  OpenLoopFit(std::vector<Reading> readings, double confidence)
      : readings_(std::move(readings)), confidence_(confidence) {
    std::stable_sort(readings_.begin(), readings_.end(), [](const Reading& a, const Reading& b) {
      return std::abs(a.command) < std::abs(b.command);
    });
    int negative = 0;
    for (const Reading& r : readings_) negative += r.command < 0 ? 1 : 0;
    const int positive = static_cast<int>(readings_.size()) - negative;
    both_ = negative > 1 && positive > 1;
    if (!both_ && negative > 0 && positive > 0) {
      throw MeasurementError(
          "one reading alone has the other sign, which leaves the gauge's offset open; take two of "
          "each sign, or all of one");
    }
  }

  OpenLoop run(double torque_constant_nm_a) {
    refuse_too_few();
    choose_dead_zone();
    const Regression fit = regression(dead_);
    OpenLoop result;
    result.confidence = confidence_;
    result.slope_nm_v = fit.coefficient(0);
    if (result.slope_nm_v.high < 0) {
      throw MeasurementError(
          "the torque falls as the voltage rises; turn the gauge's sign round, or set "
          "control.motor_polarity");
    }
    const auto v0 = fit.quotient(combination(both_ ? std::initializer_list<double>{0, 1, 0}
                                                   : std::initializer_list<double>{0, 1}),
                                 slope_only());
    if (!v0 || result.slope_nm_v.low <= 0) {
      throw MeasurementError(fmt::format(
          "no slope stands out of the noise of {:.2g} Nm; take readings at larger voltages, or a "
          "finer gauge",
          fit.sigma()));
    }
    result.dead_voltage_v = *v0;
    result.resistance_ohm = result.slope_nm_v.under(torque_constant_nm_a);
    if (both_) result.gauge_offset_nm = fit.coefficient(2);
    result.noise_nm = fit.sigma();
    result.freedom = fit.freedom();
    note_residuals(fit, &result);
    fit_observer(&result);
    warn(&result);
    return result;
  }

 private:
  Combination slope_only() const { return both_ ? combination({1, 0, 0}) : combination({1, 0}); }
  /// Columns: V, -sign(V), and 1 if the gauge's offset is fitted; the second coefficient divided by
  /// the first is the dead voltage.
  Regression regression(std::size_t dead) const {
    const std::size_t first = both_ ? 0 : dead;
    const auto n = static_cast<Index>(readings_.size() - first);
    MatrixXd x(n, both_ ? 3 : 2);
    VectorXd y(n);
    for (Index k = 0; k < n; ++k) {
      const std::size_t at = first + static_cast<std::size_t>(k);
      const Reading& r = readings_[at];
      const double live = at < dead ? 0 : 1;
      x(k, 0) = live * r.command;
      x(k, 1) = -live * sign(r.command);
      if (both_) x(k, 2) = 1;
      y[k] = r.torque_nm;
    }
    return {x, y, confidence_};
  }

  void refuse_too_few() const {
    std::set<double> commands;
    for (const Reading& r : readings_) commands.insert(r.command);
    const std::size_t needed = both_ ? 4 : 3;
    if (readings_.size() < needed) {
      throw MeasurementError(fmt::format(
          "{} readings; take at least {} at different voltages, as the paper's 1.5, 2.5, 3.5, 4.5 "
          "and 5.5 V",
          readings_.size(), needed));
    }
    if (commands.size() < (both_ ? 4U : 2U)) {
      throw MeasurementError(fmt::format(
          "only {} different voltage{}, through which no line goes; take readings at 1.5, 2.5, "
          "3.5, 4.5 and 5.5 V",
          commands.size(), commands.size() == 1 ? "" : "s"));
    }
  }

  /// Chooses the number of readings in the dead zone, from the smallest voltage on: the one for
  /// which "no torque up to there, a line beyond" fits best and the line crosses zero there.
  void choose_dead_zone() {
    dead_ = 0;
    double best = fit_of(0);
    for (std::size_t dead = 1; dead + 3 <= readings_.size(); ++dead) {
      const double here = fit_of(dead);
      if (here < best) {
        best = here;
        dead_ = dead;
      }
    }
  }
  /// Sum of squares of all readings; infinite if the line crosses zero elsewhere.
  double fit_of(std::size_t dead) const {
    const double none = std::numeric_limits<double>::infinity();
    std::set<double> live;
    for (std::size_t k = dead; k < readings_.size(); ++k) live.insert(readings_[k].command);
    if (live.size() < (both_ ? 4U : 2U)) return none;
    try {
      const Regression fit = regression(dead);
      const double v0 = fit.value(1) / fit.value(0);
      double sum = fit.sum_of_squares();
      if (dead == 0) return sum;
      if (!(v0 >= std::abs(readings_[dead - 1].command)) ||
          !(v0 <= std::abs(readings_[dead].command))) {
        return none;
      }
      if (!both_) {
        for (std::size_t k = 0; k < dead; ++k) sum += std::pow(readings_[k].torque_nm, 2);
      }
      return sum;
    } catch (const MeasurementError&) {
      return none;
    }
  }

  void note_residuals(const Regression& fit, OpenLoop* result) const {
    const std::size_t first = both_ ? 0 : dead_;
    const double rounding = rounding_nm(readings_);
    for (std::size_t k = 0; k < readings_.size(); ++k) {
      const Reading& r = readings_[k];
      Residual e{r.command, r.torque_nm, 0, 0, k < dead_};
      if (k >= first) {
        const auto row = static_cast<Index>(k - first);
        e.fitted_nm = r.torque_nm - fit.residuals()[row];
        e.studentised = fit.studentised(row, rounding);
      }
      result->residuals.push_back(e);
    }
    std::stable_sort(result->residuals.begin(), result->residuals.end(),
                     [](const Residual& a, const Residual& b) { return a.command < b.command; });
  }

  /// With a blocked shaft the observer sees the command: a line through zero.
  void fit_observer(OpenLoop* result) const {
    std::vector<const Reading*> seen;
    for (const Reading& r : readings_) {
      if (r.tau_hat_nm) seen.push_back(&r);
    }
    if (seen.size() < 2) return;
    const auto n = static_cast<Index>(seen.size());
    MatrixXd x(n, 1);
    VectorXd y(n);
    for (Index k = 0; k < n; ++k) {
      x(k, 0) = seen[static_cast<std::size_t>(k)]->command;
      y[k] = *seen[static_cast<std::size_t>(k)]->tau_hat_nm;
    }
    if (x.norm() > 0) result->observer_slope_nm_v = Regression(x, y, confidence_).coefficient(0);
  }

  void warn(OpenLoop* result) const {
    for (const Residual& e : result->residuals) {
      if (std::abs(e.studentised) < kFar) continue;
      result->warnings.push_back(fmt::format(
          "the reading at {:g} V lies {:.3g} Nm off the line, {} what the others would let expect; "
          "look at it again",
          e.command, e.residual_nm(),
          std::abs(e.studentised) > 99 ? "more than 99 times"
                                       : fmt::format("{:.0f} times", std::abs(e.studentised))));
    }
    if (result->dead_voltage_v.high < 0) {
      result->warnings.push_back(
          "a dead voltage below zero cannot be; set the unloaded gauge to zero, or take readings "
          "of "
          "both signs, which give its offset");
    }
  }

  std::vector<Reading> readings_;  ///< sorted by magnitude of the voltage
  double confidence_;
  bool both_ = false;     ///< readings of both signs
  std::size_t dead_ = 0;  ///< number of readings in the dead zone
};

}  // namespace

std::vector<Reading> open_loop_readings(const ColumnTable& table, double arm_m) {
  return readings_of(table, {"voltage_v", "voltage", "v"}, "the voltage", arm_m);
}

std::vector<Reading> closed_loop_readings(const ColumnTable& table, double arm_m) {
  return readings_of(table, {"tau_ref_nm", "tau_ref", "setpoint_nm", "setpoint_torque"},
                     "the torque that was asked for", arm_m);
}

double rounding_nm(const std::vector<Reading>& readings) {
  double place = 1;
  for (int places = 0; places < 7; ++places, place /= 10) {
    const bool all = std::all_of(readings.begin(), readings.end(), [place](const Reading& r) {
      const double steps = r.torque_nm / place;
      return std::abs(steps - std::round(steps)) < 1e-6;
    });
    if (all) return place / std::sqrt(12.0);
  }
  return 0;
}

OpenLoop fit_open_loop(std::vector<Reading> readings, double torque_constant_nm_a,
                       double confidence) {
  return OpenLoopFit(std::move(readings), confidence).run(torque_constant_nm_a);
}

namespace {

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
  const auto k = fit.quotient(combination({-mean, 0}, 1), combination({0, 1 / gain}));
  if (!k) throw MeasurementError("the torque does not follow what was asked for; check the gauge");
  return *k;
}

Regions fit_regions(const Regression& fit, const std::vector<Reading>& readings, double gain,
                    std::vector<std::string>* warnings) {
  Regions regions;
  std::vector<double> below, above;
  // The torque at which the error changes its sign: offset + slope*torque = torque.
  const auto border = fit.quotient(combination({1, 0}), combination({0, -1}, 1));
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
  const auto off = fit.quotient(combination({1, 0}), combination({0, 1}));
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
