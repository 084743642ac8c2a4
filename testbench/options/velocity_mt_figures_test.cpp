// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Velocity by M/T: what it gives at turns and at rest, and its rms error and age beside the
// N-method behind good and bad encoders of 1024 lines. FELTGATE_WRITE_FIGURES=1 writes the table to
// campaigns/figures.md. docs/blocks/velocity.md
#include <fmt/format.h>

#include <array>
#include <cmath>

#include "catch.hpp"
#include "feltgate/axis/velocity_estimator.hpp"
#include "feltgate/generated/lever.hpp"
#include "feltgate/generated/paper.hpp"
#include "figures_record.hpp"
#include "random.hpp"

using namespace feltgate::axis;
using namespace feltgate::test;
using feltgate::Lever;
using feltgate::Paper;

namespace {

constexpr double kCount = Lever::count_rad, kHz = Lever::clock_hz;
constexpr int kTick = 50, kRead = 9;  // clocks of a tick; the velocity is read in this one

Design mt(int window, int doublings) {
  Design d = Design::of<Lever>();
  d.constants["MT_COUNTS"] = 4096;
  d.constants["MT_WINDOW"] = window;
  d.constants["MT_DOUBLINGS"] = doublings;
  return d;
}

struct Estimator {
  explicit Estimator(const Design& d)
      : law(d), meter(d), m1(d["M1"]), line(static_cast<std::size_t>(m1)), stamps(meter.places) {
    for (const Word& w : d.words) {
      if (w.name == "velocity_a1") p.velocity_a1 = w.reset;
    }
  }
  void clock(std::int16_t travel, bool sample) {
    if (meter.used) meter.clock(spans, stamps.data(), travel, sample);
    if (!sample) return;
    if (meter.used) {
      s = law.tick(s, p, spans);
    } else {
      const std::int16_t counts = window.counts(travel);
      window.tick(line.data(), m1, travel);
      s = law.tick(s, p, counts);
    }
  }
  double raw() const { return std::ldexp(static_cast<double>(spans.raw), -law.f); }  // rad/s
  double velocity() const { return std::ldexp(static_cast<double>(s.velocity), -law.f); }

  VelocityEstimator<Fixed> law;
  SpanMeter meter;
  int m1;
  std::vector<std::int16_t> line;
  std::vector<std::uint32_t> stamps;
  Words<std::int64_t> p;
  TravelWindow window;
  SpanMeter::State spans;
  VelocityEstimator<Fixed>::State s;
};

/// Where the edges of an encoder are, in counts: edge n lies at n + offset[n mod 4], and each line
/// elsewhere.
struct Encoder {
  std::array<double, 4> offset{};
  double per_line = 0;  ///< rms
  double edge(std::int64_t n) const {
    double at = static_cast<double>(n) + offset[n & 3];
    if (per_line > 0) {
      Random line(static_cast<std::uint64_t>((n >> 2) + 100000) * 7919);  // apart: no shared draws
      double sum = -6;
      for (int k = 0; k < 12; ++k) sum += std::ldexp(static_cast<double>(line.bits() >> 11), -53);
      at += per_line * sum;
    }
    return at;
  }
};
// High for 45 % of a cycle, the channels 90 - 20 degrees apart; offsets and lines as the observer's
// studies assume.
constexpr double kPhase = -4.0 * 20 / 360, kHigh = 4 * -0.05;
const std::array<Encoder, 3> kEncoders{
    {{}, {{0, kPhase, kHigh, kHigh + kPhase}}, {{0, 0.10, 0.05, -0.07}, 0.02}}};

enum { n_paper, n_lever, cycle, window, all };
using Estimators = std::array<Estimator, all>;
Estimators estimators() {
  return {Estimator(Design::of<Paper>()), Estimator(Design::of<Lever>()), Estimator(mt(0, 0)),
          Estimator(mt(19300, 4))};
}

/// Moves the encoder by angle(t), rad; each(t) once in a tick when the velocities are new.
template <class Angle, class Each>
void run(Estimators& of, const Encoder& encoder, double end_s, const Angle& angle,
         const Each& each) {
  std::int64_t count = 0;
  double below = encoder.edge(0), above = encoder.edge(1);
  for (std::int64_t clock = 0;; ++clock) {
    const double t = static_cast<double>(clock) / kHz;
    if (t >= end_s) return;
    const double at = angle(t) / kCount + 0.5;
    if (at >= above || at < below) {
      count += at >= above ? 1 : -1;
      below = encoder.edge(count);
      above = encoder.edge(count + 1);
    }
    for (Estimator& e : of) e.clock(static_cast<std::int16_t>(count & 0xffff), clock % kTick == 0);
    if (clock % kTick == kRead) each(t);
  }
}

struct Errors {
  std::array<double, all> raw{}, filtered{};  ///< rms, rad/s
};
Errors errors(const Encoder& encoder, double speed) {
  const double begin = 0.02 + 60 / speed * 1e-3, end = begin + 0.02 + 0.15 / speed;
  Estimators of = estimators();
  Errors e;
  double n = 0;
  run(
      of, encoder, end, [&](double t) { return speed * t; },
      [&](double t) {
        if (t < begin) return;
        n += 1;
        for (std::size_t k = 0; k < all; ++k) {
          e.raw[k] += std::pow(of[k].raw() - speed, 2);
          e.filtered[k] += std::pow(of[k].velocity() - speed, 2);
        }
      });
  for (double& x : e.raw) x = std::sqrt(x / n);
  for (double& x : e.filtered) x = std::sqrt(x / n);
  return e;
}

/// How far the raw velocities lag in a slow ramp through the speed: (velocity - raw) / slope, ms.
std::array<double, all> ages_ms(double speed) {
  const double begin = 0.02 + 30 / speed * 1e-3, end = begin + 0.02 + 0.1 / speed, slope = speed;
  const double middle = (begin + end) / 2;
  Estimators of = estimators();
  std::array<double, all> ms{};
  double n = 0;
  const auto angle = [&](double t) { return speed * t + slope * (t * t / 2 - middle * t); };
  run(of, kEncoders[0], end, angle, [&](double t) {
    if (t < begin) return;
    n += 1;
    for (std::size_t k = 0; k < all; ++k) {
      ms[k] += 1e3 * (speed + slope * (t - middle) - of[k].raw()) / slope;
    }
  });
  for (double& x : ms) x /= n;
  return ms;
}
/// Half of the span of whole cycles, half a cell for the hold, and a tick and the clocks to where
/// it is read.
double expected_age_ms(double speed, double window_s) {
  const double cell = kCount / speed;
  double span = 4 * cell;
  while (span < window_s) span *= 2;
  return 1e3 * (span / 2 + cell / 2 + 1.2e-6);
}

}  // namespace

TEST_CASE("velocity by M/T: a span, a turn, the way to standstill") {
  Estimator e(mt(0, 0));
  int travel = 0;
  std::int64_t clock = 0;
  const auto hold = [&](std::int64_t clocks) {
    while (clocks-- > 0) e.clock(static_cast<std::int16_t>(travel), clock++ % kTick == 0);
  };
  const auto move = [&](int counts, int clocks) {
    for (int k = 0; k < std::abs(counts); ++k) {
      travel += counts > 0 ? 1 : -1;
      hold(clocks);
    }
  };
  const double count_in_clock = kCount * kHz, lsb = std::ldexp(1.0, -e.law.f);
  move(20, 500);
  CHECK(e.raw() == Approx(count_in_clock / 500).margin(lsb));
  move(-1, 500);
  CHECK(e.raw() == 0);
  move(-1, 400);
  CHECK(e.raw() == Approx(-count_in_clock / 500).margin(lsb));
  move(-8, 400);
  CHECK(e.raw() == Approx(-count_in_clock / 400).margin(lsb));
  hold(600);  // 1.5 counts over the age at the sample before the last
  CHECK(e.raw() == Approx(-1.5 * count_in_clock / 900).margin(lsb));
  hold((1 << 23) - 1'200);
  CHECK(e.raw() < 0);
  hold(400);
  CHECK(e.raw() == 0);
  hold(1 << 25);
  CHECK(e.velocity() == 0);  // the low-pass alone would stay in its dead band
  move(1, 50'000);           // the stamps before are none
  CHECK(e.velocity() == 0);
}

TEST_CASE("velocity by M/T: rms error and age beside the N-method, and the page says so",
          "[figures]") {
  const std::array<double, 3> speeds{1, 10, 100}, wanted{0.01, 0.05, 0.03};  // rad/s
  std::array<std::array<Errors, 3>, 3> of;
  std::array<std::array<double, all>, 3> age;
  for (std::size_t k = 0; k < 3; ++k) {
    // A cycle of whole clocks and 0.3: at whole clocks the stamps would be better than they are.
    const double clocks = 4 * kCount / speeds[k] * kHz;
    const double speed = speeds[k] * clocks / (std::floor(clocks) + 0.3);
    INFO(speed << " rad/s");
    for (std::size_t n = 0; n < 3; ++n) of[k][n] = errors(kEncoders[n], speed);
    for (const auto row : {cycle, window}) {
      for (const auto rms : {&Errors::raw, &Errors::filtered}) {
        const double good = (of[k][0].*rms)[row], bad = (of[k][1].*rms)[row];
        CHECK(good <= wanted[k]);
        CHECK(bad <= wanted[k]);
        CHECK((bad <= 2 * good || bad < 1e-3));
      }
    }
    CHECK(of[k][2].filtered[window] <= wanted[k]);
    age[k] = ages_ms(speed);
    CHECK(age[k][cycle] == Approx(expected_age_ms(speed, 0)).epsilon(0.02));
    CHECK(age[k][window] == Approx(expected_age_ms(speed, 386e-6)).epsilon(0.02));
  }
  std::string table =
      "| rms error, rad/s: good / 20 degrees, 45 % / irregular lines | 1 rad/s | 10 rad/s | 100 "
      "rad/s | age, ms |\n"
      "|---|---|---|---|---|\n";
  const auto row = [&](const char* name, auto rms, std::size_t estimator, const std::string& ages) {
    table += fmt::format("| {} |", name);
    for (const auto& speed : of) {
      table += fmt::format(" {:.2g} / {:.2g} / {:.2g} |", (speed[0].*rms)[estimator],
                           (speed[1].*rms)[estimator], (speed[2].*rms)[estimator]);
    }
    table += " " + ages + " |\n";
  };
  const auto ages = [&](std::size_t k, double filter_ms) {
    return fmt::format("{:.2f} / {:.3f} / {:.3f}", age[0][k] + filter_ms, age[1][k] + filter_ms,
                       age[2][k] + filter_ms);
  };
  row("N-method, m1 = 386, n = 2, 500 rad/s (`paper`)", &Errors::filtered, n_paper, "2.19");
  row("N-method, m1 = 767, n = 1, 500 rad/s (`lever`)", &Errors::filtered, n_lever, "2.38");
  row("one cycle, before the low-pass", &Errors::raw, cycle, ages(cycle, 0));
  row("one cycle, 500 rad/s", &Errors::filtered, cycle, ages(cycle, 2));
  row("386 µs, before the low-pass", &Errors::raw, window, ages(window, 0));
  row("386 µs, 500 rad/s", &Errors::filtered, window, ages(window, 2));
  check_figures("velocity_mt", table);
}
