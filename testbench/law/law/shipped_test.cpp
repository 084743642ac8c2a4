// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Every shipped law against its formula, written here by hand. Documentation: docs/laws.md
#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>

#include "catch.hpp"
#include "law_case.hpp"

using namespace feltgate::law;

namespace {

constexpr double kDegree = kPi / 180;

}  // namespace

TEST_CASE("every shipped law has a summary and a torque, and is tested here") {
  const std::vector<std::string> tested{
      "charge_far", "charge", "damper", "detent", "gimbal", "membrane", "spring", "quaternion",
      "pantograph", "pantograph_filtered", "coupled_levers", "wall",
      // lever_devices_test.cpp
      "turn_switch", "graded_membrane", "end_stops", "scroll_wheel", "moved_detents", "cut_string",
      "throttle", "lump", "attraction", "material", "ceiling", "wall_tracked", "ceiling_tracked",
      "drums",
      // virtual_objects_test.cpp
      "flywheel", "pendulum", "collision", "rigid_body",
      // local_plane_law_test.cpp
      "local_plane", "sent_force", "local_space", "local_vibration", "local_edge",
      // testbench/studies/shape
      "hidden_shapes", "texture",
      // testbench/sim/bowed_string
      "bowed_string", "four_strings"};
  for (const auto& entry : std::filesystem::directory_iterator(FELTGATE_ROOT "/rtl/laws")) {
    if (entry.path().extension() != ".law") continue;
    const std::string name = entry.path().stem().string();
    INFO(name);
    CHECK(std::find(tested.begin(), tested.end(), name) != tested.end());
    const Law law = shipped(name);
    CHECK(law.name == name);
    CHECK(law.summary.size() > 10);
    CHECK(!law.outputs.empty());
  }
}

TEST_CASE("detent: the sine of a click") {
  Running<> law(shipped("detent"));
  CHECK(law.law().summary == "a knob with soft clicks");
  CHECK(law.law().parameters[1].comment == "per turn");
  for (double x = -7; x < 7; x += 0.01) {
    CHECK(law.torque({{"position", x}}) == Approx(-0.05 * std::sin(24 * x)).margin(1e-15));
  }
  law.set("amplitude", 0.3);
  law.set("clicks", 100);
  CHECK(law.torque({{"position", 0.4}}) == Approx(-0.3 * std::sin(40)));
}

TEST_CASE("wall: free before its face, never a pull behind it") {
  Running<> law(shipped("wall"));
  for (double x = 0; x < 1; x += 0.01) {
    for (const double v : {-100.0, -3.0, 0.0, 2.0, 50.0}) {
      const double push = 4 * (0.5 - x) - 0.005 * v;
      const double torque = x > 0.5 ? std::min(push, 0.0) : 0;
      CHECK(law.torque({{"position", x}, {"velocity", v}}) == Approx(torque).margin(1e-15));
    }
  }
}

TEST_CASE("spring and damper are linear") {
  Running<> spring(shipped("spring")), damper(shipped("damper"));
  spring.set("rest", 0.25);
  for (double x = -3; x < 3; x += 0.1) {
    CHECK(spring.torque({{"position", x}}) == Approx(0.5 * (0.25 - x)).margin(1e-15));
    CHECK(damper.torque({{"velocity", x}}) == Approx(-0.03 * x).margin(1e-15));
  }
}

TEST_CASE("membrane: back to the side last seen outside") {
  Running<> law(shipped("membrane"));
  const auto at = [&](double x) { return law.torque({{"position", x}}); };
  CHECK(at(0.6) == 0);  // has been outside of nothing yet
  CHECK(at(0.4) == 0);
  CHECK(at(0.5) == -0.5);
  CHECK(at(0.7) == -0.5);
  CHECK(at(0.6) == -0.5);
  CHECK(at(0.8) == 0);
  CHECK(at(0.7) == 0.5);
  CHECK(at(0.5) == 0.5);
  law.evaluation().reset();
  CHECK(at(0.6) == 0);
}

namespace {

/// As on the page of scene_charge: strength = peak core^2, slope = strength / core^3.
double charge(double x, double core) {
  const double strength = 0.5 * core * core;
  const double outside = std::copysign(strength, x) / (x * x);
  return -(std::abs(x) > core ? outside : strength / (core * core * core) * x);
}

}  // namespace

TEST_CASE("charge: the inverse square outside of a linear core") {
  Running<> law(shipped("charge")), far(shipped("charge_far"));
  constexpr double core = kPi / 16;
  for (double x = -3; x < 3; x += 0.013) {
    CHECK(law.torque({{"position", x}}) == Approx(charge(x, core)).margin(1e-14));
  }
  CHECK(law.torque({{"position", 50}}) == Approx(charge(15.5 * core, core)));
  for (double x = -11.6; x < 11.6; x += 0.013) {
    CHECK(far.torque({{"position", x}}) == Approx(charge(x, 0.2)).margin(1e-14));
  }
  CHECK(std::abs(far.torque({{"position", 100}}) - charge(100, 0.2)) < 0.2e-3);
  law.set("peak", -0.5);
  CHECK(law.torque({{"position", 0.4}}) == Approx(-charge(0.4, core)));
  far.set("core", 0.15);
  CHECK(far.torque({{"position", 0.4}}) == Approx(charge(0.4, 0.15)));
}

namespace {

using Quaternion = std::array<double, 4>;

Quaternion turn(int axis, double angle) {
  Quaternion q{std::cos(angle / 2), 0, 0, 0};
  q[static_cast<std::size_t>(axis) + 1] = std::sin(angle / 2);
  return q;
}

std::array<double, 3> coupled(Running<>& law, const Quaternion& d, const Quaternion& o) {
  const char* const names[2][4] = {{"dw", "dx", "dy", "dz"}, {"ow", "ox", "oy", "oz"}};
  for (std::size_t i = 0; i < 4; ++i) {
    law.set(names[0][i], d[i]);
    law.set(names[1][i], o[i]);
  }
  law.torque({});
  return {law.output(0), law.output(1), law.output(2)};
}

}  // namespace

TEST_CASE("quaternion: Rz90 against Rx90, small turns, and the shorter way") {
  Running<> law(shipped("quaternion"));
  law.set("stiffness", 0.25);  // 2 k = 0.5 Nm
  const auto value = [&](const std::string& name) {
    // w is only seen by its sign; the torque is 2 k sgn(w) (x, y, z).
    return coupled(law, turn(2, kPi / 2),
                   turn(0, kPi / 2))[static_cast<std::size_t>(name[0] - 'x')];
  };
  CHECK(value("x") == Approx(0.5 * -0.5));
  CHECK(value("y") == Approx(0.5 * -0.5));
  CHECK(value("z") == Approx(0.5 * 0.5));

  CHECK(coupled(law, turn(1, 0.001), turn(1, 0))[1] == Approx(0.25e-3).epsilon(1e-6));
  for (int degrees = 1; degrees < 360; ++degrees) {
    for (int axis = 0; axis < 3; ++axis) {
      const auto torque = coupled(law, turn(axis, degrees * kDegree), turn(axis, 0));
      const double shorter = degrees <= 180 ? degrees : degrees - 360;
      const double expected = 0.5 * std::sin(shorter * kDegree / 2);
      if (degrees == 180) continue;  // both ways are as long
      INFO(degrees);
      CHECK(torque[static_cast<std::size_t>(axis)] == Approx(expected));
    }
  }
}

namespace {

using Matrix = std::array<std::array<double, 3>, 3>;

/// Of a turn about axis 0, 1, 2 = x, y, z.
Matrix rotation(std::size_t axis, double angle) {
  const std::size_t i = (axis + 1) % 3, j = (axis + 2) % 3;
  Matrix m{};
  m[axis][axis] = 1;
  m[i][i] = m[j][j] = std::cos(angle);
  m[j][i] = std::sin(angle);
  m[i][j] = -std::sin(angle);
  return m;
}

Matrix product(const Matrix& a, const Matrix& b) {
  Matrix m{};
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      for (std::size_t k = 0; k < 3; ++k) m[i][j] += a[i][k] * b[k][j];
    }
  }
  return m;
}

/// 2 sin(angle / 2) times the axis of a rotation of less than half a turn.
std::array<double, 3> half_sines(const Matrix& m) {
  const double cosine = (m[0][0] + m[1][1] + m[2][2] - 1) / 2;
  const double half = std::sqrt((1 + cosine) / 2);  // of the half angle, its cosine
  return {(m[2][1] - m[1][2]) / (2 * half), (m[0][2] - m[2][0]) / (2 * half),
          (m[1][0] - m[0][1]) / (2 * half)};
}

}  // namespace

TEST_CASE("gimbal: by matrices, from every side") {
  Running<> law(shipped("gimbal"));
  law.set("stiffness", 0.2);
  for (int goal_axis = 0; goal_axis < 3; ++goal_axis) {
    const double goal_angle = 1.1;
    const Quaternion d = turn(goal_axis, goal_angle);
    const char* const names[] = {"dw", "dx", "dy", "dz"};
    for (std::size_t i = 0; i < 4; ++i) law.set(names[i], d[i]);
    for (double a = -3; a <= 3; a += 0.7) {
      for (double b = -1.2; b <= 1.2; b += 0.4) {
        for (double c = -3; c <= 3; c += 0.9) {
          law.torque({{"position", a}, {"position[1]", b}, {"position[2]", c}});
          const Matrix outer = rotation(2, a), both = product(outer, rotation(1, b));
          const Matrix is = product(both, rotation(0, c));
          Matrix back{};
          for (std::size_t i = 0; i < 3; ++i) {
            for (std::size_t j = 0; j < 3; ++j) back[i][j] = is[j][i];
          }
          const auto goal = rotation(static_cast<std::size_t>(goal_axis), goal_angle);
          const auto torque = half_sines(product(goal, back));
          const auto along = [&](double x, double y, double z) {
            return 0.2 * (x * torque[0] + y * torque[1] + z * torque[2]);
          };
          CHECK(law.output(0) == Approx(along(0, 0, 1)).margin(1e-9));
          CHECK(law.output(1) == Approx(along(outer[0][1], outer[1][1], outer[2][1])).margin(1e-9));
          CHECK(law.output(2) == Approx(along(both[0][0], both[1][0], both[2][0])).margin(1e-9));
        }
      }
    }
  }
}

TEST_CASE("pantograph: against formulas, over its range") {
  Running<> law(shipped("pantograph"));
  for (double a = 0; a < 1.5; a += 0.11) {
    for (double b = 1.6; b < 3.1; b += 0.13) {
      for (const double w : {-20.0, 3.0, 15.0}) {
        const double u = 7 - w, L = 0.1;
        law.torque({{"position", a}, {"position[1]", b}, {"velocity", w}, {"velocity[1]", u}});
        const double J[2][2] = {{-L * std::sin(a), -L * std::sin(b)},
                                {L * std::cos(a), L * std::cos(b)}};
        const double y = L * (std::sin(a) + std::sin(b));
        const double fx = -(J[0][0] * w + J[0][1] * u);
        const double fy = 500 * std::max(0.08 - y, 0.0) - (J[1][0] * w + J[1][1] * u);
        CHECK(law.output(0) == Approx(J[0][0] * fx + J[1][0] * fy).margin(1e-14));
        CHECK(law.output(1) == Approx(J[0][1] * fx + J[1][1] * fy).margin(1e-14));
      }
    }
  }
}

TEST_CASE("coupled_levers: a spring between them, mixed with what the follower's observer sees") {
  Running<> law(shipped("coupled_levers"));
  law.set("calm", 0.01);
  for (const double share : {0.0, 0.3, 1.0}) {
    law.set("share", share);
    for (const double apart : {-0.5, -0.1, 0.02, 0.2}) {  // 4 Nm/rad, at most 1 Nm
      law.torque({{"position", 0.7 + apart},
                  {"position[1]", 0.7},
                  {"velocity", 3},
                  {"velocity[1]", 5},
                  {"tau_hat[1]", 0.07}});
      const double pull = std::clamp(4 * apart, -1.0, 1.0) - 0.02, follows = pull + share * 0.07;
      CHECK(law.output(1) == Approx(follows).margin(1e-14));
      CHECK(law.output(0) == Approx(-(1 - share) * follows - share * 0.07 - 0.03).margin(1e-14));
    }
  }
}

TEST_CASE("pantograph_filtered: the filters of a 1 kHz loop, run by run") {
  for (const double filtered : {0.0, 1.0}) {
    Running<> law(shipped("pantograph_filtered"));
    law.set("damping", 0.03);
    law.set("filtered", filtered);
    double before = 0, speed = 0, force = 0;
    for (int k = 0; k < 400; ++k) {
      // The pen swings through the floor at 0.11 m, and jumps once by 1 mm in a run: 1 m/s.
      const double a = 0.58 + 0.06 * std::sin(0.05 * k) + (k == 300 ? 0.006 : 0), b = kPi - a;
      law.torque({{"position", a}, {"position[1]", b}});
      const double y = 0.1 * (std::sin(a) + std::sin(b)), raw = (y - before) / 1e-3;
      const double trusted = std::abs(raw) > 0.5 ? 0 : raw;
      before = y;
      speed = 0.95 * speed + 0.05 * trusted;
      const double v = filtered > 0 ? speed : trusted, depth = 0.11 - y;
      const double push = depth > 0 ? 50 * depth - 0.03 * v : 0;
      force = 0.7 * force + 0.3 * push;
      const double fy = filtered > 0 ? force : push;
      CHECK(law.output(0) == Approx(0.1 * std::cos(a) * fy).margin(1e-13));
      CHECK(law.output(1) == Approx(0.1 * std::cos(b) * fy).margin(1e-13));
    }
  }
}

TEMPLATE_TEST_CASE("every number type computes the same law", "", long double, feltgate::Quad) {
  for (const char* const name : {"detent", "charge", "pantograph", "wall"}) {
    Running<> plain(shipped(name));
    Running<TestType> other(shipped(name));
    for (double x = -3; x < 3; x += 0.37) {
      const auto in = static_cast<TestType>(x);
      const double a = plain.torque({{"position", x}, {"position[1]", 2 * x}, {"velocity", -x}});
      const auto b = other.torque({{"position", in}, {"position[1]", 2 * in}, {"velocity", -in}});
      INFO(name << " at " << x);
      CHECK(static_cast<double>(b) == Approx(a).margin(1e-14));
    }
  }
}
