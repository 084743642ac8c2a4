// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Where a floor of 30 and 50 N/m at 1 kHz stops being quiet, with filters of speed and force and
// without: the bits of the twin beside the eigenvalues of the loop. docs/devices/pantograph.md
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "axes_fixture.hpp"
#include "catch.hpp"
#include "wall_loop.hpp"

using namespace feltgate;
using namespace feltgate::test;

namespace {

constexpr double kDisturbed_s = 0.4, kEnd_s = 1.4, kPressed_n = 0.6, kFloor_m = 0.11;

struct Case {
  double stiffness_n_m, damping_ns_m;
  bool filtered;
};
const std::vector<Case> kCases{{30, 0, false}, {30, 0.03, false}, {30, 0, true}, {30, 0.03, true},
                               {50, 0, false}, {50, 0.03, false}, {50, 0, true}, {50, 0.03, true}};

WallLoop loop_of(const Case& c) {
  WallLoop loop;
  loop.stiffness_n_m = c.stiffness_n_m;
  loop.damping_ns_m = c.damping_ns_m;
  loop.filtered = c.filtered;
  loop.height_m = kFloor_m - kPressed_n / c.stiffness_n_m;
  return loop;
}

/// Growth of the pen's swing after the force has changed, 1/s: half that of its energy.
double growth_of_bits_1_s(const Case& c, double joint_viscous_nm_s_rad) {
  AxesScene scene = scene_named("pantograph_wall");
  auto& setup = std::get<PantographSetup>(scene.device);
  setup.parameters.joint.viscous_nm_s_rad = joint_viscous_nm_s_rad;
  scene.scenario.parameters["stiffness"] = c.stiffness_n_m;
  scene.scenario.parameters["damping"] = c.damping_ns_m;
  scene.scenario.parameters["filtered"] = c.filtered ? 1 : 0;
  scene.scenario.expectations.clear();
  const double mass_kg = loop_of(c).mass_kg(setup.parameters);
  const double rest_m = kFloor_m - kPressed_n / c.stiffness_n_m;
  double before_m = 0, before_s = -1;
  // Energy over the logarithm's straight line, by least squares.
  double n = 0, sum_t = 0, sum_e = 0, sum_tt = 0, sum_te = 0;
  const std::vector<std::string> columns = axes_columns(scene);
  const auto pen = static_cast<std::size_t>(std::find(columns.begin(), columns.end(), "pen_y_m") -
                                            columns.begin());
  const auto row = [&](const std::vector<double>& values) {
    const double at_s = values[0], y_m = values[pen];
    if (before_s >= 0 && at_s > kDisturbed_s + 0.01) {
      const double v = (y_m - before_m) / (at_s - before_s), x = 0.5 * (y_m + before_m) - rest_m;
      const double e = std::log(0.5 * mass_kg * v * v + 0.5 * c.stiffness_n_m * x * x);
      n += 1, sum_t += at_s, sum_e += e, sum_tt += at_s * at_s, sum_te += at_s * e;
    }
    before_m = y_m, before_s = at_s;
  };
  (void)run_scene(scene, "twin", row, 1000);
  return 0.5 * (n * sum_te - sum_t * sum_e) / (n * sum_tt - sum_t * sum_t);
}

}  // namespace

TEST_CASE("pantograph wall: a floor at 1 kHz grows or dies as its eigenvalues say") {
  const plant::PantographParameters p =
      std::get<PantographSetup>(scene_named("pantograph_wall").device).parameters;
  for (const Case& c : kCases) {
    INFO(c.stiffness_n_m << " N/m, " << c.damping_ns_m << " Ns/m, filtered " << c.filtered);
    const double of_loop = loop_of(c).growth_1_s(p, p.joint.viscous_nm_s_rad);
    const double of_bits = growth_of_bits_1_s(c, p.joint.viscous_nm_s_rad);
    INFO("eigenvalues " << of_loop << " 1/s, bits " << of_bits << " 1/s");
    // The bits have counts, dead time and a voltage law that the linear loop has not.
    CHECK(of_bits == Approx(of_loop).margin(0.4));
    // On this device the filters decide.
    CHECK((of_loop < 0) == !c.filtered);
    CHECK((of_bits < 0) == !c.filtered);
  }
}

TEST_CASE("pantograph wall: the border of 50 N/m behind the filters is at K (T/2 + delay)") {
  const plant::PantographParameters p =
      std::get<PantographSetup>(scene_named("pantograph_wall").device).parameters;
  const Case c{50, 0, true};
  const WallLoop loop = loop_of(c);
  const double border = loop.border_nm_s_rad(p), turn = loop.turn_rad_m(p);
  // Half a run and 0.7/0.3 runs of the force's filter.
  CHECK(2 * turn * turn * border == Approx(50 * (0.5e-3 + 0.7e-3 / 0.3)).epsilon(0.04));
  CHECK(growth_of_bits_1_s(c, 0.6 * border) > 0.1);
  CHECK(growth_of_bits_1_s(c, 1.5 * border) < -0.1);
}

TEST_CASE("pantograph wall: the table of the page", "[.table]") {
  const plant::PantographParameters p =
      std::get<PantographSetup>(scene_named("pantograph_wall").device).parameters;
  std::printf("| stiffness | damping | filters | eigenvalues | bits | border at the pen |\n");
  std::printf("|---|---|---|---|---|---|\n");
  for (const Case& c : kCases) {
    const WallLoop loop = loop_of(c);
    const double turn = loop.turn_rad_m(p), border = loop.border_nm_s_rad(p);
    std::printf("| %.0f N/m | %.2f Ns/m | %s | %+.2f 1/s | %+.2f 1/s | %.3f Ns/m |\n",
                c.stiffness_n_m, c.damping_ns_m, c.filtered ? "yes" : "no",
                loop.growth_1_s(p, p.joint.viscous_nm_s_rad),
                growth_of_bits_1_s(c, p.joint.viscous_nm_s_rad), 2 * turn * turn * border);
  }
}
