// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Linear least squares with intervals by Student's t. A quotient's interval follows Fieller's
// theorem, which is exact where the usual propagation of errors is not. Documentation:
// docs/calibration.md
#pragma once

#include <iosfwd>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include <Eigen/Dense>

namespace feltgate::host {

/// Measurements that do not determine the requested result: what() reads "what; mend".
class MeasurementError : public std::invalid_argument {
 public:
  using std::invalid_argument::invalid_argument;
};

/// An estimate and its confidence interval.
struct Interval {
  double value = 0, low = 0, high = 0;
  bool contains(double x) const { return low <= x && x <= high; }
  double half() const { return (high - low) / 2; }
  /// The interval times a known constant.
  Interval times(double factor) const;
  /// A known constant divided by the interval; 0 must be outside of it.
  Interval under(double top) const;
  Interval plus(double shift) const { return {value + shift, low + shift, high + shift}; }
};

/// constant + weights . coefficients
struct Combination {
  double constant = 0;
  Eigen::VectorXd weights;
};

/// A fitted linear model.
class Regression {
 public:
  /// Fits y = x . coefficients + noise of constant variance. Errors: MeasurementError if there are
  /// not more rows than columns, or if the columns do not determine the coefficients.
  Regression(const Eigen::MatrixXd& x, const Eigen::VectorXd& y, double confidence);

  Eigen::Index size() const { return coefficients_.size(); }
  double value(Eigen::Index k) const { return coefficients_[k]; }
  Interval coefficient(Eigen::Index k) const;
  Interval combination(const Combination& c) const;
  /// top/bottom; nothing if the bottom's interval contains 0, as the quotient then has no bounds.
  std::optional<Interval> quotient(const Combination& top, const Combination& bottom) const;
  const Eigen::MatrixXd& covariance() const { return covariance_; }

  const Eigen::VectorXd& residuals() const { return residuals_; }
  /// Residual divided by its standard deviation, which is estimated without that row (externally
  /// studentised); the noise is taken as at least `least`.
  double studentised(Eigen::Index row, double least = 0) const;
  double sum_of_squares() const { return residuals_.squaredNorm(); }
  /// Standard deviation of the noise.
  double sigma() const { return sigma_; }
  int freedom() const { return freedom_; }
  /// Student's t at the confidence, two-sided.
  double t() const { return t_; }

 private:
  Eigen::VectorXd coefficients_, residuals_, leverage_;
  Eigen::MatrixXd covariance_;
  double sigma_ = 0, t_ = 0;
  int freedom_ = 0;
};

/// Value of Student's t whose magnitude is exceeded with probability 1 - confidence.
double student_t(double confidence, int freedom);

// Tables of numbers in named columns, from a file or typed in.

/// A table of numbers, separated by commas, semicolons, tabs or blanks; # begins a comment; an
/// empty field is NaN.
class ColumnTable {
 public:
  /// Reads a header line and rows. Errors: MeasurementError "file:line: what; mend".
  ColumnTable(std::istream& in, std::string name);
  /// The same from a file; "-" is the standard input.
  static ColumnTable of_file(const std::string& path);

  std::size_t rows() const { return lines_.size(); }
  const std::vector<std::string>& names() const { return names_; }
  const std::string& file() const { return file_; }
  int line(std::size_t row) const { return lines_[row]; }
  /// The first of these names that exists; upper and lower case are equal.
  std::optional<std::size_t> find(const std::vector<std::string>& names) const;
  /// The same; throws if none exists, with `what` as its meaning.
  std::size_t need(const std::vector<std::string>& names, const std::string& what) const;
  double at(std::size_t row, std::size_t column) const { return values_[row][column]; }
  /// Throws a MeasurementError with the line of a row.
  [[noreturn]] void fail(std::size_t row, const std::string& what, const std::string& mend) const;

 private:
  std::string file_;
  std::vector<std::string> names_;
  std::vector<std::vector<double>> values_;
  std::vector<int> lines_;
};

}  // namespace feltgate::host
