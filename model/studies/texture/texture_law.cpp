// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Documentation: docs/devices/shapes.md
#include "studies/texture/texture_law.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

#include "law/number_list.hpp"

namespace feltgate::texture {

namespace {

/// Leaves a run enough time, with a reserve.
constexpr int rate_khz = 50;

[[noreturn]] void refuse(const std::string& said) { throw std::invalid_argument(said); }

/// In depths per texel: the largest difference between neighbours, or half that of neighbours but
/// one, as the law takes it.
double steepest(const Image& f, Normals normals) {
  double most = 0;
  const auto at = [&](int i, int j) {
    return f.at(std::clamp(i, 0, f.width - 1), std::clamp(j, 0, f.height - 1));
  };
  const bool facets = normals == Normals::facets;
  for (int j = 0; j < f.height; ++j) {
    for (int i = 0; i < f.width; ++i) {
      const double x = at(i + 1, j) - at(facets ? i : i - 1, j);
      const double y = at(i, j + 1) - at(i, facets ? j : j - 1);
      most = std::max({most, std::fabs(x), std::fabs(y)});
    }
  }
  return facets ? most : most / 2;
}

/// The whole places of n from which another follows.
std::string places(const char* name, int n) {
  std::vector<double> whole(static_cast<std::size_t>(n) - 1);
  std::iota(whole.begin(), whole.end(), 0);
  return law::number_list(fmt::format("array {} =", name), whole, "");
}

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

std::string interpolated(int width, int height) {
  return between_rows("share", "u", "v", width) +
         fmt::format(R"(# Slopes: those at the four pixels, interpolated.
let right = clamp(reach_u + 1, 0, {0})
let left = clamp(reach_u - 1, 0, {0})
let behind = clamp(reach_v + 1, 0, {1})
let before = clamp(reach_v - 1, 0, {1})
)",
                     width - 1, height - 1) +
         between_rows("at_right", "right", "v", width) +
         between_rows("at_left", "left", "v", width) +
         between_rows("at_behind", "u", "behind", width) +
         between_rows("at_before", "u", "before", width) +
         "let rise_x = 0.5 * (at_right - at_left)\nlet rise_y = 0.5 * (at_behind - at_before)\n";
}

}  // namespace

std::string field_law(const Image& f, const LawRequest& r) {
  const int w = f.width, h = f.height;
  if (w > most_field || h > most_field || h < 2) {
    refuse(fmt::format("{} x {} pixels; a field has 2 to {} along each side, scale the image", w, h,
                       most_field));
  }
  const double steep = steepest(f, r.normals);
  if (steep == 0) refuse("all pixels are alike, nothing would be felt; take another image");
  if (r.depth_m * steep > most_slope * r.texel_m) {
    refuse(fmt::format(
        "{:.4g} mm of depth on texels of {:.4g} mm are too steep; say --depth {:.3g}mm at most",
        1e3 * r.depth_m, 1e3 * r.texel_m, std::floor(1e5 * most_slope * r.texel_m / steep) / 1e2));
  }
  const bool facets = r.normals == Normals::facets;
  return fmt::format(
             "# {}\nrate = {} kHz\n"
             "param stiffness = {:.9g} N/m in 0 .. {:.9g} N/m\n"
             "param damping = {:.9g} N s/m in 0 .. {:.9g} N s/m   # upright, at most the spring\n"
             "param depth = {:.9g} mm in 0 .. {:.9g} mm           # of white over black\n"
             "param surface = 0 mm in -50 .. 50 mm     # height of black\n"
             "let texel = {:.9g} mm\n"
             "let R = {:.9g} mm                             # of the capstans\n\n"
             "# Heights of the pixels, shares of the depth, a row behind the other.\n",
             r.summary, rate_khz, r.stiffness_n_per_m, most_stiffness_n_per_m, r.damping_ns_per_m,
             most_damping_ns_per_m, 1e3 * r.depth_m, 1e3 * r.depth_m, 1e3 * r.texel_m,
             1e3 * capstan_m) +
         law::number_list(fmt::format("table height(q) on [0, {}] through", w * h - 1), f.share,
                          "") +
         (facets ? places("place_x", w) : "") + places("place_y", h) +
         fmt::format(R"(
# The pen, in pixels; the field lies around 0, and beyond it, it goes on level.
let reach_u = clamp(R * position[0] / texel + {0:.9g}, -1, {1})
let reach_v = clamp(R * position[1] / texel + {2:.9g}, -1, {3})
let u = clamp(reach_u, 0, {4})
let v = clamp(reach_v, 0, {5})
)",
                     (w - 1) / 2.0, w, (h - 1) / 2.0, h, w - 1, h - 1) +
         (facets ? fmt::format(field_facets, w, w - 1, h - 1) : interpolated(w, h)) +
         fmt::format(R"(let slope_x = clamp(depth / texel * rise_x, -2, 2)
let slope_y = clamp(depth / texel * rise_y, -2, 2)
let top = depth * share

# How deep the pen is: in the texture, felt along its normal, and below, felt upright.
let deep = clamp(surface + top - R * position[2], 0, {:.9g} mm)
let within = min(deep, top)
let below = deep - within

# The normal is (-slope_x, -slope_y, 1) of length 1.
table upright(t) on [0, 8] = 1 / sqrt(1 + t) with 128 segments
let nz = upright(max(slope_x * slope_x + slope_y * slope_y, 0))
let spring = stiffness * (within * nz + below)
out torque[0] = -R * stiffness * within * slope_x * nz
out torque[1] = -R * stiffness * within * slope_y * nz
out torque[2] = R * clamp(spring - damping * R * velocity[2], 0, 2 * spring)
)",
                     1e3 * most_pen_m);
}

}  // namespace feltgate::texture
