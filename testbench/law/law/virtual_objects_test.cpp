// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Flywheel, pendulum and a body in space behind a spring and a damper: momentum, energy, and where
// they are stable. Documentation: docs/devices/one-lever.md
#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <string>

#include "catch.hpp"
#include "feltgate/largest.hpp"
#include "feltgate/random.hpp"
#include "law_case.hpp"

using namespace feltgate::law;

namespace {

std::size_t state_of(const Law& law, const std::string& name) {
  for (std::size_t i = 0; i < law.states.size(); ++i) {
    if (law.states[i].name == name) return i;
  }
  throw std::runtime_error("no state " + name);
}

/// An object whose lever is where and as fast as one says.
class Object {
 public:
  explicit Object(const std::string& name, double rate_hz = 0)
      : run_(read_law(FELTGATE_ROOT "/rtl/laws/" + name + ".law", rate_hz)),
        speed_(state_of(run_.law(), "speed")),
        twist_(state_of(run_.law(), "twist")) {}
  void set(const std::string& parameter, double si) { run_.set(parameter, si); }
  double run(double position, double velocity) {
    return run_.torque({{"position", position}, {"velocity", velocity}});
  }
  void put(double twist, double speed) {
    run_.evaluation().set_state(twist_, twist);
    run_.evaluation().set_state(speed_, speed);
  }
  double speed() { return run_.evaluation().state(speed_); }
  double twist() { return run_.evaluation().state(twist_); }
  double dt() const { return 1 / run_.law().rate_hz; }

 private:
  Running<> run_;
  std::size_t speed_, twist_;
};

/// The larger of both absolute eigenvalues of a run, lever held; the columns are what runs make of
/// a small twist and a small speed.
double radius(Object& object) {
  std::array<double, 4> m{};
  for (std::size_t column = 0; column < 2; ++column) {
    object.put(column == 0 ? 1e-9 : 0, column == 0 ? 0 : 1e-9);
    object.run(0, 0);
    m[column] = object.twist() / 1e-9;
    m[2 + column] = object.speed() / 1e-9;
  }
  const double half = (m[0] + m[3]) / 2, det = m[0] * m[3] - m[1] * m[2];
  const std::complex<double> root = std::sqrt(std::complex<double>(half * half - det));
  return std::max(std::abs(half + root), std::abs(half - root));
}

}  // namespace

TEST_CASE("flywheel: what the lever gives in torque and time the wheel has in momentum") {
  Object wheel("flywheel");
  const double inertia = 0.5e-3;
  double given = 0;
  for (int i = 0; i < 50000; ++i) {
    const double t = i * wheel.dt();
    given -= wheel.dt() * wheel.run(0.2 * std::sin(20 * t), 4 * std::cos(20 * t));
  }
  CHECK(std::abs(wheel.speed()) > 1);
  CHECK(inertia * wheel.speed() == Approx(given).epsilon(1e-9));
}

TEST_CASE("flywheel and pendulum: without damping no energy comes or goes") {
  for (const char* name : {"flywheel", "pendulum"}) {
    INFO(name);
    Object object(name);
    const bool falls = std::string(name) == "pendulum";
    object.set("damping", 0);
    const double inertia = 0.5e-3, stiffness = 2, weight = falls ? 0.05 : 0;
    const auto energy = [&] {
      return inertia * object.speed() * object.speed() / 2 +
             stiffness * object.twist() * object.twist() / 2 +
             weight * (1 - std::cos(object.twist()));
    };
    object.run(0, 0);
    object.put(0, 6);
    const double before = energy();
    double least = before, most = before;
    for (int i = 0; i < 500000; ++i) {
      object.run(0, 0);
      least = std::min(least, energy());
      most = feltgate::larger(most, energy());
    }
    // The step's own error swings with half of its angle, sqrt(k / J) dt, and does not add up.
    const double angle = std::sqrt((stiffness + weight) / inertia) * object.dt();
    CHECK(most - before < before * angle);
    CHECK(before - least < before * angle);
  }
}

TEST_CASE("pendulum: swings with the period of its weight") {
  Object pendulum("pendulum");
  pendulum.set("stiffness", 8);
  pendulum.set("damping", 0);
  pendulum.set("weight", 0.05);
  pendulum.put(0.02, 0);
  // The held spring and the weight together.
  const double period = 2 * 3.14159265358979 * std::sqrt(0.5e-3 / 8.05);
  int runs = 0;
  bool was_back = false;
  for (; runs < 100000; ++runs) {
    pendulum.run(0, 0);
    if (pendulum.twist() < 0) was_back = true;
    if (was_back && pendulum.twist() > 0) break;
  }
  CHECK(runs * pendulum.dt() == Approx(0.75 * period).epsilon(1e-3));
  Object lifted("pendulum");
  lifted.set("damping", 0.05);
  for (int i = 0; i < 100000; ++i) lifted.run(1.2, 0);
  // At rest the lever carries the weight at the pendulum's angle.
  CHECK(lifted.run(1.2, 0) == Approx(-0.05 * std::sin(1.2 + lifted.twist())));
}

TEST_CASE("flywheel: stable where k dt^2 + 2 b dt < 4 J, by eigenvalues and by its runs") {
  feltgate::SplitMix64 random(1);
  int stable = 0, unstable = 0;
  for (const double rate_hz : {50.0, 100.0, 144.0, 490.0, 1000.0, 10e3, 250e3}) {
    for (int i = 0; i < 200; ++i) {
      const double k = random.between(0.1, 8), b = random.between(0, 0.05),
                   inertia = 0.1e-3 * std::pow(50, random.uniform());
      Object wheel("flywheel", rate_hz);
      wheel.set("stiffness", k);
      wheel.set("damping", b);
      wheel.set("inertia", inertia);
      const double dt = wheel.dt();
      const double share = (k * dt * dt + 2 * b * dt) / (4 * inertia);
      if (std::abs(share - 1) < 1e-3) continue;
      INFO(rate_hz << " Hz, k " << k << ", b " << b << ", J " << inertia << ": " << share);
      wheel.run(0, 0);
      CHECK((radius(wheel) < 1) == (share < 1));
      ++(share < 1 ? stable : unstable);
      if (rate_hz > 2000 || std::abs(share - 1) < 0.1) continue;
      // What it makes of a small push within 400 runs.
      wheel.put(1e-6, 0);
      for (int n = 0; n < 400; ++n) wheel.run(0, 0);
      double largest = 0;
      for (int n = 0; n < 20; ++n) {
        wheel.run(0, 0);
        largest = feltgate::larger(largest, std::abs(wheel.twist()));
      }
      CHECK((largest < 1e-5) == (share < 1));
    }
  }
  CHECK(stable > 300);
  CHECK(unstable > 100);
}

TEST_CASE("flywheel, pendulum: at their own rate nothing that a host can set is unstable") {
  for (const char* name : {"flywheel", "pendulum"}) {
    const Law law = shipped(name);
    const auto range = [&](const std::string& parameter) {
      for (const Parameter& p : law.parameters) {
        if (p.name == parameter) return p.range;
      }
      throw std::runtime_error("no parameter " + parameter);
    };
    const double dt = 1 / law.rate_hz, b = range("damping").upper + 0.005;
    const double k = range("stiffness").upper + 0.3;  // with the weight's
    CHECK(k * dt * dt + 2 * b * dt < 4 * range("inertia").lower / 100);
  }
}

TEST_CASE("collision: both momenta and energies are those of an elastic blow") {
  Running<> law(shipped("collision"));
  const auto state = [&](const char* name) {
    return law.evaluation().state(state_of(law.law(), name));
  };
  law.set("stiffness", 0);  // the lever has let go
  law.set("damping", 0);
  for (const auto& [first, second] :
       {std::pair{0.4e-3, 0.1e-3}, {0.2e-3, 0.2e-3}, {0.1e-3, 2e-3}}) {
    INFO(first << " against " << second);
    law.evaluation().reset();
    law.set("inertia", first);
    law.set("other", second);
    law.torque({});
    law.evaluation().set_state(state_of(law.law(), "speed"), 10);
    law.evaluation().set_state(state_of(law.law(), "gap"), 0.01);
    bool touched = false;
    for (int i = 0; i < 3000; ++i) {
      law.torque({});
      touched |= state("gap") < 0;
      CHECK(first * state("speed") + second * state("speed2") == Approx(10 * first).epsilon(1e-10));
    }
    CHECK(touched);
    CHECK(state("gap") > 0);
    CHECK(state("speed") == Approx(10 * (first - second) / (first + second)).margin(0.01));
    CHECK(state("speed2") == Approx(20 * first / (first + second)).margin(0.01));
  }
}

namespace {

template <int N>
struct Numbers {
  double v[N];
  double operator[](int i) const { return v[i]; }
  double& operator[](int i) { return v[i]; }
};
using Three = Numbers<3>;
using Four = Numbers<4>;

/// A turn by `angle` about an axis, as w, x, y, z.
Four turn_about(Three axis, double angle) {
  const double far = std::sqrt(axis[0] * axis[0] + axis[1] * axis[1] + axis[2] * axis[2]);
  const double s = std::sin(angle / 2) / far;
  return {std::cos(angle / 2), s * axis[0], s * axis[1], s * axis[2]};
}
/// First b, then a.
Four product(const Four& a, const Four& b) {
  return {a[0] * b[0] - a[1] * b[1] - a[2] * b[2] - a[3] * b[3],
          a[0] * b[1] + a[1] * b[0] + a[2] * b[3] - a[3] * b[2],
          a[0] * b[2] - a[1] * b[3] + a[2] * b[0] + a[3] * b[1],
          a[0] * b[3] + a[1] * b[2] - a[2] * b[1] + a[3] * b[0]};
}

Law rigid_body(double rate_hz = 0) {
  return read_law(FELTGATE_ROOT "/rtl/laws/rigid_body.law", rate_hz);
}

/// A body in space whose hand is where and as fast as one says.
class Body {
 public:
  explicit Body(Law law, double damping = 0) : run_(std::move(law)) {
    run_.set("damping", damping);
    run_.torque({});
  }
  void set(const std::string& parameter, double si) { run_.set(parameter, si); }
  void hand(const Four& o) {
    o_ = o;
    for (int i = 0; i < 4; ++i) set(std::string("o") + "wxyz"[i], o[i]);
  }
  Three run(const Three& velocity = {}) {
    run_.torque(
        {{"velocity", velocity[0]}, {"velocity[1]", velocity[1]}, {"velocity[2]", velocity[2]}});
    return {run_.output(0), run_.output(1), run_.output(2)};
  }
  void put(const Four& d, const Three& speed) {
    for (int i = 0; i < 4; ++i) state(std::string("d") + "wxyz"[i], d[i]);
    for (int i = 0; i < 3; ++i) state(std::string("s") + "xyz"[i], speed[i]);
  }
  double of(const std::string& name) { return run_.evaluation().state(state_of(run_.law(), name)); }
  Three speed() { return {of("sx"), of("sy"), of("sz")}; }
  /// Half of the angle between body and hand has this cosine.
  double near() {
    return std::abs(of("dw") * o_[0] + of("dx") * o_[1] + of("dy") * o_[2] + of("dz") * o_[3]);
  }
  double dt() const { return 1 / run_.law().rate_hz; }

 private:
  void state(const std::string& name, double to) {
    run_.evaluation().set_state(state_of(run_.law(), name), to);
  }
  Running<> run_;
  Four o_{1, 0, 0, 0};
};

}  // namespace

TEST_CASE("rigid body: torque times time is its momentum, and its quaternion keeps its length") {
  Body body(rigid_body(), 0.5e-3);
  Three given{};
  for (int n = 0; n < 40000; ++n) {
    const double t = n * body.dt();
    body.hand(product(turn_about({0, 0, 1}, 0.7 * std::sin(9 * t)),
                      turn_about({1, 1, 0}, 2.5 * std::sin(7 * t))));
    const Three torque = body.run({std::sin(3 * t), 2 * std::cos(20 * t), 1});
    for (int i = 0; i < 3; ++i) given[i] -= body.dt() * torque[i];
  }
  const Three speed = body.speed();
  double fast = 0, length2 = 0;
  for (int i = 0; i < 3; ++i) {
    CHECK(0.1e-3 * speed[i] == Approx(given[i]).epsilon(1e-9));
    fast += std::abs(speed[i]);
  }
  for (const char* part : {"dw", "dx", "dy", "dz"}) length2 += body.of(part) * body.of(part);
  CHECK(fast > 1);
  CHECK(length2 == Approx(1).margin(1e-4));
}

TEST_CASE("rigid body: without damping no energy comes or goes") {
  constexpr double inertia = 0.1e-3, stiffness = 0.1;
  const Four hand = turn_about({1, 1, 1}, 2.0944);
  Body body{rigid_body()};
  const auto energy = [&] {
    const Three s = body.speed();
    return inertia * (s[0] * s[0] + s[1] * s[1] + s[2] * s[2]) / 2 +
           4 * stiffness * (1 - body.near());
  };
  body.hand(hand);
  body.put(hand, {6, -4, 3});
  const double begin = energy(), angle = std::sqrt(stiffness / inertia) * body.dt();
  double off = 0;
  for (int n = 0; n < 100000; ++n) {  // 5 s
    (void)body.run();
    off = feltgate::larger(off, std::abs(energy() - begin));
  }
  CHECK(off < 2 * angle * begin);
}

TEST_CASE("rigid body: stable where k dt^2 + 2 b dt < 4 J, by its runs") {
  feltgate::SplitMix64 random(2);
  int stable = 0, unstable = 0;
  for (const double rate_hz : {5.0, 10.0, 20.0, 50.0, 1000.0}) {
    for (int i = 0; i < 60; ++i) {
      const double k = random.between(0.01, 0.25), b = random.between(1e-4, 2e-3),
                   inertia = 0.05e-3 * std::pow(20, random.uniform());
      const double dt = 1 / rate_hz, share = (k * dt * dt + 2 * b * dt) / (4 * inertia);
      if (std::abs(share - 1) < 0.1) continue;
      Body body(rigid_body(rate_hz), b);
      body.set("stiffness", k);
      body.set("inertia", inertia);
      INFO(rate_hz << " Hz, k " << k << ", b " << b << ", J " << inertia << ": " << share);
      const Four hand = turn_about({1, 2, -1}, 1);
      body.hand(hand);
      body.put(product(turn_about({0, 1, 1}, 1e-6), hand), {});
      for (int n = 0; n < 400; ++n) (void)body.run();
      double largest = 0;
      for (int n = 0; n < 20; ++n) {
        for (const double torque : body.run().v)
          largest = feltgate::larger(largest, std::abs(torque));
      }
      CHECK((largest < 1e-5 * k) == (share < 1));
      ++(share < 1 ? stable : unstable);
    }
  }
  CHECK((stable > 60 && unstable > 60));
  // At its own rate nothing that a host can set is unstable.
  const double dt = 1 / shipped("rigid_body").rate_hz;
  CHECK(0.25 * dt * dt + 2 * 2e-3 * dt < 4 * 0.05e-3);
}
