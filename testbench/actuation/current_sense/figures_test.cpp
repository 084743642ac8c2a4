// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// current_sense behind a second-order modulator: its noise beside closed forms, and what the ripple
// of a PWM leaves. Documentation: docs/blocks/current.md
#include <fmt/format.h>

#include <utility>

#include "catch.hpp"
#include "current_sense_bench.hpp"
#include "feltgate/largest.hpp"
#include "figures_record.hpp"

using namespace feltgate;
using namespace feltgate::test;

namespace {

constexpr double kClockHz = 50e6;
constexpr double kFullScaleA = 32;  // 320 mV over 10 mohm
constexpr double kRange = 0.78125;  // 250 mV

double amperes(std::int64_t current, const CurrentSense::Parameters& p) {
  return kFullScaleA * static_cast<double>(current) / static_cast<double>(p.full_scale());
}

struct Noise {
  double squares = 0, worst = 0, mean = 0;
  double modulator_largest = 0, modulator_squares = 0;  // of its quantiser's error
  std::int64_t results = 0;
  double rms() const { return std::sqrt(squares / static_cast<double>(results)); }
};

/// At 400 constant currents over the range, 20 results each.
Noise noise(const CurrentSense::Parameters& p) {
  Noise found;
  for (int k = 0; k < 400; ++k) {
    const double level = kRange * (2 * std::fmod((k + 0.5) * 0.6180339887498949, 1.0) - 1);
    Fed fed(p);
    Modulator modulator;
    fed.in.armed = true;
    for (int result = 0; result < 23;) {
      fed.step([&](std::int64_t) { return modulator.next(level); });
      if (!fed.twin.out().valid || ++result <= 3) continue;
      const double error = amperes(fed.twin.out().current, p) - kFullScaleA * level;
      found.squares += error * error;
      found.mean += error;
      found.worst = larger(found.worst, std::fabs(error));
      ++found.results;
    }
    found.modulator_largest = larger(found.modulator_largest, modulator.largest_error);
    found.modulator_squares += modulator.rms_error() * modulator.rms_error() / 400;
  }
  found.mean /= static_cast<double>(found.results);
  return found;
}

/// Of the fast filter, whose results are on no port: its response over the bits at the same
/// currents.
Noise fast_noise(const CurrentSense::Parameters& p) {
  const std::vector<std::int64_t> response = sinc3_response(1 << p.fast_log2);
  Noise found;
  for (int k = 0; k < 400; ++k) {
    const double level = kRange * (2 * std::fmod((k + 0.5) * 0.6180339887498949, 1.0) - 1);
    Modulator modulator;
    std::vector<bool> bits;
    for (int n = 0; n < 1000; ++n) bits.push_back(modulator.next(level));
    for (std::size_t first = 200; first + response.size() <= bits.size(); first += 8) {
      std::int64_t sum = -p.fast_full_scale();
      for (std::size_t j = 0; j < response.size(); ++j) sum += bits[first + j] ? response[j] : 0;
      const double error =
          kFullScaleA *
          (static_cast<double>(sum) / static_cast<double>(p.fast_full_scale()) - level);
      found.squares += error * error;
      found.worst = larger(found.worst, std::fabs(error));
      ++found.results;
    }
  }
  return found;
}

// Ripple of `lever` at 50 kHz: 24 V, 82 uH, duty 0.29.
constexpr int kPeriod = 1000;  // clocks
constexpr double kDuty = 0.29, kRippleA = 24 * kDuty * (1 - kDuty) / (82e-6 * 50e3);

/// The current in a clock of the period, in whose middle the high pulse is centred.
double current_a(std::int64_t clock, double mean) {
  const double t = static_cast<double>(clock % kPeriod) / kPeriod - 0.5;  // from that centre
  const double on = std::fabs(t) <= kDuty / 2 ? t / kDuty : 0;
  const double off = std::fabs(t) <= kDuty / 2 ? 0 : (t > 0 ? 0.5 - t : -0.5 - t) / (1 - kDuty);
  return mean + kRippleA * (on + off);
}

struct Bias {
  double mean = 0, worst = 0;
};

/// Error of the results with a strobe in this clock of every period, -1: without any.
Bias ripple(int strobe) {
  const CurrentSense::Parameters p{};
  Bias found;
  double results = 0;
  for (int k = 0; k < 20; ++k) {
    const double mean = 0.37 * k - 3.1;
    Fed fed(p);
    Modulator modulator;
    fed.in.armed = true;
    for (int result = 0; result < 33;) {
      fed.in.strobe = strobe >= 0 && fed.clock % kPeriod == strobe;
      fed.step([&](std::int64_t) {
        return modulator.next(current_a(fed.clock - 1, mean) / kFullScaleA);
      });
      const CurrentSense::Out& out = fed.twin.out();
      if (!out.valid || (strobe >= 0 && !out.aligned) || ++result <= 3) continue;
      const double error = amperes(out.current, p) - mean;
      found.mean += error;
      found.worst = larger(found.worst, std::fabs(error));
      ++results;
    }
  }
  found.mean /= results;
  return found;
}

}  // namespace

TEST_CASE("current_sense: noise is that of the closed form, ripple is not aliased", "[figures]") {
  std::string figures =
      "| decimation | LSB, mA | noise rms, mA | greatest error, mA | its bound, mA | results a "
      "second | centre of the window to the result, µs |\n|---|---|---|---|---|---|---|\n";
  for (const int log2 : {5, 6, 7}) {
    CurrentSense::Parameters p;
    p.decimation_log2 = log2;
    const Noise found = noise(p);
    const double decimation = 1 << log2;
    const double white =
        kFullScaleA * std::sqrt(6 * found.modulator_squares / std::pow(decimation, 5));
    const double bound = kFullScaleA * 4 * found.modulator_largest / (decimation * decimation);
    INFO("decimation " << decimation << ": rms " << found.rms() << " of " << white << " A, worst "
                       << found.worst << " of " << bound << " A, mean " << found.mean
                       << " A, modulator " << found.modulator_largest);
    CHECK(found.results == 8000);
    CHECK(found.rms() < 1.2 * white);
    CHECK(found.rms() > 0.8 * white);
    CHECK(found.worst <= bound);
    CHECK(found.worst > bound / 20);
    CHECK(std::fabs(found.mean) < found.rms() / 10);
    figures +=
        fmt::format("| {} | {:.3f} | {:.2f} | {:.1f} | {:.1f} | {:.0f} | {:.2f} |\n", decimation,
                    1e3 * amperes(1, p), 1e3 * found.rms(), 1e3 * found.worst, 1e3 * bound,
                    kClockHz / (p.divider << log2), 1e6 / kClockHz * p.delay_clocks());
  }
  // The middle of the window on that of the high pulse, and of the low one: with the modulator's
  // clock half of it is what can be met. Then a quarter of a period beside it.
  const CurrentSense::Parameters p{};
  const Noise fast = fast_noise(p);
  CHECK(fast.worst < 0.2 * kFullScaleA);
  CHECK(fast.worst > fast.rms());
  figures += fmt::format("| 8, fast | {:.0f} | {:.0f} | {:.0f} | - | {:.0f} | - |\n",
                         1e3 * kFullScaleA / static_cast<double>(p.fast_full_scale()),
                         1e3 * fast.rms(), 1e3 * fast.worst, kClockHz / (p.divider << p.fast_log2));
  const int high = kPeriod / 2 - p.centre_clocks(), low = kPeriod - p.centre_clocks();
  const int early = p.divider / 2;
  const Bias of_high = ripple(high - early), of_low = ripple(low - early);
  const Bias late_high = ripple(high + early), late_low = ripple(low + early);
  const Bias beside = ripple(high + kPeriod / 4), without = ripple(-1);
  const double step_a = kRippleA / kDuty / kPeriod * early;  // in half of the modulator's clock
  CHECK(of_high.mean < 0);
  CHECK(late_high.mean > 0);
  CHECK(of_low.mean > 0);
  CHECK(late_low.mean < 0);
  for (const Bias& at : {of_high, late_high, of_low, late_low}) CHECK(std::fabs(at.mean) < step_a);
  CHECK(beside.worst > 0.25);
  CHECK(without.worst > 0.25);
  figures += "\n| window | mean error, mA | greatest error, mA |\n|---|---|---|\n";
  const std::pair<const char*, Bias> rows[] = {
      {"its middle 2 clocks before that of the high pulse", of_high},
      {"2 clocks after it", late_high},
      {"2 clocks before that of the low pulse", of_low},
      {"2 clocks after it", late_low},
      {"a quarter of a period from that of the high pulse", beside},
      {"without strobes", without}};
  for (const auto& [name, bias] : rows) {
    figures += fmt::format("| {} | {:.1f} | {:.0f} |\n", name, 1e3 * bias.mean, 1e3 * bias.worst);
  }
  check_figures("current_sense", figures);
}
