// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The page's knob: its core has the words and the on-times of the twin's; torque, detents and wrong
// offsets by closed forms. Documentation: docs/page.md
#include "apps/page/knob_loop.hpp"

#include <algorithm>
#include <cmath>

#include "catch.hpp"
#include "sim/loop/ensemble.hpp"
#include "sim/plant/plant_file.hpp"

namespace feltgate::page {
namespace {

const std::string vectors = std::string(FELTGATE_ROOT) + "/vectors/";
constexpr double turn_rad = 6.283185307179586;

plant::Parameters motor() { return plant::read_plant_file(vectors + "plants/gimbal_motor.toml"); }

/// The hand turns the knob of the loop, and waits.
void turn(KnobLoop& loop, double to_rad, double seconds) {
  loop.hold(true);
  const double from_rad = loop.hand_rad();
  constexpr int frames = 60;
  for (int n = 1; n <= frames; ++n) {
    loop.lead(from_rad + (to_rad - from_rad) * n / frames);
    loop.advance(0.5 * seconds / frames);
  }
  loop.advance(0.5 * seconds);
}

}  // namespace

TEST_CASE("page: the knob's core has the twin's words and on-times") {
  Ensemble twin(KnobCore::design_name, BackendChoice{"twin", {}, false}, 1, {}, Waveform{});
  twin.skip_self_test();
  KnobCore core;
  const DesignInfo& d = core.design();
  const auto set = [&](const char* parameter, double value) {
    twin.set_parameter(parameter, value);
    core.set(parameter, value);
  };
  set("attract_strength", 816);
  set("attract_core", 261);
  set("attract_core_slope", 4.59e-5);
  twin.set_control(d.scene_number("charge_attract"), 0, true);
  int differ = 0, other_legs = 0, compared = 0, most_duty = 0;
  const auto compare = [&](const Snapshot& s) {
    core.arm(s.armed);
    core.tick(s.position);
    const ChainRaw& r = core.raw();
    if (r.velocity != s.velocity || r.tau_hat != s.tau_hat || r.tau_ref != s.tau_ref ||
        r.current_ref != s.current_ref || r.voltage != s.voltage || r.duty != s.duty) {
      ++differ;
    }
    most_duty = std::max(most_duty, std::abs(static_cast<int>(s.duty)));
  };
  constexpr Clock step = 500;
  double rad = 0;
  for (int n = 1; n <= 30'000; ++n) {
    const double next_rad = 0.3 * std::sin(2e-5 * M_PI * n) * std::min(1.0, 2e-4 * n);
    twin.lead().turn_encoder(rad, next_rad, step);
    twin.advance(step, nullptr, nullptr, compare);
    rad = next_rad;
    // Within a PWM period, which the last snapshot is in as well.
    const Clock of_period = twin.lead().now() % d.pwm_period;
    if (of_period < 100 || of_period > 950) continue;
    ++compared;
    for (std::size_t leg = 0; leg < 3; ++leg) {
      other_legs += twin.lead().on_time(leg) == core.on_clocks()[leg] ? 0 : 1;
    }
  }
  CHECK(differ == 0);
  CHECK(most_duty > 10);
  CHECK(compared > 10'000);
  CHECK(other_legs == 0);
}

TEST_CASE("page: a knob snaps into the detent that is nearest, with the torque of the detent") {
  KnobLoop loop(motor());
  // Hand and detent balance: 135 N/m at 20 mm against 0.12 Nm/rad.
  turn(loop, 0.2, 2);
  const double hand = 135 * 0.02 * 0.02, detent = 0.012 / 0.1;
  CHECK(loop.plant().observables().theta_rad == Approx(0.2 * hand / (hand + detent)).margin(0.008));
  CHECK(loop.core().out().tau_ref_nm ==
        Approx(-0.2 * hand * detent / (hand + detent)).margin(1e-3));
  CHECK(loop.plant().observables().motor_torque_nm ==
        Approx(loop.core().out().tau_ref_nm).margin(6e-4));
  turn(loop, 1.5, 3);
  CHECK(loop.detent_rad() == Approx(1.5).margin(4e-4));
  turn(loop, 1.55, 1);
  loop.hold(false);
  loop.advance(0.5);
  // Friction keeps 0.65 mNm, and dead times take from a torque that is as small.
  CHECK(loop.plant().observables().theta_rad == Approx(1.5).margin(0.014));
  // Turns of the electrical angle later the word still knows it.
  const double core = loop.core().electrical_turns(loop.position());
  const double rotor = loop.plant().motor().electrical_rad(loop.plant().observables().theta_rad);
  CHECK(std::cos(turn_rad * core - rotor) == Approx(1).margin(1e-3));
}

TEST_CASE("page: a wrong offset takes the torque's cosine, and half a turn turns it round") {
  for (const double turns : {0.0, 1 / 6.0, 0.25, 0.5}) {
    KnobLoop loop(motor());
    loop.offset(turns);
    CHECK(loop.core().offset_turns() == Approx(turns).margin(1e-9));
    turn(loop, 0.15, 1);
    const double asked = loop.core().out().tau_ref_nm;
    INFO(turns);
    CHECK(loop.plant().observables().motor_torque_nm ==
          Approx(asked * std::cos(turn_rad * turns)).margin(1.2e-3));  // dead times
    CHECK(std::abs(asked) > 2.5e-3);
    loop.hold(false);
    loop.advance(0.5);
    const double from_detent = std::abs(loop.plant().observables().theta_rad - loop.detent_rad());
    if (turns == 0) CHECK(from_detent < 0.014);
    if (turns == 0.5) CHECK(from_detent > 0.2);  // it sits on a crest
  }
}

}  // namespace feltgate::page
