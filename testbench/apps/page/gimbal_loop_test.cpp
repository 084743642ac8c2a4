// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The page's body in space: it arrives where the hand turned, whatever the order of the axes; it
// swings with the frequency of the closed form of docs/devices/one-lever.md behind a hand of the
// page; a whole turn leaves no torque. Documentation: docs/page.md
#include <array>
#include <cmath>
#include <limits>
#include <string>

#include "apps/page/law_loops.hpp"
#include "catch.hpp"
#include "law/compile.hpp"

namespace feltgate::page {
namespace {

using plant::Quaternion;
using plant::Vec3;
using Matrix = std::array<std::array<double, 3>, 3>;

GimbalLoop made() {
  static const auto compiled = law::compile_file(
      std::string(FELTGATE_ROOT) + "/rtl/laws/rigid_body.law", law::target_of(gimbal_design()));
  static const std::string image = law::text(compiled.image);
  GimbalLoop::BodyWords words;
  for (std::size_t n = 0; n < words.size(); ++n) {
    words[n] = state_word(compiled, std::array{"dw", "dx", "dy", "dz"}[n]);
  }
  return GimbalLoop(image, words);
}

/// A rotation about axis 0, 1 or 2 as a matrix, by cosines.
Matrix about(std::size_t axis, double rad) {
  Matrix m{};
  const std::size_t a = (axis + 1) % 3, b = (axis + 2) % 3;
  m[axis][axis] = 1;
  m[a][a] = m[b][b] = std::cos(rad);
  m[a][b] = -std::sin(rad);
  m[b][a] = std::sin(rad);
  return m;
}
Matrix operator*(const Matrix& p, const Matrix& q) {
  Matrix m{};
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      for (std::size_t k = 0; k < 3; ++k) m[i][j] += p[i][k] * q[k][j];
    }
  }
  return m;
}
/// How far the body's three axes are from the columns of a matrix.
double off(const Quaternion& body, const Matrix& m) {
  double most = 0;
  for (std::size_t j = 0; j < 3; ++j) {
    const Vec3 axis = body.turn({j == 0 ? 1.0 : 0.0, j == 1 ? 1.0 : 0.0, j == 2 ? 1.0 : 0.0});
    most = std::fmax(most, plant::length(axis - Vec3{m[0][j], m[1][j], m[2][j]}));
  }
  return most;
}

void turn_slowly(GimbalLoop& loop, Vec3 rad) {
  for (int n = 0; n < 100; ++n) {
    loop.turn(0.01 * rad);
    loop.advance(0.005);
  }
}

}  // namespace

TEST_CASE("page: the body in space arrives where the hand has turned") {
  GimbalLoop first = made(), second = made();
  turn_slowly(first, {0.9, 0, 0});
  turn_slowly(first, {0, -0.7, 0});
  turn_slowly(second, {0, -0.7, 0});
  turn_slowly(second, {0.9, 0, 0});
  for (GimbalLoop* loop : {&first, &second}) loop->advance(5);
  const Matrix x = about(0, 0.9), y = about(1, -0.7);
  CHECK(off(first.body(), y * x) < 0.01);
  CHECK(off(second.body(), x * y) < 0.01);
  CHECK(off(first.body(), x * y) > 0.3);  // the order counts
  CHECK(first.twist_rad() < 0.01);
  CHECK(plant::length(first.torque_nm()) < 1e-3);
}

TEST_CASE("page: the body in space swings as body and hand do") {
  GimbalLoop loop = made();
  loop.set("damping", 0);
  loop.turn({0.12, 0.16, 0});  // by 0.2 rad, at once
  loop.advance(0.002);
  double before = loop.torque_nm().x, first_s = 0, last_s = 0;
  int crossings = 0;
  for (int n = 0; n < 8000; ++n) {
    loop.advance(5e-5);
    const double now = loop.torque_nm().x;
    if ((now < 0) != (before < 0)) {
      last_s = loop.time_s();
      if (crossings++ == 0) first_s = last_s;
    }
    before = now;
  }
  REQUIRE(crossings > 3);
  const double measured_rad_s = M_PI * (crossings - 1) / (last_s - first_s);
  // A body of J behind k, at a hand of 1.35 Nm/rad, 65 mNm s/rad and 5.5 g m^2: the swing at s with
  // J s^2 + k Z/(k + Z) = 0, Z = J_h s^2 + b_h s + k_h, by steps to the fixed point.
  const double j = 1e-4, k = 0.1, jh = 0.55 * 0.01, bh = 6.5 * 0.01, kh = 135 * 0.01;
  double w = std::sqrt(k / j);
  for (int n = 0; n < 50; ++n) {
    const double re = kh - jh * w * w, im = bh * w;  // Z
    const double share = (re * (re + k) + im * im) / ((re + k) * (re + k) + im * im);
    w = std::sqrt(k * share / j);
  }
  CAPTURE(measured_rad_s, w);
  CHECK(std::fabs(measured_rad_s / w - 1) < 0.03);
}

TEST_CASE("page: a whole turn of the body's hand leaves no torque; what is not finite is ignored") {
  GimbalLoop loop = made();
  loop.turn({std::numeric_limits<double>::quiet_NaN(), 0, 0});
  for (int n = 0; n < 4; ++n) turn_slowly(loop, {0, 0, M_PI / 2});
  loop.advance(5);
  CHECK(loop.twist_rad() < 0.01);
  CHECK(plant::length(loop.torque_nm()) < 1e-3);
  CHECK(off(loop.body(), about(2, 0)) < 0.01);
  CHECK_THROWS_AS(loop.set("stiffness", 9), std::invalid_argument);
}

}  // namespace feltgate::page
