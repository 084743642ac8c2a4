// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Claims of TouchWorld: its own loop of 1 kHz, its stylus and its meshes. Documentation:
// docs/claims.md
#include <fmt/format.h>

#include "sim/plant/plant.hpp"
#include "sim/plant/pushing_hand.hpp"
#include "studies/claims/claims.hpp"
#include "studies/claims/haptic_lever.hpp"
#include "studies/stability/mass_loop.hpp"
#include "studies/texture/texture_force.hpp"

namespace feltgate::claims {

namespace {

using stability::MassLoop;

constexpr double device_b = 0.003, virtual_b = 0.1, stylus_kg = 0.045, wall_n_m = 206;
constexpr double most_n = 3.3, millisecond_s = 1e-3;

MassLoop loop(double b_virtual, double period_s, double mass_kg = stylus_kg) {
  return {mass_kg, device_b, period_s, b_virtual, 0, 0};
}

double bound(double b_virtual, double period_s) { return 2 * (device_b + b_virtual) / period_s; }

Claim border(const Lab&) {
  Claim c{
      "V, Fig. 17, 18, table; Future Work II",
      "the stiffest walls are 6, 106, 206 and 406 N/m at 1 kHz, 412 at 2 kHz, 1030 at 5 kHz; the "
      "transition is precisely at 206",
      "2 (b + bv) / T with b = 0.003 Ns/m",
      "eigenvalues of the document's own loop: a held force, velocity by backward difference, "
      "45 g",
      "for its own loop, within 0.5 % for 45 g. It is the border of a mass alone, neither "
      "Llewellyn's condition nor passivity, which virtual damping does not help",
      {}};
  const struct {
    double n_m, bv, hz;
  } walls[] = {{6, 0, 1e3},     {106, 0.05, 1e3}, {206, 0.1, 1e3},
               {406, 0.2, 1e3}, {412, 0.1, 2e3},  {1030, 0.1, 5e3}};
  for (const auto& w : walls) {
    c.asks(fmt::format("bv {:g} Ns/m at {:g} kHz", w.bv, w.hz / 1e3), "N/m", bound(w.bv, 1 / w.hz),
           stability::stiffest(loop(w.bv, 1 / w.hz)), near(w.n_m, 0.005 * w.n_m));
  }
  c.explains("206 N/m with 10 g", "N/m", none,
             stability::stiffest(loop(virtual_b, millisecond_s, 0.01)));
  c.explains("206 N/m with 1 kg", "N/m", none,
             stability::stiffest(loop(virtual_b, millisecond_s, 1)));
  return c;
}

Claim margin(const Lab&) {
  const double per_s =
      std::log(stability::spectral_radius(loop(virtual_b, millisecond_s), wall_n_m)) /
      millisecond_s;
  const double half =
      std::log(stability::spectral_radius(loop(virtual_b, millisecond_s), 103)) / millisecond_s;
  Claim c{"V, Fig. 19",
          "at 206 N/m the system is well within the bound, with no oscillation",
          "1 - 206 / 206 of the stiffness is left; a swing grows by (K - Kmax) T / (4 m) or so",
          "eigenvalues of the same loop: growth of a swing at 206 N/m, below 0 it decays",
          "206 N/m is the bound itself (we take 10 % for well within). At half of it, 103 N/m, a "
          "swing decays",
          {}};
  c.asks("share of the bound that is left", "%", 100 * (1 - wall_n_m / bound(virtual_b, 1e-3)),
         100 * (1 - wall_n_m / stability::stiffest(loop(virtual_b, millisecond_s))), at_least(10));
  c.explains("growth at 206 N/m", "1/s", 0, per_s);
  c.explains("growth at 103 N/m", "1/s", (103 - 206) * millisecond_s / (4 * stylus_kg), half);
  return c;
}

Claim z_width(const Lab&) {
  const double per_s = 2 * pi * 10;
  Claim c{"V, Fig. 20",
          "a Z-width of approximately 1093 at 1 kHz, nearly doubled at 2, quintupled at 5",
          "Kmax / (b 2 pi 10 Hz), which is our reading: the paper gives no frequency",
          "eigenvalues of the same loop",
          "the free impedance is that at 10 Hz",
          {}};
  const double stated[] = {1093, 2186, 5465};
  for (int i = 0; i < 3; ++i) {
    const double khz = i == 0 ? 1 : i == 1 ? 2 : 5, period_s = millisecond_s / khz;
    c.asks_if(fmt::format("at {:g} kHz", khz), "", bound(virtual_b, period_s) / (device_b * per_s),
              stability::z_width(stability::stiffest(loop(virtual_b, period_s)), device_b, 10),
              near(stated[i], 0.005 * stated[i]));
  }
  return c;
}

Claim zeta(const Lab&) {
  // The same contact without samples: the decay of its swing.
  const double w = std::sqrt(wall_n_m / stylus_kg), b = device_b + virtual_b, step_s = 1e-5;
  const double decay =
      -std::log(stability::spectral_radius({stylus_kg, b, step_s, 0, 0, 0}, wall_n_m)) / step_s +
      wall_n_m * step_s / (4 * stylus_kg);  // what the hold takes
  Claim c{
      "VI.4, Fig. 27, Table 3",
      "hDamping = 0.1 is near critical: zeta is about 1",
      "b / (2 sqrt(k m)) with 0.103 Ns/m, 206 N/m, 45 g; the mass for zeta = 1 is b² / (4 k)",
      "eigenvalues of the same contact in steps of 10 µs: decay of the swing over its frequency",
      "a swing takes 37 periods to fall to 2 %. Critical would be a stylus of 13 mg",
      {}};
  c.asks("zeta", "", b / (2 * std::sqrt(wall_n_m * stylus_kg)), decay / w, near(1, 0.1));
  c.explains("mass for zeta = 1", "mg", 1e6 * b * b / (4 * wall_n_m));
  return c;
}

/// Depth at 0.1 m to which a hand pushes a lever into a wall of 206 N/m.
double depth_mm(const Lab& lab, double force_n) {
  Scenario s = lab.scene("wall");
  s.duration_s = 0.6;
  s.parameters = {{"wall_contact", 0},
                  {"wall_damping", 0.005},
                  {"wall_stiffness", wall_n_m * 0.01 * count_rad}};
  s.hand = plant::pushing_hand(0.1 * force_n, 0.4);
  Mean angle;
  lab.run(s, lab.plant("p24"), "lever", {}, [&angle](double time_s, const plant::Observables& o) {
    if (time_s > 0.5) angle.add(o.theta_rad);
  });
  return 1e3 * 0.1 * angle.mean();
}

Claim saturation(const Lab& lab) {
  const double left_n = most_n - wall_n_m * 14e-3;
  Claim c{
      "V, Fig. 16",
      "at 206 N/m the total force reaches 3.3 N at approximately 14 mm",
      "3.3 N / 206 N/m; at 14 mm the spring has 206 N/m times 14 mm",
      "`lever` with a wall of 206 N/m at 0.1 m, a hand that pushes with 3.3 N, friction of `p24`",
      "friction and damping add 0.42 N, for which the figure gives neither speed nor "
      "coefficient. The spring alone is 16 mm deep",
      {}};
  c.asks("depth at 3.3 N", "mm", 1e3 * most_n / wall_n_m, depth_mm(lab, most_n), near(14, 0.5));
  c.asks_if("depth of the spring's share", "mm", 1e3 * (most_n - 0.42) / wall_n_m,
            depth_mm(lab, most_n - 0.42), near(14, 0.5));
  c.explains("spring at 14 mm", "N", wall_n_m * 14e-3);
  c.explains("left for the rest", "N", left_n);
  return c;
}

/// Rms error of the force along a sine of so many pixels a period, relative to the smooth curve's.
double force_error(int pixels, texture::Normals normals) {
  texture::LawRequest r;
  r.summary = "a sine";
  r.depth_m = 0.4 * r.texel_m * pixels / (2 * pi);  // slopes to 0.2
  r.normals = normals;
  const int count = 6 * pixels + 1;
  std::vector<double> row;
  for (int i = 0; i < count; ++i) row.push_back(0.5 + 0.5 * std::sin(2 * pi * i / pixels));
  const law::Compiled law = law::compile_text(texture::row_law(row, r), "sine.law", law::Target{});
  texture::Words words(law);
  const double middle_m = 0.5 * r.texel_m * (count - 1), per_m = 2 * pi / (pixels * r.texel_m);
  double wrong = 0, all = 0;
  for (double x = -2 * pixels * r.texel_m; x < 2 * pixels * r.texel_m; x += 0.0613e-3) {
    // 2 mm below black: sideways by the texture alone.
    const texture::PenForce felt = texture::pen_force(words, {x, r.surface_m - 2e-3});
    const double phase = (felt.at_m.x + middle_m) * per_m;
    const double height = r.depth_m * (0.5 + 0.5 * std::sin(phase));
    const double slope = 0.5 * r.depth_m * per_m * std::cos(phase);
    const double right = -r.stiffness_n_per_m * height * slope / std::sqrt(1 + slope * slope);
    wrong += (felt.force_n.x - right) * (felt.force_n.x - right);
    all += right * right;
  }
  return std::sqrt(wrong / all);
}

/// The same of the slope alone, of a low sine.
double reduction_pct(int pixels) {
  const double h = 2 * pi / pixels, s = std::sin(h / 2) / (h / 2), c = std::sin(h) / h;
  const double facets = std::sqrt(1 - s * s);
  const double shaded = std::sqrt(1 - 2 * c * s * s + c * c * (2 + std::cos(h)) / 3);
  return 100 * (1 - shaded / facets);
}

Claim force_shading(const Lab&) {
  const auto simulated = [](int pixels) {
    return 100 * (1 - force_error(pixels, texture::Normals::interpolated) /
                          force_error(pixels, texture::Normals::facets));
  };
  Claim c{"Future Work VII",
          "force shading reduces the rms error of the force by up to 36 % on coarse meshes",
          "On a low sine of N facets a period, h = 2 pi / N, s = sinc h/2, c = sinc h: facets miss "
          "sqrt(1 - s²) of the slope, shading sqrt(1 - 2 c s² + c² (2 + cos h)/3)",
          "a row of pixels in the engine's words, slopes to 0.2, sideways force against the smooth "
          "curve's",
          "a bump has about 8 facets (to 6 %): 35 % of the slope's error, 41 % of the force's. "
          "With 16 it "
          "is 66 and 70 %",
          {}};
  c.asks_if("reduction, 8 facets", "%", reduction_pct(8), simulated(8), near(36, 6));
  c.explains("16 facets", "%", reduction_pct(16), simulated(16));
  return c;
}

Claim mesh(const Lab&) {
  const double vertices = 61324, faces = 122700, euler = vertices - faces / 2;
  Claim c{
      "VI.2, Fig. 24",
      "meshes of objects have 61 324 vertices and 122 700 faces",
      "Euler's V - E + F with E = 3 F / 2 is V - F / 2; the genus of a closed surface is 1 - half "
      "of it",
      "-: the mesh is not given",
      "for one closed, clean object: it would have 14 handles. More likely there are several "
      "shells or defects",
      {}};
  c.explains("V - F / 2", "", euler);
  c.asks("handles of one closed object", "", 1 - euler / 2, none, at_most(0));
  return c;
}

Claim preset(const Lab&) {
  Claim c{
      "VI.4, Table 3",
      "all objects have stiffness 0.8, damping 0.1, static friction 0.4, dynamic 0.3",
      "Shares of the hardest surface and of the largest damping; ours are 4 Nm/rad and 50 mNm "
      "s/rad ([material](devices/material.md))",
      "-: this table runs no laws; `./feltgate run material_object` does",
      "the shares are those of our law, whose own values they are. The paper gives no units, so "
      "nothing can be compared in newtons. The preset's name is `material_object`",
      {}};
  c.explains("stiffness", "Nm/rad", 0.8 * 4);
  c.explains("damping", "mNm s/rad", 0.1 * 50);
  c.asks_if("dynamic over static friction", "", 0.3 / 0.4, none, at_most(1));
  return c;
}

}  // namespace

std::vector<Source> touch_world() {
  return {{"border", 3, border}, {"margin", 3, margin},         {"z_width", 3, z_width},
          {"zeta", 3, zeta},     {"saturation", 3, saturation}, {"force_shading", 3, force_shading},
          {"mesh", 3, mesh},     {"preset", 3, preset}};
}

}  // namespace feltgate::claims
