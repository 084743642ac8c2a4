// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The plane under a pen, and a sent force, against vectors. Documentation:
// docs/devices/pantograph.md
#include <algorithm>
#include <cmath>
#include <map>
#include <string>

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

namespace {

/// Of a plane that moves under three slides: spring, damping, friction, and of local_vibration the
/// texture.
void check_plane_in_space(Running<>& law, bool vibrates) {
  constexpr double kCapstan_m = 0.01;
  feltgate::SplitMix64 random(6);
  const char* const axes[] = {"x", "y", "z"};
  int pressed = 0, slipping = 0;
  double turns = 0;  // of the vibration, before this run
  for (int run = 0; run < 2000; ++run) {
    double n[3], v[3], of_plane[3], pen[3], length = 0, out_of = 0;
    for (double& part : n) {
      part = random.between(-1, 1);
      length += part * part;
    }
    const double deep_m = random.between(-4e-3, 18e-3), k = random.between(50, 900),
                 damping = random.between(0, 2), mu = random.between(0, 1),
                 vibration_n = random.between(0, 1), frequency_hz = random.between(0, 250);
    for (int i = 0; i < 3; ++i) {
      n[i] /= std::sqrt(length);
      v[i] = random.between(-1, 1);
      of_plane[i] = random.between(-1, 1);
      pen[i] = random.between(-0.2, 0.2);
      out_of += n[i] * (v[i] - of_plane[i]);
      law.set(std::string("speed_") + axes[i], of_plane[i]);
      law.set(std::string("normal_") + axes[i], n[i]);
      law.set(std::string("point_") + axes[i], pen[i] + deep_m * n[i]);
    }
    law.set("stiffness", k);
    law.set("damping", damping);
    law.set("friction", mu);
    if (vibrates) {
      law.set("vibration", vibration_n);
      law.set("frequency", frequency_hz);
    }
    law.torque({{"position", pen[0] / kCapstan_m},
                {"position[1]", pen[1] / kCapstan_m},
                {"position[2]", pen[2] / kCapstan_m},
                {"velocity", v[0] / kCapstan_m},
                {"velocity[1]", v[1] / kCapstan_m},
                {"velocity[2]", v[2] / kCapstan_m}});
    const double spring = k * std::max(deep_m, 0.0);
    const double shake_n = vibrates ? vibration_n * std::sin(2 * 3.14159265358979 * turns) : 0;
    turns += frequency_hz * 1e-5;
    const double push = std::clamp(spring - damping * out_of + shake_n, 0.0, 2 * spring);
    pressed += push > 0 ? 1 : 0;
    for (int i = 0; i < 3; ++i) {
      const double across = v[i] - of_plane[i] - out_of * n[i];
      const double drag = std::clamp(5 * across, -mu * push, mu * push);
      slipping += std::abs(drag) < std::abs(5 * across) ? 1 : 0;
      CHECK(law.output(i) == Approx(kCapstan_m * (n[i] * push - drag)).margin(1e-11));
    }
  }
  CHECK(pressed > 1000);
  CHECK(slipping > 500);
}

}  // namespace

TEST_CASE("local_space: spring, damping and friction of a plane that moves under three slides") {
  Running<> law(shipped("local_space"));
  check_plane_in_space(law, false);
}

TEST_CASE("local_vibration: the same, and a vibration of the push that never pulls") {
  Running<> law(shipped("local_vibration"));
  check_plane_in_space(law, true);
}

namespace {

struct Vec3 {
  double v[3];
  double operator[](int i) const { return v[i]; }
  double& operator[](int i) { return v[i]; }
};
double dot(const Vec3& a, const Vec3& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

/// Half the square of the shorter way out of both planes, `a` and `b` deep; where they differ by
/// less than a millimetre, a parabola joins them.
double energy_over(double a, double b) {
  constexpr double w = 1e-3;
  const double way =
      std::abs(a - b) < w ? (a + b) / 2 - (w * w + (a - b) * (a - b)) / (4 * w) : std::min(a, b);
  return way > 0 ? way * way / 2 : 0;
}

/// From a point `a` and `b` behind two planes through 0 to the nearest point in front of both, by
/// Dykstra's projections.
Vec3 way_out(const Vec3& n, const Vec3& m, Vec3 at) {
  const Vec3 from = at;
  Vec3 owed[2] = {};
  for (int k = 0; k < 2000; ++k) {
    const Vec3& normal = k % 2 == 0 ? n : m;
    Vec3& owes = owed[k % 2];
    for (int i = 0; i < 3; ++i) at[i] += owes[i];
    const double behind = std::min(0.0, dot(normal, at));
    for (int i = 0; i < 3; ++i) {
      owes[i] = behind * normal[i];
      at[i] -= owes[i];
    }
  }
  return {at[0] - from[0], at[1] - from[1], at[2] - from[2]};
}

}  // namespace

TEST_CASE(
    "local_edge: in a groove the nearest free point, over an edge an energy; else local_space") {
  constexpr double capstan_m = 0.01, k = 200;
  Running<> law(shipped("local_edge")), one(shipped("local_space"));
  feltgate::SplitMix64 random(8);
  const char* const axes[] = {"x", "y", "z"};
  const auto unit = [&] {
    while (true) {
      Vec3 v{random.between(-1, 1), random.between(-1, 1), random.between(-1, 1)};
      const double far = std::sqrt(dot(v, v));
      if (far < 0.1 || far > 1) continue;
      for (double& part : v.v) part /= far;
      return v;
    }
  };
  int both[2] = {}, single = 0;
  for (int run = 0; run < 1400; ++run) {
    const Vec3 n = unit(), m = unit();
    const double lean = dot(n, m);
    if (std::abs(lean) > 0.766) continue;
    const bool convex = run % 3 == 0, alone = run % 3 == 1;
    Vec3 point, at;
    std::map<std::string, double> inputs;
    for (int i = 0; i < 3; ++i) {
      point[i] = random.between(-0.2, 0.2);
      at[i] = random.between(-4e-3, 4e-3);
      const std::string of = i == 0 ? "" : "[" + std::to_string(i) + "]";
      inputs["position" + of] = (point[i] + at[i]) / capstan_m;
      // Of two planes a pen that goes with them feels the springs alone.
      const double speed_m_s = random.between(-1, 1);
      inputs["velocity" + of] = alone ? random.between(-50, 50) : speed_m_s / capstan_m;
      for (Running<>* l : {&law, &one}) l->set(std::string("speed_") + axes[i], speed_m_s);
      law.set(std::string("normal_") + axes[i], n[i]);
      law.set(std::string("second_") + axes[i], alone ? 0 : m[i]);
      one.set(std::string("normal_") + axes[i], n[i]);
      one.set(std::string("point_") + axes[i], point[i]);
    }
    law.set("height", dot(n, point));
    law.set("second_height", alone ? 0 : dot(m, point));
    law.set("lean", alone ? 0 : lean);
    law.set("spread", alone ? 1 : convex ? 0 : 1 / (1 - lean * lean));
    for (Running<>* l : {&law, &one}) {
      l->set("stiffness", k);
      l->set("damping", 1);
      l->set("friction", alone ? 0.5 : 0);
      l->torque(inputs);
    }
    const Vec3 out = way_out(n, m, at);
    double pushed = 0;
    for (int i = 0; i < 3; ++i) {
      if (alone) {
        CHECK(law.output(i) == Approx(one.output(i)).margin(1e-12));
        pushed += std::abs(one.output(i));
        continue;
      }
      double force = k * out[i];
      if (convex) {
        constexpr double by = 1e-8;
        const auto energy = [&](double step) {
          Vec3 there = at;
          there[i] += step;
          return energy_over(-dot(n, there), -dot(m, there));
        };
        force = -k * (energy(by) - energy(-by)) / (2 * by);
      }
      CHECK(law.output(i) == Approx(capstan_m * force).margin(convex ? 2e-8 : 1e-10));
      pushed += std::abs(force);
    }
    if (alone) {
      single += pushed > 0 ? 1 : 0;
    } else {
      const double a = -dot(n, at), b = -dot(m, at);
      const bool edge = convex ? std::min(a, b) > 0 && std::abs(a - b) < 1e-3
                               : a - lean * b > 0 && b - lean * a > 0;
      both[convex ? 1 : 0] += edge ? 1 : 0;
    }
  }
  CHECK((both[0] > 40 && both[1] > 8 && single > 80));
}

TEST_CASE("sent_force: as it is sent") {
  Running<> law(shipped("sent_force"));
  law.set("force_x", 3);
  law.set("force_y", -2);
  law.torque({{"position", 0.4}, {"position[1]", 2.5}});
  check_torques(law, 0.4, 2.5, {3, -2});
}
