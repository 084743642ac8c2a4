// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The section [commutation] of a design whose bridge has three legs: its keys, and what cannot
// work. Documentation: docs/blocks/three_phase.md
#include "feltgate/commutation.hpp"

#include <fmt/format.h>

#include <cmath>

#include "design/design.hpp"
#include "files/toml/toml_reader.hpp"

namespace feltgate::design {

namespace {

constexpr double kElectricalTurnRad = 2 * 3.14159265358979323846;

}  // namespace

void read_commutation(config::TomlReader& r, Design& d) {
  d.pole_pairs = static_cast<int>(r.integer("pole_pairs", 1, 100));
  d.hall = r.has("hall") && r.integer("hall", 0, 1) == 1;
  d.commutation_offset_rad = r.number("offset_rad", {-kElectricalTurnRad, kElectricalTurnRad});
  d.modulation = static_cast<int>(r.choice("modulation", {"sines", "space_vectors"}));
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
  if (d.current_loop && d.modulation != Commutation::kSpaceVectors) {
    d.fail("commutation.modulation", "a current loop makes space vectors",
           "write modulation = \"space_vectors\", or leave [current_loop] out");
  }
  if (d.pwm_mode != 0) {
    d.fail("pwm.mode", "three legs have one kind of pulses", "write mode = \"sign_magnitude\"");
  }
  const Commutation commutation(d.pwm_period_clocks(),
                                static_cast<Commutation::Modulation>(d.modulation));
  if (d.pwm_period_clocks() < commutation.latency_clocks() + 2) {
    d.fail("pwm.frequency_hz",
           fmt::format("a PWM period has {} clocks, and the commutation of one takes {}",
                       d.pwm_period_clocks(), commutation.latency_clocks() + 2),
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
