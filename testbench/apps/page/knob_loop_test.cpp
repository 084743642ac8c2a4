// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The page's knob: its core has the words and the on-times of the twin's in the scene knob_detents;
// recorded inputs repeat that run; torque, detents and wrong offsets by closed forms.
// Documentation: docs/page.md
#include "apps/page/knob_loop.hpp"

#include <cmath>

#include "apps/page/live_loop.hpp"
#include "apps/page/recorded_inputs.hpp"
#include "catch.hpp"
#include "sim/loop/scenario.hpp"
#include "sim/plant/plant_file.hpp"

namespace feltgate::page {
namespace {

const std::string vectors = std::string(FELTGATE_ROOT) + "/vectors/";
constexpr double turn_rad = 6.283185307179586;

plant::Parameters motor() { return plant::read_plant_file(vectors + "plants/gimbal_motor.toml"); }

/// Keeps what a run of the twin gives, tick by tick, and lets the knob's core follow it.
struct Beside : Passenger {
  void set_parameter(int address, double value) override {
    for (int i = 0; i < core.design().parameter_count; ++i) {
      const ParameterInfo& p = core.design().parameters[i];
      if (p.address == address) core.set(p.name, value);
    }
  }
  void tick(const Snapshot& s) override {
    snapshots.push_back(s);
    core.arm(s.armed);
    core.tick(s.position);
    const ChainRaw& r = core.raw();
    if (r.velocity != s.velocity || r.tau_hat != s.tau_hat || r.tau_ref != s.tau_ref ||
        r.current_ref != s.current_ref || r.voltage != s.voltage || r.duty != s.duty) {
      ++differences;
    }
    on.push_back(core.on_clocks());
  }
  KnobCore core;
  std::vector<Snapshot> snapshots;
  std::vector<std::array<std::int16_t, 3>> on;
  int differences = 0;
};

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

TEST_CASE(
    "page: the knob's core has the twin's words and on-times, and recorded inputs repeat it") {
  Scenario scene = read_scenario(vectors + "scenes/knob_detents.toml");
  scene.duration_s = 0.45;  // over the first crest
  scene.expectations.clear();
  const plant::Parameters plant = motor();
  resolve_effects(scene, plant.effects);
  Beside beside;
  Recording inputs;
  CountRecorder recorder(14, &inputs);
  RunOptions options;
  options.design = KnobCore::design_name;
  options.engine = "twin";
  options.inputs = &inputs;
  options.passenger = &beside;
  options.plant_step = [&](Clock clocks, const plant::Observables& o) {
    recorder.turned(o.theta_rad, clocks);
  };
  run_scenario(scene, plant, options);
  inputs.edges.clear();  // the core has no such pins
  REQUIRE(beside.snapshots.size() == 450'000);
  CHECK(beside.differences == 0);
  CHECK(std::abs(beside.snapshots.back().duty) > 10);
  CHECK(inputs.counts.size() > 500);

  std::size_t n = 0;
  int differ = 0, other_legs = 0, compared = 0;
  replay(
      KnobCore::design_name, inputs_from_text(text_of(inputs)),
      [&](const Backend& twin) {
        for (const Snapshot& s : twin.snapshots()) differ += s == beside.snapshots[n++] ? 0 : 1;
        // Within a PWM period, which the last snapshot is in as well.
        const Clock of_period = twin.now() % twin.design().pwm_period;
        if (n == 0 || of_period < 100 || of_period > 950) return;
        ++compared;
        for (std::size_t leg = 0; leg < 3; ++leg) {
          other_legs += twin.on_time(leg) == beside.on[n - 1][leg] ? 0 : 1;
        }
      },
      500);
  CHECK(n == beside.snapshots.size());
  CHECK(differ == 0);
  CHECK(compared > 20'000);
  CHECK(other_legs == 0);
}

TEST_CASE("page: the knob's first detents are those of the scene") {
  const Scenario scene = read_scenario(vectors + "scenes/knob_detents.toml");
  const DesignInfo design = design_named(KnobCore::design_name);
  const double core = scene.parameters.at("attract_core");
  CHECK(core * design.count_rad == Approx(0.2 * 0.5).epsilon(0.005));
  CHECK(scene.parameters.at("attract_core_slope") == Approx(0.012 / core).epsilon(0.003));
  CHECK(scene.parameters.at("attract_strength") == Approx(0.012 * core * core).epsilon(0.003));
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
