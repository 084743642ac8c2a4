// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The figures of a run for the hand (felt torque and energy): closed forms first, then a scene.
// Documentation: docs/json.md
#include "sim/loop/felt.hpp"

#include <cmath>
#include <filesystem>
#include <fstream>

#include "catch.hpp"
#include "design/design.hpp"
#include "loop_fixture.hpp"
#include "sim/backends/backend.hpp"
#include "sim/loop/figures.hpp"
#include "sim/loop/scenario_bounds.hpp"
#include "sim/loop/speed_jumps.hpp"

namespace {

using namespace feltgate;

bool near(double a, double b) { return std::abs(a - b) < 1e-9; }

design::Elaborated lever() {
  const std::string root = FELTGATE_ROOT;
  return design::elaborate(design::read_design(root + "/rtl/designs/lever.toml"),
                           design::read_registers(root + "/rtl/registers.toml"));
}

}  // namespace

TEST_CASE("energy: a spring gives back what it took, and a push beyond shows as a debt") {
  FeltMeter meter(1e-6);
  for (int i = 0; i < 100; ++i) meter.step(0.01, 2.0, 1.0);   // 2 J in
  for (int i = 0; i < 150; ++i) meter.step(0.01, 2.0, -1.0);  // 3 J out
  const FeltEnergy e = meter.felt().energy;
  CHECK(near(e.taken_from_hand_j, 2.0));
  CHECK(near(e.given_to_hand_j, 3.0));
  CHECK(near(e.net_from_hand_j(), -1.0));
  CHECK(near(e.peak_from_hand_j, 2.0));
  CHECK(near(e.peak_to_hand_j, 1.0));
}

TEST_CASE("a step response is right however long it is") {
  // An exponential with a ripple of 0.02 on a step of 2, first in one sample a block, then in four.
  for (const std::int64_t samples : {400'000, 3'000'000}) {
    const double tau = static_cast<double>(samples) / 20;
    StepSamples response(1.0);
    for (std::int64_t k = 0; k < samples; ++k) {
      const double at = static_cast<double>(k);
      response.add(3.0 - 2.0 * std::exp(-at / tau) + (k % 2 == 0 ? 0.02 : -0.02));
    }
    const StepResponse r = response.response(1e-6, 3.03);
    CHECK(std::abs(r.final_value_nm - 3.0) < 1e-7);
    CHECK(std::abs(r.ripple_nm - 0.02) < 1e-7);
    CHECK(std::abs(r.overshoot_pct - 1.0) < 1e-5);
    // Out of the band of 0.04 until 2 exp(-t) = 0.02, less one ripple.
    CHECK(std::abs(r.settling_ms - 1e-3 * tau * std::log(100.0)) < 0.01);
    CHECK(std::abs(r.final_error_pct - 100 * (3.0 / 3.03 - 1)) < 1e-6);
  }
}

TEST_CASE("a pulse shorter than a hand feels counts as its mean over 1 ms") {
  FeltMeter meter(1e-6);
  for (int tick = 0; tick < 3000; ++tick) {
    const bool pulse = tick >= 1000 && tick < 1100;
    meter.step(1e-6, pulse ? -50.0 : 0.0, 0.0);
    meter.tick(pulse ? 1.0 : 0.0, pulse ? -2.0 : 0.0, 0, 0);
    meter.motor(pulse ? 0.5 : 0.0, pulse ? 1.0 : 0.0);
  }
  const FeltTorque t = meter.felt().torque;
  CHECK(t.asked.value == 1.0);
  CHECK(near(t.asked.at_s, 1e-3));
  CHECK(t.commanded.value == -2.0);
  CHECK(near(t.motor.value, 0.05));
  CHECK(near(t.motor.at_s, 1e-3));
  CHECK(near(t.hand.value, -5.0));
  CHECK(near(t.motor_error.max(), 0.05));
  CHECK(t.motor_error.count() == 3);
}

TEST_CASE("limits and faults: each by its name, how long and since when") {
  FeltMeter meter(1e-3);
  const auto ticks = [&](int n, unsigned limits, unsigned faults) {
    for (int i = 0; i < n; ++i) meter.tick(0, 0, limits, faults);
  };
  ticks(10, limit::gates_closed, 0);
  ticks(5, limit::ramp | limit::torque, 0);
  ticks(20, 0, 0);
  ticks(5, limit::torque, 1u << 2);
  const Felt f = meter.felt();
  REQUIRE(f.limits.size() == 3);
  CHECK(near(f.limits.at("gates_closed").seconds, 0.010));
  CHECK(near(f.limits.at("ramp").seconds, 0.005));
  CHECK(near(f.limits.at("torque").seconds, 0.010));
  CHECK(near(f.limits.at("torque").first_s, 0.010));
  REQUIRE(f.faults.size() == 1);
  CHECK(near(f.faults.at("speed").first_s, 0.035));
}

TEST_CASE("a scene: energy, errors within their bounds, expectations by name") {
  Scenario scene = shipped_scene("wall");
  const plant::Parameters plant = p24();
  resolve_effects(scene, plant.effects);
  Expectation wrong;
  wrong.figure = "tau_ref_min_nm";
  wrong.low = -0.1;
  wrong.high = 0;
  scene.expectations.push_back(wrong);
  RunOptions options;
  options.engine = "twin,quad";
  const RunResult r = run_within_bounds(lever(), scene, plant, options);
  CHECK(r.felt.closed_loop);
  CHECK(std::abs(r.felt.torque.asked.value + 0.4023) < 1e-3);
  CHECK(std::abs(r.felt.torque.motor.value - r.felt.torque.asked.value) < 0.01);
  CHECK(r.felt.energy.net_from_hand_j() == r.figures.at("hand_energy_j"));
  CHECK(r.felt.energy.taken_from_hand_j > 0.02);  // 4 Nm/rad * (0.1 rad)^2 / 2
  CHECK(r.felt.energy.taken_from_hand_j < 0.025);
  CHECK(r.felt.energy.peak_to_hand_j == 0);
  REQUIRE(r.felt.errors.size() == 3);
  for (const FeltError& e : r.felt.errors) {
    CAPTURE(e.signal, e.error.max(), e.bound);
    CHECK(e.error.max() > 0);
    CHECK(e.holds());
    CHECK(e.bound < 1e-3);
  }
  REQUIRE(r.expectations.size() == 6);
  for (std::size_t i = 0; i < 5; ++i) CHECK(r.expectations[i].kept());
  CHECK(!r.expectations[5].kept());
  CHECK(r.expectations[5].figure == "tau_ref_min_nm");
  CHECK(r.broken.size() == 1);
}

TEST_CASE("the column of what a hand feels has the peak that the text tells, and no blow") {
  Scenario scene = shipped_scene("wall");
  scene.duration_s = 0.05;
  plant::Segment jump;  // from rest to 2 rad/s at once
  jump.kind = plant::Segment::Kind::kRamp;
  jump.duration_s = 0.0405;
  jump.to = 0.081;
  scene.hand.phases.resize(1);
  scene.hand.phases[0].profile = {jump};
  scene.hand.phases[0].duration_s = 0.0405;
  scene.expectations.clear();
  RunOptions options;
  options.engine = "twin";
  double felt = 0, row = 0;
  options.row = [&](const Row& r) {
    felt = larger(felt, std::abs(r.hand_felt_nm));
    row = larger(row, std::abs(r.hand_torque_nm));
  };
  const RunResult r = run_on_p24(scene, options);
  CHECK(felt == std::abs(r.felt.torque.hand.value));
  CHECK(felt < 1.5);
  CHECK(row > 50);
}

TEST_CASE("no shipped scene of a lever has a jump in its hand's speed") {
  std::size_t scenes = 0;
  const std::string root = FELTGATE_ROOT;
  for (const auto& file : std::filesystem::directory_iterator(root + "/vectors/scenes")) {
    if (names_device(file.path().string())) continue;
    Scenario scene = read_scenario(file.path().string());
    const auto plant = plant::read_plant_file(
        root + "/vectors/plants/" + (scene.plant.empty() ? "p24" : scene.plant) + ".toml");
    resolve_effects(scene, plant.effects);
    CHECK(speed_jumps(scene, plant) == std::vector<std::string>{});
    ++scenes;
  }
  CHECK(scenes > 20);
}

TEST_CASE("a jump of the speed that the hand imposes is told with line, size and mend") {
  const auto told = [](const std::string& phases, bool dynamics = true) {
    const std::string path =
        std::filesystem::temp_directory_path().string() + "/feltgate_jump_scene.toml";
    std::ofstream(path) << "title = \"t\"\nabout = \"a\"\nduration_s = 2\n[core]\nscene = "
                           "\"free\"\n[hand]\n"
                        << phases;
    Scenario scene = read_scenario(path);
    resolve_effects(scene, p24().effects);
    scene.effects.hand_dynamics = dynamics;
    std::vector<std::string> all = speed_jumps(scene, p24());
    for (std::string& one : all) one.erase(0, one.rfind("feltgate_jump_scene"));
    return all;
  };
  const std::string phase = "[[hand.phase]]\nkind = \"prescribed\"\nmotion = [\n";
  const std::string at_rest =
      "{ kind = \"minimum_jerk\", duration_s = 0.1, to_rad = 0.2 },\n"
      "{ kind = \"sine\", duration_s = 0.5, amplitude_rad = 0.1, frequency_hz = 2, phase_rad = "
      "1.5707963 },\n";
  CHECK(told(phase + at_rest + "]\n").empty());
  const auto ramp =
      told(phase + at_rest + "{ kind = \"ramp\", duration_s = 0.1, to_rad = 0.4 },\n]\n");
  REQUIRE(ramp.size() == 2);
  CHECK(ramp[0].rfind("feltgate_jump_scene.toml:12: the hand's speed jumps by 2 rad/s at 0.6 s, "
                      "which costs the hand",
                      0) == 0);
  CHECK(ramp[0].find("kind = \"minimum_jerk\"") != std::string::npos);
  CHECK(ramp[1].find("jumps by -2 rad/s at 0.7 s") != std::string::npos);
  // Cut off in its middle, where it is fastest: 30/16 of its mean speed.
  const std::string cut =
      "[[hand.phase]]\nkind = \"prescribed\"\nduration_s = 0.05\nmotion = "
      "[{ kind = \"minimum_jerk\", duration_s = 0.1, to_rad = 0.2 }]\n";
  CHECK(told(cut + "[[hand.phase]]\nkind = \"free\"\n").empty());
  const auto locked = told(cut + "[[hand.phase]]\nkind = \"locked\"\n");
  REQUIRE(locked.size() == 1);
  CHECK(locked[0].find("toml:12: the hand's speed jumps by -3.75 rad/s at 0.05 s") !=
        std::string::npos);
  // After a phase with a free lever its speed is unknown.
  CHECK(told("[[hand.phase]]\nkind = \"free\"\nduration_s = 0.1\n" + phase + at_rest + "]\n")
            .empty());
  const std::string arm =
      "[[hand.phase]]\nkind = \"impedance\"\nmotion = [{ kind = \"ramp\", "
      "duration_s = 3, to_rad = 3 }]\n";
  CHECK(told(arm).empty());
  CHECK(told(arm, false).size() == 1);  // its end comes after the scene's
}

TEST_CASE("free lever: inertia and sliding friction are felt, within 1 %, in both designs") {
  const plant::Parameters p = p24();
  constexpr double pi = 3.14159265358979, amplitude_rad = 0.5, pulse_rad_s = 4 * pi;
  constexpr int steps = 10000;  // of half a swing
  double squares = 0;
  for (int k = 0; k < steps; ++k) {
    const double angle = pi * (k + 0.5) / steps;
    const double speed = amplitude_rad * pulse_rad_s * std::sin(angle);
    const double slow = speed / p.lugre.stribeck_rad_s;
    const double sliding =
        p.lugre.coulomb_nm + (p.lugre.static_nm - p.lugre.coulomb_nm) * std::exp(-slow * slow);
    const double hand =
        sliding + p.lugre.viscous_nm_s_rad * speed +
        p.lever.inertia_kg_m2 * amplitude_rad * pulse_rad_s * pulse_rad_s * std::cos(angle);
    squares += hand * hand / steps;
  }
  for (const char* design : {"lever", "paper"}) {
    Scenario scene = shipped_scene("free_lever");
    scene.expectations.clear();  // those of lever
    RunOptions options;
    options.design = design;
    options.engine = "twin";
    INFO(design);
    CHECK(run_on_p24(scene, options).figures.at("drag_rms_nm") ==
          Approx(std::sqrt(squares)).epsilon(0.01));
  }
}

TEST_CASE("engines by name: lists, their order, and what compares them") {
  const auto names = [](const char* list) { return choose_backends(list).names(); };
  using Names = std::vector<std::string>;
  CHECK(names("twin,double,float") == Names{"twin", "double", "float"});
  CHECK(names("all") == Names{"twin", "float", "double", "quad"});
  CHECK(names("rtl") == Names{"rtl"});
  CHECK(names("double") == Names{"double"});
  CHECK(choose_backends("rtl,float").lead == "rtl");
  CHECK(choose_backends("float,rtl,twin").lead == "lockstep");
  CHECK(choose_backends("float,double").rider_drives);
  CHECK(choose_backends("twin,double,float").reference() == "double");
  CHECK(choose_backends("all").reference() == "quad");
  CHECK(choose_backends("quad").reference().empty());
  CHECK(choose_backends("twin,float").reference().empty());
  const auto complaint = [](const char* list) -> std::string {
    try {
      choose_backends(list);
      return "";
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
  };
  CHECK(complaint("twin,dubble").find("did you mean \"double\"?") != std::string::npos);
  CHECK(complaint("twin,twin").find("twice") != std::string::npos);
  CHECK(complaint("").find("unknown") != std::string::npos);
}
