// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Claims of the report on DIMPLE: orientation by quaternions, texture, and 40 kHz against 1 kHz.
// Documentation: docs/claims.md
#include <array>

#include "law/read_law.hpp"

#include "studies/claims/claims.hpp"
#include "studies/shape/pen_force.hpp"
#include "studies/stability/linear_loop.hpp"
#include "studies/stability/mass_loop.hpp"
#include "studies/texture/texture_force.hpp"

namespace feltgate::claims {

namespace {

/// w, x, y, z.
using Quaternion = std::array<double, 4>;

Quaternion product(const Quaternion& a, const Quaternion& b) {
  return {a[0] * b[0] - a[1] * b[1] - a[2] * b[2] - a[3] * b[3],
          a[0] * b[1] + a[1] * b[0] + a[2] * b[3] - a[3] * b[2],
          a[0] * b[2] - a[1] * b[3] + a[2] * b[0] + a[3] * b[1],
          a[0] * b[3] + a[1] * b[2] - a[2] * b[1] + a[3] * b[0]};
}

Quaternion inverse(const Quaternion& q) { return {q[0], -q[1], -q[2], -q[3]}; }

Quaternion turn(double angle_rad, int axis) {
  Quaternion q{std::cos(angle_rad / 2), 0, 0, 0};
  q[static_cast<std::size_t>(axis)] = std::sin(angle_rad / 2);
  return q;
}

/// A ball on a spring and damper towards `device`, with the torque of equation 1 or of the other
/// order: the angle that is left after 10 s, in degrees.
double left_deg(const Quaternion& device, bool reversed) {
  Quaternion object = turn(pi / 2, 1);
  std::array<double, 3> speed{};
  constexpr double dt = 1e-3, stiffness = 4, damping = 2;
  for (int step = 0; step < 10'000; ++step) {
    const Quaternion q =
        reversed ? product(inverse(device), object) : product(device, inverse(object));
    const double sign = q[0] < 0 ? -1 : 1;
    Quaternion spin{};
    for (std::size_t i = 0; i < 3; ++i) {
      speed[i] += dt * (2 * stiffness * sign * q[i + 1] - damping * speed[i]);
      spin[i + 1] = speed[i];
    }
    const Quaternion rate = product(spin, object);
    double size = 0;
    for (std::size_t i = 0; i < 4; ++i) {
      object[i] += 0.5 * dt * rate[i];
      size += object[i] * object[i];
    }
    for (double& x : object) x /= std::sqrt(size);
  }
  const double w = std::abs(product(device, inverse(object))[0]);
  return 2 * std::acos(std::min(1.0, w)) * 180 / pi;
}

Claim quaternion(const Lab&) {
  const Quaternion device = turn(pi / 2, 3), object = turn(pi / 2, 1);
  const Quaternion q = product(device, inverse(object));
  Claim c{
      "4, eq. 1",
      "qd qo^-1 gives the torque; qd^-1 qo resulted in a singularity",
      "The last three elements of qd qo^-1 are the axis times sin(phi/2): the torque is 2 k "
      "sin(phi/2), k phi for small angles",
      "a ball on that spring with damping, from 90° about x towards 90° about z; the axis itself "
      "in `./feltgate run gimbal`",
      "a failure is meant: the other order has no singularity. It is the same error with the other "
      "sign and in the device's frame, so in the frame of the world it pushes away. The flip at "
      "360° is a missing sign of the first element",
      {}};
  c.explains("its elements, Rz 90° and Rx 90°: w", "", 0.5, q[0]);
  c.explains("x", "", -0.5, q[1]);
  c.explains("y", "", -0.5, q[2]);
  c.explains("z", "", 0.5, q[3]);
  c.explains("torque at 90° over k", "", 2 * std::sin(pi / 4));
  c.asks_if("angle left by qd qo^-1", "°", 0, left_deg(device, false), at_most(0.1));
  c.asks_if("left by qd^-1 qo", "°", none, left_deg(device, true), at_least(45));
  return c;
}

/// What of the stiffness is left along the normals of texels, and with the split, in engine words.
texture::Firmness firmness_of(double texel_m) {
  texture::LawRequest r;
  r.summary = "a sine";
  r.texel_m = r.depth_m = texel_m;
  std::vector<double> row;
  for (int i = 0; i < 97; ++i) row.push_back(0.5 + 0.5 * std::sin(2 * pi * i / 16));
  return texture::firmness(law::compile_text(texture::row_law(row, r), "sine.law", law::Target{}),
                           row, r);
}

Claim texture_stiffness(const Lab&) {
  // A slope a, texels of s: the normal leaves the texel at a depth of s / (2 sin a) from its
  // middle.
  const auto without = [](double texel_m) {
    texture::LawRequest r;
    r.texel_m = texel_m;
    r.depth_m = texel_m;  // a slope of 1, a single texel
    r.stiffness_n_per_m = 1;
    const auto f = texture::plane_force({0.0, 1.0}, r, 0.5 * texel_m, texture::firmness_depth_m);
    return texture::firmness_depth_m / std::hypot(f.x, f.y);
  };
  const texture::Firmness large = firmness_of(10e-3), small = firmness_of(0.1e-3);
  const double bounded = 2 * std::sin(pi / 4) * texture::firmness_depth_m;
  Claim c{
      "5.1",
      "as texels get smaller, k has to grow by several magnitudes to feel the same",
      "The depth along a texel's normal ends at s / (2 sin a): at a slope of 45° and 3 mm deep, k "
      "grows by 2 sin 45° 3 mm / s. With the depth split in two the part below has the full k",
      "planes of texels of s in real numbers; with the split, a sine in the engine's words, share "
      "of k felt to 3 mm",
      "k grows as 1/s: two magnitudes for s = 0.04 mm. Split, it stays",
      {}};
  c.explains("k, texels of 1 mm, factor", "", bounded / 1e-3, without(1e-3));
  c.asks("texels of 0.01 mm, factor", "", bounded / 0.01e-3, without(0.01e-3), at_least(100));
  c.asks("share with the split, 0.1 over 10 mm", "", 1, small.split / large.split, near(1, 0.01));
  c.explains("without, 0.1 over 10 mm", "", none, small.plane / large.plane);
  return c;
}

Claim texture_force(const Lab&) {
  texture::LawRequest r;
  r.summary = "a ramp";
  r.depth_m = 3.75e-3;  // texels of 1 mm, five steps of 0.75 mm down
  r.stiffness_n_per_m = 1000;
  const law::Law law =
      law::read_law_text(texture::row_law({1.0, 0.8, 0.6, 0.4, 0.2, 0.0}, r), "ramp.law", 100e3);
  const shape::Point f =
      shape::Pen(law).at({((3.75 - 0.8) / 0.75 - 2.5) * 1e-3, r.surface_m - 0.5e-3});
  Claim c{"5.1, F = dt k nt + ds k ns",
          "the depth split in texture and surface gives lateral force, and is stiff to the surface",
          "0.8 mm high, 0.5 mm below the surface, normal (0.6, 0, 0.8), 1000 N/m: our example",
          "that ramp's law in real numbers; in the engine's words in [texture](devices/texture.md)",
          "it does. It points a little more upward than the texture, as the report says",
          {}};
  c.asks("sideways", "N", 0.8e-3 * 1000 * 0.6, f.x, near(0.48, 0.001));
  c.asks("upward", "N", 0.8e-3 * 1000 * 0.8 + 0.5e-3 * 1000, f.y, near(1.14, 0.001));
  return c;
}

Claim forty_khz(const Lab& lab) {
  const stability::LoopModel model =
      stability::make_model(lab.design("lever"), lab.plant("linear"));
  const auto border = [&model](int ticks) {
    return stability::border(model, 0.005, ticks).stiffness_nm_rad;
  };
  const stability::MassLoop at_1{0.1, 0.103, 1e-3, 0, 0, 0}, at_40{0.1, 0.103, 25e-6, 0, 0, 0};
  Claim c{
      "3, 6",
      "a device at 40 kHz, with a bridge over the bus approximately 1 kHz: what is lost?",
      "The stiffest wall is (b + B) / (T/2 + td): 40 times as stiff at 40 kHz without a delay td, "
      "less with one",
      "eigenvalues: a mass of 0.1 kg, an ideal actuator; and `lever` on plant `linear`, B = 0.005 "
      "Nms/rad",
      "the actuator is ideal. On our lever the winding's 0.2 ms leaves a factor of about 3",
      {}};
  const double one = border(1000), forty = border(25);
  c.asks("40 kHz over 1 kHz, `lever`", "",
         stability::closed_form(model, 0.005, 25) / stability::closed_form(model, 0.005, 1000),
         forty / one, at_least(40 * 0.95));
  c.asks_if("ideal actuator", "", 40, stability::stiffest(at_40) / stability::stiffest(at_1),
            near(40, 2));
  c.explains("`lever` at 1 kHz", "Nm/rad", stability::closed_form(model, 0.005, 1000), one);
  c.explains("at 40 kHz", "Nm/rad", stability::closed_form(model, 0.005, 25), forty);
  return c;
}

}  // namespace

std::vector<Source> dimple() {
  return {{"quaternion", 4, quaternion},
          {"texture_stiffness", 4, texture_stiffness},
          {"texture_force", 4, texture_force},
          {"forty_khz", 4, forty_khz}};
}

}  // namespace feltgate::claims
