// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The plane under a pen, and a sent force, against vectors. Documentation:
// docs/devices/local_plane.md
#include <algorithm>
#include <cmath>

#include "catch.hpp"
#include "feltgate/random.hpp"
#include "law_case.hpp"

using namespace feltgate::law;

namespace {

constexpr double kLink_m = 0.1;

struct Vec {
  double x, y;
};

/// Torques of a rhombus for a force at its pen.
void check_torques(const Running<>& law, double a, double b, Vec f) {
  CHECK(law.output(0) == Approx(kLink_m * (std::cos(a) * f.y - std::sin(a) * f.x)).margin(1e-12));
  CHECK(law.output(1) == Approx(kLink_m * (std::cos(b) * f.y - std::sin(b) * f.x)).margin(1e-12));
}

}  // namespace

TEST_CASE("local_plane: spring, damping and friction of a plane, its cone exact") {
  Running<> law(shipped("local_plane"));
  feltgate::SplitMix64 random(5);
  int pressed = 0, slipping = 0;
  for (int run = 0; run < 4000; ++run) {
    const double a = random.between(0.2, 1.4), b = random.between(1.7, 2.9);
    const double w = random.between(-3, 3), u = random.between(-3, 3);
    const double turn = random.between(-3.1, 3.1), deep_m = random.between(-4e-3, 18e-3);
    const double k = random.between(50, 900), damping = random.between(0, 2),
                 mu = random.between(0, 1);
    const Vec n{std::cos(turn), std::sin(turn)};
    const Vec pen{kLink_m * (std::cos(a) + std::cos(b)), kLink_m * (std::sin(a) + std::sin(b))};
    const Vec v{-kLink_m * (std::sin(a) * w + std::sin(b) * u),
                kLink_m * (std::cos(a) * w + std::cos(b) * u)};
    const Vec point{pen.x + deep_m * n.x, pen.y + deep_m * n.y};
    if (std::abs(point.x) > 0.25 || std::abs(point.y) > 0.25) continue;
    law.set("point_x", point.x);
    law.set("point_y", point.y);
    law.set("normal_x", n.x);
    law.set("normal_y", n.y);
    law.set("stiffness", k);
    law.set("damping", damping);
    law.set("friction", mu);
    law.torque({{"position", a}, {"position[1]", b}, {"velocity", w}, {"velocity[1]", u}});
    const double spring = k * std::max(deep_m, 0.0);
    const double push = std::clamp(spring - damping * (n.x * v.x + n.y * v.y), 0.0, 2 * spring);
    const double along = n.y * v.x - n.x * v.y;
    const double drag = std::clamp(5 * along, -mu * push, mu * push);
    pressed += push > 0 ? 1 : 0;
    slipping += std::abs(drag) < std::abs(5 * along) ? 1 : 0;
    CHECK(std::abs(drag) <= mu * push);
    check_torques(law, a, b, {n.x * push - n.y * drag, n.y * push + n.x * drag});
  }
  CHECK(pressed > 1000);
  CHECK(slipping > 500);
}

TEST_CASE("local_space: spring, damping and friction of a plane under three slides") {
  constexpr double kCapstan_m = 0.01;
  Running<> law(shipped("local_space"));
  feltgate::SplitMix64 random(6);
  const char* const axes[] = {"x", "y", "z"};
  int pressed = 0, slipping = 0;
  for (int run = 0; run < 2000; ++run) {
    double n[3], v[3], pen[3], length = 0, out_of = 0;
    for (double& part : n) {
      part = random.between(-1, 1);
      length += part * part;
    }
    const double deep_m = random.between(-4e-3, 18e-3), k = random.between(50, 900),
                 damping = random.between(0, 2), mu = random.between(0, 1);
    for (int i = 0; i < 3; ++i) {
      n[i] /= std::sqrt(length);
      v[i] = random.between(-1, 1);
      pen[i] = random.between(-0.2, 0.2);
      out_of += n[i] * v[i];
      law.set(std::string("normal_") + axes[i], n[i]);
      law.set(std::string("point_") + axes[i], pen[i] + deep_m * n[i]);
    }
    law.set("stiffness", k);
    law.set("damping", damping);
    law.set("friction", mu);
    law.torque({{"position", pen[0] / kCapstan_m},
                {"position[1]", pen[1] / kCapstan_m},
                {"position[2]", pen[2] / kCapstan_m},
                {"velocity", v[0] / kCapstan_m},
                {"velocity[1]", v[1] / kCapstan_m},
                {"velocity[2]", v[2] / kCapstan_m}});
    const double spring = k * std::max(deep_m, 0.0);
    const double push = std::clamp(spring - damping * out_of, 0.0, 2 * spring);
    pressed += push > 0 ? 1 : 0;
    for (int i = 0; i < 3; ++i) {
      const double across = v[i] - out_of * n[i];
      const double drag = std::clamp(5 * across, -mu * push, mu * push);
      slipping += std::abs(drag) < std::abs(5 * across) ? 1 : 0;
      CHECK(law.output(i) == Approx(kCapstan_m * (n[i] * push - drag)).margin(1e-12));
    }
  }
  CHECK(pressed > 1000);
  CHECK(slipping > 500);
}

TEST_CASE("sent_force: as it is sent") {
  Running<> law(shipped("sent_force"));
  law.set("force_x", 3);
  law.set("force_y", -2);
  law.torque({{"position", 0.4}, {"position[1]", 2.5}});
  check_torques(law, 0.4, 2.5, {3, -2});
}
