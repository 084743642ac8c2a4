// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Margins of several axes: where the axes can be told apart they are those of single levers, and a
// pen on a floor is the matrix that its own test derives.
#include <cmath>

#include <Eigen/LU>
#include "catch.hpp"

#include "levers_loop.hpp"
#include "rates_case.hpp"
#include "studies/rates/device_joints.hpp"
#include "studies/rates/margin.hpp"
#include "studies/rates/rates.hpp"
#include "wall_loop.hpp"

using namespace feltgate;
using namespace feltgate::rates;
using Matrix = Eigen::Matrix2d;

namespace {

Slope of(const Matrix& stiffness, const Matrix& damping) {
  Slope s;
  s.stiffness = stiffness;
  s.damping = damping;
  s.observed = Matrix::Zero();
  s.stiffness_nm_rad = stability::eigenvalues(stiffness).real().maxCoeff();
  s.damping_nm_s_rad = stability::eigenvalues(damping).real().maxCoeff();
  return s;
}
Slope single(double stiffness_nm_rad, double damping_nm_s_rad) {
  Slope s;
  s.stiffness_nm_rad = stiffness_nm_rad;
  s.damping_nm_s_rad = damping_nm_s_rad;
  return s;
}

const Matrix apart = (Matrix() << 1, -1, -1, 1).finished();
const Matrix pulled = (Matrix() << 0, 0, -1, 1).finished();  ///< the second lever alone

}  // namespace

TEST_CASE("axes that do not know of each other are levers") {
  const auto e = elaborated("lever");
  const plant::Parameters p = lever();
  const auto one = stability::make_model(e, p);
  const auto two = stability::make_axes_model(e, p, p.lever.inertia_kg_m2 * Matrix::Identity());
  for (const int ticks : {1000, 1}) {
    CAPTURE(ticks);
    const double border = margin(one, single(4, 0.005), ticks, 1).border;
    const Slope both = of(Matrix::Identity() * 4, Matrix::Identity() * 0.005);
    CHECK(margin(two, both, ticks, 1).border == Approx(border).epsilon(0.002));
    // The second one is half as stiff: the first ends it.
    const Slope less = of(Eigen::Vector2d(4, 2).asDiagonal(), Matrix::Identity() * 0.005);
    CHECK(margin(two, less, ticks, 1).border == Approx(border).epsilon(0.002));
    CHECK(margin(two, less, ticks, 1).ratio == Approx(border / 4).epsilon(0.002));
  }
  const Margin damped = margin(two, of(Matrix::Zero(), Matrix::Identity() * 0.03), 7000, 1);
  CHECK(damped.of == Margin::Of::damping);
  CHECK(damped.border == Approx(margin(one, single(0, 0.03), 7000, 1).border).epsilon(0.002));
}

TEST_CASE("coupled levers: their own matrix, and what bits show with the observer's torque") {
  plant::Parameters p = plant_named("p24");
  p.effects.lugre = false;
  p.effects.viscous = true;
  p.lever.viscous_nm_s_rad = 1e-5;  // next to none, and free levers come to rest
  const auto two = stability::make_axes_model(elaborated("two_levers_law"), p,
                                              p.lever.inertia_kg_m2 * Matrix::Identity());
  test::LeversLoop levers;
  const double border = margin(two, of(4 * apart, 0.005 * apart), 2, 2).ratio * 4;
  CHECK(border == Approx(levers.border_nm_rad(p)).epsilon(0.03));
  // docs/devices/pantograph.md: by bits between 5 and 6 Nm/rad.
  Slope observed = of(4 * pulled, 0.005 * pulled);
  observed.observed << 0, -1, 0, 1;
  const double with_observer = margin(two, observed, 2, 2).ratio * 4;
  CHECK(with_observer > 5);
  CHECK(with_observer < 6);
}

TEST_CASE("joints: behind a capstan, with the encoder at the motor, in two rings") {
  const AxesScene pantograph = scene_of("pantograph_floor");
  DeviceSetup device = pantograph.device;
  auto& p = std::get<PantographSetup>(device).parameters;
  plant::Effects on = pantograph.scenario.effects;
  on.lugre = true;
  const plant::Parameters joint = joint_of(device, on);
  CHECK(plant::smooth_damping_nm_s_rad(joint, joint.effects) ==
        Approx(p.joint.viscous_nm_s_rad + 9 * p.lugre.viscous_nm_s_rad));
  CHECK(joint.encoder.lines == p.encoder.lines);
  p.joint.encoder_on_motor = true;
  CHECK(joint_of(device, on).encoder.lines == 3 * p.encoder.lines);

  // The rings in a row: each axis turns what is inside it, and none another.
  const AxesScene gimbal = scene_of("gimbal");
  const auto& g = std::get<GimbalSetup>(gimbal.device).parameters;
  const Eigen::MatrixXd straight = inertia_kg_m2(gimbal.device, Eigen::Vector3d::Zero());
  CHECK(straight(2, 2) == Approx(g.bodies.handle.x + g.bodies.joint_inertia_kg_m2[2]));
  CHECK(straight(1, 1) ==
        Approx(g.bodies.handle.y + g.bodies.inner.y + g.bodies.joint_inertia_kg_m2[1]));
  CHECK(straight(0, 0) == Approx(g.bodies.handle.z + g.bodies.inner.z + g.bodies.outer.z +
                                 g.bodies.joint_inertia_kg_m2[0]));
  CHECK(straight.isDiagonal());
  // A middle joint that is turned lets the outer one turn the handle about its own axis.
  const Eigen::MatrixXd turned = inertia_kg_m2(gimbal.device, Eigen::Vector3d(0, 0.5, 0));
  CHECK(turned(0, 2) == Approx(-std::sin(0.5) * g.bodies.handle.x));
  CHECK(turned(2, 0) == Approx(turned(0, 2)));
}

TEST_CASE("an inertia without an inverse is refused") {
  CHECK_THROWS_WITH(stability::make_axes_model(elaborated("lever"), lever(), Matrix::Zero()),
                    Catch::Contains("no inverse"));
}

TEST_CASE("masses that couple two axes are two levers, one heavier and one lighter") {
  const auto e = elaborated("lever");
  plant::Parameters p = lever();
  const double j = p.lever.inertia_kg_m2, c = 0.6 * j;
  const auto two = stability::make_axes_model(e, p, (Matrix() << j, c, c, j).finished());
  const Slope both = of(Matrix::Identity() * 4, Matrix::Identity() * 0.005);
  const double found = margin(two, both, 1000, 1).border;
  double borders[2];
  for (int i = 0; i < 2; ++i) {
    p.lever.inertia_kg_m2 = i == 0 ? j - c : j + c;
    borders[i] = margin(stability::make_model(e, p), single(4, 0.005), 1000, 1).border;
  }
  CHECK(std::fabs(borders[0] - borders[1]) > 0.01 * borders[0]);
  CHECK(found == Approx(std::min(borders[0], borders[1])).epsilon(0.002));
}

TEST_CASE("a law that gives tau_hat back is an observer of another gain") {
  const auto e = elaborated("lever");
  const plant::Parameters p = lever();
  const auto two = stability::make_axes_model(e, p, p.lever.inertia_kg_m2 * Matrix::Identity());
  Slope s = of(4 * Matrix::Identity(), 0.005 * Matrix::Identity());
  s.observed = 0.5 * Matrix::Identity();
  const double found = margin(two, s, 1, 0).border;
  auto other = stability::make_model(e, p);
  other.observer_gain += 0.5 * other.torque_gain;
  CHECK(found == Approx(margin(other, single(4, 0.005), 1, 0).border).epsilon(0.002));
  CHECK(std::fabs(found - margin(stability::make_model(e, p), single(4, 0.005), 1, 0).border) >
        0.02 * found);
}

TEST_CASE("along a floor a pen with next to no friction is not shaken") {
  const AxesScene scene = scene_of("stylus_floor");
  const plant::Parameters slide = joint_of(scene.device, scene.scenario.effects);
  REQUIRE(slide.lever.viscous_nm_s_rad < 1e-6);
  const auto model = stability::make_axes_model(elaborated("stylus_law"), slide,
                                                slide.lever.inertia_kg_m2 * Matrix::Identity());
  const Slope slope = of(Eigen::Vector2d(0.02, 0).asDiagonal(), 1e-4 * Matrix::Identity());
  CHECK(margin(model, slope, 1000, 10).ratio > 1.5);
}

TEST_CASE("a pen on a floor of 1 kHz ends where its own matrix does") {
  const AxesScene scene = scene_of("pantograph_floor");
  const auto& parameters = std::get<PantographSetup>(scene.device).parameters;
  test::WallLoop floor;
  floor.filtered = false;
  const double viscous = floor.border_nm_s_rad(parameters);
  REQUIRE(viscous > 1e-4);
  DeviceSetup device = scene.device;
  std::get<PantographSetup>(device).parameters.joint.viscous_nm_s_rad = viscous;
  plant::Effects on = scene.scenario.effects;
  on.lugre = false;
  on.inductance = on.back_emf = true;
  const plant::Parameters joint = joint_of(device, on);
  CHECK(joint.motor.torque_constant_nm_a == Approx(3 * 0.0302));
  // The pen stands at (0, 0.1) m: cranks of 0.1 m at 30 and 150 degrees.
  const double first = std::asin(0.5);
  const Eigen::Vector2d at(first, 3.14159265358979323846 - first);
  const auto model =
      stability::make_axes_model(elaborated("pantograph_law"), joint, inertia_kg_m2(device, at));
  // y = (theta1 - theta5) / (2 g), g the turn of a crank per way of the pen.
  const double per = 1 / (2 * floor.turn_rad_m(parameters));
  const Eigen::Vector2d by(per, -per);
  const Slope slope = of(floor.stiffness_n_m * by * by.transpose(), Matrix::Zero());
  const Margin found = margin(model, slope, 1000, 10);
  CHECK(found.of == Margin::Of::stiffness);
  CHECK(found.ratio == Approx(1).epsilon(0.02));
  // Twice the friction carries about twice the floor.
  std::get<PantographSetup>(device).parameters.joint.viscous_nm_s_rad = 2 * viscous;
  const auto calmer = stability::make_axes_model(elaborated("pantograph_law"), joint_of(device, on),
                                                 inertia_kg_m2(device, at));
  CHECK(margin(calmer, slope, 1000, 10).ratio > 1.5);
}

// Two levers at several rates against closed forms.

namespace {

Report measured(const AxesScene& scene, const LawSource& law, const Options& options) {
  return measure(scene, law, elaborated(own_design(scene)), options);
}

}  // namespace

TEST_CASE("two levers turned apart: each axis lags by half a period in the mean") {
  constexpr double k = 50.0 / 131072 / count_rad, v = 3.3, tick_s = 1e-6;
  Options options;
  options.rates_hz = {490, 1e3, 10e3};
  const Report r = measured(axes_scene("testbench/studies/rates/turned_levers.toml"),
                            shipped("coupled_levers"), options);
  REQUIRE(r.axes == 2);
  REQUIRE(r.rows.size() == 4);  // three, the law's fastest
  // The levers part at v: from 0 to a period, and of each lever a count's angle evenly spread.
  const double count = k * count_rad, counts = count / std::sqrt(6);
  for (std::size_t i = 0; i < 3; ++i) {
    const RateRow& row = r.rows[i];
    const double mean = k * v * (row.ticks + 1) / 2 * tick_s;
    CAPTURE(row.rate_hz, row.mean_error_nm, mean);
    CHECK(std::fabs(row.mean_error_nm - mean) < 0.01 * mean + 2e-6);
    const double held = k * v * row.ticks * tick_s;
    const double rms = std::sqrt(held * held / 3 + counts * counts);
    REQUIRE(row.of_axes.size() == 2);
    for (const ErrorFigure& axis : row.of_axes) {
      CHECK(std::fabs(axis.rms() - rms) < 0.02 * rms);
      CHECK(axis.max() < 1.02 * (held + count));
      CHECK(axis.max() > 0.95 * (held + count));
      CHECK(axis.count() > 350000);
    }
    CHECK(row.error.count() == row.of_axes[0].count() + row.of_axes[1].count());
    CHECK(row.expected == 1);
  }
  // The scene's bound on the torque at its end is between the lags of 490 Hz and of 1 kHz.
  CHECK(r.rows[0].broken.size() == 1);
  CHECK(r.rows[1].broken.empty());
  // They feel twice of it against each other.
  CHECK(r.slope.stiffness_nm_rad == Approx(2 * k).epsilon(1e-6));
  CHECK(r.slope.damping_nm_s_rad == Approx(0).margin(1e-9));
  for (std::size_t i = 0; i < 4; ++i) {
    CHECK(r.rows[i].margin.of == Margin::Of::stiffness);
    CHECK(r.rows[i].margin.border == Approx(r.rows[i].margin.ratio * 2 * k));
    if (i > 0) CHECK(r.rows[i].margin.ratio > r.rows[i - 1].margin.ratio);
  }
  CHECK(r.floor.rms() == Approx(counts).epsilon(0.01));
  CHECK(r.rows[3].error.rms() == Approx(r.floor.rms()).epsilon(0.02));
}

TEST_CASE("what the host sends a device is in the continuous law") {
  // A plane that comes 1000 times a second: without it the law would be off by all of its force.
  AxesScene scene = scene_of("stylus_floor");
  scene.scenario.duration_s = 0.08;
  scene.scenario.expectations.clear();
  const Report r = measured(scene, shipped("local_space"), Options{{1e3}, false, {}});
  REQUIRE(r.axes == 3);
  CHECK(r.largest_nm > 1e-3);
  CHECK(r.rows.back().error.rms() < 0.1 * r.largest_nm);
}

TEST_CASE("what has no margin, or one of another kind, is told") {
  AxesScene scene = axes_scene("testbench/studies/rates/turned_levers.toml");
  scene.scenario.duration_s = 0.03;
  scene.scenario.expectations.clear();
  scene.scenario.parameters.clear();
  const auto notes = [&](const std::string& text) {
    const Report r = measured(scene, {"inline.law", text}, Options{{10e3}, false, {}});
    CHECK(r.slope.coupled == (text.find("position") != std::string::npos));
    std::string all;
    for (const std::string& note : r.notes) all += note + "\n";
    return all;
  };
  // Each lever is driven by the other's angle, and by none of its own.
  CHECK_THAT(notes("param k = 0.2 Nm/rad in 0 .. 1 Nm/rad\n"
                   "out torque[0] = clamp(k * position[1], -0.1 Nm, 0.1 Nm)\n"
                   "out torque[1] = clamp(-k * position[0], -0.1 Nm, 0.1 Nm)\n"),
             Catch::Contains("drive each other") && Catch::Contains("nowhere stiff or damped"));
  CHECK_THAT(notes("param b = 0.01 Nm s/rad in 0 .. 0.02 Nm s/rad\n"
                   "out torque[0] = clamp(-b * velocity[0], -0.1 Nm, 0.1 Nm)\n"
                   "out torque[1] = clamp(-b * velocity[1], -0.1 Nm, 0.1 Nm)\n"),
             Catch::Contains("that of the law's damping"));
}
