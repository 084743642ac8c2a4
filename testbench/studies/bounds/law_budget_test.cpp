// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The error budget of laws: a stage that is made coarse is the one that the table names, with the
// error of a closed form; the whole is what a run measures. Documentation: docs/error-bounds.md
#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>

#include "catch.hpp"
#include "feltgate/generated/lever_law.hpp"
#include "law/compile.hpp"
#include "sim/axes_loop/axes_run.hpp"
#include "sim/backends/axes_cores.hpp"
#include "sim/law_loop/scene_law.hpp"
#include "sim/loop/loop.hpp"
#include "sim/loop/scenario_bounds.hpp"
#include "sim/plant/plant_file.hpp"
#include "studies/budget/design_budget.hpp"
#include "studies/budget/scene_budget.hpp"

namespace feltgate::bounds {

namespace {

const std::string kRoot = FELTGATE_ROOT;
constexpr double kRate = 67092 * 0x1p-27;  // a1 of both low-passes in lever_law: 500 rad/s at 1 MHz
constexpr int kVelocityBits = 13, kObserverBits = 18;

constexpr Formats coarse(int velocity_bits, int observer_bits) {
  BaseFormats b = LeverLaw::base;
  b.velocity.fraction = velocity_bits;
  b.observer_fraction = observer_bits;
  return derive(b);
}
/// lever_law with fewer fraction bits of the velocity, 13 in place of 21.
struct CoarseVelocity : LeverLaw {
  static constexpr Formats f = coarse(kVelocityBits, LeverLaw::base.observer_fraction);
};
/// The same of the observer's state, 18 in place of 30.
struct CoarseObserver : LeverLaw {
  static constexpr Formats f = coarse(LeverLaw::base.velocity.fraction, kObserverBits);
};

design::Elaborated elaborated(const std::string& name, design::Design design) {
  design.name = name;
  design.allow_coarse = true;
  return design::elaborate(design, design::read_registers(kRoot + "/rtl/registers.toml"));
}
design::Design shipped(const std::string& name) {
  return design::read_design(kRoot + "/rtl/designs/" + name + ".toml");
}

/// Positions of up to two axes, in counts, in tick k.
using Motion = std::array<int, 2> (*)(int k);

/// The budgets of a law on a motion that no plant answers: armed after 1 ms, a run every 10 ticks,
/// whose torque is in force 15 ticks after its samples.
template <class D>
std::vector<SceneBudget> budgets(const design::Elaborated& e, const std::string& text,
                                 std::size_t axes, Motion motion) {
  add_budget(e.design.name, make_design_budget<D>);
  const DesignInfo info = design_info<D>();
  law::Target target = law::target_of(info);
  target.axes = static_cast<int>(axes);
  const auto law =
      make_axes_law(law::compile_text(text, "t", target), "t", info, static_cast<int>(axes));
  Scenario scene;
  scene.scene = "law";
  BudgetRun run(e, scene, law.get(), axes);
  run.begin();
  for (int k = 0; k < 120'000; ++k) {
    std::array<Snapshot, most_axes> s;
    std::array<ChainIn, most_axes> in;
    for (std::size_t n = 0; n < axes; ++n) {
      s[n].tick = static_cast<std::uint32_t>(k);
      s[n].position = motion(k)[n];
      s[n].armed = k >= 1000;
      s[n].scene = static_cast<std::uint8_t>(e.registers.scene_number("law"));
      in[n] = {s[n].position, static_cast<std::int16_t>(s[n].position), s[n].armed, s[n].scene};
    }
    s[0].law_begins = k % 10 == 0;
    s[0].law_known = k >= 15;
    s[0].law_tick = static_cast<std::uint32_t>((k - 15) / 10 * 10);
    s[0].law_changes = 1;
    run.tick(s.data(), in.data());
  }
  std::vector<SceneBudget> all;
  for (std::size_t n = 0; n < axes; ++n) all.push_back(run.budget(n));
  return all;
}

/// At rest when the motor arms, so that no ramp acts; then 0.77 rad to the positive side in 50 ms,
/// and rest: the estimates end at their dead band's edge.
std::array<int, 2> there(int k) { return {std::clamp(k - 5000, 0, 50'000) / 100, 0}; }
/// The other axis alone.
std::array<int, 2> other(int k) { return {0, there(k)[0]}; }

const BudgetLine& line(const SceneBudget& b, const std::string& name) {
  for (const BudgetLine& l : b.sources) {
    if (l.max.name == name) return l;
  }
  FAIL("no row " << name);
  return b.whole;
}

/// The name of the row with the largest error of the torque reference, if it exceeds ten times
/// each other.
std::string cause(const SceneBudget& b) {
  std::string name;
  double most = 0, next = 0;
  for (const BudgetLine& l : b.sources) {
    next = std::max(next, std::min(most, l.max.tau_ref_nm));
    if (l.max.tau_ref_nm <= most) continue;
    most = l.max.tau_ref_nm;
    name = l.max.name;
  }
  return most > 10 * next ? name : "none";
}

const std::string kDamper =
    "param b = 0.02 Nm s/rad in 0 .. 0.1 Nm s/rad\nout torque = -b * velocity\n";

}  // namespace

TEST_CASE("budget of a law: a coarse velocity is the cause, by its dead band times the damping") {
  design::Design d = shipped("lever_law");
  d.velocity.fraction = kVelocityBits;
  const auto e = elaborated("coarse_velocity", d);
  const SceneBudget b = budgets<CoarseVelocity>(e, kDamper, 1, there).front();
  const double dead_band = std::ldexp(0.5, -kVelocityBits) / kRate;  // 0.12 rad/s
  CHECK(cause(b) == "velocity_n");
  const BudgetLine& l = line(b, "velocity_n");
  CHECK(l.max.velocity_rad_s <= dead_band);
  CHECK(l.max.velocity_rad_s > 0.9 * dead_band);
  CHECK(l.max.tau_ref_nm == Approx(0.02 * l.max.velocity_rad_s).epsilon(2e-3));  // 0.02 is a word
  CHECK(b.whole.max.tau_ref_nm == Approx(l.max.tau_ref_nm).epsilon(0.02));
  CHECK(b.within_bounds());
}

TEST_CASE("budget of a law: a coarse observer is the cause, by its dead band in the law's loop") {
  design::Design d = shipped("lever_law");
  d.observer_fraction = kObserverBits;
  const auto e = elaborated("coarse_observer", d);
  const SceneBudget b = budgets<CoarseObserver>(
                            e, "param c = 0.25 in 0 .. 0.5\nout torque = -c * tau_hat\n", 1, there)
                            .front();
  // The torque that answers tau_hat comes back in it: the input of the filter moves by 1 + c.
  const double dead_band = std::ldexp(0.5, -kObserverBits) / kRate / 1.25;  // 3 mNm
  CHECK(cause(b) == "dob");
  const BudgetLine& l = line(b, "dob");
  CHECK(l.max.tau_ref_nm <= 0.25 * dead_band * 1.01);
  CHECK(l.max.tau_ref_nm > 0.25 * dead_band * 0.85);
}

TEST_CASE("budget of a law: a coarse table is the cause, by half the sagitta of its segments") {
  const auto e = elaborated("plain", shipped("lever_law"));
  const std::string rise = "table rise(x) on [0, 1 rad] = 0.4 * x^2 with 4 segments\n";
  const SceneBudget b =
      budgets<LeverLaw>(e, rise + "out torque = rise(position) * 1 Nm\n", 1, there).front();
  // The compiler lays the chords so that the error is as large at their ends as in their middles.
  const double half_sagitta = 0.25 * 0.25 / 8 * 0.8 / 2;  // 3.1 mNm
  CHECK(cause(b) == "law");
  CHECK(line(b, "law").max.tau_ref_nm == Approx(half_sagitta).epsilon(0.01));
  // It reads the position alone, so that the bounds exist, and hold; the other blocks have no part.
  CHECK(std::isfinite(b.sum.bound.tau_ref_nm));
  CHECK(line(b, "law").bound.tau_ref_nm >= half_sagitta);
  CHECK(line(b, "velocity_n").bound.tau_ref_nm == 0);
  CHECK(b.within_bounds());
}

TEST_CASE("budget of a law of two axes: the error comes from the axis that moves") {
  design::Design d = shipped("lever_law");
  d.velocity.fraction = kVelocityBits;
  const auto e = elaborated("coarse_velocity", d);
  const std::string coupling =
      "param b = 0.02 Nm s/rad in 0 .. 0.1 Nm s/rad\nlet pull = b * (velocity[1] - velocity[0])\n"
      "out torque[0] = pull\nout torque[1] = -pull\n";
  const auto b = budgets<CoarseVelocity>(e, coupling, 2, other);
  REQUIRE(b.size() == 2);
  CHECK(line(b[0], "velocity_n").max.velocity_rad_s == 0);  // it rests
  const double moves = line(b[1], "velocity_n").max.velocity_rad_s;
  CHECK(moves > 0.1);
  for (const SceneBudget& axis : b) {
    CHECK(cause(axis) == "velocity_n");
    CHECK(line(axis, "velocity_n").max.tau_ref_nm == Approx(0.02 * moves).epsilon(2e-3));
    CHECK_FALSE(std::isfinite(line(axis, "velocity_n").bound.tau_ref_nm));
  }
}

TEST_CASE("budget of a scene with a law: the whole is what a run measures, the chain is the core") {
  add_budget("lever_law", make_design_budget<LeverLaw>);
  const auto e = elaborated("lever_law", shipped("lever_law"));
  const DesignInfo info = design_named("lever_law");
  const plant::Parameters plant = plant::read_plant_file(kRoot + "/vectors/plants/p24.toml");
  // At arming a constant torque is in force, from a run before it; lines of a law are cleared,
  // which ends a run.
  const std::string constant = "out torque = 0.1 Nm\n";
  for (const std::string& text : {std::string("detent"), constant, std::string("bowed_string")}) {
    const bool given = text == constant;
    CAPTURE(text);
    Scenario scene =
        read_scenario(kRoot + "/vectors/scenes/" + (given ? "detent" : text) + ".toml");
    scene.duration_s = given ? 0.2 : 0.1;
    scene.events.clear();
    scene.expectations.clear();
    resolve_effects(scene, plant.effects);
    const auto law = [&] {
      return given ? make_scene_law(law::compile_text(text, "t", law::target_of(info)), info)
                   : make_scene_law(kRoot + "/rtl/laws/" + text + ".law", info);
    };
    const auto of_budget = law(), of_run = law();
    BudgetOptions options;
    options.law = of_budget.get();
    const SceneBudget b = scene_budget(e, scene, plant, options);
    CHECK(b.ticks_apart == 0);
    CHECK(b.within_bounds());
    RunOptions run;
    run.design = "lever_law";
    run.engine = "twin,quad";
    run.law = of_run.get();
    const RunBounds bounds = scenario_bounds(e, scene, hardly_any_rad_s, of_run.get());
    const Coverage coverage(bounds.worst(), chain_numbers(e));
    run.coverage = &coverage;
    const BackendFigures twin = run_scenario(scene, plant, run).engines.front();
    CHECK(b.ticks_out_of_bounds == twin.torque_nm.outside());
    CHECK((twin.torque_nm.outside() > 0) == given);
    CHECK(b.whole.max.velocity_rad_s == Approx(twin.velocity_rad_s.max()).epsilon(1e-9));
    CHECK(b.whole.max.tau_hat_nm == Approx(twin.tau_hat_nm.max()).epsilon(1e-9));
    CHECK(b.whole.max.current_a * info.torque_constant_nm_a ==
          Approx(twin.torque_nm.max()).epsilon(1e-9));
  }
}

TEST_CASE("budget of a scene with a ramp: its row of coefficients leaves out where it parts them") {
  const auto e = elaborated("lever", shipped("lever"));
  // A charge that the host moves, with a slow ramp, whose word is wrong by 5 %: it takes 30 ms, and
  // its two chains differ by more than their bound long before core and reference do.
  const std::string path = std::filesystem::temp_directory_path() / "feltgate_ramp.toml";
  std::ofstream(path) << R"(title = "Ramp"
about = "A charge that the host moves."
duration_s = 0.1
[core]
scene = "charge_attract"
arm_s = 0.01
[parameters]
ramp_step = 5e-7
[hand]
[[hand.phase]]
kind = "prescribed"
motion = [{ kind = "hold", duration_s = 0.02 }, { kind = "minimum_jerk", duration_s = 0.02, to_rad = 0.2 }]
[[event]]
at_s = 0.05
set = { attract_centre = 200 }
)";
  Scenario scene = read_scenario(path);
  std::filesystem::remove(path);
  const plant::Parameters plant = plant::read_plant_file(kRoot + "/vectors/plants/p24.toml");
  resolve_effects(scene, plant.effects);
  const SceneBudget b = scene_budget(e, scene, plant, {});
  CHECK(b.ticks_apart == 0);
  CHECK(b.within_bounds());
  CHECK(b.ticks_out_of_coefficients > b.ticks_out_of_bounds);
  CHECK(b.ticks_out_of_coefficients < b.ticks_out_of_bounds + 1000);
}

TEST_CASE("budget of a device: the chains of each axis are its core, homing and arming included") {
  for (const char* name : {"gimbal", "coupled_levers"}) {
    AxesScene scene = read_axes_scene(
        kRoot + "/vectors/scenes/" + name + ".toml",
        [](const std::string& device) { return kRoot + "/vectors/devices/" + device + ".toml"; });
    scene.scenario.duration_s = 0.06;
    scene.scenario.events.clear();
    scene.scenario.expectations.clear();
    const std::string design = device_of(scene) + "_law";
    const auto e = elaborated(design, shipped(design));
    const auto law = make_axes_law(kRoot + "/rtl/laws/" + scene.scenario.law + ".law",
                                   find_axes_design(design)->info(), axes_of(scene));
    BudgetOptions options;
    options.law = law.get();
    const auto axes = scene_budgets(e, scene, options);
    REQUIRE(axes.size() == static_cast<std::size_t>(axes_of(scene)));
    for (const SceneBudget& b : axes) {
      CAPTURE(name);
      CHECK(b.ticks == 60'000);
      CHECK(b.ticks_apart == 0);
      CHECK(b.within_bounds());
      CHECK(b.whole.max.tau_ref_nm > 0);
    }
  }
}

}  // namespace feltgate::bounds
