// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The margin of a law's whole torque at a place of rest: by the linear loop, and by the swing of
// the core's own bits, whose law counts that many times. Documentation: docs/speed-for-accuracy.md
#pragma once

#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "studies/rates/margin.hpp"
#include "studies/stability/bit_loop.hpp"

namespace feltgate::rates {

/// Where the law comes to rest if the device is held at the angles of `place`: with its states and
/// lines. Nothing if its torque still changes after 0.3 s. `nm`: its torques there.
std::optional<Place> at_rest(const law::Law& law, const Place& place, double run_s,
                             const HostWords& words, Eigen::VectorXd* nm);

/// Growth of a swing: the logarithm of its size, from one period to the next.
class Envelope {
 public:
  /// From `from_s` on; ends after `periods` or when the swing is smaller or larger than that.
  Envelope(double from_s, double period_s, double smallest_rad, double largest_rad, int periods)
      : next_s_(from_s),
        period_s_(period_s),
        least_(smallest_rad),
        most_(largest_rad),
        left_(periods) {}
  /// The angles of all axes at a time, some dozen times a period; false when enough was seen.
  bool add(double time_s, const Eigen::VectorXd& angles_rad);
  /// +-infinity where the swing ended within three periods.
  double growth_1_s() const;

 private:
  double next_s_, period_s_, least_, most_;
  int left_;
  bool begun_ = false;
  Eigen::VectorXd low_, high_;
  std::vector<double> times_s_, logs_;
  double last_ = 0, first_ = 0;
};

/// A margin of the whole torque.
struct GainMargin {
  std::string of;           ///< "alone", or "with the scene's hand"
  double linear = 0;        ///< factor on the torque at which the linear loop stops being stable
  double rad_s = 0;         ///< of its swing there
  double swing_counts = 0;  ///< how large the swing of the bits begins
  double bits = std::numeric_limits<double>::quiet_NaN();  ///< factor at which bits begin to grow
  double swing_nm = 0;  ///< and the law's torque in it, at the border
  /// The swing spans 6 counts and 2.5 steps of the duty: less says nothing of a linear loop.
  bool large = false;
  bool disagrees = false;  ///< the bits were tried and show no border near
  std::string why;         ///< why bits are missing
};

/// Finds the factor at which a swing neither grows nor dies, near `linear`, to 1 % and
/// interpolated; NaN where none is between 0.5 and 2 times `linear`.
double border_of(double linear, const std::function<double(double factor)>& growth_1_s);

/// How far to deflect the device from rest along `direction`: at most `most_rad`, and so little
/// that the law's torque is linear within 2 %; 0: not even 5 counts.
double linear_range_rad(const law::Law& law, const Place& rest, const Eigen::VectorXd& direction,
                        double count_rad, double most_rad, const HostWords& words);

/// Whether the law's torque in a swing of that size, and as fast, is that of a small one, to 3 % of
/// what has the frequency of the swing.
bool swings_linearly(const law::Law& law, const Place& rest, const Eigen::VectorXd& direction,
                     double by, double rad_s, double run_s, const HostWords& words);

}  // namespace feltgate::rates
