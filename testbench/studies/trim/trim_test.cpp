// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Trim: off means not computed, the trimmed set holds on motions nobody searched on, a set that is
// too loose is refused. Documentation: docs/speed-for-accuracy.md
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <numeric>

#include "catch.hpp"
#include "feltgate/largest.hpp"
#include "sim/axes_loop/axes_run.hpp"
#include "sim/backends/axes_cores.hpp"
#include "sim/law_loop/scene_law.hpp"
#include "sim/plant/plant_file.hpp"
#include "studies/trim/trim.hpp"

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

/// The largest loss of `model` on motions made with these seeds.
double worst_on(const trim::Subject& subject, const trim::Model& model,
                std::initializer_list<std::uint64_t> seeds) {
  double worst = 0;
  for (const std::uint64_t seed : seeds) {
    const trim::Course other = subject.other(seed);
    const auto difference = trim::compare(other.feel(subject.full), other.feel(model));
    worst = feltgate::larger(worst, difference.worst());
  }
  return worst;
}

bool dropped(const trim::Report& r, const std::string& part) {
  for (const trim::PartReport& p : r.parts) {
    if (p.name == part) return p.dropped;
  }
  return false;
}

}  // namespace

TEST_CASE("what a run leaves out is no state of its plant") {
  Scenario push = scene("push");
  push.duration_s = 0.02;
  trim::Model all = averaged(push);
  all.effects.viscous = true;
  const trim::Felt with = trim::feel(push, p24(), "lever", all, kWindow_s);
  CHECK(with.states == 7);

  struct Case {
    const char* part;
    std::size_t states;
  };
  std::vector<std::string> seen;
  for (const Case& c :
       {Case{"inductance", 1}, Case{"back_emf", 0}, Case{"dead_voltage", 0}, Case{"lugre", 1},
        Case{"viscous", 0}, Case{"supply_limit", 1}, Case{"dead_time", 0},
        Case{"encoder_imperfect", 0}, Case{"hand_dynamics", 4}}) {
    trim::Model without = all;
    trim::set_part(without, c.part, false);
    const trim::Felt felt = trim::feel(push, p24(), "lever", without, kWindow_s);
    INFO(c.part);
    CHECK(felt.states == with.states - c.states);
    seen.emplace_back(c.part);
  }
  CHECK(seen == trim::parts_of(all, true));  // no part without a test
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
    options.longest_s = 1e9;
    const trim::Subject subject = trim::lever_subject(s, p24(), options);
    const trim::Report r = trim::trim(subject, options);
    INFO(name);
    REQUIRE(r.faster.size() == 3);
    CHECK(r.faster[0] <= r.faster[1]);
    CHECK(r.faster[1] <= r.faster[2]);
    CHECK(r.faster[0] > 2);
    CHECK(r.times_faster() == r.faster[1]);
    CHECK_FALSE(r.out_of_time);
    CHECK(r.holds);
    CHECK(r.smaller());
    CHECK(r.own.worst() <= options.tolerance);
    CHECK(dropped(r, "gates"));
    CHECK(dropped(r, "supply_limit"));
    CHECK_FALSE(dropped(r, "dead_voltage"));
    CHECK(r.trimmed.step_clocks > r.full.step_clocks);
    CHECK(r.trimmed_run.states < r.full_run.states);
    // Seeds far from those of the search and of its own check.
    const double others = worst_on(subject, r.trimmed, {100, 103});
    CHECK(others <= options.tolerance);
    CHECK(others > 0);
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
  const double unseen = worst_on(subject, without, {1, 2, 3, 4});
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
  CHECK(worst_on(subject, nothing, {1, 2, 3, 4}) > 0.5);
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

// Trim of scenes with a law, on one lever and on devices of several axes.

namespace {

const std::string root = FELTGATE_ROOT;
const std::string laws = root + "/rtl/laws/";

AxesScene device_scene(const std::string& path) {
  return read_axes_scene(
      path, [](const std::string& name) { return root + "/vectors/devices/" + name + ".toml"; });
}

AxesScene shipped(const std::string& name) {
  return device_scene(root + "/vectors/scenes/" + name + ".toml");
}

trim::LawMaker coupled() {
  return
      [] { return make_axes_law(laws + "coupled_levers.law", design_named("two_levers_law"), 2); };
}

trim::Signal signal(std::initializer_list<double> values) {
  trim::Signal s(1, 1e-3);
  for (const double v : values) s.add(1, v);
  return s;
}

}  // namespace

TEST_CASE("each axis is compared with its own size") {
  trim::Felt reference, other;
  reference.torque = {signal({100, 100, 100}), signal({1, 1, 1})};
  other.torque = {signal({100, 100, 100}), signal({1.5, 1.5, 1.5})};
  const trim::Difference d = trim::compare(reference, other);
  CHECK(d.torque.peak == Approx(0.5));
  CHECK(d.torque.rms == Approx(0.5));
  CHECK(d.worst() == d.torque.peak);
  other.torque[1] = signal({1, std::nan(""), 1});
  CHECK_FALSE(trim::compare(reference, other).worst() < 1e300);
}

TEST_CASE("other motions of a device: about its start, with their times, the same for a seed") {
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    const AxesScene wall = shipped("pantograph_floor");
    const auto& own = std::get<PantographSetup>(wall.device);
    const trim::AxesMotion m = trim::perturbed(wall, seed);
    const auto& pen = std::get<PantographSetup>(m.scene.device);
    CHECK((m.amplitude > 0.9 && m.amplitude < 1.1));
    CHECK((m.speed > 0.7 && m.speed < 1.4));
    CHECK(m.scene.scenario.duration_s == Approx(wall.scenario.duration_s / m.speed));
    CHECK(m.scene.scenario.expectations.empty());
    CHECK(pen.parameters.encoder.seed != own.parameters.encoder.seed);
    CHECK(pen.parameters.encoder.seed ==
          std::get<PantographSetup>(trim::perturbed(wall, seed).scene.device)
              .parameters.encoder.seed);
    const plant::Vec2 start = own.hand.start_m.value_or(own.parameters.start_m);
    for (std::size_t i = 0; i < own.hand.phases.size(); ++i) {
      const plant::Profile &was = own.hand.phases[i].y, &is = pen.hand.phases[i].y;
      for (std::size_t k = 0; k < was.size(); ++k) {
        CHECK(is[k].duration_s == Approx(was[k].duration_s / m.speed));
        if (was[k].kind != plant::Segment::Kind::kMinimumJerk) continue;
        CHECK(is[k].to - start.y == Approx((was[k].to - start.y) * m.amplitude));
      }
    }
    const trim::AxesMotion levers = trim::perturbed(shipped("coupled_levers"), seed);
    const auto& set = std::get<TwoLeversSetup>(levers.scene.device);
    CHECK(set.hand[0].phases[0].profile[1].duration_s == Approx(0.15 / levers.speed));
    CHECK(std::fabs(set.hand[0].phases[0].profile[1].to - 0.3 * levers.amplitude) < 1e-12);
    const double count_rad = 6.283185307179586 / 4096;
    CHECK(std::fabs(*set.hand[0].start_rad) <= 2 * count_rad);
    const trim::AxesMotion turned = trim::perturbed(shipped("gimbal"), seed);
    const auto& handle = std::get<GimbalSetup>(turned.scene.device).hand;
    CHECK(handle.phases[0].way[1].to == Approx(6.28318531 * turned.amplitude));
  }
  CHECK_FALSE(trim::has_mass(shipped("coupled_levers").device));
  AxesScene held = shipped("pantograph_wall");
  CHECK_FALSE(trim::has_mass(held.device));
  std::get<PantographSetup>(held.device).hand.phases[0].kind = plant::PenPhase::Kind::kImpedance;
  CHECK(trim::has_mass(held.device));
}

TEST_CASE("two levers are trimmed to what both of them feel") {
  AxesScene scene = shipped("coupled_levers");
  scene.scenario.duration_s = 0.1;
  scene.scenario.expectations.clear();
  trim::Options options;
  options.design = "two_levers_law";
  options.timed_runs = 1;
  options.unseen = 2;
  const trim::Subject subject = trim::axes_subject(scene, options, coupled());
  CHECK_FALSE(subject.full.gates);
  const trim::Felt felt = subject.own.feel(subject.full);
  REQUIRE(felt.torque.size() == 2);
  REQUIRE(felt.position.size() == 2);
  REQUIRE(felt.force.size() == 2);  // of the hand and of what is met

  // The same run by the figures of `feltgate run`.
  scene.scenario.effects = subject.full.effects;
  const auto law = coupled()();
  AxesRunOptions run;
  run.design = options.design;
  run.engine = "twin";
  run.law = law.get();
  const auto names = axes_columns(scene);
  double sums_nm[2] = {0, 0};
  run.row = [&](const std::vector<double>& row) {
    for (std::size_t i = 0; i < row.size(); ++i) {
      if (names[i] == "motor_torque_nm.0") sums_nm[0] += row[i];
      if (names[i] == "motor_torque_nm.1") sums_nm[1] += row[i];
    }
  };
  const AxesResult result = run_axes(scene, run);
  const auto figure = [&](const std::string& name) { return result.figures.at(name); };
  for (std::size_t n = 0; n < 2; ++n) {
    const std::string axis = "." + std::to_string(n);
    // The last mean has half a triangle; both levers turn less than 5 mrad in a window of 1 ms.
    const auto& position = felt.position[n].means();
    const double end = position[position.size() - 2];
    CHECK(end == Approx(figure("theta_rad" + axis + ".max")).margin(0.005));
    const auto& torque = felt.torque[n].means();
    const double sum_nm = std::accumulate(torque.begin(), torque.end(), 0.0);
    CHECK(1000 * sum_nm == Approx(sums_nm[n]));  // ticks of 1 us in means over 1 ms
    const auto [low, high] = std::minmax_element(torque.begin(), torque.end());
    CHECK(*low >= figure("motor_torque_nm" + axis + ".min") - 1e-12);
    CHECK(*high <= figure("motor_torque_nm" + axis + ".max") + 1e-12);
  }

  const trim::Report r = trim::trim(subject, options);
  CHECK(r.holds);
  CHECK(r.smaller());
  CHECK(r.trimmed.step_clocks == 250);
  CHECK_FALSE(r.trimmed.effects.supply_limit);
  CHECK(r.trimmed.effects.dead_voltage);
  CHECK(r.trimmed.effects.dead_time);
  for (const trim::PartReport& p : r.parts) {
    INFO(p.name);
    CHECK(p.name != "gates");
    CHECK((p.alone.worst() > 0) == (p.name != "supply_limit"));
  }
  CHECK(worst_on(subject, r.trimmed, {100, 101}) <= options.tolerance);

  // The file is a scene of the device again, with these effects and without a plant of one lever.
  const std::string file = std::string(FELTGATE_BUILD_DIR) + "/trimmed_levers.toml";
  std::ofstream(file) << trim::scene_text(scene.scenario, r.trimmed, "made by a test");
  const AxesScene back = device_scene(file);
  std::remove(file.c_str());
  CHECK(device_of(back) == "two_levers");
  for (const plant::EffectName& e : plant::effect_names) {
    INFO(e.name);
    CHECK(back.scenario.effects.*e.flag == r.trimmed.effects.*e.flag);
  }
}

TEST_CASE("a law on one lever is felt, and its file found from the trimmed scene") {
  const std::string path = root + "/vectors/scenes/detent.toml";
  Scenario detent = read_scenario(path);
  detent.duration_s = 0.25;
  const plant::Parameters p24 = plant::read_plant_file(root + "/vectors/plants/p24.toml");
  const DesignInfo& design = design_named("lever_law");
  const auto law = [&design] { return make_scene_law(laws + "detent.law", design); };
  trim::Options options;
  options.design = "lever_law";
  const trim::Subject subject = trim::lever_subject(detent, p24, options, law);
  trim::Model averaged = subject.full;
  averaged.gates = false;
  averaged.step_clocks = 250;
  const auto torque = subject.own.feel(averaged).torque.at(0).means();
  const auto [low, high] = std::minmax_element(torque.begin(), torque.end());
  CHECK(*high - *low > 0.04);  // of 0.1 Nm from valley to crest
  detent.law = "laws/own.law";
  detent.path = std::string(FELTGATE_BUILD_DIR) + "/own_detent.toml";
  std::ofstream(detent.path) << "duration_s = 1\n[core]\nscene = \"law\"\nlaw = \"laws/own.law\"\n";
  const std::string text = trim::scene_text(detent, averaged, "made by a test");
  // A quote in a name, and a device and a trace of [met] beside the file.
  detent.law = "a\"b.law";
  std::ofstream(detent.path) << "device = \"dev/mine.toml\"\ncore = { scene = \"law\", law = "
                                "\"x\" }\nmet = { phase = [ { file = \"t.csv\" } ] }\n";
  const std::string inlined = trim::scene_text(detent, averaged, "made by a test");
  for (const char* part : {"law = \"/", "a\\\"b.law\"", "device = \"/", "/t.csv\"",
                           "plant = \"p24\"", "step_clocks = 250", "bridge = \"averaged\""}) {
    INFO(part);
    CHECK(inlined.find(part) != std::string::npos);
  }
  std::remove(detent.path.c_str());
  CHECK(text.find("law = \"" + std::string(FELTGATE_BUILD_DIR) + "/laws/own.law\"") !=
        std::string::npos);
}
