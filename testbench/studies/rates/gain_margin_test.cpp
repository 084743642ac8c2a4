// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Margins of laws whose host samples the device, and of scenes at rest: against closed forms and
// the swing of the core's bits. Documentation: docs/speed-for-accuracy.md
#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <fstream>

#include "mismatch.hpp"
#include "sim/plant/plant_file.hpp"
#include "studies/rates/device_joints.hpp"
#include "studies/rates/margin.hpp"
#include "studies/rates/rates.hpp"
#include "wall_loop.hpp"

using namespace feltgate;
using namespace feltgate::rates;

namespace {

const std::string root = FELTGATE_ROOT, built = FELTGATE_BUILD_DIR;

design::Elaborated elaborated(const std::string& name) {
  return design::elaborate(design::read_design(root + "/rtl/designs/" + name + ".toml"),
                           design::read_registers(root + "/rtl/registers.toml"));
}
AxesScene scene_of(const std::string& name) {
  return read_axes_scene(root + "/vectors/scenes/" + name + ".toml", [](const std::string& device) {
    return root + "/vectors/devices/" + device + ".toml";
  });
}

}  // namespace

TEST_CASE("a wall on a tracker ends where its samples and their age say, and where bits swing") {
  if (!test::case_tried(0, 3)) return;  // half a minute
  // Samples of 1.87 kHz that are 0.5 ms old, in a law of 8 kHz: half of each period and the age
  // late.
  const std::string path = built + "/tracker_margin.toml";
  std::ofstream(path)
      << "title = \"tracked\"\nabout = \"-\"\nduration_s = 0.06\nplant = \"linear\"\n[core]\n"
         "scene = \"law\"\nlaw = \"x\"\narm_s = 0.002\n[tracker]\nmailbox = \"seen\"\n"
         "rate_hz = 1870\nlatency_s = 0.0005\nnoise_rad = 0.001\n[[hand.phase]]\n"
         "kind = \"prescribed\"\nmotion = [{ kind = \"hold\", duration_s = 0.02 }, { kind = "
         "\"minimum_jerk\", duration_s = 0.03, to_rad = 0.05 }]\n";
  Scenario scene = read_scenario(path);
  std::remove(path.c_str());
  const plant::Parameters p = plant::read_plant_file(root + "/vectors/plants/linear.toml");
  resolve_effects(scene, p.effects);
  Options options;
  options.rates_hz = {};
  options.gains = options.bits = true;
  const Report r = measure(scene,
                           {"x.law",
                            "rate = 8 kHz\nmailbox seen = 0 rad in -4 .. 4 rad max_age 50 ms\n"
                            "out torque = -1 Nm * seen\n"},
                           p, elaborated("lever_law"), options);
  REQUIRE(r.gains.size() == 1);
  const GainMargin& g = r.gains.front();
  CAPTURE(g.why);
  plant::Parameters friction = p;
  friction.effects.viscous = true;
  const stability::LoopModel m = stability::make_model(elaborated("lever_law"), friction);
  // A wall of the host's own that is as late: by its hold alone, and the two ticks of that host.
  const double late_s = 0.5 / 1870 + 0.5e-3 + 33e-6 + 62.5e-6;
  const double wall = stability::border(m, 0, static_cast<int>(2e6 * late_s)).stiffness_nm_rad;
  CHECK(g.linear == Approx(wall).epsilon(0.03));
  CHECK(g.bits == Approx(g.linear).epsilon(0.05));
  CHECK(r.rows.back().margin.ratio == Approx(g.linear).epsilon(0.01));
}

namespace {

/// What the scene's host sends of a pose.
HostWords of_plane(const AxesScene& scene, const law::Law& law) {
  return [&](const Eigen::VectorXd&, const Eigen::VectorXd& sampled, law::Evaluation<double>& at) {
    for (const auto& [name, si] : plane_words(*scene.plane, pen_m(scene.device, sampled))) {
      for (std::size_t i = 0; i < law.parameters.size(); ++i) {
        if (law.parameters[i].name == name) at.set_parameter(i, si);
      }
    }
  };
}

}  // namespace

TEST_CASE("planes of a sphere: a pen slides off, and swings as on a floor") {
  AxesScene scene = scene_of("stylus_sphere");
  const auto e = elaborated("stylus_law");
  const law::Law law = read({root + "/rtl/laws/local_space.law", ""}, 100e3);
  const HostWords words = of_plane(scene, law);
  const auto& p = std::get<StylusSetup>(scene.device).parameters;
  const double per_m = 1 / p.lever.lever.radius_m;
  // 2 mm deep on top of a sphere of 30 mm.
  Place place{Eigen::VectorXd::Zero(9), {}, {}};
  place.inputs[2] = 0.028 * per_m;
  for (const law::Parameter& q : law.parameters) place.parameters.push_back(q.initial);
  plant::Effects on = scene.scenario.effects;
  on.lugre = false;
  const auto model = stability::make_axes_model(e, joint_of(scene.device, on),
                                                inertia_kg_m2(scene.device, place.inputs.head(3)));
  auto linear = linearised(law, place, 1e-4, words);
  REQUIRE(linear);
  linear->host = {1000, 1533, 1};
  const Margin found = margin(model, *linear, 1, 10, 10);
  // The force of 0.6 N turns with the pen, by 1/28 mm, and is late; friction is the joint's and, as
  // the compensation of the back-EMF is late too, a part of the motor's.
  const double k = 300 * 0.002 / 0.028, m = p.lever.lever.inertia_kg_m2 * per_m * per_m;
  const double late_s = 0.5e-3 + 1.533e-3 + 15e-6 + stability::actuator_delay_s(model.axis, 1);
  const double motor = model.axis.motor_damping_nm_s_rad * per_m * per_m;
  const double own = model.axis.damping_nm_s_rad * per_m * per_m;
  double slides = 1;
  const auto left_n_m = [&](double s) {
    const double taken = model.axis.compensated * std::exp(-s * model.axis.velocity_delay_s);
    return k * std::exp(-s * late_s) - (own + motor * (1 - taken)) * s - m * s * s;
  };
  while (left_n_m(slides) > 0) slides *= 1.001;
  CHECK(found.slides_1_s == Approx(slides).epsilon(0.02));
  // A floor through the same point: nothing of it turns.
  linear->b.rightCols(6).setZero();
  linear->d.rightCols(6).setZero();
  const Margin floor = margin(model, *linear, 1, 10, 10);
  CHECK(found.ratio == Approx(floor.ratio).epsilon(0.02));
  CHECK(floor.slides_1_s < 0.01);
}

TEST_CASE("a floor whose forces a host sends ends where the host's period and age say") {
  AxesScene scene = scene_of("plane_floor");
  scene.plane->sends_force = true;
  const auto e = elaborated("pantograph_law");
  const law::Law law = read({root + "/rtl/laws/sent_force.law", ""}, 100e3);
  const HostWords words = of_plane(scene, law);
  // The pen stands at (0, 0.1) m, 10 mm deep: cranks of 0.1 m at 30 and 150 degrees.
  const double first = std::asin(0.5);
  Place place{Eigen::VectorXd::Zero(6), {}, {}};
  place.inputs.head(2) << first, 3.14159265358979323846 - first;
  for (const law::Parameter& p : law.parameters) place.parameters.push_back(p.initial);
  plant::Effects on = scene.scenario.effects;
  on.lugre = false;
  const auto model = stability::make_axes_model(e, joint_of(scene.device, on),
                                                inertia_kg_m2(scene.device, place.inputs.head(2)));
  const auto border_n_m = [&](double latency_ticks) {
    auto linear = linearised(law, place, 1e-4, words);
    REQUIRE(linear);
    linear->host = {1000, latency_ticks + 33, 1};
    return scene.plane->stiffness_n_m * margin(model, *linear, 1, 10, 10).ratio;
  };
  // K times what the force is late is taken off the pen's friction; the lag of the back-EMF's
  // compensation, which this leaves out, helps where the swing is fast.
  test::WallLoop floor;
  const double turn = floor.turn_rad_m(std::get<PantographSetup>(scene.device).parameters);
  const double b = 2 * model.axis.damping_nm_s_rad * turn * turn;
  const double late_s = 0.5e-3 + 33e-6 + 15e-6 + stability::actuator_delay_s(model.axis, 1);
  CHECK(border_n_m(1500) == Approx(b / (late_s + 1.5e-3)).epsilon(0.08));
  CHECK(border_n_m(0) == Approx(b / late_s).epsilon(0.25));
  CHECK(border_n_m(50) < 0.99 * border_n_m(0));
}
