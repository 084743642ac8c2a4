// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Scenes that cannot run: each is refused or stopped with a message that has file, line and the
// change to make. And a scene that is made for another design. Documentation: docs/scenes.md,
// docs/plant.md
#include <cmath>
#include <filesystem>
#include <fstream>

#include "catch.hpp"
#include "design/design.hpp"
#include "files/toml/toml_reader.hpp"
#include "sim/loop/loop.hpp"
#include "sim/loop/scenario_check.hpp"
#include "sim/plant/plant_file.hpp"

namespace {

using namespace feltgate;

const std::string kHead =
    "title = \"t\"\nabout = \"a\"\nduration_s = 0.02\n[core]\nscene = \"free\"\n";  // 5 lines

/// Reads a scene's text and runs it with the twin. Returns the error message; empty without an
/// error.
std::string told(const std::string& text, const std::string& plant_change = "",
                 bool resolve = true) {
  const std::string folder = std::filesystem::temp_directory_path().string();
  const std::string path = folder + "/feltgate_bad_scene.toml";
  std::ofstream(path) << text;
  const auto without_folder = [&](std::string message) {
    const auto at = message.find(folder + "/");
    if (at != std::string::npos) message.erase(at, folder.size() + 1);
    return message;
  };
  try {
    plant::Parameters p =
        plant::read_plant_file(std::string(FELTGATE_ROOT) + "/vectors/plants/p24.toml");
    if (plant_change == "light") p.lever.inertia_kg_m2 = 1e-12;
    Scenario scene = read_scenario(path);
    resolve_effects(scene, p.effects);
    if (resolve) resolve_amounts(scene, design_named("lever"));
    RunOptions options;
    options.engine = "twin";
    (void)run_scenario(scene, p, options);
  } catch (const config::ConfigError& error) {
    return without_folder(error.what());
  }
  return {};
}

void expect(const std::string& message, const std::string& beginning, const std::string& mend) {
  INFO(message);
  CHECK(message.rfind("feltgate_bad_scene.toml:" + beginning, 0) == 0);
  CHECK(message.find(mend) != std::string::npos);
}

std::string hand(const std::string& phase) { return kHead + "[hand]\n[[hand.phase]]\n" + phase; }

}  // namespace

TEST_CASE("a good scene runs to its end", "[bad_scene]") { CHECK(told(kHead) == ""); }

TEST_CASE("a parameter may have its unit behind it, and one of something else has its line") {
  const auto with = [](const std::string& value) {
    return kHead + "[parameters]\nwall_stiffness = " + value +
           "\n[[event]]\nat_s = 0.01\nset = { wall_stiffness = " + value + " }\n";
  };
  std::ofstream("amounts.toml") << with("\"0.1 Nm/deg\"");
  Scenario scene = read_scenario("amounts.toml");
  std::filesystem::remove("amounts.toml");
  CHECK(has_amounts(scene));
  const DesignInfo& design = design_named("lever");
  resolve_amounts(scene, design);
  CHECK(!has_amounts(scene));
  // In Nm/count, as `get` prints it.
  const double wanted = 0.1 * 180 / M_PI * design.count_rad;
  CHECK(scene.parameters.at("wall_stiffness") == Approx(wanted).epsilon(1e-12));
  CHECK(scene.events[0].set.at("wall_stiffness") == Approx(wanted).epsilon(1e-12));

  CHECK(told(with("\"0.1 Nm/deg\"")) == "");
  CHECK(told(with("\"0.001\"")) == "");
  expect(told(with("\"0.1 Nm\"")), "7: wall_stiffness: ", "give it in");
  expect(told(with("\"stiff\"")), "7: wall_stiffness: ", "give one");
  expect(told(with("\"90 Nm/deg\"")), "7: ", "wall_stiffness");
  expect(told(kHead + "[parameters]\nwall_stifness = \"1 Nm/rad\"\n"), "7: ", "wall_stiffness");
  expect(told(kHead + "[[event]]\nat_s = 0.01\nset = { wall_stiffness = \"1 kg\" }\n"),
         "7: wall_stiffness: ", "give it in");
  // A scene read without its amounts must not run.
  CHECK(told(with("\"0.1 Nm/deg\""), "", false).find("write numbers") != std::string::npos);
}

TEST_CASE("what is stiff beyond the step is refused before the run", "[bad_scene]") {
  expect(told(hand("kind = \"impedance\"\nmass_kg = 1e-6\n"
                   "motion = [{kind = \"hold\", duration_s = 1}]\n")),
         "8: the fastest mechanical pole, ", "raise mass_kg");
  const std::string cord = told(hand("kind = \"cord\"\ndamping_nm_s_rad = 1000\n"));
  expect(cord,
         "8: the fastest mechanical pole, 8.2e+06 1/s, times the plant's step of 5e-07 s is "
         "4.1 and must stay below 2.5; lower damping_nm_s_rad",
         "or set step_clocks = 15 (it is 25)");
  CHECK(told("step_clocks = 15\n" + hand("kind = \"cord\"\ndamping_nm_s_rad = 1000\n")) == "");
  const std::string light = told(kHead, "light");
  INFO(light);
  CHECK(light.find("p24.toml:18: the fastest pole of bristles and back-EMF") != std::string::npos);
  CHECK(light.find("raise inertia_kg_m2") != std::string::npos);
}

TEST_CASE("angles and speeds that nothing can show", "[bad_scene]") {
  expect(told(kHead + "[hand]\nstart_rad = 1e12\n"),
         "7: \"start_rad\" = 1000000000000 is out of range", "from -1000000 to 1000000");
  const auto ramp = [](const std::string& to) {
    return hand("kind = \"prescribed\"\nmotion = [{kind = \"ramp\", to_rad = " + to +
                ", duration_s = 0.005}]\n");
  };
  expect(told(ramp("1e9")), "9: \"to_rad\" = 1000000000 is out of range", "from -1000000");
  expect(told(ramp("1e6")), " after 0 s the lever turns at 2e+08 rad/s", "slow the motion");
  CHECK(told(ramp("1.0")) == "");
}

TEST_CASE("events that never come", "[bad_scene]") {
  const auto event = [](const std::string& at) {
    return kHead + "[[event]]\nat_s = " + at + "\narm = true\n";
  };
  expect(told(kHead + "[[event]]\nat_s = 0.01\nset = {}\n"), "7: the event does nothing",
         "give it set, scene, mode, arm, stop, encoder, open_phase or step_nm");
  for (const char* late : {"1e12", "1e300", "0.02", "0.03"}) {
    expect(told(event(late)), "7: the event at ", "move the event, or raise duration_s");
  }
  CHECK(told(event("0.019")) == "");
  // An arming time after the end of the scene means that it does not arm.
  CHECK(told(kHead + "arm_s = 1e300\n[[expect]]\nfigure = \"tau_ref_max_nm\"\nhigh = 0\n") == "");
  expect(told("duration_s = 1e300\n"), "1: ", "");
}

TEST_CASE("events that an armed core drops", "[bad_scene]") {
  const auto event = [](const std::string& at, const std::string& what) {
    return "[[event]]\nat_s = " + at + "\n" + what + "\n";
  };
  const std::string limit = "set = {current_limit = 1.0}", mode = "mode = \"open_loop\"";
  const std::string mend = "write arm = false into an event before this one";
  expect(told(kHead + event("0.01", limit)),
         "7: current_limit cannot change while the motor is armed", mend);
  expect(told(kHead + event("0.01", mode)), "7: mode cannot change while the motor is armed", mend);
  CHECK(told(kHead + event("0.01", "mode = \"closed_loop\"")) == "");
  CHECK(told(kHead + event("0.01", "set = {torque_limit = 0.2}")) == "");
  CHECK(told(kHead + "arm_s = 0.015\n" + event("0.01", limit)) == "");
  CHECK(told(kHead + event("0.009", "arm = false") + event("0.01", limit + "\n" + mode) +
             event("0.011", "arm = true")) == "");
}

TEST_CASE("what the host should feed and cannot", "[bad_scene]") {
  expect(told(kHead + "[tracker]\nmailbox = \"tracked\"\nrate_hz = 144\n"),
         "7: [tracker] needs a law with a mailbox", "name one: law = ");
  expect(told(kHead + "[feed]\nrate_hz = 144\n"), "7: [feed] needs a law with a mailbox",
         "or leave it out");
  const auto tracker = [](const std::string& key) {
    return told(kHead + "[tracker]\nmailbox = \"tracked\"\nrate_hz = 144\n" + key + "\n");
  };
  expect(tracker("alpha = 1.5"), "9: \"alpha\" = 1.5 is out of range", "from 0.001 to 1");
  expect(tracker("of = \"hand\""), "9: ", "encoder");
  expect(told(kHead + "[tracker]\nmailbox = \"tracked\"\n"), "6: ", "rate_hz");
  expect(told(kHead + "[drag]\nfrom_s = 0.03\n"), "7: \"from_s\" = 0.03 is out of range",
         "from 0 to 0.02");
}

TEST_CASE("bounds that nothing keeps", "[bad_scene]") {
  expect(told(kHead + "[[expect]]\nfigure = \"faults\"\nlow = 3\nhigh = 2\n"),
         "8: no value is above low and below high", "exchange them");
}

TEST_CASE("misspelt names are named, and the nearest one", "[bad_scene]") {
  expect(told("title = \"t\"\nabout = \"a\"\nduration_s = 0.02\n[core]\nscene = \"wal\"\n"),
         "5: scene \"wal\" is not built in design lever; did you mean \"wall\"?", "choose one of");
  expect(told(kHead + "[[event]]\nat_s = 0.01\nscene = \"dampr\"\n"),
         "7: scene \"dampr\" is not built in design lever; did you mean \"damper\"?", "free, ");
  expect(told(kHead + "[parameters]\ntorque_limt = 0.4\n"),
         "7: parameter \"torque_limt\" is unknown; did you mean \"torque_limit\"?",
         "`feltgate design lever` lists them");
  expect(told(kHead + "[[event]]\nat_s = 0.01\nset = {setpoint_torqe = 0.1}\n"),
         "7: parameter \"setpoint_torqe\" is unknown; did you mean \"setpoint_torque\"?", "lists");
  expect(told(kHead + "[[expect]]\nfigure = \"tau_ref_max\"\nhigh = 0\n"),
         "6: figure \"tau_ref_max\"", "did you mean \"tau_ref_max_nm\"?");
  expect(told(kHead + "[parameters]\ntorque_limit = 1e9\n"),
         "7: torque_limit = 1000000000 Nm does not fit its register",
         "choose a value from -16 to below 16");
  expect(told("dutation_s = 1\n" + kHead),
         "1: key \"dutation_s\" is unknown in the scene; did you "
         "mean \"duration_s\"?",
         "");
  expect(told("title = \"t\"\nabout = \"a\"\ndutation_s = 1\n[core]\nscene = \"free\"\n"),
         "1: key \"duration_s\" is missing in the scene", "rename \"dutation_s\" in line 3");
}

TEST_CASE("a scene of the lever at a tenth of its torques", "[scaled]") {
  const std::string root = FELTGATE_ROOT;
  const auto lever = design::elaborate(design::read_design(root + "/rtl/designs/lever.toml"),
                                       design::read_registers(root + "/rtl/registers.toml"));
  DesignInfo fine = design_named("lever");
  fine.name = "fine";
  fine.count_rad = 6.283185307179586 / 16384;  // a quarter of the lever's
  const auto near = [](double value) { return Approx(value).epsilon(1e-9); };

  Scenario wall = read_scenario(root + "/vectors/scenes/wall.toml");
  CHECK(own_design(wall) == "lever");
  scale_torques(wall, 0.1, lever, fine);
  CHECK(wall.parameters.size() == 3);  // of the scene that is rendered, and no other
  CHECK(wall.parameters.at("wall_contact") == near(0.5 / fine.count_rad));
  CHECK(wall.parameters.at("wall_stiffness") == near(0.4 * fine.count_rad));
  CHECK(wall.parameters.at("wall_damping") == near(0.0005));
  for (const Expectation& x : wall.expectations) {
    if (x.figure == "tau_ref_min_nm") CHECK(x.low == near(-0.0407));
    if (x.figure == "energy_absorbed_j") CHECK(x.low == near(0.00005));
  }

  Scenario step = read_scenario(root + "/vectors/scenes/torque_step.toml");
  step.amounts["attract_strength"] = "0.02 Nm rad^2";
  scale_torques(step, 0.1, lever, fine);
  CHECK_FALSE(has_amounts(step));
  CHECK(step.parameters.at("attract_strength") == near(0.002 / std::pow(fine.count_rad, 2)));
  CHECK(step.events[0].set.at("setpoint_torque") == near(0.01));
  CHECK(*step.events[0].step_nm == near(0.01));
  int of_lever = 0;
  for (const Expectation& x : step.expectations) {
    if (x.figure.rfind("torque_settling_ms", 0) != 0) continue;
    CHECK_FALSE(x.design.has_value());
    CHECK(x.high == 1.0);  // no torque
    ++of_lever;
  }
  CHECK(of_lever == 3);
  Scenario detent = read_scenario(root + "/vectors/scenes/detent.toml");
  CHECK(own_design(detent) == "lever_law");
  CHECK_THROWS_AS(scale_torques(detent, 0.1, lever, fine), std::invalid_argument);
  CHECK(own_design(read_scenario(root + "/vectors/scenes/knob_detents.toml")) == "gimbal_motor");
}
