// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// velocity_mt beside velocity_n: rms error and age at constant speeds, behind good and bad encoders
// of 1024 lines. The table of docs/blocks/velocity.md is what this test prints;
// FELTGATE_WRITE_FIGURES=1 writes it to campaigns/figures.md.
#include <fmt/format.h>

#include <array>
#include <string>

#include "catch.hpp"
#include "feltgate/velocity_n.hpp"
#include "feltgate/words.hpp"
#include "figures_record.hpp"
#include "velocity_mt_bench.hpp"

using namespace feltgate;
using namespace feltgate::test;

namespace {

using OneCycle = VelocityMt<Lever>;
using Windowed = VelocityMt<Lever, 19300, 4>;
constexpr std::array<double, 3> kSpeeds{1, 10, 100};  // rad/s
constexpr double kCutoff = 500;                       // rad/s, of both designs

/// The N-method of a design, tick by tick.
template <class D>
struct NMethod {
  Words<D, Fixed> words;
  DelayLine<D::m1> line;
  EstimatorStep<D, Fixed> step;
  void tick(std::int16_t travel) {
    const std::int16_t counts = travel_difference(travel, line.oldest());
    line.push(travel);
    step.tick(words, counts);
  }
};

double rad_s(std::int64_t raw) { return std::ldexp(static_cast<double>(raw), -21); }

struct Rms {
  double squares = 0;
  std::int64_t n = 0;
  void add(double error) {
    squares += error * error;
    ++n;
  }
  double value() const { return std::sqrt(squares / static_cast<double>(n)); }
};

enum Row { n_paper, n_lever, cycle, cycle_filtered, window, window_filtered, rows };
using Errors = std::array<Rms, rows>;

template <class Block>
void measure_mt(const Encoder& encoder, double speed, Rms& raw, Rms& filtered, Errors* n_method) {
  const double begin = 0.02 + 60 / speed * 1e-3, end = begin + 0.02 + 0.15 / speed;
  Moved<Block> m(encoder);
  NMethod<Paper> paper;
  NMethod<Lever> lever;
  m.run(
      end, [speed](double t) { return speed * t; },
      [&](double t) {
        if (n_method != nullptr) {
          paper.tick(wrapped_travel(m.sampled_count));
          lever.tick(wrapped_travel(m.sampled_count));
        }
        if (t < begin) return;
        raw.add(rad_s(m.twin.raw()) - speed);
        filtered.add(rad_s(m.twin.out().velocity) - speed);
        if (n_method == nullptr) return;
        (*n_method)[n_paper].add(rad_s(paper.step.velocity.raw()) - speed);
        (*n_method)[n_lever].add(rad_s(lever.step.velocity.raw()) - speed);
      });
}

Errors measure(const Encoder& encoder, double speed) {
  Errors e{};
  measure_mt<OneCycle>(encoder, speed, e[cycle], e[cycle_filtered], &e);
  measure_mt<Windowed>(encoder, speed, e[window], e[window_filtered], nullptr);
  return e;
}

/// How far the raw velocity lags, by a slow ramp through the speed: lag = (velocity - raw)/slope.
/// Seconds.
template <class Block>
double age_s(double speed) {
  const double begin = 0.02 + 30 / speed * 1e-3, end = begin + 0.02 + 0.1 / speed, slope = speed;
  const double middle = (begin + end) / 2;
  Moved<Block> m(Encoder::ideal());
  double sum = 0;
  std::int64_t n = 0;
  m.run(
      end, [&](double t) { return speed * t + slope * (t * t / 2 - middle * t); },
      [&](double t) {
        if (t < begin) return;
        sum += (speed + slope * (t - middle) - rad_s(m.twin.raw())) / slope;
        ++n;
      });
  return sum / static_cast<double>(n);
}

/// Whole cycles that the window takes at a speed, and the age by the closed form: half of the span,
/// half a cell for the hold, and a tick and the clocks up to where the value is read.
double expected_age_s(double speed, double window_s) {
  const double cell = kCountRad / speed;
  double span = 4 * cell;
  while (span < window_s) span *= 2;
  return span / 2 + cell / 2 + 1.2e-6;
}

std::string table(const std::array<std::array<Errors, 3>, 3>& of,
                  const std::array<double, 3>& cycle_ms, const std::array<double, 3>& window_ms) {
  const std::array<const char*, rows> names{"N-method, m1 = 386, n = 2, 500 rad/s (`paper`)",
                                            "N-method, m1 = 767, n = 1, 500 rad/s (`lever`)",
                                            "one cycle, before the low-pass",
                                            "one cycle, 500 rad/s",
                                            "386 µs, before the low-pass",
                                            "386 µs, 500 rad/s"};
  std::string text =
      "| rms error, rad/s: good / 20 degrees, 45 % / irregular lines | 1 rad/s | 10 rad/s | 100 "
      "rad/s | age, ms |\n"
      "|---|---|---|---|---|\n";
  for (std::size_t row = 0; row < rows; ++row) {
    text += fmt::format("| {} |", names[row]);
    for (const auto& speed : of) {
      text += fmt::format(" {:.2g} / {:.2g} / {:.2g} |", speed[0][row].value(),
                          speed[1][row].value(), speed[2][row].value());
    }
    const double filter_ms = row == cycle || row == window ? 0 : 1e3 / kCutoff;
    const double m1_ms = row == n_paper ? 0.386 : 0.767;
    const auto& raw_ms = row == window || row == window_filtered ? window_ms : cycle_ms;
    if (row <= n_lever) {
      text += fmt::format(" {:.2f} |\n", m1_ms / 2 + filter_ms);
    } else {
      text += fmt::format(" {:.2f} / {:.3f} / {:.3f} |\n", raw_ms[0] + filter_ms,
                          raw_ms[1] + filter_ms, raw_ms[2] + filter_ms);
    }
  }
  return text;
}

}  // namespace

TEST_CASE("velocity_mt: rms error and age beside the N-method, and the page says so", "[figures]") {
  // The quarter-cycle offsets and the 0.02 counts of each line that the observer's studies assume.
  const Encoder irregular{{0, 0.10, 0.05, -0.07}, 0.02};
  std::array<std::array<Errors, 3>, 3> of{};
  std::array<double, 3> cycle_ms{}, window_ms{};
  const std::array<double, 3> wanted{0.01, 0.05, 0.03};
  for (std::size_t k = 0; k < kSpeeds.size(); ++k) {
    // A cycle of whole clocks and 0.3: at whole clocks the stamps would be better than they are.
    const double clocks = 4 * kCountRad / kSpeeds[k] * Design::clock_hz;
    const double speed = kSpeeds[k] * clocks / (std::floor(clocks) + 0.3);
    INFO(speed << " rad/s");
    of[k] = {measure(Encoder::ideal(), speed), measure(Encoder::cheap(-1), speed),
             measure(irregular, speed)};
    const auto rms = [&](std::size_t encoder, Row row) { return of[k][encoder][row].value(); };
    for (const Row row : {cycle, cycle_filtered, window, window_filtered}) {
      CHECK(rms(0, row) <= wanted[k]);
      CHECK(rms(1, row) <= wanted[k]);
      CHECK((rms(1, row) <= 2 * rms(0, row) || rms(1, row) < 1e-3));
    }
    CHECK(rms(2, window_filtered) <= wanted[k]);
    cycle_ms[k] = 1e3 * age_s<OneCycle>(speed);
    window_ms[k] = 1e3 * age_s<Windowed>(speed);
    CHECK(cycle_ms[k] == Approx(1e3 * expected_age_s(speed, 0)).epsilon(0.02));
    CHECK(window_ms[k] == Approx(1e3 * expected_age_s(speed, 386e-6)).epsilon(0.02));
  }
  check_figures("velocity_mt", table(of, cycle_ms, window_ms));
}
