// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Margins of laws with states: against the wall's, a filter's closed form, and the core's bits.
#include <algorithm>
#include <cmath>
#include <fstream>

#include <fmt/format.h>
#include "catch.hpp"

#include "feltgate/largest.hpp"
#include "mismatch.hpp"
#include "rates_case.hpp"
#include "sim/law_loop/scene_law.hpp"
#include "sim/loop/loop.hpp"
#include "studies/rates/device_joints.hpp"
#include "studies/rates/margin.hpp"
#include "studies/rates/rates.hpp"
#include "wall_loop.hpp"

using namespace feltgate;
using namespace feltgate::rates;

namespace {

const std::string built = FELTGATE_BUILD_DIR;

design::Elaborated law_core() { return elaborated("lever_law"); }

/// A spring on the filtered angle; `more`: a statement that no torque shows.
LawSource filtered(const std::string& frequency, const std::string& more = "") {
  return {"filtered.law", "rate = 40 kHz\nparam stiffness = 0.1 Nm in 0.01 .. 2 Nm\n" + more +
                              "out torque = -stiffness * lowpass(position, " + frequency + ")\n"};
}

Place at(double stiffness_nm) { return {Eigen::Vector3d(0.01, 0, 0), {0.01}, {stiffness_nm}}; }

/// A law of one axis without states.
stability::LinearLaw stateless(double spring_nm_rad, double damping_nm_s_rad) {
  return {Eigen::MatrixXd(0, 0),
          Eigen::MatrixXd(0, 3),
          Eigen::MatrixXd(1, 0),
          Eigen::RowVector3d(-spring_nm_rad, -damping_nm_s_rad, 0),
          {},
          {}};
}
const Eigen::MatrixXd alone = Eigen::MatrixXd::Identity(1, 1);

/// The margins that `feltgate rates` gives for this law where a hand turns the lever to 0.3 rad.
Report measured(const std::string& law) {
  const std::string path = built + "/places_margin.toml";
  std::ofstream(path)
      << "title = \"places\"\nabout = \"-\"\nduration_s = 0.2\nplant = \"linear\"\n[core]\n"
         "scene = \"law\"\nlaw = \"x\"\narm_s = 0.01\n[effects]\nviscous = true\n"
         "[[hand.phase]]\nkind = \"prescribed\"\nmotion = [{ kind = \"hold\", duration_s = 0.02 "
         "}, { kind = \"minimum_jerk\", duration_s = 0.15, to_rad = 0.3 }]\n";
  Scenario scene = read_scenario(path);
  std::remove(path.c_str());
  const plant::Parameters p = plant_named("linear");
  resolve_effects(scene, p.effects);
  Options options;
  options.rates_hz = {};
  return measure(scene, {"x.law", law}, p, law_core(), options);
}

double margin_of(const std::string& law) {
  const Report r = measured(law);
  return r.rows.back().margin.of == Margin::Of::none ? -1 : r.rows.back().margin.ratio;
}

/// Growth of the swing of a lever that a hand lets go at 0.05 rad: last tenths over the first.
double swing_growth(const LawSource& source, double stiffness_nm) {
  const std::string path = built + "/states_margin.toml";
  std::ofstream(path)
      << "title = \"a filtered spring\"\nabout = \"-\"\nduration_s = 1.2\nplant = "
         "\"linear\"\n[core]\nscene = \"law\"\n"
         "law = \"filtered\"\narm_s = 0.13\n[parameters]\nstiffness = "
      << stiffness_nm
      << "\ndead_voltage = 0\ndead_voltage_slope = 0\n[effects]\nviscous = true\n[[hand.phase]]\n"
      << "kind = \"prescribed\"\nduration_s = 0.15\nmotion = [{ kind = "
         "\"minimum_jerk\", duration_s = 0.1, to_rad = 0.05 }]\n"
         "[[hand.phase]]\nkind = \"free\"\n";
  Scenario scene = read_scenario(path);
  std::remove(path.c_str());
  const plant::Parameters p = plant_named("linear");
  resolve_effects(scene, p.effects);
  const DesignInfo& design = design_named("lever_law");
  const auto law = make_scene_law(fastest(source, law::target_of(design)), design);
  double first = 0, last = 0;
  RunOptions options;
  options.design = "lever_law";
  options.engine = "twin";
  options.law = law.get();
  options.row_every = 100;
  options.row = [&](const Row& r) {
    if (r.time_s > 0.3 && r.time_s < 0.6) first = larger(first, std::fabs(r.theta_rad));
    if (r.time_s > 0.9) last = larger(last, std::fabs(r.theta_rad));
  };
  run_scenario(scene, p, options);
  return last / first;
}

}  // namespace

TEST_CASE("a law without states has the poles of a wall") {
  const stability::LoopModel m = stability::make_model(law_core(), lever());
  const stability::AxesLoopModel axes = stability::make_axes_model(law_core(), lever());
  const stability::LinearLaw law = stateless(4, 0.005);
  for (const auto& [ticks, delay] : {std::pair{1, 0}, {100, 2}, {1000, 3}}) {
    const auto wall = stability::poles(m, stability::Wall{4, 0.005, ticks, delay}).front();
    const auto own = stability::poles(axes, law, 1, 0, ticks, delay).front();
    CAPTURE(ticks);
    CHECK(std::abs(own - wall) < 1e-6 * std::abs(wall));
    CHECK(std::abs(stability::poles(axes, law, 2, 0, ticks, delay).front() - wall) >
          1e-3 * std::abs(wall));
  }
}

TEST_CASE("a law is linear at a place: by its filter, its formula and its signs") {
  const double share = 1 - std::exp(-2 * 3.14159265358979323846 * 30 / 40e3);
  const law::Law law = read(filtered("30 Hz"), 40e3);
  const auto linear = linearised(law, at(0.5), count_rad);
  REQUIRE(linear);
  REQUIRE(linear->a.rows() == 1);
  CHECK(linear->a(0, 0) == Approx(1 - share));
  CHECK(linear->b(0, 0) == Approx(share));
  CHECK(linear->c(0, 0) == Approx(-0.5 * (1 - share)));
  CHECK(linear->d(0, 0) == Approx(-0.5 * share));
  // At 5 Hz the filter passes all but 1.4 %.
  CHECK(stability::steepness(*linear, 1 / 40e3, alone).most_nm_rad == Approx(0.4931).epsilon(1e-3));
  // A damper of 0.002 Nms/rad has that times the angular frequency.
  CHECK(stability::steepness(stateless(0, 0.002), 1e-6, alone).most_nm_rad ==
        Approx(0.002 * 2 * 3.14159265 * 500));
  // What no torque shows, and what turns by itself, is not in the loop.
  const std::string beside =
      "phase angle = 0 in 0 .. 1\nnext angle = angle + 100 Hz * dt\n"
      "event turned(lowpass(velocity, 10 Hz)) when angle < 0.5\n";
  const law::Law more = read(filtered("30 Hz", beside), 40e3);
  Place place = at(0.5);
  place.states.assign(more.states.size(), 0.01);
  const auto of_more = linearised(more, place, count_rad);
  REQUIRE(of_more);
  CHECK(of_more->a.rows() == 1);
  // At a jump there is no slope.
  const LawSource jumps{"jumps.law",
                        "param stiffness = 0.1 Nm in 0.01 .. 2 Nm\nout torque = "
                        "if position < 0.01 then stiffness else 0 Nm\n"};
  CHECK_FALSE(linearised(read(jumps, 40e3), at(0.5), count_rad));
}

TEST_CASE("a filtered spring ends where the closed form says, and where the bits swing") {
  const LawSource source = filtered("30 Hz");
  const stability::LoopModel m = stability::make_model(law_core(), lever());
  const auto linear = linearised(read(source, 40e3), at(0.1), count_rad);
  REQUIRE(linear);
  const Margin found =
      margin(stability::make_axes_model(law_core(), lever()), *linear, 0.1, 25, 25);
  CHECK(found.of == Margin::Of::torque);
  // J t s^3 + (J + B t) s^2 + B s + k of a filter with the time t: Routh, for what is left of B.
  const double t = 1 / (2 * 3.14159265358979323846 * 30), j = m.inertia_kg_m2;
  const double b = m.motor_damping_nm_s_rad * (1 - m.compensated) + m.damping_nm_s_rad;
  CHECK(found.border == Approx(b * (j + b * t) / (j * t)).epsilon(0.05));
  // Within 5 % of the core's bits.
  CHECK(swing_growth(source, 0.95 * found.border) < 1);
  CHECK(swing_growth(source, 1.05 * found.border) > 1);
}

TEST_CASE("the margin of a law with states is that of its worst place, however it is written") {
  // A damper before 0.15 rad has the most torque per angle, a wall beyond 0.28 the least margin.
  const double two_places = margin_of(
      "rate = 40 kHz\nlet x = lowpass(position, 1.5 kHz)\nlet v = lowpass(velocity, 1.5 kHz)\n"
      "out torque = if position < 0.15 then -0.02 Nm s * v else if position < 0.28 then 0 Nm "
      "else -15 Nm * (x - 0.28)\n");
  const double wall =
      margin_of("rate = 40 kHz\nout torque = -15 Nm * (lowpass(position, 1.5 kHz) - 0.28)\n");
  CHECK(two_places == Approx(wall).epsilon(0.01));
  CHECK(wall < 1);
  // A filter by hand, of the same share, in a state of any range.
  const double share = 1 - std::exp(-2 * 3.14159265358979323846 * 64 / 40e3);
  const auto by_hand = [&](const std::string& end) {
    return margin_of(
        fmt::format("rate = 40 kHz\nstate y = 0 in -{0} .. {0}\n"
                    "let z = y + {1:.15g} * (position - y)\nnext y = clamp(z, -{0}, {0})\n"
                    "out torque = -1 Nm * z\n",
                    end, share));
  };
  const double filter = margin_of("rate = 40 kHz\nout torque = -1 Nm * lowpass(position, 64 Hz)\n");
  CHECK(filter < 1);
  CHECK(by_hand("1") == Approx(filter).epsilon(0.02));
  CHECK(by_hand("1000") == Approx(filter).epsilon(0.02));
  // Where no torque is stable there is no border: a spring that pushes away.
  CHECK(margin_of("rate = 40 kHz\nout torque = 1 Nm * lowpass(position, 64 Hz)\n") == -1);
  // Filters of any frequency that the law's own rate allows.
  CHECK(margin_of("rate = 40 kHz\nout torque = -1 Nm * lowpass(position, 4 kHz)\n") > 0);
}

namespace {

/// Largest stable spring, Nm/rad, of an ideal loop with this delay in the law's angle: a line reads
/// what was written `runs` ago.
LawSource late_spring(int runs) {
  return {"late.law",
          fmt::format("rate = 40 kHz\nparam stiffness = 0.1 Nm in 0.01 .. 20 Nm\nline past[{0}] in "
                      "-4 .. 4\nnext past = clamp(position, -4, 4)\n"
                      "out torque = -stiffness * past[{0}]\n",
                      runs)};
}

}  // namespace

TEST_CASE("a spring behind a delay line ends where its delay says, and where the bits swing") {
  const stability::AxesLoopModel m = stability::make_axes_model(law_core(), lever());
  const double b =
      m.axis.motor_damping_nm_s_rad * (1 - m.axis.compensated) + m.axis.damping_nm_s_rad;
  for (const int runs : {20, 200}) {
    const LawSource source = late_spring(runs);
    const auto linear =
        linearised(read(source, 40e3), Place{Eigen::Vector3d(0.01, 0, 0), {}, {0.1}}, count_rad);
    REQUIRE(linear);
    REQUIRE(linear->taps.size() == 1);
    const Margin found = margin(m, *linear, 0.1, 25, 25);
    // K sin(w t) = b w and K cos(w t) = J w^2, with the delays of hold, run, duty and winding. The
    // lag of the back-EMF's compensation, which this leaves out, helps where the swing is fast.
    const double t = (runs + 0.5 + 1) * 25e-6 + stability::actuator_delay_s(m.axis, 1);
    double w = 1;
    while (std::tan(w * t) < b / (m.axis.inertia_kg_m2 * w)) w *= 1.0001;
    CAPTURE(runs);
    CHECK(found.border == Approx(b * w / std::sin(w * t)).epsilon(runs > 100 ? 0.05 : 0.15));
    CHECK(swing_growth(source, 0.95 * found.border) < 1);
    CHECK(swing_growth(source, 1.05 * found.border) > 1);
  }
}

TEST_CASE("a delay line of two runs is two states") {
  const auto linear_of = [](const LawSource& source, const std::vector<double>& states) {
    const auto linear =
        linearised(read(source, 40e3), Place{Eigen::Vector3d(0.01, 0, 0), states, {0.1}}, 1e-3);
    REQUIRE(linear);
    return *linear;
  };
  const std::string head = "rate = 40 kHz\nparam stiffness = 0.1 Nm in 0.01 .. 20 Nm\n";
  const auto line = linear_of(late_spring(2), {});
  const auto states = linear_of(
      {"states.law", head + "state a = 0 in -4 .. 4\nnext a = clamp(position, -4, 4)\n"
                            "state b = 0 in -4 .. 4\nnext b = a\nout torque = -stiffness * b\n"},
      {0.01, 0.01});
  const stability::AxesLoopModel m = stability::make_axes_model(law_core(), lever());
  const double found = margin(m, line, 0.1, 25, 25).ratio;
  CHECK(found == Approx(margin(m, states, 0.1, 25, 25).ratio).epsilon(2e-3));
  CHECK(std::fabs(found / margin(m, linear_of(late_spring(3), {}), 0.1, 25, 25).ratio - 1) > 0.02);
  CHECK(stability::steepness(line, 25e-6, alone).most_nm_rad ==
        Approx(stability::steepness(states, 25e-6, alone).most_nm_rad));
}

TEST_CASE("a filtered floor of two axes ends where its own matrix does") {
  const AxesScene scene = scene_of("pantograph_wall_filtered");
  const auto& parameters = std::get<PantographSetup>(scene.device).parameters;
  test::WallLoop floor;
  const double viscous = floor.border_nm_s_rad(parameters);
  DeviceSetup device = scene.device;
  std::get<PantographSetup>(device).parameters.joint.viscous_nm_s_rad = viscous;
  plant::Effects on = scene.scenario.effects;
  on.lugre = false;
  on.inductance = on.back_emf = true;
  // The pen stands at (0, 0.1) m: cranks of 0.1 m at 30 and 150 degrees.
  const double first = std::asin(0.5);
  const Eigen::Vector2d at(first, 3.14159265358979323846 - first);
  const auto e = elaborated("pantograph_law");
  const auto model = stability::make_axes_model(e, joint_of(device, on), inertia_kg_m2(device, at));
  const law::Law law = read(shipped("pantograph_filtered"), 1e3);
  // before, speed, force of a pen at rest 10 mm deep in a floor of 50 N/m.
  Place place{Eigen::VectorXd::Zero(6), {0.1, 0, 0.5}, {0.11, 50, 0, 1}};
  place.inputs.head(2) = at;
  const auto linear = linearised(law, place, 1e-4);
  REQUIRE(linear);
  CHECK(margin(model, *linear, 1, 1000, 10).ratio == Approx(1).epsilon(0.03));
  // Without the filters of the law it is far from its border.
  place.parameters[3] = 0;
  const auto bare = linearised(law, place, 1e-4);
  REQUIRE(bare);
  CHECK(margin(model, *bare, 1, 1000, 10).ratio > 2);
}

// Margins of laws whose host samples the device, and of scenes at rest: against closed forms and
// the swing of the core's bits.

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
  const plant::Parameters p = plant_named("linear");
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
  const law::Law law = read(shipped("local_space"), 100e3);
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
  const law::Law law = read(shipped("sent_force"), 100e3);
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
