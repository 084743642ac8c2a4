// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Incremental encoder: converts the angle to changes of the pins A, B and Z, each with the clock at
// which it is first visible. Documentation: docs/plant.md
#pragma once

#include <cstdint>
#include <vector>

#include "feltgate/encoder_source.hpp"
#include "parameters.hpp"

namespace feltgate::plant {

/// One encoder, advanced along the motion of its shaft.
class Encoder {
 public:
  /// `imperfect` = false leaves out offsets and jitter. Errors: std::invalid_argument for an angle
  /// beyond 2^45 counts, where doubles cannot resolve counts.
  Encoder(const EncoderParameters& parameters, bool imperfect, double start_rad);

  /// Moves the angle linearly to `theta_rad` during the `clocks` after `begin`. Appends events with
  /// clocks in (begin, begin + clocks], strictly increasing; changes in the same clock are one
  /// event. Errors: std::domain_error for more than one count per clock, which pins cannot show.
  void advance(double theta_rad, Clock begin, Clock clocks, std::vector<EncoderEvent>& events) {
    if (theta_rad >= low_rad_ && theta_rad < high_rad_) {
      theta_rad_ = theta_rad;
      return;
    }
    cross(theta_rad, begin, clocks, events);
  }

  EncoderPins pins() const { return pins_of(count_); }
  /// Ideal position, counts: 0 while the angle is in [0, one count).
  std::int64_t count() const { return count_; }
  /// Angle of the edge between counts `edge` - 1 and `edge`, rad; both directions share it.
  double edge_rad(std::int64_t edge) const;
  double count_rad() const { return count_rad_; }

 private:
  void cross(double theta_rad, Clock begin, Clock clocks, std::vector<EncoderEvent>& events);
  void settle();
  EncoderPins pins_of(std::int64_t count) const;

  std::int64_t counts_per_rev_;
  double count_rad_;
  std::vector<double> offset_counts_;  ///< empty for an ideal encoder
  double theta_rad_;
  std::int64_t count_ = 0;
  double low_rad_ = 0.0;  ///< edges around the present count
  double high_rad_ = 0.0;
};

}  // namespace feltgate::plant
