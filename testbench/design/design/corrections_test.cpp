// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The table against the error of an absolute encoder. Documentation:
// docs/blocks/absolute_encoder.md
#include <algorithm>
#include <cmath>

#include "catch.hpp"
#include "design/design.hpp"
#include "feltgate/absolute_encoder.hpp"
#include "sim/backends/absolute_sensor.hpp"

namespace feltgate {

constexpr double turn_rad = 2 * M_PI;

TEST_CASE("encoder: the table takes a sensor's error away") {
  // A magnet off its axis by half a degree, and a second harmonic.
  const std::vector<double> error_rad{7.5e-3, 4.5e-3, -1.2e-3, 0.9e-3};
  constexpr int bits = 14, angles = 10'000;
  AbsoluteSensor sensor(AbsoluteEncoder::Parameters{});
  sensor.set_error(error_rad);
  design::Design d;
  d.absolute_bits = bits;
  for (const double term : error_rad) d.absolute_error_mrad.push_back(1e3 * term);
  const auto table = d.absolute_corrections();
  const double count_rad = std::ldexp(turn_rad, -bits);
  double before = 0, after = 0;
  for (int k = 0; k < angles; ++k) {
    const double rad = k * turn_rad / angles;
    const auto count = static_cast<std::int32_t>(std::floor(sensor.shown_rad(rad) / count_rad));
    before = std::max(before, std::abs((count + 0.5) * count_rad - rad));
    after =
        std::max(after, std::abs((corrected(count, table.data(), bits) + 0.5) * count_rad - rad));
  }
  CHECK(before > 8.7e-3);
  CHECK(after < before / 10);
}

TEST_CASE("encoder: the corrections are within half a count of the curve, and half an entry") {
  for (const int bits : {12, 14, 19}) {
    design::Design d;
    d.absolute_bits = bits;
    d.absolute_error_mrad = {120, -70, 10, 20, 0, 0, -4, 5};
    const auto table = d.absolute_corrections();
    const double counts_per_rad = std::ldexp(1 / turn_rad, bits);
    // Of a straight line between two of 256 angles: n^2 (2 pi/256)^2 / 8 of each harmonic.
    const double chord_rad =
        std::pow(turn_rad / 256, 2) / 8 *
        (std::hypot(0.12, 0.07) + 4 * std::hypot(0.01, 0.02) + 16 * std::hypot(0.004, 0.005));
    const double bound = 0.5 + std::ldexp(0.5, bits - 20) + counts_per_rad * chord_rad + 1e-9;
    double worst = 0;
    for (std::int32_t k = -(1 << bits); k < 1 << bits; ++k) {
      const double rad = k / counts_per_rad;
      double error_mrad = 0;
      for (std::size_t t = 0; t < d.absolute_error_mrad.size(); ++t) {
        const double x = static_cast<double>(t / 2 + 1) * rad;
        error_mrad += d.absolute_error_mrad[t] * (t % 2 == 0 ? std::cos(x) : std::sin(x));
      }
      worst = std::max(worst, std::abs(corrected(k, table.data(), bits) - k +
                                       1e-3 * error_mrad * counts_per_rad));
    }
    INFO(bits << " bits: " << worst << " of " << bound);
    CHECK(worst <= bound);
    CHECK(worst > 0.9 * 0.5);
    // Wraps, and keeps the order.
    for (std::int32_t k = -(1 << bits); k < 1 << bits; ++k) {
      if (corrected(k + 1, table.data(), bits) < corrected(k, table.data(), bits)) FAIL(k);
    }
  }
}

}  // namespace feltgate
