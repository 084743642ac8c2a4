// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Documentation: docs/devices/shapes.md
#include "studies/texture/texture_law.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "law/number_list.hpp"
#include "studies/shape/rhombus.hpp"

namespace feltgate::texture {

namespace {

/// Rates that leave a run enough time, with a reserve.
constexpr int row_khz = 100, field_khz = 50;

[[noreturn]] void refuse(const std::string& said) { throw std::invalid_argument(said); }

/// Of a line of n places: the largest difference between neighbours, or half that of neighbours but
/// one, as the law takes it.
template <class At>
double steepest_along(int n, const At& at, Normals normals) {
  double most = 0;
  for (int i = 0; i < n; ++i) {
    const double before = at(std::max(i - 1, 0)), here = at(i), after = at(std::min(i + 1, n - 1));
    most = std::max(
        most, normals == Normals::facets ? std::fabs(after - here) : std::fabs(after - before) / 2);
  }
  return most;
}

/// Throws for a texture that is too steep or flat everywhere.
void check(const LawRequest& r, double steep, bool alike) {
  if (alike) refuse("all pixels are alike, nothing would be felt; take another row or image");
  const double most = deepest_m(steep, r.texel_m);
  if (r.depth_m > most) {
    refuse(fmt::format(
        "{:.4g} mm of depth on texels of {:.4g} mm are too steep; say --depth {:.3g}mm at most",
        1e3 * r.depth_m, 1e3 * r.texel_m, std::floor(1e5 * most) / 1e2));
  }
}

bool alike(const std::vector<double>& shares) {
  return std::all_of(shares.begin(), shares.end(), [&](double s) { return s == shares.front(); });
}

std::string head(const LawRequest& r, int rate_khz) {
  return fmt::format("# {}\nrate = {} kHz\n", r.summary, rate_khz) +
         fmt::format(
             "param stiffness = {:.9g} N/m in 0 .. {:.9g} N/m\n"
             "param damping = {:.9g} N s/m in 0 .. {:.9g} N s/m   # upright, at most the spring\n"
             "param depth = {:.9g} mm in 0 .. {:.9g} mm           # of white over black\n",
             r.stiffness_n_per_m, most_stiffness_n_per_m, r.damping_ns_per_m, most_damping_ns_per_m,
             1e3 * r.depth_m, 1e3 * r.depth_m);
}

/// Whole places below a place, for facets.
std::string places(int n) {
  std::vector<double> whole;
  for (int i = 0; i + 1 < n; ++i) whole.push_back(i);
  return law::number_list("array place =", whole, "");
}

/// The pen at `pen_y` below `top`, and its force along the normal and upright.
std::string split(const std::string& height_of_pen) {
  return fmt::format(R"(
# How deep the pen is: in the texture, felt along its normal, and below, felt upright.
let deep = clamp(surface + top - {}, 0, {:.9g} mm)
let within = min(deep, top)
let below = deep - within
)",
                     height_of_pen, 1e3 * most_pen_m);
}

std::string row_pen() {
  return "\n# The pen of the pantograph.\n" + shape::law_cranks() +
         R"(let vy = clamp(L * (c1 * velocity[0] + c5 * velocity[1]), -2 m/s, 2 m/s)
)";
}

std::string row_force() {
  return R"(
# The normal is (-slope, 1) of length 1.
table upright(t) on [0, 2] = 1 / sqrt(1 + t * t) with 64 segments
let nz = upright(abs(slope))
let spring = stiffness * (within * nz + below)
let fy = clamp(spring - damping * vy, 0, 2 * spring)
let fx = -stiffness * within * slope * nz
)" + shape::law_torques();
}

constexpr const char* field_force = R"(
# The normal is (-slope_x, -slope_y, 1) of length 1.
table upright(t) on [0, 8] = 1 / sqrt(1 + t) with 128 segments
let nz = upright(clamp(slope_x * slope_x + slope_y * slope_y, 0, 8))
let spring = stiffness * (within * nz + below)
out torque[0] = -R * stiffness * within * slope_x * nz
out torque[1] = -R * stiffness * within * slope_y * nz
out torque[2] = R * clamp(spring - damping * R * velocity[2], 0, 2 * spring)
)";

/// h00 is at the place (i, j); triangles lie to both sides of the line from (i + 1, j) to (i, j +
/// 1).
constexpr const char* field_facets = R"(
let i = place_x[u]
let j = place_y[v]
let a = u - i
let b = v - j
let h00 = height({0} * j + i)
let h10 = height({0} * j + i + 1)
let h01 = height({0} * j + i + {0})
let h11 = height({0} * j + i + {0} + 1)
let near = a + b < 1
let side_x = if near then h10 - h00 else h11 - h01
let side_y = if near then h01 - h00 else h11 - h10
let share = if near then h00 + a * side_x + b * side_y
  else h11 - (1 - a) * side_x - (1 - b) * side_y
let rise_x = if reach_u > 0 and reach_u < {1} then side_x else 0
let rise_y = if reach_v > 0 and reach_v < {2} then side_y else 0
)";

/// Share at (u, v): a line between two rows. Each name once for each place.
std::string between_rows(const std::string& name, const std::string& u, const std::string& v,
                         int width) {
  return fmt::format(
      "let {0}_j = place_y[{2}]\n"
      "let {0}_here = height({3} * {0}_j + {1})\n"
      "let {0}_next = height({3} * {0}_j + {3} + {1})\n"
      "let {0} = {0}_here + ({2} - {0}_j) * ({0}_next - {0}_here)\n",
      name, u, v, width);
}

}  // namespace

std::vector<double> row_of(const Image& image, int row) {
  std::vector<double> shares;
  for (int i = 0; i < image.width; ++i) shares.push_back(image.at(i, row));
  return shares;
}

double steepest(const std::vector<double>& row, Normals normals) {
  return steepest_along(
      static_cast<int>(row.size()), [&](int i) { return row[static_cast<std::size_t>(i)]; },
      normals);
}

double steepest(const Image& field, Normals normals) {
  double most = 0;
  for (int row = 0; row < field.height; ++row) {
    most = std::max(most, steepest_along(
                              field.width, [&](int i) { return field.at(i, row); }, normals));
  }
  for (int column = 0; column < field.width; ++column) {
    most = std::max(most, steepest_along(
                              field.height, [&](int i) { return field.at(column, i); }, normals));
  }
  return most;
}

double deepest_m(double steep, double texel_m) {
  const double least = most_slope * texel_m / most_depth_m;
  return steep > least ? most_slope * texel_m / steep : most_depth_m;
}

std::string row_law(const std::vector<double>& row, const LawRequest& r) {
  const int n = static_cast<int>(row.size());
  const bool facets = r.normals == Normals::facets;
  if (n > (facets ? most_facets : most_row)) {
    refuse(fmt::format("{} pixels in a row; a law holds {}, scale the image down or crop it", n,
                       facets ? most_facets : most_row));
  }
  check(r, steepest(row, r.normals), alike(row));
  std::string s = head(r, row_khz) +
                  fmt::format(
                      "param surface = {:.9g} mm in -200 .. 200 mm   # height of black\n"
                      "param middle = 0 mm in -100 .. 100 mm     # of the row\n"
                      "let texel = {:.9g} mm\n\n# Heights of the pixels, shares of the depth.\n",
                      1e3 * r.surface_m, 1e3 * r.texel_m);
  s += law::number_list(fmt::format("table height(q) on [0, {}] through", n - 1), row, "");
  if (facets) s += places(n);
  s += row_pen();
  s += fmt::format("\nlet q = clamp((L * (c1 + c5) - middle) / texel + {:.9g}, -1, {})\n",
                   (n - 1) / 2.0, n);
  s += "let top = depth * height(q)\n";
  if (facets) {
    s += fmt::format(
        "let inside = q > 0 and q < {}\n"
        "let i = place[q]\n"
        "let rise = if inside then height(i + 1) - height(i) else 0\n",
        n - 1);
  } else {
    s += "let rise = 0.5 * (height(q + 1) - height(q - 1))\n";
  }
  s += "let slope = clamp(depth / texel * rise, -2, 2)\n";
  return s + split("L * (s1 + s5)") + row_force();
}

std::string field_law(const Image& f, const LawRequest& r) {
  if (f.width > most_field || f.height > most_field || f.height < 2) {
    refuse(fmt::format("{} x {} pixels; a field has 2 to {} along each side, scale the image",
                       f.width, f.height, most_field));
  }
  check(r, steepest(f, r.normals), alike(f.share));
  std::string s = head(r, field_khz) +
                  fmt::format(
                      "param surface = {:.9g} mm in -50 .. 50 mm     # height of black\n"
                      "let texel = {:.9g} mm\n"
                      "let R = {:.9g} mm                             # of the capstans\n\n"
                      "# Heights of the pixels, shares of the depth, a row behind the other.\n",
                      1e3 * r.surface_m, 1e3 * r.texel_m, 1e3 * capstan_m);
  s += law::number_list(fmt::format("table height(q) on [0, {}] through", f.width * f.height - 1),
                        f.share, "");
  std::vector<double> along_x, along_y;
  for (int i = 0; i + 1 < f.width; ++i) along_x.push_back(i);
  for (int j = 0; j + 1 < f.height; ++j) along_y.push_back(j);
  const bool facets = r.normals == Normals::facets;
  if (facets) s += law::number_list("array place_x =", along_x, "");
  s += law::number_list("array place_y =", along_y, "");
  s += fmt::format(
      "\n# The pen, in pixels; the field lies around 0, and beyond it, it goes on level.\n"
      "let reach_u = clamp(R * position[0] / texel + {0:.9g}, -1, {1})\n"
      "let reach_v = clamp(R * position[1] / texel + {2:.9g}, -1, {3})\n"
      "let u = clamp(reach_u, 0, {4})\n"
      "let v = clamp(reach_v, 0, {5})\n",
      (f.width - 1) / 2.0, f.width, (f.height - 1) / 2.0, f.height, f.width - 1, f.height - 1);
  if (facets) {
    s += fmt::format(field_facets, f.width, f.width - 1, f.height - 1);
  } else {
    s += between_rows("share", "u", "v", f.width);
    s += "# Slopes: those at the four pixels, interpolated.\n";
    s += fmt::format(
        "let right = clamp(reach_u + 1, 0, {0})\nlet left = clamp(reach_u - 1, 0, {0})\n",
        f.width - 1);
    s += fmt::format(
        "let behind = clamp(reach_v + 1, 0, {0})\nlet before = clamp(reach_v - 1, 0, {0})\n",
        f.height - 1);
    s += between_rows("at_right", "right", "v", f.width);
    s += between_rows("at_left", "left", "v", f.width);
    s += between_rows("at_behind", "u", "behind", f.width);
    s += between_rows("at_before", "u", "before", f.width);
    s += "let rise_x = 0.5 * (at_right - at_left)\nlet rise_y = 0.5 * (at_behind - at_before)\n";
  }
  s += "let slope_x = clamp(depth / texel * rise_x, -2, 2)\n"
       "let slope_y = clamp(depth / texel * rise_y, -2, 2)\n"
       "let top = depth * share\n";
  return s + split("R * position[2]") + field_force;
}

}  // namespace feltgate::texture
