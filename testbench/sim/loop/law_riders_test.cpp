// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Laws in double and quad beside the engine's law: they ramp when the core ramps, and give no
// torque when a mailbox is too old. Documentation: docs/laws.md
#include <cmath>
#include <filesystem>
#include <fstream>
#include <memory>

#include "catch.hpp"
#include "design/design.hpp"
#include "feltgate/largest.hpp"
#include "loop_fixture.hpp"
#include "sim/law_loop/scene_law.hpp"
#include "sim/loop/backend_choice.hpp"
#include "sim/loop/scenario_bounds.hpp"

namespace {

using namespace feltgate;

const std::string kHead =
    "title = \"t\"\nabout = \"a\"\nduration_s = 0.1\n[core]\nscene = \"law\"\nlaw = \"x\"\n"
    "arm_s = 0.005\n";
/// At 0.4 rad when the motor arms.
const std::string kHold =
    "[hand]\n[[hand.phase]]\nkind = \"prescribed\"\nmotion = [\n"
    "  { kind = \"minimum_jerk\", duration_s = 0.004, to_rad = 0.4 },\n"
    "  { kind = \"hold\", duration_s = 0.2 }]\n";

struct Ridden {
  RunResult result;
  double rider_nm = 0;    ///< largest difference of a rider's reference to the core's
  double largest_nm = 0;  ///< of the core's
};

std::string kept(const std::string& name, const std::string& text) {
  const std::string path = (std::filesystem::temp_directory_path() / name).string();
  std::ofstream(path) << text;
  return path;
}

/// A scene whose law is that of the file, or a text.
Ridden ride(const std::string& scene, const std::string& law) {
  const Scenario s = read_scenario(kept("feltgate_law_riders.toml", kHead + scene + kHold));
  const std::string shipped = std::string(FELTGATE_ROOT) + "/rtl/laws/" + law + ".law";
  const auto loaded = make_scene_law(
      std::filesystem::exists(shipped) ? shipped : kept("feltgate_law_riders.law", law),
      design_named("lever_law"));
  RunOptions options;
  options.design = "lever_law";
  options.engine = "twin,double,quad";
  options.law = loaded.get();
  Ridden all;
  options.row = [&](const Row& r) {
    for (std::size_t n = 1; n < r.engines.size(); ++n) {
      const double off_nm = r.engines[n].tau_ref_nm - r.engines[0].tau_ref_nm;
      all.rider_nm = feltgate::larger(all.rider_nm, std::fabs(off_nm));
    }
    all.largest_nm = feltgate::larger(all.largest_nm, std::fabs(r.engines[0].tau_ref_nm));
  };
  all.result = run_on_p24(s, options);
  return all;
}

const std::string kMailbox =
    "mailbox pull = 0.1 Nm in -1 .. 1 Nm max_age 5 ms\nout torque = pull\n";

}  // namespace

TEST_CASE("laws in real numbers ramp after arming and after a commit") {
  const Ridden r = ride("[[event]]\nat_s = 0.07\nset = { stiffness = 0.1 }\n", "spring");
  CHECK(r.largest_nm > 0.15);
  CHECK(r.rider_nm < 1e-3);
  CHECK(r.result.law_stale.seconds == 0);
}

TEST_CASE("a mailbox that nobody feeds has no torque, in real numbers neither, and is told") {
  const Ridden r = ride("", kMailbox);
  CHECK(r.rider_nm < 1e-3);
  CHECK(r.result.law_stale.seconds > 0.085);
  CHECK(r.result.law_stale.first_s < 0.01);
}

TEST_CASE("a mailbox that is fed too rarely comes and goes, one fed in time stays") {
  const Ridden rarely = ride("[feed]\nrate_hz = 100\n", kMailbox);
  CHECK(rarely.result.law_stale.seconds > 0.03);
  CHECK(rarely.result.law_stale.seconds < 0.07);
  CHECK(rarely.largest_nm > 0.01);
  CHECK(rarely.rider_nm < 1e-3);
  const Ridden fed = ride("[feed]\nrate_hz = 1000\n", kMailbox);
  CHECK(fed.result.law_stale.seconds == 0);
  CHECK(fed.largest_nm > 0.09);
  CHECK(fed.rider_nm < 1e-3);
}

TEST_CASE("a law's riders need the twin, which knows the runs: the RTL alone is refused") {
  CHECK_THROWS_WITH(require_runs_of_law(choose_backends("rtl,double")),
                    Catch::Contains("add the twin, as rtl,twin,double"));
  for (const char* good : {"rtl", "rtl,twin,double", "twin,float", "double"}) {
    CHECK_NOTHROW(require_runs_of_law(choose_backends(good)));
  }
}

TEST_CASE("a law of several axes says how a scene runs it") {
  const std::string law = std::string(FELTGATE_ROOT) + "/rtl/laws/";
  const auto told = [&](const std::string& name) {
    try {
      make_scene_law(law + name + ".law", design_named("lever_law"));
    } catch (const std::exception& error) {
      return std::string(error.what());
    }
    return std::string("taken");
  };
  CHECK(told("coupled_levers").find("device = \"two_levers\"") != std::string::npos);
  CHECK(told("gimbal").find("device = \"gimbal\"") != std::string::npos);
}

TEST_CASE("a large error without a proven bound breaks the run, unless the scene expects one") {
  const std::string folder = std::string(FELTGATE_ROOT) + "/testbench/sim/loop/";
  const std::string rtl = std::string(FELTGATE_ROOT) + "/rtl/";
  const design::Elaborated design =
      design::elaborate(design::read_design(rtl + "designs/lever_law.toml"),
                        design::read_registers(rtl + "registers.toml"));
  const plant::Parameters plant = p24();
  Scenario s = read_scenario(folder + "parting.toml");
  resolve_effects(s, plant.effects);
  const auto run = [&](const char* engine) {
    const auto law = make_scene_law(folder + "parting.law", design_named("lever_law"));
    RunOptions options;
    options.design = "lever_law";
    options.engine = engine;
    options.law = law.get();
    return run_within_bounds(design, s, plant, options);
  };
  const RunResult r = run("twin,quad");
  REQUIRE(r.large.size() == 1);
  CHECK_THAT(r.large[0], Catch::StartsWith("torque_error_nm = 0.0") &&
                             Catch::EndsWith("Nm at most were asked, and no bound is proven"));
  CHECK(r.broken == r.large);
  CHECK_FALSE(r.as_expected());
  Expectation e;
  e.figure = "torque_error_nm";
  e.low = 0;
  e.high = 0.1;
  s.expectations = {e};
  CHECK(run("twin,quad").as_expected());
  CHECK(run("twin").as_expected());
  s.expectations[0].high = 0.001;
  CHECK(run("twin,quad").broken.size() == 1);
}
