// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// A material: each of its fields alone against its formula, and stick-slip against its closed form.
// Documentation: docs/devices/one-lever.md
#include <algorithm>
#include <cmath>
#include <map>
#include <string>

#include "catch.hpp"
#include "feltgate/largest.hpp"
#include "feltgate/random.hpp"
#include "law_case.hpp"

using namespace feltgate::law;

namespace {

constexpr double kFace = 0.5;

/// The law with everything off but what is named, in SI.
struct Alone {
  explicit Alone(const std::map<std::string, double>& fields) : law(shipped("material")) {
    for (const char* name : {"hardness", "damping", "viscosity", "spring", "constant", "load"}) {
      law.set(name, 0);
    }
    for (const auto& [name, value] : fields) law.set(name, value);
  }
  double at(double position, double velocity = 0) {
    return law.torque({{"position", position}, {"velocity", velocity}});
  }
  Running<> law;
};

}  // namespace

TEST_CASE("material: nothing is felt before its face") {
  Running<> law(shipped("material"));
  for (const char* name : {"viscosity", "spring", "load", "vibration", "constant"}) {
    law.set(name, 0.05);
  }
  for (double x = -1; x <= kFace; x += 0.01) {
    CHECK(law.torque({{"position", x}, {"velocity", 5}}) == 0);
  }
  CHECK(law.torque({{"position", 0.6}, {"velocity", 5}}) != 0);
}

TEST_CASE("material: hardness, capped by the hardest") {
  Alone m({{"hardness", 0.8}});
  CHECK(m.at(0.6) == Approx(-0.8 * 4 * 0.1));
  m.law.set("hardest", 0.3);
  CHECK(m.at(0.6) == Approx(-0.3 * 4 * 0.1));
  CHECK(m.at(0.7) == Approx(-0.3 * 4 * 0.2));
}

TEST_CASE("material: damping grows after an impact, and never pulls") {
  Alone m({{"damping", 0.01}, {"ease", 0.002}});
  const double dt = 1 / m.law.law().rate_hz;
  for (int round = 0; round < 2; ++round) {
    CHECK(m.at(0.4, 3) == 0);
    for (int run = 0; run < 400; ++run) {
      CHECK(m.at(0.6, 3) == Approx(-0.01 * 3 * std::min(run * dt / 0.002, 1.0)).margin(1e-12));
    }
    CHECK(m.at(0.6, -3) == 0);
  }
}

TEST_CASE("material: pushed beyond what it gives, it is broken until it is left") {
  Alone m({{"hardness", 0.5}, {"give", 0.1}});
  CHECK(m.at(0.549) == Approx(-0.098));
  CHECK(m.at(0.551) == 0);
  CHECK(m.at(0.52) == 0);
  CHECK(m.at(0.49) == 0);
  CHECK(m.at(0.52) == Approx(-0.04));
}

TEST_CASE("material: viscosity, spring, constant") {
  Alone thick({{"viscosity", 0.02}});
  CHECK(thick.at(0.6, 3) == Approx(-0.06));
  CHECK(thick.at(0.6, -3) == Approx(0.06));
  CHECK(thick.at(0.6, 300) == Approx(-1));  // counts 50 rad/s
  Alone drawn({{"spring", 2}, {"anchor", 0.55}});
  CHECK(drawn.at(0.6) == Approx(-0.1));
  CHECK(drawn.at(0.51) == Approx(0.08));
  Alone pushed({{"constant", -0.2}});
  CHECK(pushed.at(0.6) == Approx(-0.2));
}

TEST_CASE("material: vibration of 30 to 200 Hz") {
  for (const double hz : {30.0, 100.0, 200.0}) {
    INFO("frequency " << hz);
    Alone m({{"vibration", 0.05}, {"frequency", hz}});
    const double dt = 1 / m.law.law().rate_hz;
    for (int run = 0; run < 5000; ++run) {
      CHECK(m.at(0.6) == Approx(0.05 * std::sin(2 * kPi * hz * run * dt)).margin(1e-9));
    }
  }
}

TEST_CASE("material: friction stays within its cone, and only takes") {
  Alone m({{"load", 0.25}, {"static", 0.8}, {"dynamic", 0.5}});
  feltgate::SplitMix64 random(3);
  double x = 1, taken = 0, before = m.at(x), most = 0;
  for (int run = 0; run < 200000; ++run) {
    const double to =
        std::clamp(x + 2e-3 * (static_cast<double>(random.below(2001)) / 1000 - 1), 0.6, 1.4);
    const double torque = m.at(to);
    CHECK(std::abs(torque) <= 0.2 + 1e-12);
    most = feltgate::larger(most, std::abs(torque));
    taken -= (torque + before) / 2 * (to - x);
    CHECK(taken > -0.2 * 0.2 / 4);  // what the bristle may still hold, and a step
    x = to;
    before = torque;
  }
  CHECK(most > 0.1999);
  CHECK(taken > 0.4);
}

TEST_CASE(
    "material: sticks to static friction, then slips at dynamic friction until it turns back") {
  Alone m({{"load", 0.25}, {"static", 0.8}, {"dynamic", 0.5}});
  m.at(0.6);
  CHECK(m.at(0.649) == Approx(-4 * 0.049));
  CHECK(m.at(0.651) == Approx(-0.125));
  CHECK(m.at(0.9) == Approx(-0.125));
  CHECK(m.at(0.9) == Approx(-0.125));
  CHECK(m.at(0.89) == Approx(-0.125 + 0.04));  // sticks, and is static again
  CHECK(m.at(0.9 + 0.018) == Approx(-0.125 - 4 * 0.018));
  CHECK(m.at(0.85) == Approx(-0.125 + 4 * 0.05));
  CHECK(m.at(0.8) == Approx(0.125));
  CHECK(m.at(0.4) == 0);
  CHECK(m.at(0.6) == 0);  // a new contact
}

TEST_CASE("material: the cycle of stick and slip has the closed form's period and speed") {
  // A body of inertia J, drawn by a spring k at speed v over friction Ts, Td.
  const double k = 0.5, J = 3e-4, v = 2, Ts = 0.2, Td = 0.15, D = Ts - Td, bristle = 4;
  Alone m({{"load", 0.25}, {"static", Ts / 0.25}, {"dynamic", Td / 0.25}, {"calm", 0.03}});
  const double dt = 1 / m.law.law().rate_hz, w = std::sqrt(k / J);
  const double slip_s = (kPi + 2 * std::atan(k * v / (w * D))) / w;
  const double stick_s = 2 * D / v * (1 / k + 1 / bristle);
  double x = 0.6, speed = 0, before = 0, fastest = 0, first_s = 0, last_s = 0;
  int slips = 0;
  for (int run = 0; run * dt < 2; ++run) {
    const double pull = k * (v * run * dt - (x - 0.6));
    const double friction = m.at(x, speed);
    if (std::abs(before) > Ts - 1e-3 && std::abs(friction + Td) < 1e-9) {
      ++slips;
      (slips == 2 ? first_s : last_s) = run * dt;
    }
    before = friction;
    speed += dt * (pull + friction) / J;
    x += dt * speed;
    fastest = std::max(fastest, speed);
  }
  REQUIRE(slips > 5);
  CHECK((last_s - first_s) / (slips - 2) == Approx(slip_s + stick_s).epsilon(0.02));
  CHECK(fastest == Approx(v + std::hypot(v, D * w / k))
                       .epsilon(0.06));  // calmed, it tears off a little above Ts
}
