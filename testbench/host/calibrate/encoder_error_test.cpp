// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The error of an absolute encoder, from a simulated turn, and what the core's table leaves of it.
// Documentation: docs/calibration.md
#include <algorithm>
#include <cmath>

#include "bench.hpp"
#include "catch.hpp"
#include "design/design.hpp"
#include "feltgate/absolute_encoder.hpp"
#include "host/identify/identify.hpp"
#include "host/identify/report.hpp"
#include "sim/backends/absolute_sensor.hpp"

using namespace feltgate;
using namespace feltgate::host;
using namespace feltgate::test;

namespace {

constexpr double kTurn = 2 * M_PI;
/// A magnet off its axis by half a degree, and a second harmonic.
const std::vector<double> kError{7.5e-3, 4.5e-3, -1.2e-3, 0.9e-3};
constexpr int kBits = 14;
constexpr double kCount = kTurn / 16384;

/// A free motor that was spun up and runs down, as its sensor of 14 bits shows it, with noise.
Recording shown(double volts, double seconds, std::uint64_t seed, double noise_counts) {
  plant::Parameters p = shipped("p24");
  p.encoder.lines = 1 << 16;  // the angle, nearly itself
  Recording r = drive(p, {{volts, seconds}, {0, 6, true}});
  const auto go = std::lower_bound(r.time_s.begin(), r.time_s.end(), seconds) - r.time_s.begin();
  r.time_s.erase(r.time_s.begin(), r.time_s.begin() + go);
  r.angle_rad.erase(r.angle_rad.begin(), r.angle_rad.begin() + go);
  SplitMix64 random(seed);
  AbsoluteSensor sensor(AbsoluteEncoder::Parameters{});
  sensor.set_error(kError);
  for (double& angle : r.angle_rad) {
    const double rad = sensor.shown_rad(angle) + noise_counts * kCount * random.gaussian();
    angle = std::floor(rad / kCount) * kCount;
  }
  return r;
}

std::vector<double> values(const EncoderError& e) {
  std::vector<double> terms;
  for (const Interval& i : e.terms_rad) terms.push_back(i.value);
  return terms;
}

/// The design with a table against this error.
design::Design with_table(const std::vector<double>& terms_rad) {
  design::Design d;
  d.absolute_bits = kBits;
  for (const double term : terms_rad) d.absolute_error_mrad.push_back(1e3 * term);
  return d;
}

/// The largest error over a turn, less its mean, without and with the corrections of a core.
struct Left {
  double before_rad = 0, after_rad = 0;
};
Left left(const design::Design& d) {
  AbsoluteSensor sensor(AbsoluteEncoder::Parameters{});
  sensor.set_error(kError);
  const auto table = d.absolute_corrections();
  std::vector<double> before, after;
  for (int k = 0; k < 10000; ++k) {
    const double rad = k * kTurn / 10000;
    const auto count = static_cast<std::int32_t>(std::floor(sensor.shown_rad(rad) / kCount));
    before.push_back((count + 0.5) * kCount - rad);
    after.push_back((corrected(count, table.data(), kBits) + 0.5) * kCount - rad);
  }
  const auto largest = [](const std::vector<double>& v) {
    double mean = 0, most = 0;
    for (const double x : v) mean += x / static_cast<double>(v.size());
    for (const double x : v) most = std::max(most, std::abs(x - mean));
    return most;
  };
  return {largest(before), largest(after)};
}

}  // namespace

TEST_CASE("encoder: a turn that runs down gives the error of its encoder, and the table takes it") {
  for (const double volts : {6.0, -4.0}) {
    const EncoderError e = identify_encoder(shown(volts, 0.5, 1, 0.5), 4, kCount, 0.95);
    INFO(report_text(e, 0.95));
    CHECK(e.turns > 3);
    CHECK(e.warnings.empty());
    // On another seed and in the other direction the same is left over as here.
    const EncoderError again = identify_encoder(shown(-volts, 0.4, 2, 0.5), 4, kCount, 0.95);
    for (std::size_t k = 0; k < e.terms_rad.size(); ++k) {
      const double truth = k < kError.size() ? kError[k] : 0;
      CHECK(std::abs(e.terms_rad[k].value - truth) < 0.1e-3);
      CHECK(std::abs(again.terms_rad[k].value - e.terms_rad[k].value) < 0.2e-3);
    }
    // A tenth of half a degree is 0.87 mrad, and a count 0.38.
    const Left whole = left(with_table(values(e)));
    INFO(1e3 * whole.before_rad << " mrad, with the table " << 1e3 * whole.after_rad);
    CHECK(whole.before_rad > 8.7e-3);
    CHECK(whole.after_rad < whole.before_rad / 10);
    // A table of a second turn, taken with the first in the core, finds nothing.
    Recording turn = shown(-volts, 0.5, 3, 0.5);
    const auto table = with_table(values(e)).absolute_corrections();
    for (double& angle : turn.angle_rad) {
      const auto count = static_cast<std::int32_t>(std::lround(angle / kCount));
      angle = corrected(count, table.data(), kBits) * kCount;
    }
    CHECK(identify_encoder(turn, 4, kCount, 0.95).largest_rad < 0.3e-3);
  }
}

TEST_CASE("encoder: with a better encoder on the shaft its motion does not matter") {
  SplitMix64 random(5);
  AbsoluteSensor sensor(AbsoluteEncoder::Parameters{});
  sensor.set_error(kError);
  Recording r;
  double rad = 0;
  for (int k = 0; k < 4000; ++k) {
    rad += 0.02 * (0.5 + std::sin(0.01 * k)) + 0.002 * random.gaussian();  // a hand, to and fro
    r.time_s.push_back(k * 1e-3);
    r.angle_rad.push_back(std::floor(sensor.shown_rad(rad) / kCount) * kCount);
    r.reference_rad.push_back(rad + 0.7);
  }
  const EncoderError e = identify_encoder(r, 2, kCount, 0.95);
  CHECK(e.by_reference);
  for (std::size_t k = 0; k < kError.size(); ++k) {
    CHECK(std::abs(e.terms_rad[k].value - kError[k]) < 0.03e-3);
  }
  r.reference_rad.clear();
  CHECK_FALSE(identify_encoder(r, 2, kCount, 0.95).warnings.empty());
}

TEST_CASE("encoder: what does not determine the error is refused") {
  Recording r = shown(4, 0.5, 1, 0);
  r.time_s.resize(200);
  r.angle_rad.resize(200);
  CHECK_THROWS_WITH(identify_encoder(r, 4, kCount, 0.95), Catch::Contains("turns one way"));
}

TEST_CASE("encoder: the corrections are within half a count of the curve, and half an entry") {
  for (const int bits : {12, 14, 19}) {
    design::Design d = with_table({0.12, -0.07, 0.01, 0.02, 0, 0, -0.004, 0.005});
    d.absolute_bits = bits;
    const auto table = d.absolute_corrections();
    const double counts_per_rad = std::ldexp(1 / kTurn, bits);
    // Of a straight line between two of 256 angles: n^2 (2 pi/256)^2 / 8 of each harmonic.
    const double chord_rad =
        std::pow(kTurn / 256, 2) / 8 *
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
