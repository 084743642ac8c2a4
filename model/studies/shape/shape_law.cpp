// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Documentation: docs/devices/shapes.md
#include "studies/shape/shape_law.hpp"

#include <fmt/format.h>

#include <cmath>

#include "law/number_list.hpp"
#include "studies/shape/rhombus.hpp"

namespace feltgate::shape {

namespace {

using law::number_list;

template <class Of>
std::vector<double> each(std::size_t count, const Of& of) {
  std::vector<double> values;
  for (std::size_t i = 0; i < count; ++i) values.push_back(of(i));
  return values;
}

std::string pen() {
  return "\n# The pen of the rhombus, and its velocity.\n" + law_cranks() + R"(let x = L * (c1 + c5)
let y = L * (s1 + s5)
let vx = clamp(-L * (s1 * velocity[0] + s5 * velocity[1]), -0.5 m/s, 0.5 m/s)
let vy = clamp(L * (c1 * velocity[0] + c5 * velocity[1]), -0.5 m/s, 0.5 m/s)
)";
}

constexpr const char* depth = R"(
let dx = clamp(ax, -0.03 m, 0.03 m)
let dy = clamp(ay, -0.03 m, 0.03 m)
)";

std::string force() {
  std::string s =
      "\n# A spring from the pen to that place, as long as the pen is inside; its torques on the "
      "cranks.\n";
  for (const char* axis : {"x", "y"}) {
    s += fmt::format("let f{0} = if inside then -stiffness * d{0} - damping * v{0} else 0\n", axis);
  }
  return s + law_torques();
}

std::string head(const LawRequest& r) {
  return "# " + r.summary + "\n" +
         fmt::format(
             "param stiffness = {:.9g} N/m in 0 .. {:.9g} N/m\n"
             "param damping = {:.9g} N s/m in 0 .. {:.9g} N s/m\n",
             r.stiffness_n_per_m, most_stiffness_n_per_m, r.damping_ns_per_m,
             most_damping_ns_per_m);
}

/// Corners, the first one again at the end.
std::string corners(const Polygon& p, const char* form) {
  const std::size_t n = p.size();
  const auto at = [&](std::size_t i) { return p.at[i % n]; };
  return number_list(fmt::format(form, "shape_x"),
                     each(n + 1, [&](std::size_t i) { return at(i).x; }), "m") +
         number_list(fmt::format(form, "shape_y"),
                     each(n + 1, [&](std::size_t i) { return at(i).y; }), "m");
}

/// Longest step along an axis from corner to corner, with room for rounding.
double longest(const Polygon& p) {
  double most = 0;
  for (std::size_t i = 0; i < p.size(); ++i) most = std::max(most, p.edge_m(i));
  return most * 1.0001;
}

/// Distance along the outline from the first corner to each corner, as a share of the whole length.
std::string shares(const Polygon& p, const char* form) {
  std::vector<double> so_far{0};
  for (std::size_t i = 0; i < p.size(); ++i) so_far.push_back(so_far.back() + p.edge_m(i));
  const double around = so_far.back();
  for (double& s : so_far) s /= around;
  return number_list(fmt::format(form, "share"), so_far, "");
}

/// Ripples over the distance along the outline: their number is whole, so that they close.
constexpr const char* ripples = R"(
let height = ripple * sin(2 * pi * ripples * share(place))
let dx = clamp(ax - height * gy, -0.03 m, 0.03 m)
let dy = clamp(ay + height * gx, -0.03 m, 0.03 m)
)";

std::string proxy(const Polygon& p, bool texture) {
  const std::size_t n = p.size();
  const std::string form = fmt::format("table {{}}(q) on [0, {}] through", n);
  std::string s = "# Corners, and the outline's direction there.\n";
  s += corners(p, form.c_str());
  s += number_list(fmt::format(form, "along_x"),
                   each(n + 1, [&](auto i) { return p.along[i % n].x; }), "");
  s += number_list(fmt::format(form, "along_y"),
                   each(n + 1, [&](auto i) { return p.along[i % n].y; }), "");
  if (texture) s += shares(p, form.c_str());
  s += pen();
  return s +
         fmt::format(R"(
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
)",
                     n, static_cast<double>(n) - 0.5, n - 1, longest(p)) +
         (texture ? ripples : depth) + force();
}

/// All outlines in the same two tables, each with the vertex before its first and the two behind
/// its last; the direction is that from half an edge before to half an edge behind.
std::string resident(const std::vector<Polygon>& shapes) {
  const std::size_t n = shapes.front().size(), count = shapes.size();
  const std::size_t words = resident_words(static_cast<int>(n));
  std::vector<double> xs, ys;
  double most = 0;
  for (const Polygon& p : shapes) {
    most = std::max(most, longest(p));
    for (std::size_t i = 0; i < words; ++i) {
      xs.push_back(p.at[(i + n - 1) % n].x);
      ys.push_back(p.at[(i + n - 1) % n].y);
    }
  }
  const std::string form = fmt::format("table {{}}(q) on [0, {}] through", xs.size() - 1);
  std::string s = "# Corners of all shapes, one behind the other.\n";
  s += number_list(fmt::format(form, "shape_x"), xs, "m") +
       number_list(fmt::format(form, "shape_y"), ys, "m");
  return s + pen() +
         fmt::format(R"(
# Another shape than a run before: nothing is felt until its outline has been looked along.
state shown = 0 in 0 .. {4} whole
next shown = shape
let same = not (shown < shape or shown > shape)
let first = {5} * shape + 1

# The proxy walks along the outline to where the pen is square to it, half an edge a run at most.
state place = 0 in 0 .. {0}
let at = first + place
let ax = x - shape_x(at)
let ay = y - shape_y(at)
let gx = clamp(shape_x(at + 0.5) - shape_x(at - 0.5), -{3:.6g} m, {3:.6g} m)
let gy = clamp(shape_y(at + 0.5) - shape_y(at - 0.5), -{3:.6g} m, {3:.6g} m)
let reached = place + clamp((ax * gx + ay * gy) / {6:.6g} m^2, -0.5, 0.5)
let walked = if reached < 0 then reached + {0} else if reached < {0} then reached else reached - {0}
let behind = ax * gy - ay * gx < 0

# While the pen is outside, and once around at first, half an edge further every run, looks for a
# place that is nearer, by a thousandth so that it is another one.
state probe = 0 in 0 .. {1}
next probe = clamp(if same and probe < {2} then probe + 0.5 else 0, 0, {1})
state looked = 0 in 0 .. 1 whole
next looked = if same then (if probe >= {2} then 1 else looked) else 0
let inside = behind and looked > 0.5 and same
let qx = x - shape_x(first + probe)
let qy = y - shape_y(first + probe)
let nearer = qx * qx + qy * qy < 0.998 * (ax * ax + ay * ay)
next place = clamp(if nearer and not inside then probe else walked, 0, {0})
)",
                     n, static_cast<double>(n) - 0.5, n - 1, most, count - 1, words, most * most) +
         depth + force();
}

}  // namespace

std::string law_text(const std::vector<Polygon>& shapes, const LawRequest& r) {
  return head(r) + fmt::format("param shape = 0 in 0 .. {} whole\n\n", shapes.size() - 1) +
         resident(shapes);
}

std::string law_text(const Polygon& polygon, const LawRequest& r) {
  std::string s = head(r) + "\n";
  if (r.texture) {
    s += "param ripple = 0.2 mm in 0 .. 1 mm         # height of the texture\n"
         "param ripples = 80 in 0 .. 200 whole       # of them around the outline\n\n";
  }
  return s + proxy(polygon, r.texture);
}

}  // namespace feltgate::shape
