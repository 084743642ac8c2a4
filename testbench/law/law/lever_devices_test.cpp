// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The laws of the devices with one lever against closed forms. Documentation: docs/devices.md
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "catch.hpp"
#include "feltgate/largest.hpp"
#include "feltgate/random.hpp"
#include "law_case.hpp"

using namespace feltgate::law;

namespace {

/// What the object takes on a straight way, by trapezoids; the law's memory goes along.
double taken_j(Running<>& law, double from, double to) {
  constexpr int steps = 20000;
  double energy = 0, before = law.torque({{"position", from}});
  for (int i = 1; i <= steps; ++i) {
    const double torque = law.torque({{"position", from + (to - from) * i / steps}});
    energy -= (torque + before) / 2 * (to - from) / steps;
    before = torque;
  }
  return energy;
}

}  // namespace

TEST_CASE("turn switch: springs to the place in which it is latched") {
  Running<> law(shipped("turn_switch"));
  const auto at = [&](double x) { return law.torque({{"position", x}}); };
  CHECK(at(0.25) == Approx(-0.25));  // on the way up it is not latched
  CHECK(at(0.31) == Approx(0.35 - 0.31));
  CHECK(at(0.4) == Approx(0.35 - 0.4));
  CHECK(at(0.21) == Approx(0.35 - 0.21));  // on the way back it is
  CHECK(at(0.19) == Approx(-0.19));
  CHECK(at(0.29) == Approx(-0.29));
  CHECK(at(-0.31) == Approx(-0.35 + 0.31));
  CHECK(law.torque({{"position", -0.3}, {"velocity", 2}}) == Approx(-0.05 - 0.02));
  law.set("cancel", 1);
  CHECK(at(-0.35) == Approx(0.35));
  law.set("cancel", 0);
  CHECK(at(-0.29) == Approx(0.29));  // and it stays off
  law.evaluation().reset();
  CHECK(at(0.25) == Approx(-0.25));
}

TEST_CASE("turn switch: in and out takes stiffness times place times the way between both angles") {
  Running<> law(shipped("turn_switch"));
  for (const double side : {1.0, -1.0}) {
    const double energy = taken_j(law, 0, 0.45 * side) + taken_j(law, 0.45 * side, 0);
    CHECK(energy == Approx(1 * 0.35 * (0.3 - 0.2)).epsilon(1e-3));
  }
}

TEST_CASE("graded membrane: from the face that is entered to the one that is left") {
  Running<> law(shipped("graded_membrane"));
  const auto at = [&](double x) { return law.torque({{"position", x}}); };
  CHECK(at(0.6) == 0);  // has been outside of nothing yet
  CHECK(at(0.4) == 0);
  CHECK(at(0.5) == Approx(-0.1));
  CHECK(at(0.65) == Approx(-0.1 - 0.3 * 0.75));
  CHECK(at(0.55) == Approx(-0.1 - 0.3 * 0.25));
  CHECK(at(0.71) == 0);
  CHECK(at(0.65) == Approx(0.1 + 0.3 * 0.25));
  CHECK(at(0.5) == Approx(0.4));
  at(0.8);
  for (const double far : {0.4, 0.05}) {
    law.set("far", far);
    CHECK(taken_j(law, 0.3, 0.9) == Approx(0.2 * (0.1 + far) / 2).epsilon(1e-3));
    CHECK(taken_j(law, 0.9, 0.3) == Approx(0.2 * (0.1 + far) / 2).epsilon(1e-3));
  }
}

TEST_CASE("end stops: restitution squared of what they took comes back") {
  for (const double restitution : {0.5, 0.7, 1.0}) {
    INFO("restitution " << restitution);
    Running<> law(shipped("end_stops"));
    law.set("restitution", restitution);
    for (const double side : {1.0, -1.0}) {
      const double in = taken_j(law, 0.9 * side, 1.1 * side);
      CHECK(in == Approx(4 * 0.1 * 0.1 / 2).epsilon(1e-3));
      CHECK(-taken_j(law, 1.1 * side, 0.9 * side) ==
            Approx(restitution * restitution * in).epsilon(1e-3));
    }
  }
}

TEST_CASE("end stops: back along a steeper line, in again along it, never a pull") {
  Running<> law(shipped("end_stops"));
  const auto at = [&](double x) { return law.torque({{"position", x}}); };
  CHECK(at(1) == 0);
  CHECK(at(1.1) == Approx(-0.4));
  CHECK(at(1.09) == Approx(-0.4 + 16 * 0.01));
  CHECK(at(1.07) == 0);  // left behind: it gave all it will
  CHECK(at(1.09) == Approx(-0.24));
  CHECK(at(1.12) == Approx(-0.48));
  CHECK(at(1.11) == Approx(-0.48 + 16 * 0.01));
  CHECK(at(1.0) == 0);
  CHECK(at(1.09) == Approx(-0.36));  // a new contact
  CHECK(at(-1.1) == Approx(0.4));
}

TEST_CASE("scroll wheel: the clutch turns it, drag slows it down") {
  Running<> law(shipped("scroll_wheel"));
  const double dt = 1 / law.law().rate_hz, inertia = 0.2e-3, clutch = 0.01;
  law.set("drag", 0);
  double wheel = 0;
  const auto run = [&](double velocity) {
    const double pull = std::clamp(clutch * (velocity - wheel), -0.2, 0.2);
    wheel += dt / inertia * pull;
    CHECK(law.torque({{"velocity", velocity}}) == Approx(-pull).margin(1e-12));
  };
  for (int i = 0; i < 500; ++i) run(10);
  CHECK(wheel == Approx(10 * (1 - std::pow(1 - dt * clutch / inertia, 500))));
  for (int i = 0; i < 500; ++i) run(60);  // slips
  for (int i = 0; i < 500; ++i) run(0);
  law.set("drag", 1e-3);
  const double held = wheel * (1 - dt * (clutch + 1e-3) / inertia);
  law.torque({});
  CHECK(law.torque({}) == Approx(clutch * held));
}

namespace {

const char* const kPlaces[] = {"p0", "p1", "p2", "p3", "p4"};

/// What a host does: detent i lies in place i mod 5, the five nearest at a time.
std::size_t keep_nearest(Running<>& law, const std::vector<double>& all, double position) {
  std::size_t first = 0;
  while (first + 5 < all.size() &&
         std::abs(all[first + 5] - position) < std::abs(all[first] - position)) {
    ++first;
  }
  for (std::size_t i = first; i < first + 5; ++i) {
    law.set(kPlaces[i % 5], std::round(all[i] * 4096 / (2 * std::acos(-1.0))));
  }
  return first;
}

}  // namespace

TEST_CASE("moved detents: five in the mailbox feel like all of them") {
  Running<> law(shipped("moved_detents"));
  const double width = 5.625 * std::acos(-1.0) / 180;
  feltgate::SplitMix64 random(2);
  const double unit = width / 64;
  std::vector<double> all{-2000 * unit};
  for (int i = 1; i < 25; ++i) {
    all.push_back(all.back() + std::ceil(random.between(128, 330)) * unit);
  }
  std::size_t moves = 0, before = keep_nearest(law, all, -3.1);
  for (double x = -3.1; x < all.back() + 0.1; x += 0.0011) {
    double nearest = 1e9;
    for (const double p : all) nearest = std::abs(x - p) < std::abs(nearest) ? x - p : nearest;
    const double torque = -0.1 * std::sin(std::acos(-1.0) * std::clamp(nearest / width, -1.0, 1.0));
    const double old = law.torque({{"position", x}});
    const std::size_t first = keep_nearest(law, all, x);
    moves += first != before ? 1 : 0;
    before = first;
    // An exchange far away is not felt.
    CHECK(law.torque({{"position", x}}) == Approx(old).margin(1e-12));
    CHECK(old == Approx(torque).margin(1e-12));
  }
  CHECK(moves == all.size() - 5);
}

TEST_CASE("cut string: a spring up to its strength, then nothing until the blades have opened") {
  Running<> law(shipped("cut_string"));
  const auto at = [&](double x) { return law.torque({{"position", x}}); };
  CHECK(at(0.2) == 0);
  CHECK(at(0.35) == Approx(-0.1));
  CHECK(at(0.32) == Approx(-0.04));  // not yet cut, it gives all back
  CHECK(at(0.399) == Approx(-0.198));
  CHECK(at(0.401) == 0);
  CHECK(at(0.35) == 0);
  CHECK(at(0.21) == 0);
  CHECK(at(0.35) == 0);  // it has to open further
  CHECK(at(0.19) == 0);
  CHECK(at(0.35) == Approx(-0.1));
  CHECK(at(0.19) == 0);
  CHECK(taken_j(law, 0.19, 0.6) == Approx(0.2 * 0.2 / (2 * 2)).epsilon(1e-3));
}

TEST_CASE("throttle: dry friction on any way, and a notch that gives back what it takes") {
  Running<> law(shipped("throttle"));
  // Over the notch and back. Friction takes its torque times the way; at either end the spring of
  // what sticks turns over first, from -friction to friction, which takes nothing.
  const double taken = 0.06 * (0.6 - 2 * 0.06 / 4);
  CHECK(taken_j(law, -0.3, 0.3) == Approx(taken).epsilon(1e-3));
  CHECK(taken_j(law, 0.3, -0.3) == Approx(taken).epsilon(1e-3));
  law.set("friction", 0);
  for (double x = -0.2; x < 0.2; x += 0.01) {
    const double off = std::min(std::max(x, -0.1), 0.1);
    CHECK(law.torque({{"position", x}}) == Approx(-0.1 * std::sin(kPi * off / 0.1)).margin(1e-12));
  }
}

TEST_CASE("lump: stiff at first, softer after a while, and stiff again where the lump lies") {
  Running<> law(shipped("lump"));
  const auto at = [&](double x) { return law.torque({{"position", x}}); };
  CHECK(at(0.2) == 0);
  CHECK(at(0.3) == Approx(-0.5 * 0.1 - 0.4 * 0.1));
  // 100 kHz: after 100 ms the quick part has 1/e left.
  for (int k = 1; k < 10000; ++k) at(0.3);
  CHECK(at(0.3) == Approx(-0.5 * 0.1 - 0.4 * 0.1 * std::exp(-1.0)).epsilon(1e-3));
  for (int k = 0; k < 100000; ++k) at(0.3);
  CHECK(at(0.3) == Approx(-0.05).epsilon(1e-3));
  CHECK(at(0.45) == Approx(-0.5 * 0.25 - 0.4 * 0.15 - 2 * 0.05).epsilon(1e-3));
  CHECK(at(0.25) == Approx(-0.025));  // it is left faster than it comes back
}

TEST_CASE(
    "attraction: draws near, lets go before the edge, pushes back inside; all of it an energy") {
  Running<> law(shipped("attraction"));
  const auto at = [&](double x) { return law.torque({{"position", x}}); };
  CHECK(at(0.19) == 0);
  CHECK(at(0.275) == Approx(0.025));
  CHECK(at(0.35) == Approx(0.05));
  CHECK(at(0.425) == Approx(0.025));
  CHECK(at(0.55) == 0);  // here a hand sits
  CHECK(at(0.7) == Approx(-0.2));
  CHECK(at(1.7) == Approx(-1));  // from half a radian on no more
  CHECK(taken_j(law, 0, 0.55) == Approx(-0.05 * 0.3 / 2).epsilon(1e-3));
  CHECK(taken_j(law, 0.55, 0.7) == Approx(2 * 0.1 * 0.1 / 2).epsilon(1e-3));
  law.set("sits", 0.2);
  law.set("reach", 0.1);
  CHECK(at(0.35) == Approx(0.05));
  CHECK(at(0.41) == 0);
  CHECK(taken_j(law, 0.55, 0) == Approx(0.05 * 0.1 / 2).epsilon(1e-3));
}

// A material: each of its fields alone against its formula, and stick-slip against its closed form.

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

// The laws of a stick over drums and under a ceiling.

TEST_CASE("ceiling: 10 mm deep are 0.07 Nm") {
  Running<> law(shipped("ceiling"));
  CHECK(law.torque({{"position", 0.4}}) == 0);
  CHECK(law.torque({{"position", 0.5 + 0.01 / 0.3}}) == Approx(-0.07));
  law.set("length", 0.2);
  CHECK(law.torque({{"position", 0.5 + 0.01 / 0.2}}) == Approx(-0.07));
  CHECK(law.torque({{"position", 5}}) == Approx(-700 * 0.06 * 0.06));
}

TEST_CASE("wall and ceiling on a tracker, without and with the encoder") {
  Running<> wall(shipped("wall_tracked")), ceiling(shipped("ceiling_tracked"));
  for (double x = 0; x < 1; x += 0.01) {
    for (const double turned : {-0.02, 0.0, 0.015}) {
      const double at = x - turned;  // the encoder when the tracker saw x
      for (const bool fused : {false, true}) {
        const double place = fused ? x + 0.7 - at : x;
        for (Running<>* law : {&wall, &ceiling}) {
          law->set("tracked", x);
          law->set("turned", at);
          law->set("fusion", fused ? 1 : 0);
        }
        const double push = 11.459 * std::clamp(place - 0.5, 0.0, 0.5);
        const double depth = std::clamp(0.3 * (place - 0.5), 0.0, 0.05);
        CHECK(wall.torque({{"position", 0.7}}) == Approx(-push).margin(1e-12));
        CHECK(ceiling.torque({{"position", 0.7}}) == Approx(-700 * depth * depth).margin(1e-12));
      }
    }
  }
}

TEST_CASE("drums: boxes open downward, each hit told once with speed and place") {
  Running<> law(shipped("drums"));
  const auto hits = [&] {
    std::string names;
    for (std::size_t n = 0; n < law.law().events.size(); ++n) {
      if (law.evaluation().happened(n)) names += law.law().events[n].name + " ";
    }
    return names;
  };
  const double middles[] = {-0.3, 0.0, 0.3}, skins[] = {900, 600, 300};
  for (int drum = 0; drum < 3; ++drum) {
    law.set("across", middles[drum] + 0.03);
    CHECK(law.torque({{"position", 0.01}, {"velocity", -5}}) == 0);
    CHECK(hits().empty());
    const double depth = 0.3 * std::sin(0.04);
    CHECK(law.torque({{"position", -0.04}, {"velocity", -5}}) ==
          Approx(skins[drum] * depth * depth));
    const std::string number = std::to_string(drum + 1);
    CHECK(hits() == "hit" + number + " place" + number + " ");
    CHECK(law.evaluation().event_value(2 * static_cast<std::size_t>(drum)) ==
          Approx(0.3 * std::cos(0.04) * 5));
    CHECK(law.evaluation().event_value(2 * static_cast<std::size_t>(drum) + 1) == Approx(0.25));
    law.torque({{"position", -0.05}});
    CHECK(hits().empty());  // still inside
  }
  // Beside, before and behind a drum, and far below it: open downward.
  law.set("across", 0.13);
  CHECK(law.torque({{"position", -0.04}}) == 0);
  law.set("across", 0);
  law.set("ahead", 0.13);
  CHECK(law.torque({{"position", -0.04}}) == 0);
  law.set("ahead", 0);
  law.set("height", -0.4);
  CHECK(law.torque({{"position", 0}}) == Approx(600 * 0.05 * 0.05));
}
