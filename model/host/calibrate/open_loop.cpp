// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The open-loop calibration. Documentation: docs/calibration.md
#include "host/calibrate/open_loop.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

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
    find_bend(fit, &result);
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

  /// Fits a line with another slope from some voltage on; keeps it if noise alone hardly explains
  /// it.
  void find_bend(const Regression& straight, OpenLoop* result) const {
    const std::size_t live = readings_.size() - dead_;
    if (live < 6 || !(straight.sigma() > 0)) return;
    const double from = std::abs(readings_[dead_ + 1].command);
    const double to = std::abs(readings_[readings_.size() - 2].command);
    constexpr int steps = 400;
    double best = straight.sum_of_squares();
    std::vector<std::pair<double, double>> squares;  // of each voltage
    for (int k = 1; k < steps; ++k) {
      const double at = from + (to - from) * k / steps;
      const auto fit = bent(at);
      if (!fit) continue;
      squares.emplace_back(at, fit->sum_of_squares());
      best = std::min(best, squares.back().second);
    }
    const int freedom = straight.freedom() - 2;
    const double gain = straight.sum_of_squares() - best;
    const double f = best > 0 ? gain / 2 / (best / freedom) : 0;
    Bend bend;
    // The place was chosen too, which multiplies the chance by the number of places between
    // readings.
    bend.chance = std::min(1.0, static_cast<double>(live - 3) * f_tail(f, 2, freedom));
    if (best > 0 && bend.chance > 1 - confidence_) return;
    if (!(gain > 1e-12 * straight.sum_of_squares())) return;
    const double t = student_t(confidence_, freedom);
    const double limit = best * (1 + t * t / freedom);
    bend.at_v = {0, to, from};
    for (const auto& [at, sum] : squares) {
      if (sum == best) bend.at_v.value = at;
      if (sum > limit) continue;
      bend.at_v.low = std::min(bend.at_v.low, at);
      bend.at_v.high = std::max(bend.at_v.high, at);
    }
    const auto fit = bent(bend.at_v.value);
    bend.slope_below_nm_v = fit->coefficient(0);
    VectorXd both = VectorXd::Zero(fit->size());
    both[0] = both[fit->size() - 1] = 1;
    bend.slope_above_nm_v = fit->combination({0, both});
    result->bend = bend;
  }
  std::optional<Regression> bent(double at) const {
    const auto n = static_cast<Index>(readings_.size() - dead_);
    MatrixXd x(n, both_ ? 4 : 3);
    VectorXd y(n);
    for (Index k = 0; k < n; ++k) {
      const Reading& r = readings_[dead_ + static_cast<std::size_t>(k)];
      x(k, 0) = r.command;
      x(k, 1) = -sign(r.command);
      if (both_) x(k, 2) = 1;
      x(k, x.cols() - 1) = sign(r.command) * std::max(0.0, std::abs(r.command) - at);
      y[k] = r.torque_nm;
    }
    try {
      return Regression(x, y, confidence_);
    } catch (const MeasurementError&) {
      return {};
    }
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
    if (result->bend) {
      result->warnings.push_back(fmt::format(
          "the line bends at {:.3g} V ({:.3g} to {:.3g}): {:.4g} below and {:.4g} Nm/V above it; "
          "one slope does not fit both",
          result->bend->at_v.value, result->bend->at_v.low, result->bend->at_v.high,
          result->bend->slope_below_nm_v.value, result->bend->slope_above_nm_v.value));
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

}  // namespace feltgate::host
