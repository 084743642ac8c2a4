// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Trim: off means not computed, the trimmed set holds on motions nobody searched on, a set that is
// too loose is refused. Documentation: docs/speed-for-accuracy.md
#include "studies/trim/trim.hpp"
#include "feltgate/largest.hpp"

#include <algorithm>
#include <cstdio>
#include <fstream>

#include "catch.hpp"
#include "sim/plant/plant_file.hpp"
#include "studies/trim/motions.hpp"

using namespace feltgate;

namespace {

const std::string kRoot = FELTGATE_ROOT;
constexpr double kWindow_s = 1e-3;

Scenario scene(const std::string& name) {
  return read_scenario(kRoot + "/testbench/studies/trim/" + name + ".toml");
}

plant::Parameters p24() { return plant::read_plant_file(kRoot + "/vectors/plants/p24.toml"); }

trim::Model averaged(const Scenario& s, int step_clocks = 250) {
  trim::Model model = trim::full_model(s, p24().effects, step_clocks);
  model.gates = false;
  return model;
}

double worst_of(const std::vector<trim::UnseenReport>& motions) {
  double worst = 0;
  for (const trim::UnseenReport& u : motions) worst = feltgate::larger(worst, u.difference.worst());
  return worst;
}

bool dropped(const trim::Report& r, const std::string& part) {
  for (const trim::PartReport& p : r.parts) {
    if (p.name == part) return p.dropped;
  }
  return false;
}

}  // namespace

TEST_CASE("what a run leaves out is neither computed nor a state of its plant") {
  Scenario push = scene("push");
  push.duration_s = 0.02;
  trim::Model all = averaged(push);
  all.effects.viscous = true;
  const trim::Felt with = trim::feel(push, p24(), "lever", all, kWindow_s);
  CHECK(with.states == 7);

  struct Case {
    const char* part;
    std::uint64_t plant::Evaluations::*count;
    std::size_t states;
  };
  std::vector<std::string> seen;
  for (const Case& c : {Case{"inductance", &plant::Evaluations::inductance, 1},
                        Case{"back_emf", &plant::Evaluations::back_emf, 0},
                        Case{"dead_voltage", &plant::Evaluations::dead_voltage, 0},
                        Case{"lugre", &plant::Evaluations::lugre, 1},
                        Case{"viscous", &plant::Evaluations::viscous, 0},
                        Case{"supply_limit", &plant::Evaluations::supply_limit, 1},
                        Case{"dead_time", &plant::Evaluations::dead_time, 0},
                        Case{"encoder_imperfect", &plant::Evaluations::encoder_imperfect, 0},
                        Case{"hand_dynamics", &plant::Evaluations::hand_dynamics, 4}}) {
    trim::Model without = all;
    trim::set_part(without, c.part, false);
    const trim::Felt felt = trim::feel(push, p24(), "lever", without, kWindow_s);
    INFO(c.part);
    CHECK(with.evaluations.*c.count > 0);
    CHECK(felt.evaluations.*c.count == 0);
    CHECK(felt.states == with.states - c.states);
    seen.emplace_back(c.part);
  }
  CHECK(seen == trim::parts_of(all, true));  // no part without a test

  // Fewer steps are fewer evaluations; gates that switch contain their dead time.
  const trim::Felt fine = trim::feel(push, p24(), "lever", averaged(push, 50), kWindow_s);
  CHECK(fine.evaluations.inductance == 5 * with.evaluations.inductance);
  trim::Model gates = all;
  gates.gates = true;
  CHECK(trim::feel(push, p24(), "lever", gates, kWindow_s).evaluations.dead_time == 0);
}

TEST_CASE("the full model makes the torque that the averaged one makes") {
  Scenario sweep = scene("sweep");
  sweep.duration_s = 0.06;
  const trim::Model full = trim::full_model(sweep, p24().effects, 5);
  CHECK(full.effects.supply_limit);
  const trim::Felt gates = trim::feel(sweep, p24(), "lever", full, kWindow_s);
  const trim::Felt mean = trim::feel(sweep, p24(), "lever", averaged(sweep, 50), kWindow_s);
  CHECK(*std::max_element(gates.torque[0].means().begin(), gates.torque[0].means().end()) > 0.15);
  CHECK(trim::compare(gates, mean).worst() < 0.02);
}

TEST_CASE("a trimmed scene holds on motions that the search did not see") {
  for (const char* name : {"push", "sweep"}) {
    const Scenario s = scene(name);
    trim::Options options;
    options.tolerance = 0.02;
    options.timed_runs = 3;
    const trim::Report r = trim::trim(trim::lever_subject(s, p24(), options), options);
    INFO(name);
    REQUIRE(r.faster.size() == 3);
    CHECK(r.faster[0] <= r.faster[1]);
    CHECK(r.faster[1] <= r.faster[2]);
    CHECK(r.faster[0] > 2);
    CHECK(r.times_faster() == r.faster[1]);
    CHECK(r.holds);
    CHECK(r.smaller());
    CHECK(r.own.worst() <= options.tolerance);
    CHECK(dropped(r, "gates"));
    CHECK(dropped(r, "supply_limit"));
    CHECK_FALSE(dropped(r, "dead_voltage"));
    CHECK(r.trimmed.step_clocks > r.full.step_clocks);
    CHECK(r.trimmed_run.states < r.full_run.states);
    CHECK(r.trimmed_run.evaluations.inductance < r.full_run.evaluations.inductance);
    // Seeds far from those of the search and of its own check: all four quarters.
    const auto others = trim::check_unseen(trim::lever_subject(s, p24(), options), r.trimmed,
                                           options, {100, 101, 102, 103});
    CHECK(worst_of(others) <= options.tolerance);
    CHECK(worst_of(others) > 0);
  }
}

TEST_CASE("a set that is too loose is refused, and mended by the final check") {
  const Scenario sweep = scene("sweep");
  // The back-EMF as the scene's own motion shows it; a faster hand shows more.
  trim::Model without = averaged(sweep, 50);
  const trim::Felt with_emf = trim::feel(sweep, p24(), "lever", without, kWindow_s);
  trim::set_part(without, "back_emf", false);
  const double own =
      trim::compare(with_emf, trim::feel(sweep, p24(), "lever", without, kWindow_s)).worst();
  trim::Options options;
  const trim::Subject subject = trim::lever_subject(sweep, p24(), options);
  const double unseen = worst_of(trim::check_unseen(subject, without, options, {1, 2, 3, 4}));
  INFO("without back-EMF: " << own << " on the own motion, " << unseen << " on others");
  REQUIRE(unseen > 1.2 * own);
  options.share = 1;  // nothing kept back for other motions
  options.timed_runs = 1;
  options.tolerance = 0.95 * unseen;
  const trim::Report r = trim::trim(subject, options);
  CHECK(r.holds);
  CHECK(std::any_of(r.unseen.begin(), r.unseen.end(),
                    [](const trim::UnseenReport& u) { return u.searched; }));
  CHECK(std::any_of(r.unseen.begin(), r.unseen.end(),
                    [](const trim::UnseenReport& u) { return !u.searched; }));
  CHECK(std::any_of(r.parts.begin(), r.parts.end(),
                    [](const trim::PartReport& p) { return p.put_back; }));
  // Nothing at all is within no tolerance: the full model is the answer.
  trim::Model nothing = averaged(sweep);
  for (const std::string& part : subject.parts(nothing)) {
    trim::set_part(nothing, part, false);
  }
  CHECK(worst_of(trim::check_unseen(subject, nothing, options, {1, 2, 3, 4})) > 0.5);
}

TEST_CASE("a search without time leaves everything on, and runs nothing a second time") {
  trim::Options options;
  options.longest_s = 1e-9;
  const trim::Subject subject = trim::lever_subject(scene("push"), p24(), options);
  const trim::Report r = trim::trim(subject, options);
  CHECK(r.out_of_time);
  CHECK(r.holds);
  CHECK_FALSE(r.smaller());
  CHECK_FALSE(dropped(r, "gates"));
  CHECK(r.faster == std::vector<double>{1.0});
  CHECK(r.unseen.empty());
  options.longest_s = 1e9;
  CHECK_FALSE(trim::trim(subject, options).out_of_time);
}

TEST_CASE("the trimmed scene is a scene file that says what is off") {
  for (const char* path :
       {"/testbench/studies/trim/sweep.toml", "/vectors/scenes/torque_step.toml"}) {
    Scenario s = read_scenario(kRoot + path);
    trim::Model model{plant::Effects{}, false, 150};
    model.effects.lugre = model.effects.back_emf = false;
    const std::string file = std::string(FELTGATE_BUILD_DIR) + "/trimmed_scene.toml";
    std::ofstream(file) << trim::scene_text(s, model, "made by a test\nin two lines");
    Scenario back = read_scenario(file);
    resolve_effects(back, plant::Effects{});
    CHECK(effects_off(back) == std::vector<std::string>{"gates", "back_emf", "lugre", "viscous",
                                                        "supply_limit", "encoder_imperfect"});
    CHECK(back.step_clocks == 150);
    CHECK_FALSE(back.switched);
    CHECK(back.plant == "p24");
    CHECK(back.title == s.title);
    CHECK(back.events.size() == s.events.size());
    CHECK(back.hand.phases.size() == s.hand.phases.size());
    CHECK(back.expectations.size() == s.expectations.size());
    // Trimmed once more: the keys are replaced, not doubled.
    model.gates = true;
    std::ofstream(file + ".again.toml") << trim::scene_text(back, model, "again");
    CHECK(read_scenario(file + ".again.toml").switched);
    std::remove(file.c_str());
    std::remove((file + ".again.toml").c_str());
  }
}

TEST_CASE("perturbed motions: the same for a seed, within their ranges, in all quarters") {
  const Scenario sweep = scene("sweep");
  int quarters = 0;
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    const trim::Motion m = trim::perturbed(sweep, p24(), seed);
    const trim::Motion again = trim::perturbed(sweep, p24(), seed);
    CHECK(m.scene.duration_s == again.scene.duration_s);
    CHECK(m.plant.encoder.seed == again.plant.encoder.seed);
    CHECK(m.plant.encoder.seed != p24().encoder.seed);
    CHECK((m.amplitude > 0.7 && m.amplitude < 1.3));
    CHECK((m.speed > 0.7 && m.speed < 1.4));
    CHECK(m.scene.hand.phases[0].profile[1].to == Approx(0.4 * m.amplitude));
    CHECK(m.scene.hand.phases[0].profile[1].duration_s == Approx(0.1 / m.speed));
    CHECK(m.scene.arm_s == Approx(0.005 / m.speed));
    quarters |= 1 << ((m.amplitude > 1 ? 1 : 0) + (m.speed > 1 ? 2 : 0));
  }
  CHECK(quarters == 15);
}
