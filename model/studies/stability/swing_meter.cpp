// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Documentation: docs/speed-for-accuracy.md
#include "studies/stability/swing_meter.hpp"

#include <cmath>
#include <limits>

namespace feltgate::stability {

bool SwingMeter::add(double time_s, double theta_rad, double omega_rad_s) {
  constexpr int skipped = 3;
  if (done_ || left_) return false;
  if (speed_ * omega_rad_s < 0) {
    const double size = std::abs(theta_rad - extreme_rad_) / 2;
    extreme_rad_ = theta_rad;
    if (++seen_ > skipped) {
      times_s_.push_back(time_s);
      logs_.push_back(std::log(size));
      done_ = size < smallest_rad_ || seen_ == wanted_ + skipped;
    }
  }
  if (omega_rad_s != 0) speed_ = omega_rad_s;
  return !done_;
}

Growth SwingMeter::growth() const {
  Growth g;
  g.left = left_;
  g.swings = static_cast<int>(logs_.size());
  if (g.swings < 3) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    g.rate_1_s = left_ ? infinity : -infinity;
    return g;
  }
  double t = 0, y = 0, tt = 0, ty = 0;
  for (std::size_t i = 0; i < logs_.size(); ++i) {
    t += times_s_[i];
    y += logs_[i];
    tt += times_s_[i] * times_s_[i];
    ty += times_s_[i] * logs_[i];
  }
  const double n = static_cast<double>(logs_.size());
  g.rate_1_s = (n * ty - t * y) / (n * tt - t * t);
  g.rad_s = 3.141592653589793 * (n - 1) / (times_s_.back() - times_s_.front());
  return g;
}

}  // namespace feltgate::stability
