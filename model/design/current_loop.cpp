// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The section [current_loop] of a design that measures its current: its keys, the words of its
// blocks, and what cannot work. Documentation: docs/blocks/current.md
#include <cmath>

#include <fmt/format.h>

#include "design/design.hpp"
#include "feltgate/axis/three_phase.hpp"
#include "feltgate/current_sense.hpp"
#include "feltgate/field_oriented.hpp"
#include "files/toml/toml_reader.hpp"

namespace feltgate::design {

void read_current_loop(config::TomlReader& r, Design& d) {
  d.current_loop = true;
  d.current_full_scale_a = r.number("full_scale_a", {0.5, 512});
  d.current_bandwidth_hz = r.number("bandwidth_hz", {10, 20'000});
  d.inductance_h = r.number("inductance_h", {1e-7, 1});
  d.overcurrent_a = r.number("overcurrent_a", {0.01, 512});
  d.driver_fault = r.has("driver_fault") && r.integer("driver_fault", 0, 1) == 1;
  d.heartbeat = r.has("heartbeat") && r.integer("heartbeat", 0, 1) == 1;
}

CurrentGains Design::current_loop_gains() const {
  return current_gains(resistance_ohm, inductance_h, current_bandwidth_hz,
                       1.0 / static_cast<double>(pwm_hz), current_full_scale_a, full_duty_v());
}

CurrentCheckWords Design::current_loop_check() const {
  return current_check_words(resistance_ohm, current_limit_a, current_full_scale_a, full_duty_v());
}

int Design::current_strobe_clock() const {
  constexpr CurrentSense::Parameters sense;
  constexpr int pwm_clocks = 3;  // from the carrier to a gate
  // The middle of the pulses; of three phases the begin of the next period.
  const int middle = phases == 3 ? pwm_period_clocks() : pwm_period_clocks() / 2;
  return middle + pwm_clocks + dead_clocks() / 2 - sense.centre_clocks() - sense.divider / 2;
}

void check_current_loop(const Design& d) {
  const double exponent = std::log2(d.current_full_scale_a);
  if (exponent != std::round(exponent)) {
    d.fail("current_loop.full_scale_a", "the full scale is no power of two",
           "choose the shunt for one, 32 say");
  }
  if (exponent < d.current.integer || d.current.fraction + exponent <= kCurrentControlBits) {
    d.fail("current_loop.full_scale_a", "formats.current does not fit the full scale",
           fmt::format("give it at most {:g} integer bits and at least {:g} fraction bits",
                       exponent, kCurrentControlBits + 1 - exponent));
  }
  if (d.overcurrent_a <= d.current_limit_a || d.overcurrent_a >= d.current_full_scale_a) {
    d.fail("current_loop.overcurrent_a",
           "the over-current is not between control.current_limit_a and the full scale",
           "choose one between them, with room for ripple and noise on both sides");
  }
  if (!d.current_loop_gains().in_range) {
    d.fail("current_loop.bandwidth_hz", "a gain of the current loop does not fit its word",
           "choose another bandwidth");
  }
  if (!d.current_loop_check().in_range) {
    d.fail("motor.resistance_ohm", "the check of the measured current has no word for it",
           "choose a full scale whose voltage at the resistance is 0.0002 to 16 times the supply");
  }
  if (!d.emf_in_law()) {
    d.fail("voltage.law", "a current loop feeds forward what the voltage law gives back",
           "take law = \"motor_model\"");
  }
  if (d.engine || d.axes > 1) {
    d.fail("current_loop", "a core with an engine or several axes has no pins of a modulator",
           "leave [current_loop] out, or [engine] and [axes]");
  }
  constexpr CurrentSense::Parameters sense;
  const bool field = d.phases == 3;
  const int begin = d.current_strobe_clock();
  const int measured = begin + sense.centre_clocks() + sense.divider + sense.delay_clocks() -
                       (field ? d.pwm_period_clocks() : 0);  // around the begin of the next period
  const int end =
      measured + (field ? FieldOriented::kLatencyClocks : CurrentControl::kLatencyClocks) + 2;
  if (begin < 2 || begin > d.pwm_period_clocks() - 2 || end > d.pwm_period_clocks() - 2) {
    d.fail("pwm.frequency_hz",
           fmt::format("a PWM period has {} clocks, and a current is measured and controlled from "
                       "clock {} to {}",
                       d.pwm_period_clocks(), begin, end),
           "lower it");
  }
}

// The section [commutation] of a design whose bridge has three legs: its keys, and what cannot
// work.

namespace {

constexpr double kElectricalTurnRad = 2 * 3.14159265358979323846;

}  // namespace

void read_commutation(config::TomlReader& r, Design& d) {
  d.pole_pairs = static_cast<int>(r.integer("pole_pairs", 1, 100));
  d.hall = r.has("hall") && r.integer("hall", 0, 1) == 1;
  d.commutation_offset_rad = r.number("offset_rad", {-kElectricalTurnRad, kElectricalTurnRad});
}

double Design::full_duty_v() const { return phases == 3 ? supply_v / std::sqrt(3.0) : supply_v; }

void check_commutation(const Design& d) {
  if (d.phases != 3) {
    if (d.pole_pairs != 0) {
      d.fail("commutation", "only three phases are commutated",
             "write phases = 3 in [pwm], or leave [commutation] out");
    }
    return;
  }
  if (d.pole_pairs == 0) {
    d.fail("pwm.phases", "three phases need to know the motor", "add [commutation]");
  }
  if (d.axes > 1) {
    d.fail("pwm.phases", "a core with several axes has no pins of a third leg",
           "write phases = 2, or leave [axes] out");
  }
  if (d.pwm_mode != 0) {
    d.fail("pwm.mode", "three legs have one kind of pulses", "write mode = \"sign_magnitude\"");
  }
  constexpr int least_clocks = axis::ThreePhase::lead + 2;
  if (d.pwm_period_clocks() < least_clocks) {
    d.fail("pwm.frequency_hz",
           fmt::format("a PWM period has {} clocks, and the commutation of one takes {}",
                       d.pwm_period_clocks(), least_clocks),
           "lower it");
  }
  if (d.pole_pairs >= 4 * d.lines) {
    d.fail("commutation.pole_pairs", "a count is an electrical turn or more", "lower it");
  }
  if (d.hall && d.absolute) {
    d.fail("commutation.hall", "an absolute encoder knows the angle at power-up",
           "leave it or [absolute_encoder] out");
  }
  if (d.hall && d.engine) {
    d.fail("commutation.hall", "a core with an engine has no pins of Hall lines",
           "leave it or [engine] out");
  }
  const double between_s = d.absolute ? d.absolute_period_s : 0;
  if (d.overspeed_rad_s * d.pole_pairs * between_s > kElectricalTurnRad / 8) {
    d.fail("supervisor.overspeed_rad_s",
           "at this speed a reading moves by an eighth of an electrical turn",
           "lower it, or shorten absolute_encoder.period_s");
  }
}

}  // namespace feltgate::design
