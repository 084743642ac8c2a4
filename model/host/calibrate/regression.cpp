// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Linear least squares with confidence intervals. Documentation: docs/calibration.md
#include "host/calibrate/regression.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iostream>
#include <limits>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <boost/math/distributions/students_t.hpp>

#include "sim/traces/text.hpp"

namespace feltgate::host {

namespace {

/// Unit columns whose smallest singular value is below this count as linearly dependent.
constexpr double kSameDirection = 1e-7;

double product(const Eigen::VectorXd& a, const Eigen::MatrixXd& m, const Eigen::VectorXd& b) {
  return a.dot(m * b);
}

}  // namespace

Interval Interval::times(double factor) const {
  return {value * factor, std::min(low * factor, high * factor),
          std::max(low * factor, high * factor)};
}

Interval Interval::under(double top) const {
  return {top / value, std::min(top / low, top / high), std::max(top / low, top / high)};
}

double student_t(double confidence, int freedom) {
  const boost::math::students_t distribution(freedom);
  return boost::math::quantile(boost::math::complement(distribution, (1 - confidence) / 2));
}

Regression::Regression(const Eigen::MatrixXd& x, const Eigen::VectorXd& y, double confidence) {
  freedom_ = static_cast<int>(x.rows() - x.cols());
  if (freedom_ < 1) {
    throw MeasurementError(fmt::format(
        "{} readings for {} unknowns leave nothing to judge the noise by; take at least {}, better "
        "twice as many",
        x.rows(), x.cols(), x.cols() + 1));
  }
  if (!x.allFinite() || !y.allFinite()) {
    throw MeasurementError("a reading is not a finite number; take it again");
  }
  const Eigen::VectorXd length = x.colwise().norm();
  const Eigen::VectorXd unit = length.cwiseMax(std::numeric_limits<double>::min()).cwiseInverse();
  const Eigen::MatrixXd scaled = x * unit.asDiagonal();
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(scaled, Eigen::ComputeThinU | Eigen::ComputeThinV);
  const Eigen::VectorXd& s = svd.singularValues();
  if (!(s[s.size() - 1] > kSameDirection * s[0])) {
    throw MeasurementError(
        "the readings do not tell the unknowns apart; vary more what is commanded");
  }
  coefficients_ = unit.asDiagonal() * svd.solve(y);
  residuals_ = y - x * coefficients_;
  sigma_ = std::sqrt(residuals_.squaredNorm() / freedom_);
  const Eigen::MatrixXd inverse = unit.asDiagonal() * svd.matrixV() *
                                  s.cwiseAbs2().cwiseInverse().asDiagonal() *
                                  svd.matrixV().transpose() * unit.asDiagonal();
  covariance_ = sigma_ * sigma_ * inverse;
  leverage_ = svd.matrixU().rowwise().squaredNorm();
  t_ = student_t(confidence, freedom_);
}

Interval Regression::coefficient(Eigen::Index k) const {
  const double half = t_ * std::sqrt(std::max(0.0, covariance_(k, k)));
  return {coefficients_[k], coefficients_[k] - half, coefficients_[k] + half};
}

Interval Regression::combination(const Combination& c) const {
  const double value = c.constant + c.weights.dot(coefficients_);
  const double variance = product(c.weights, covariance_, c.weights);
  const double half = t_ * std::sqrt(std::max(0.0, variance));
  return {value, value - half, value + half};
}

std::optional<Interval> Regression::quotient(const Combination& top,
                                             const Combination& bottom) const {
  // All r with (top - r*bottom)^2 <= t^2*variance(top - r*bottom): a quadratic in r.
  const double p = top.constant + top.weights.dot(coefficients_);
  const double q = bottom.constant + bottom.weights.dot(coefficients_);
  const double t2 = t_ * t_;
  const double a = q * q - t2 * product(bottom.weights, covariance_, bottom.weights);
  const double b = p * q - t2 * product(top.weights, covariance_, bottom.weights);
  const double c = p * p - t2 * product(top.weights, covariance_, top.weights);
  if (!(a > 0)) return {};
  const double root = std::sqrt(std::max(0.0, b * b - a * c));
  return Interval{p / q, (b - root) / a, (b + root) / a};
}

double Regression::studentised(Eigen::Index row, double least) const {
  const double free = 1 - leverage_[row];
  const double r = residuals_[row];
  if (freedom_ < 2 || free < 1e-9) return 0;
  const double without = (residuals_.squaredNorm() - r * r / free) / (freedom_ - 1);
  const double deviation = std::sqrt(std::max(without, least * least) * free);
  if (deviation > 0) return r / deviation;
  return r == 0 ? 0 : std::copysign(std::numeric_limits<double>::infinity(), r);
}

// Tables of numbers in named columns.

namespace {

std::vector<std::string> fields_of(const std::string& line, char separator) {
  std::vector<std::string> fields;
  std::string field;
  const auto end = [&] {
    std::string text(traces::trim(field));
    if (text.size() > 1 && text.front() == '"' && text.back() == '"') {
      text = text.substr(1, text.size() - 2);
    }
    if (separator != ' ' || !text.empty()) fields.push_back(text);
    field.clear();
  };
  for (const char c : line) {
    if (c == separator || (separator == ' ' && c == '\t')) {
      end();
    } else {
      field += c;
    }
  }
  end();
  return fields;
}

char separator_of(const std::string& line) {
  for (const char c : {',', ';', '\t'}) {
    if (line.find(c) != std::string::npos) return c;
  }
  return ' ';
}

}  // namespace

ColumnTable::ColumnTable(std::istream& in, std::string name) : file_(std::move(name)) {
  std::string line;
  char separator = ',';
  for (int number = 1; std::getline(in, line); ++number) {
    const std::size_t comment = line.find('#');
    const std::string text(traces::trim(std::string_view(line).substr(0, comment)));
    if (text.empty()) continue;
    const auto where = [&] { return fmt::format("{}:{}: ", file_, number); };
    if (names_.empty()) {
      separator = separator_of(text);
      names_ = fields_of(text, separator);
      for (std::string& n : names_) n = traces::lower(n);
      if (std::any_of(names_.begin(), names_.end(),
                      [](const std::string& n) { return traces::parse_real(n).has_value(); })) {
        throw MeasurementError(where() +
                               "numbers where the names of the columns should be; begin with a "
                               "line such as voltage_v,torque_nm");
      }
      continue;
    }
    const auto fields = fields_of(text, separator);
    if (fields.size() != names_.size()) {
      throw MeasurementError(fmt::format("{}{} fields under {} names; mend the row", where(),
                                         fields.size(), names_.size()));
    }
    std::vector<double> row;
    for (std::size_t k = 0; k < fields.size(); ++k) {
      const auto value = traces::parse_real(fields[k]);
      if (!value && !fields[k].empty()) {
        throw MeasurementError(fmt::format("{}{} = \"{}\" is no number; write it as 1.25 or 1e-3",
                                           where(), names_[k], fields[k]));
      }
      row.push_back(value.value_or(std::numeric_limits<double>::quiet_NaN()));
    }
    values_.push_back(std::move(row));
    lines_.push_back(number);
  }
  if (names_.empty()) {
    throw MeasurementError(file_ + ":1: nothing in it; begin with the names of the columns");
  }
}

ColumnTable ColumnTable::of_file(const std::string& path) {
  if (path == "-") return {std::cin, "standard input"};
  std::ifstream in(path);
  if (!in) throw MeasurementError(path + ":0: cannot be read; check the path");
  return {in, path};
}

std::optional<std::size_t> ColumnTable::find(const std::vector<std::string>& names) const {
  for (const std::string& name : names) {
    const auto at = std::find(names_.begin(), names_.end(), name);
    if (at != names_.end()) return static_cast<std::size_t>(at - names_.begin());
  }
  return {};
}

std::size_t ColumnTable::need(const std::vector<std::string>& names,
                              const std::string& what) const {
  if (const auto column = find(names)) return *column;
  throw MeasurementError(fmt::format("{}:1: no column of {}; name it {} (there is {})", file_, what,
                                     fmt::join(names, " or "), fmt::join(names_, ", ")));
}

void ColumnTable::fail(std::size_t row, const std::string& what, const std::string& mend) const {
  throw MeasurementError(fmt::format("{}:{}: {}; {}", file_, lines_[row], what, mend));
}

}  // namespace feltgate::host
