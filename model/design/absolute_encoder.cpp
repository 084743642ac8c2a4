// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The section [absolute_encoder] of a design: its keys, the block's parameters, and what cannot
// work. Documentation: docs/blocks/absolute_encoder.md
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "design/design.hpp"
#include "feltgate/absolute_encoder.hpp"
#include "files/toml/toml_reader.hpp"

namespace feltgate::design {

namespace {

constexpr double kTurnRad = 2 * 3.14159265358979323846;
/// Readings in which each fault is named, with a reading that begins just before it.
constexpr int kReadingsToFault = 18;
constexpr double kNamedIn_s = 2e-3;
constexpr std::size_t kMostTerms = 32;
/// The table: an entry has 16 bits with its sign. With half of this slope the shorter way around
/// and the order of the angles stay what they are.
constexpr double kMostError_mrad = 190, kMostSlope_mrad = 500;

/// Of a reading: the noise of two, and rounding.
constexpr int kNoise_counts = 2;

int whole(double value) { return static_cast<int>(std::lround(value)); }
bool is_whole(double value) { return std::abs(value - std::round(value)) < 1e-6; }

/// Clocks from the start of a reading to the earliest start of the next, at most.
int busy_clocks(const AbsoluteEncoder::Parameters& p) {
  const int late = p.framing == AbsoluteEncoder::kBiss ? p.ack_clocks + 3 : 0;
  return 2 * p.gap_clocks + 2 * p.half_clocks * (p.frame_bits() + late) + 8;
}

/// The amplitudes of the harmonics and those of their slopes add up to at most so much.
struct Amplitudes {
  double error = 0, slope = 0;
};
Amplitudes sum_of(const std::vector<double>& terms) {
  Amplitudes sum;
  for (std::size_t k = 0; k + 1 < terms.size(); k += 2) {
    const double size = std::hypot(terms[k], terms[k + 1]);
    sum.error += size;
    sum.slope += static_cast<double>(k / 2 + 1) * size;
  }
  return sum;
}

}  // namespace

void read_absolute_encoder(config::TomlReader& r, Design& d) {
  d.absolute = true;
  d.absolute_framing = static_cast<int>(r.choice("framing", {"spi", "ssi", "biss"}));
  const bool spi = d.absolute_framing == AbsoluteEncoder::kSpi;
  d.absolute_bits = static_cast<int>(r.integer("bits", 12, 24));
  if (spi && d.absolute_bits != 14) {
    r.fail("bits", fmt::format("an SPI frame has 14 bits of angle, not {}", d.absolute_bits),
           "write bits = 14, or take another framing");
  }
  d.absolute_serial_hz = r.number("serial_hz", {1e4, 1e8});
  d.absolute_gap_s = r.number("gap_s", {0, 1e-4});
  d.absolute_period_s = r.number("period_s", {1e-6, 1});
  if (spi) {
    d.absolute_diagnosis = static_cast<int>(r.integer("diagnosis", 0, 0x3fff));
  } else if (r.has("diagnosis")) {
    r.fail("diagnosis", "only SPI asks for a register of the diagnosis", "leave it out");
  }
  d.lines = (1 << d.absolute_bits) / 4;
  if (r.has("error_mrad"))
    d.absolute_error_mrad = r.numbers("error_mrad", {-kMostError_mrad, kMostError_mrad});
}

double harmonics(const std::vector<double>& terms, double angle_rad) {
  double sum = 0;
  for (std::size_t term = 0; term < terms.size(); ++term) {
    const double x = static_cast<double>(term / 2 + 1) * angle_rad;
    sum += terms[term] * (term % 2 == 0 ? std::cos(x) : std::sin(x));
  }
  return sum;
}

Corrections Design::absolute_corrections() const {
  Corrections table{};
  for (std::size_t k = 0; k < table.size(); ++k) {
    const double angle_rad = static_cast<double>(k) * kTurnRad / static_cast<double>(table.size());
    const double turns = 1e-3 * harmonics(absolute_error_mrad, angle_rad) / kTurnRad;
    table[k] = static_cast<std::int16_t>(std::lround(std::ldexp(-turns, Map::absolute_entry_bits)));
  }
  return table;
}

AbsoluteEncoder::Parameters Design::absolute_parameters() const {
  AbsoluteEncoder::Parameters p;
  const auto clocks = static_cast<double>(clock_hz);
  p.framing = absolute_framing;
  p.bits = absolute_bits;
  p.half_clocks = whole(clocks / (2 * absolute_serial_hz));
  p.gap_clocks = static_cast<int>(std::ceil(clocks * absolute_gap_s - 1e-6));
  p.diag_address = absolute_diagnosis;
  // The table's error makes a reading move up to so much faster than the shaft.
  const double counts = overspeed_rad_s * absolute_period_s / count_rad() /
                        (1 - 1e-3 * sum_of(absolute_error_mrad).slope);
  p.jump_step = static_cast<int>(
      std::min(std::ceil(counts - 1e-6) + kNoise_counts, std::ldexp(1, absolute_bits - 3)));
  return p;
}

int Design::absolute_period_ticks() const {
  return whole(absolute_period_s * static_cast<double>(tick_hz));
}

int Design::absolute_delay_ticks() const {
  constexpr int to_position = 2;  // clocks
  const AbsoluteEncoder::Parameters p = absolute_parameters();
  // BiSS-C: of a sensor that begins two serial clocks after its acknowledge.
  const int wait = p.framing == AbsoluteEncoder::kBiss ? 10 * p.half_clocks : 0;
  const int table = absolute_table() ? correction_clocks(absolute_bits) : 0;
  return (p.reading_clocks() + wait + table + to_position + clocks_per_tick() - 1) /
         clocks_per_tick();
}

namespace {

void check_error(const Design& d) {
  if (!d.absolute_table()) return;
  const auto& terms = d.absolute_error_mrad;
  const auto wrong = [&d](const std::string& what, const char* mend) {
    d.fail("absolute_encoder.error_mrad", what, mend);
  };
  if (terms.size() % 2 != 0 || terms.size() > kMostTerms) {
    wrong(fmt::format("{} numbers are no cosines and sines of up to {} harmonics", terms.size(),
                      kMostTerms / 2),
          "write two for each harmonic of a turn, or []");
  }
  const auto [error, slope] = sum_of(terms);
  if (error > kMostError_mrad || slope > kMostSlope_mrad) {
    wrong(fmt::format("the harmonics may add up to {:.4g} mrad and a slope of {:.4g} mrad per "
                      "radian, more than {:g} and {:g}",
                      error, slope, kMostError_mrad, kMostSlope_mrad),
          "mount the magnet better");
  }
  if (d.absolute_bits > 19) {
    wrong(fmt::format("the table has steps of 2^-20 turn, too coarse for {} bits", d.absolute_bits),
          "leave it out, or take up to 19 bits");
  }
}

}  // namespace

void check_absolute_encoder(const Design& d) {
  const AbsoluteEncoder::Parameters p = d.absolute_parameters();
  if (d.axes > 1) {
    d.fail("absolute_encoder", "a core with several axes has no pins for its lines",
           "leave [absolute_encoder] out, or [axes]");
  }
  if (d.mt) {
    d.fail("velocity.estimator", "M/T needs the clocks of edges, which an absolute encoder lacks",
           "take estimator = \"n_method\"");
  }
  check_error(d);
  const auto clocks = static_cast<double>(d.clock_hz);
  if (!is_whole(clocks / (2 * d.absolute_serial_hz)) || p.half_clocks < 4) {
    d.fail("absolute_encoder.serial_hz",
           fmt::format("half a serial clock is {:.4g} clocks, not a whole number from 4 on",
                       clocks / (2 * d.absolute_serial_hz)),
           fmt::format("take {:g} Hz over a whole number from 4 on", clocks / 2));
  }
  if (p.gap_clocks < 4) {
    d.fail("absolute_encoder.gap_s", fmt::format("the gap is {} clocks, less than 4", p.gap_clocks),
           fmt::format("choose {:g} s or longer", 4 / clocks));
  }
  const int period = d.absolute_period_ticks();
  if (!is_whole(d.absolute_period_s * static_cast<double>(d.tick_hz)) ||
      period * d.clocks_per_tick() < busy_clocks(p)) {
    d.fail("absolute_encoder.period_s",
           fmt::format("readings of {} clocks cannot follow each other in {:.6g} ticks of {}",
                       busy_clocks(p), d.absolute_period_s * static_cast<double>(d.tick_hz),
                       d.clocks_per_tick()),
           "choose a whole number of ticks in which a reading fits");
  }
  if (kReadingsToFault * d.absolute_period_s > kNamedIn_s) {
    d.fail("absolute_encoder.period_s",
           fmt::format("the slowest fault takes {} readings, more than {:g} ms", kReadingsToFault,
                       1e3 * kNamedIn_s),
           fmt::format("choose {:.4g} s or less", kNamedIn_s / kReadingsToFault));
  }
  if (d.m1 % period != 0) {
    d.fail("velocity.m1",
           fmt::format("{} ticks are no whole number of readings, one in {} ticks", d.m1, period),
           "choose a multiple; with gain = \"exact\" any fits");
  }
  const double reading_rad = d.overspeed_rad_s * d.absolute_period_s;
  if (reading_rad > kTurnRad / 8 ||
      d.overspeed_rad_s * (d.m1 + period) * d.tick_s() / d.count_rad() > 0x7fff) {
    d.fail(
        "supervisor.overspeed_rad_s",
        "at this speed a reading moves by an eighth of a turn, or the velocity's window by 32767 "
        "counts",
        "lower it, or shorten absolute_encoder.period_s or velocity.m1");
  }
  // The self-test adds up the counts from tick to tick, and sees no direction in two at once.
  const double fastest = d.self_test_nm / d.inertia_kg_m2 * d.self_test_pulse_s;
  if (d.self_test && fastest * d.absolute_period_s > d.self_test_count_rad()) {
    d.fail("self_test.torque_nm",
           fmt::format("the pulse makes the lever so fast, {:.3g} rad/s, that a reading moves by "
                       "more than a count",
                       fastest),
           "lower it, pulse_ms or absolute_encoder.period_s");
  }
}

}  // namespace feltgate::design
