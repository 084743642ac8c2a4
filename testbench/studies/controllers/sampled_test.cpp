// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The velocity by an absolute encoder, whose angle is read, rounded and late: estimators in their
// bits, beside closed forms of what a count over a window makes. Documentation:
// docs/blocks/absolute_encoder.md
#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "catch.hpp"
#include "feltgate/axis/absolute.hpp"
#include "feltgate/axis/tick_counter.hpp"
#include "feltgate/generated/lever_absolute.hpp"
#include "sim/backends/absolute_sensor.hpp"
#include "sim/reference/chain.hpp"

using namespace feltgate;

namespace {

constexpr double kTick_s = 1e-6, kTurn = 6.283185307179586, kPole_rad_s = 500;
constexpr double kRamp_rad_s2 = 200, kSettled_s = 0.15, kCount_rad = kTurn / 16384;
constexpr int kPeriod_ticks = LeverAbsolute::absolute_period;
constexpr std::array<double, 4> speeds_rad_s{0.107, 1.07, 10.7, 107};

/// The same sensor without a diagnosis between its angles.
struct BySsi : LeverAbsolute {
  static constexpr int absolute_framing = 1;
};
template <class Of, int M1, int Shift>
struct ByWindow : Of {
  static constexpr int m1 = M1, velocity_shift = Shift;
};

/// A steady speed, or one that grows from 0.
struct Motion {
  double rad_s = 0, rad_s2 = 0, seconds = 0;
  double at(double s) const { return 0.0123 + rad_s * s + rad_s2 * s * s / 2; }
  double speed(double s) const { return rad_s + rad_s2 * s; }
  int ticks() const { return static_cast<int>(seconds / kTick_s); }
};
Motion steady(double rad_s) { return {rad_s, 0, rad_s < 1 ? 0.6 : 0.3}; }
constexpr Motion ramp{0, kRamp_rad_s2, 0.4};

/// A design's data with the framing of D.
template <class D>
axis::Design design_of_reading() {
  axis::Design design = axis::Design::of<D>();
  design.constants["ABSOLUTE_FRAMING"] = D::absolute_framing;
  return design;
}
template <class D>
AbsoluteEncoder::Parameters parameters_of_reading() {
  return axis::Absolute::parameters(design_of_reading<D>());
}

/// What the core's decoder has as travel at the sample of each tick, clock by clock of its lines.
template <class D>
std::vector<std::int16_t> read_by(const Motion& motion) {
  constexpr int sample = axis::TickCounter::sample_clock;
  axis::Absolute position(design_of_reading<D>());
  AbsoluteSensor sensor(parameters_of_reading<D>());
  std::vector<std::int16_t> out;
  Clock now = 0;
  for (int k = 0; k < motion.ticks(); ++k) {
    sensor.turn(motion.at(k * kTick_s), motion.at((k + 1) * kTick_s), now, D::clocks_per_tick);
    for (int c = 0; c < D::clocks_per_tick; ++c, ++now) {
      axis::Pins in;
      axis::Encoder at;
      in.encoder_data = sensor.pin(now, position.lines());
      at.sample = c == sample;
      if (at.sample) out.push_back(static_cast<std::int16_t>(position.out().travel));
      position.clock(in, at, {});
    }
  }
  return out;
}

struct Seen {
  double rms = 0, worst = 0, mean = 0;  ///< of the velocity less the true one, rad/s
};
class Spread {
 public:
  void add(double error) {
    sum_ += error, squares_ += error * error, worst_ = std::max(worst_, std::abs(error)), ++n_;
  }
  Seen seen() const { return {std::sqrt(squares_ / n_), worst_, sum_ / n_}; }

 private:
  double sum_ = 0, squares_ = 0, worst_ = 0, n_ = 0;
};
struct Errors {
  Seen filtered, raw;
};

/// An estimator by counts, fed with a travel of each tick; less its error of gain.
template <class D>
Errors errors_of(const std::vector<std::int16_t>& travel, const Motion& motion) {
  const double gain = std::ldexp(D::m1 * kTick_s / kCount_rad, D::velocity_shift);
  DesignInfo design = design_info<D>();
  design.data.constants["M1"] = D::m1;
  design.data.constants["VELOCITY_SHIFT"] = D::velocity_shift;
  Chain<axis::Fixed> chain("N", design);
  chain.set_parameter(D::A::velocity_a1, -std::expm1(-kPole_rad_s * kTick_s));
  Spread filtered, raw;
  for (int k = 0; k < motion.ticks(); ++k) {
    const auto t = travel[static_cast<std::size_t>(k)];
    const double input = axis::Fixed::value(chain.velocity_input(t), D::f.velocity.fraction);
    ChainIn in;
    in.position = in.travel = t;
    chain.tick(in);
    if (k * kTick_s < kSettled_s) continue;
    raw.add(input / gain - motion.speed(k * kTick_s));
    filtered.add(chain.out().velocity_rad_s / gain - motion.speed(k * kTick_s));
  }
  return {filtered.seen(), raw.seen()};
}

/// Of whole counts in a window at a steady speed: so many or one more, in their shares; and of
/// whole readings, where the window is no multiple.
struct Closed {
  double rms = 0, worst = 0;
};
Closed of_counts(double rad_s, int m1) {
  const double counts = rad_s * m1 * kTick_s / kCount_rad, down = std::floor(counts);
  const double step = rad_s / counts, share = counts - down;
  const double below = step * down - rad_s, above = below + step;
  const double readings = static_cast<double>(m1) / kPeriod_ticks,
               part = readings - std::floor(readings);
  Closed c{std::sqrt((1 - share) * below * below + share * above * above),
           std::max(std::abs(below), std::abs(above))};
  if (part > 0) {
    c.rms = std::hypot(c.rms, rad_s * std::sqrt(part * (1 - part)) / readings);
    c.worst = step + rad_s * std::max(part, 1 - part) / readings;
  }
  return c;
}

}  // namespace

TEST_CASE("sampled velocity: an absolute encoder's, with closed forms") {
  std::array<std::vector<std::int16_t>, 5> spi, ssi;
  std::array<Motion, 5> motions;
  for (std::size_t k = 0; k < 5; ++k) {
    motions[k] = k < 4 ? steady(speeds_rad_s[k]) : ramp;
    spi[k] = read_by<LeverAbsolute>(motions[k]);
    ssi[k] = read_by<BySsi>(motions[k]);
  }
  const auto check = [&](auto design, const auto& travel, double age_s, bool diagnosis) {
    using D = decltype(design);
    std::array<Errors, 5> of;
    for (std::size_t k = 0; k < 5; ++k) of[k] = errors_of<D>(travel[k], motions[k]);
    const bool on_grid = D::m1 % kPeriod_ticks == 0;
    for (std::size_t k = 0; k < 4; ++k) {
      Closed c = of_counts(speeds_rad_s[k], D::m1);
      if (diagnosis) {
        // In 2 of 16 readings a window of four has 3 or 5.
        const double miss = speeds_rad_s[k] / 4;
        c.rms = std::hypot(c.rms, miss * std::sqrt(2.0 / 16)), c.worst += miss;
      }
      CAPTURE(D::m1, diagnosis, speeds_rad_s[k], of[k].raw.rms, c.rms, of[k].raw.worst, c.worst);
      // A count and a reading more do not come independently.
      const double margin = on_grid && !diagnosis ? 0.01 : 0.2;
      CHECK(std::abs(of[k].raw.rms / c.rms - 1) < (speeds_rad_s[k] > 100 ? 0.01 : margin));
      CHECK(of[k].raw.worst < 1.01 * c.worst);
      if (!diagnosis && on_grid) CHECK(of[k].raw.worst > 0.99 * c.worst);
      CHECK(of[k].filtered.rms < of[k].raw.rms);
    }
    const double lag_s = D::m1 * kTick_s / 2 + age_s + 1 / kPole_rad_s;
    CAPTURE(D::m1, diagnosis, of[4].filtered.mean, lag_s);
    CHECK(std::abs(-of[4].filtered.mean / kRamp_rad_s2 / lag_s - 1) < 0.02);
    return of;
  };
  // From the angle to the tick that has it, and until the next one.
  const auto age_s = [](const AbsoluteEncoder::Parameters& p, double held_ticks) {
    return (std::ceil(p.reading_clocks() / 50.0) + (held_ticks - 1) / 2) * kTick_s;
  };
  const double of_ssi = age_s(parameters_of_reading<BySsi>(), kPeriod_ticks);
  // One reading in 16 is held twice as long.
  const double of_spi = age_s(parameters_of_reading<LeverAbsolute>(), kPeriod_ticks * 18.0 / 16);
  check(LeverAbsolute{}, spi, of_spi, true);
  const auto four = check(ByWindow<BySsi, 384, 0>{}, ssi, of_ssi, false);
  check(ByWindow<BySsi, 96, 2>{}, ssi, of_ssi, false);
  const auto off = check(ByWindow<BySsi, 432, 0>{}, ssi, of_ssi, false);
  CHECK(off[3].raw.rms > 5 * four[3].raw.rms);
}
