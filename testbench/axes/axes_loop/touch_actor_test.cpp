// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Meshes that move under a pen that is held, in closed loop, against closed forms. docs/touch.md
#include <algorithm>
#include <cmath>

#include "touch_meshes.hpp"

namespace feltgate::test {
namespace {

using plant::length;
using touch::Mesh;

TEST_CASE("touch: a mesh that comes to the pen is felt as one that the pen goes to") {
  // A plate rises with 20 mm/s under a pen that is held.
  const Mesh plate = touch::clean(box({0.02, 0.02, 0.002}));
  touch::TouchRequest request;
  request.host.stiffness_n_m = 300;
  request.stroke = {{0, {0.003, 0, 0.004}}, {0.2, {0.003, 0, 0.004}}};
  request.mesh_way = {{0, {0, 0, 0}, 0}, {0.2, {0, 0, 4e-3}, 3}};
  const touch::TouchRun rising = run_on(plate, "twin,double", request);
  CHECK(rising.result.broken.empty());
  int felt = 0;
  for (const touch::TouchRow& row : rising.rows) {
    const double deep_m = std::max(0.0, 0.02 * row.time_s + 0.002 - 0.004);
    if (row.time_s < 0.12) continue;
    ++felt;
    // A plane is up to 3.1 ms old, the pen is counted to 15 um.
    CHECK(row.force_n.z < 300 * (deep_m + 15e-6));
    CHECK(row.force_n.z > 300 * (deep_m - 0.02 * 3.1e-3 - 15e-6));
    CHECK(std::hypot(row.force_n.x, row.force_n.y) < 1e-3);
  }
  CHECK(felt > 70);
}

TEST_CASE("touch: a wall that turns about the vertical turns the force with it") {
  // The pen presses into the side y = -10 mm of a box, 1.5 mm deep; then the box turns by 0.3 rad.
  const Mesh wall = touch::clean(box({0.03, 0.01, 0.02}));
  touch::TouchRequest request;
  request.host.stiffness_n_m = 300;
  request.stroke = {{0, {0, -0.012, 0}}, {0.03, {0, -0.0085, 0}}, {0.2, {0, -0.0085, 0}}};
  request.mesh_way = {{0, {}, 0}, {0.05, {}, 0}, {0.15, {}, 0.3}, {0.2, {}, 0.3}};
  const touch::TouchRun run = run_on(wall, "twin,double", request);
  CHECK(run.result.broken.empty());
  int felt = 0;
  for (const touch::TouchRow& row : run.rows) {
    if (row.time_s < 0.04) continue;
    ++felt;
    const double turn_rad = std::clamp((row.time_s - 0.05) / 0.1, 0.0, 1.0) * 0.3;
    // 3 rad/s for 3.1 ms, and a count of 15 um along each axis of 1.5 mm.
    CHECK(std::abs(std::atan2(row.force_n.x, -row.force_n.y) - turn_rad) < 0.01 + 0.02);
    const double deep_m = 0.01 - 0.0085 * std::cos(turn_rad);
    CHECK(length(row.force_n) == Approx(300 * deep_m).margin(300 * 40e-6));
  }
  CHECK(felt > 150);
}

}  // namespace
}  // namespace feltgate::test
