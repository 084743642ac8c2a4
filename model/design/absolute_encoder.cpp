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
/// Of a reading: the noise of two, and rounding.
constexpr int kNoise_counts = 2;

int whole(double value) { return static_cast<int>(std::lround(value)); }
bool is_whole(double value) { return std::abs(value - std::round(value)) < 1e-6; }

/// Clocks from the start of a reading to the earliest start of the next, at most.
int busy_clocks(const AbsoluteEncoder::Parameters& p) {
  return 2 * p.gap_clocks + 2 * p.half_clocks * p.frame_bits() + 8;
}

}  // namespace

void read_absolute_encoder(config::TomlReader& r, Design& d) {
  d.absolute = true;
  d.absolute_framing = static_cast<int>(r.choice("framing", {"spi", "ssi"}));
  const bool spi = d.absolute_framing == AbsoluteEncoder::kSpi;
  d.absolute_bits = static_cast<int>(r.integer("bits", 12, 22));
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
}

AbsoluteEncoder::Parameters Design::absolute_parameters() const {
  AbsoluteEncoder::Parameters p;
  const auto clocks = static_cast<double>(clock_hz);
  p.framing = absolute_framing;
  p.bits = absolute_bits;
  p.half_clocks = whole(clocks / (2 * absolute_serial_hz));
  p.gap_clocks = static_cast<int>(std::ceil(clocks * absolute_gap_s - 1e-6));
  p.diag_address = absolute_diagnosis;
  const double counts = overspeed_rad_s * absolute_period_s / count_rad();
  p.jump_step = static_cast<int>(
      std::min(std::ceil(counts - 1e-6) + kNoise_counts, std::ldexp(1, absolute_bits - 3)));
  return p;
}

int Design::absolute_period_ticks() const {
  return whole(absolute_period_s * static_cast<double>(tick_hz));
}

int Design::absolute_delay_ticks() const {
  constexpr int to_position = 2;  // clocks
  return (absolute_parameters().reading_clocks() + to_position + clocks_per_tick() - 1) /
         clocks_per_tick();
}

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
