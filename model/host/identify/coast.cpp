// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Evaluates a coast-down of the lever: the angle has a closed form, which is fitted to the counts.
// And a turn of a free shaft: what repeats with it is the error of its encoder.
// Documentation: docs/identify.md, docs/calibration.md
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "design/design.hpp"
#include "host/identify/identify.hpp"

namespace feltgate::host {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kWindow_s = 0.06, kShortest_s = 0.015;
constexpr int kCoastRounds = 30;
constexpr double kSteepest_1_s = 1e3;

/// The last windows, in which the lever slows down; before them it was still driven.
std::vector<const Window*> slowing(const std::vector<Window>& windows) {
  std::vector<const Window*> used;
  for (const Window& w : windows) {
    if (w.slowest_rad_s <= kCreep_rad_s) continue;
    if (w.acceleration_rad_s2 * w.speed_rad_s >= 0) {
      used.clear();
    } else {
      used.push_back(&w);
    }
  }
  return used;
}

/// The angle without its constant, for speed w0, damping b (1/s) and friction f (rad/s^2):
/// w0*e1 - f*e2, e1 = (1 - exp(-b t))/b, e2 = (t - e1)/b.
struct Way {
  double e1, e2;
};

Way way(double b, double t) {
  const double x = b * t;
  if (std::abs(x) < 1e-4) return {t * (1 - x / 2 + x * x / 6), t * t * (0.5 - x / 6 + x * x / 24)};
  const double e1 = -std::expm1(-x) / b;
  return {e1, (t - e1) / b};
}

/// Gauss-Newton fit of angle, speed, damping and friction; keeps the columns of the last iteration.
class CoastFit {
 public:
  CoastFit(const Recording& r, double from_s, double to_s) {
    for (std::size_t k = 0; k < r.rows(); ++k) {
      if (r.time_s[k] < from_s || r.time_s[k] > to_s) continue;
      time_s_.push_back(r.time_s[k] - from_s);
      angle_rad_.push_back(r.angle_rad[k] - r.angle_rad.front());
    }
  }

  /// Fits, starting from a guess of speed, damping and friction.
  Regression run(double speed_rad_s, double damping_1_s, double friction_rad_s2,
                 double confidence) {
    p_ << angle_rad_.front(), speed_rad_s, damping_1_s, friction_rad_s2;
    for (int round = 0; round < kCoastRounds; ++round) {
      const Regression step = regression(confidence);
      Eigen::Vector4d d;
      for (int k = 0; k < 4; ++k) d[k] = step.value(k);
      p_ += d;
      if (!p_.allFinite() || std::abs(p_[2]) > kSteepest_1_s) {
        throw MeasurementError(
            "the coast-down is no line of dry and viscous friction; let nothing touch the lever, "
            "and record from where it is let go");
      }
      if (std::abs(d[2]) < 1e-9 && std::abs(d[3]) < 1e-9 * std::abs(p_[3])) break;
    }
    return regression(confidence);
  }
  double damping_1_s() const { return p_[2]; }
  double friction_rad_s2() const { return p_[3]; }

 private:
  Regression regression(double confidence) const {
    const auto n = static_cast<Index>(time_s_.size());
    MatrixXd x(n, 4);
    VectorXd y(n);
    for (Index k = 0; k < n; ++k) {
      const double t = time_s_[static_cast<std::size_t>(k)], b = p_[2];
      const double db = 1e-4 / std::max(t, 1e-3);
      const Way w = way(b, t), up = way(b + db, t), down = way(b - db, t);
      x(k, 0) = 1;
      x(k, 1) = w.e1;
      x(k, 2) = (p_[1] * (up.e1 - down.e1) - p_[3] * (up.e2 - down.e2)) / (2 * db);
      x(k, 3) = -w.e2;
      y[k] = angle_rad_[static_cast<std::size_t>(k)] - (p_[0] + p_[1] * w.e1 - p_[3] * w.e2);
    }
    return {x, y, confidence};
  }

  std::vector<double> time_s_, angle_rad_;
  Eigen::Vector4d p_;
};

/// First guess of damping and friction, from the windows alone: coarse, but direct.
std::pair<double, double> guess(const std::vector<const Window*>& windows, double confidence) {
  const auto n = static_cast<Index>(windows.size());
  MatrixXd x(n, 2);
  VectorXd y(n);
  for (Index k = 0; k < n; ++k) {
    const Window& w = *windows[static_cast<std::size_t>(k)];
    x(k, 0) = -std::abs(w.speed_rad_s);
    x(k, 1) = -1;
    y[k] = -std::abs(w.acceleration_rad_s2);
  }
  const Regression fit(x, y, confidence);
  return {fit.value(0), fit.value(1)};
}

}  // namespace

Coast identify_coast(const Recording& recording, double confidence) {
  std::vector<Window> windows;
  std::vector<const Window*> used;
  for (double shortest_s = kWindow_s; shortest_s >= kShortest_s; shortest_s /= 2) {
    windows = windows_of(recording, shortest_s);
    used = slowing(windows);
    if (used.size() >= 8) break;
  }
  if (used.size() < 4) {
    throw MeasurementError(fmt::format(
        "{}: the lever runs down in {} windows only; let it go at a higher speed, and record until "
        "it stands",
        recording.name, used.size()));
  }
  Recording turned = recording;
  if (used.front()->speed_rad_s < 0) {
    for (double& a : turned.angle_rad) a = -a;
  }
  CoastFit coast(turned, used.front()->from_s, used.back()->to_s);
  const auto [damping_1_s, friction_rad_s2] = guess(used, confidence);
  const Regression fit =
      coast.run(std::abs(used.front()->speed_rad_s), damping_1_s, friction_rad_s2, confidence);
  Coast c;
  c.damping_1_s = fit.coefficient(2).plus(coast.damping_1_s());
  c.friction_rad_s2 = fit.coefficient(3).plus(coast.friction_rad_s2());
  c.noise_rad = fit.sigma();
  c.freedom = fit.freedom();
  c.length_s = used.back()->to_s - used.front()->from_s;
  c.covariance = fit.covariance().bottomRightCorner(2, 2);
  for (const Window* w : used) {
    c.fastest_rad_s = std::max(c.fastest_rad_s, std::abs(w->speed_rad_s));
  }
  return c;
}

namespace {

constexpr double kTurnRad = 2 * 3.14159265358979323846;
constexpr double kFewestTurns = 3;
constexpr double kEnds = 0.25;       ///< of a turn, left out at both ends: friction near rest
constexpr double kTurnsPerKnot = 1;  ///< so the smooth motion cannot follow the shaft
constexpr std::size_t kMostKnots = 60;

/// B-splines of degree 5 over the time, with knots where the shaft has turned by equal parts.
class Splines {
 public:
  Splines(const std::vector<double>& time_s, const std::vector<double>& angle_rad) {
    const double way = angle_rad.back() - angle_rad.front();
    const auto parts = std::clamp<std::size_t>(
        static_cast<std::size_t>(std::abs(way) / (kTurnRad * kTurnsPerKnot)), 1, kMostKnots);
    knots_.assign(kDegree + 1, time_s.front());
    std::size_t row = 0;
    for (std::size_t k = 1; k < parts; ++k) {
      const double share = static_cast<double>(k) / static_cast<double>(parts);
      while ((angle_rad[row] - angle_rad.front()) / way < share) ++row;
      knots_.push_back(time_s[row]);
    }
    knots_.insert(knots_.end(), kDegree + 1, time_s.back());
  }
  Index size() const { return static_cast<Index>(knots_.size() - kDegree - 1); }

  /// The values of all splines at a time, after de Boor.
  VectorXd at(double t) const {
    std::size_t span = kDegree;
    while (span + kDegree + 2 < knots_.size() && t >= knots_[span + 1]) ++span;
    double b[kDegree + 1] = {1};
    for (std::size_t degree = 1; degree <= kDegree; ++degree) {
      double carried = 0;
      for (std::size_t k = 0; k < degree; ++k) {
        const double right = knots_[span + 1 + k], left = knots_[span + 1 + k - degree];
        const double part = b[k] / (right - left);
        b[k] = carried + (right - t) * part;
        carried = (t - left) * part;
      }
      b[degree] = carried;
    }
    VectorXd all = VectorXd::Zero(size());
    for (std::size_t k = 0; k <= kDegree; ++k) all[static_cast<Index>(span - kDegree + k)] = b[k];
    return all;
  }

 private:
  static constexpr std::size_t kDegree = 5;
  std::vector<double> knots_;
};

/// Without its ends.
Recording inner(const Recording& turn) {
  std::size_t first = 0, last = turn.rows() - 1;
  const auto far = [&](std::size_t a, std::size_t b) {
    return std::abs(turn.angle_rad[a] - turn.angle_rad[b]) > kEnds * kTurnRad;
  };
  while (first < last && !far(first, 0)) ++first;
  while (last > first && !far(last, turn.rows() - 1)) --last;
  Recording r;
  r.name = turn.name;
  const auto cut = [&](const std::vector<double>& v) {
    using Way = std::vector<double>::difference_type;
    return std::vector<double>(v.begin() + static_cast<Way>(first),
                               v.begin() + static_cast<Way>(last) + 1);
  };
  r.time_s = cut(turn.time_s);
  r.angle_rad = cut(turn.angle_rad);
  if (!turn.reference_rad.empty()) r.reference_rad = cut(turn.reference_rad);
  return r;
}

/// The slowest and fastest of eighths of a turn.
void speeds(const Recording& r, EncoderError* e) {
  e->slowest_rad_s = std::numeric_limits<double>::infinity();
  for (std::size_t from = 0, to = 0; to < r.rows(); ++to) {
    const double way = std::abs(r.angle_rad[to] - r.angle_rad[from]);
    if (way < kTurnRad / 8) continue;
    const double speed = way / (r.time_s[to] - r.time_s[from]);
    e->slowest_rad_s = std::min(e->slowest_rad_s, speed);
    e->fastest_rad_s = std::max(e->fastest_rad_s, speed);
    from = to;
  }
}

}  // namespace

EncoderError identify_encoder(const Recording& turn, int harmonics, double count_rad,
                              double confidence) {
  const Recording r = inner(turn);
  EncoderError e;
  e.turns = std::abs(r.angle_rad.back() - r.angle_rad.front()) / kTurnRad;
  e.by_reference = !r.reference_rad.empty();
  if (e.turns < kFewestTurns) {
    throw MeasurementError(fmt::format(
        "{}: {:.2g} turns one way, without a quarter at each end; turn the shaft by at least {:g}, "
        "better ten",
        r.name, e.turns, kFewestTurns));
  }
  const Splines motion(r.time_s, r.angle_rad);
  const auto rows = static_cast<Index>(r.rows());
  const Index smooth = e.by_reference ? 1 : motion.size();
  MatrixXd x(rows, smooth + 2 * harmonics);
  VectorXd y(rows);
  for (Index k = 0; k < rows; ++k) {
    const auto row = static_cast<std::size_t>(k);
    y[k] = r.angle_rad[row] - (e.by_reference ? r.reference_rad[row] : 0);
    if (e.by_reference) {
      x(k, 0) = 1;
    } else {
      x.row(k).head(smooth) = motion.at(r.time_s[row]);
    }
    for (int n = 1; n <= harmonics; ++n) {
      x(k, smooth + 2 * n - 2) = std::cos(n * r.angle_rad[row]);
      x(k, smooth + 2 * n - 1) = std::sin(n * r.angle_rad[row]);
    }
  }
  const Regression fit(x, y, confidence);
  std::vector<double> terms;
  for (Index k = 0; k < 2 * harmonics; ++k) {
    e.terms_rad.push_back(fit.coefficient(smooth + k));
    terms.push_back(fit.value(smooth + k));
  }
  for (int k = 0; k < 1024; ++k) {
    const double error_rad = design::harmonics(terms, k * kTurnRad / 1024);
    e.largest_rad = std::max(e.largest_rad, std::abs(error_rad));
  }
  e.noise_rad = fit.sigma();
  e.freedom = fit.freedom();
  speeds(r, &e);
  if (e.noise_rad > 3 * 0.29 * count_rad) {
    e.warnings.push_back(fmt::format(
        "{:.2g} counts are left over, and rounding to counts leaves 0.29: the motion was not "
        "smooth, the readings are not all of the same age, the encoder is noisy, or it needs "
        "more --harmonics",
        e.noise_rad / count_rad));
  }
  return e;
}

}  // namespace feltgate::host
