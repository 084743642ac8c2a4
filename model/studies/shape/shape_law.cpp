// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Documentation: docs/devices/shapes.md
#include "studies/shape/shape_law.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "law/number_list.hpp"
#include "studies/shape/rhombus.hpp"

namespace feltgate::shape {

namespace {

std::string table(const char* name, const std::vector<double>& through, const char* unit) {
  return law::number_list(fmt::format("table {}(q) on [0, {}] through", name, through.size() - 1),
                          through, unit);
}

}  // namespace

std::string law_text(const Polygon& p, const LawRequest& r) {
  const std::size_t n = p.at.size();
  std::vector<double> x, y, along_x, along_y;
  double longest_m = 0;
  for (std::size_t i = 0; i <= n; ++i) {
    x.push_back(p.at[i % n].x);
    y.push_back(p.at[i % n].y);
    along_x.push_back(p.along[i % n].x);
    along_y.push_back(p.along[i % n].y);
    longest_m = std::max(longest_m, length(p.at[(i + 1) % n] - p.at[i % n]));
  }
  return fmt::format(
             "# {}\n"
             "param stiffness = {:.9g} N/m in 0 .. {:.9g} N/m\n"
             "param damping = {:.9g} N s/m in 0 .. {:.9g} N s/m\n\n"
             "# Corners, and the outline's direction there.\n",
             r.summary, r.stiffness_n_per_m, most_stiffness_n_per_m, r.damping_ns_per_m,
             most_damping_ns_per_m) +
         table("shape_x", x, "m") + table("shape_y", y, "m") + table("along_x", along_x, "") +
         table("along_y", along_y, "") +
         fmt::format(R"(
# The pen of the rhombus, and its velocity.
let L = {4:.9g} m
let s1 = sin(position[0])
let c1 = cos(position[0])
let s5 = sin(position[1])
let c5 = cos(position[1])
let x = L * (c1 + c5)
let y = L * (s1 + s5)
let vx = clamp(-L * (s1 * velocity[0] + s5 * velocity[1]), -0.5 m/s, 0.5 m/s)
let vy = clamp(L * (c1 * velocity[0] + c5 * velocity[1]), -0.5 m/s, 0.5 m/s)

# The proxy walks along the outline to where the pen is square to it, half an edge a run at most.
state place = 0 in 0 .. {0}
let ax = x - shape_x(place)
let ay = y - shape_y(place)
let gx = along_x(place)
let gy = along_y(place)
let reached = place + clamp((ax * gx + ay * gy) / {3:.6g} m, -0.5, 0.5)
let walked = if reached < 0 then reached + {0} else if reached < {0} then reached else reached - {0}
let behind = ax * gy - ay * gx < 0

# While the pen is outside, and once around at first, half an edge further every run, looks for a
# nearer place.
state probe = 0 in 0 .. {1}
next probe = clamp(if probe < {2} then probe + 0.5 else 0, 0, {1})
state looked = 0 in 0 .. 1 whole
next looked = if probe >= {2} then 1 else looked
let inside = behind and looked > 0.5
let qx = x - shape_x(probe)
let qy = y - shape_y(probe)
let nearer = qx * qx + qy * qy < ax * ax + ay * ay
next place = clamp(if nearer and not inside then probe else walked, 0, {0})

let dx = clamp(ax, -0.03 m, 0.03 m)
let dy = clamp(ay, -0.03 m, 0.03 m)

# A spring from the pen to that place, as long as the pen is inside; its torques on the cranks.
let fx = if inside then -stiffness * dx - damping * vx else 0
let fy = if inside then -stiffness * dy - damping * vy else 0
out torque[0] = L * (c1 * fy - s1 * fx)
out torque[1] = L * (c5 * fy - s5 * fx)
)",
                     n, static_cast<double>(n) - 0.5, n - 1, 1.0001 * longest_m, link_m);
}

}  // namespace feltgate::shape
