// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The observer beside other controllers: the chain of the twin, closed forms at stall and in
// motion, eigenvalues. Documentation: docs/speed-for-accuracy.md
#include <algorithm>
#include <cmath>
#include <vector>

#include "catch.hpp"
#include "feltgate/generated/lever.hpp"
#include "feltgate/random.hpp"
#include "sim/plant/plant_file.hpp"
#include "sim/reference/chain.hpp"
#include "studies/controllers/controllers.hpp"

using namespace feltgate;
using namespace feltgate::controllers;

namespace {

const std::string kRoot = FELTGATE_ROOT;

Bench bench() {
  return {design::elaborate(design::read_design(kRoot + "/rtl/designs/lever.toml"),
                            design::read_registers(kRoot + "/rtl/registers.toml")),
          plant::read_plant_file(kRoot + "/vectors/plants/p24.toml"),
          plant::read_plant_file(kRoot + "/vectors/plants/linear.toml")};
}

void within(double value, double of, double share) {
  INFO(value << " against " << of);
  CHECK(std::abs(value / of - 1) < share);
}

// Constants of the plants, written again.
constexpr double kKt = 0.0302, kR = 0.42, kL = 82.3e-6, kJ = 1.22e-4, kG = 500, kShare = 0.78336;
constexpr double kWinding_s = kL / kR;

/// Both chains get the same counts and set-points; every integer of every tick must agree.
void equal_in_every_bit(RealChain& ours, RealChain& twin, int setpoint) {
  SplitMix64 random(7);
  ChainIn in;
  in.armed = true;
  in.scene = Map::scene_number("setpoint");
  int moved = 0;
  for (int tick = 0; tick < 20000; ++tick) {
    if (tick % 500 == 0) {
      const double torque = 1e-3 * static_cast<double>(random.below(901)) - 0.45;
      ours.set_parameter(setpoint, torque);
      twin.set_parameter(setpoint, torque);
    }
    const int step = static_cast<int>(random.below(64)) == 0 ? 1 : 0;
    in.position += tick < 12000 ? step : -step;
    in.travel = static_cast<std::int16_t>(in.position);
    ours.tick(in);
    twin.tick(in);
    const ChainRaw &a = *ours.raw(), &b = *twin.raw();
    REQUIRE(a.velocity == b.velocity);
    REQUIRE(a.tau_hat == b.tau_hat);
    REQUIRE(a.current_ref == b.current_ref);
    REQUIRE(a.voltage == b.voltage);
    REQUIRE(a.duty == b.duty);
    moved += a.tau_hat != 0 && a.duty != 0 ? 1 : 0;
  }
  CHECK(moved > 15000);
}

/// Of (num[0] + num[1] s) / (den[0] + den[1] s + s^2) / s, in partial fractions: the value at t.
double second_order(double n0, double n1, double d0, double d1, double t) {
  const double root = std::sqrt(d1 * d1 / 4 - d0), p = -d1 / 2 + root, q = -d1 / 2 - root;
  return n0 / d0 + (n0 + n1 * p) / (p * (p - q)) * std::exp(p * t) +
         (n0 + n1 * q) / (q * (q - p)) * std::exp(q * t);
}

/// When a response is within 2 % of 1 for good.
template <class Response>
double settles_ms(Response response) {
  double t = 0.03;
  while (t > 0 && std::abs(response(t) - 1) < 0.02) t -= 1e-6;
  return 1e3 * t;
}

/// A push on the frictionless lever, in real arithmetic and small steps, written from the block
/// diagram alone: what the motor adds to `push`, the observer from exact equations.
double inertia_by_hand(Kind kind, double push) {
  constexpr double dt = 1e-6, lag = 1 / kG, boxcar = 767e-6;
  double w = 0, filtered = 0, u = 0, i = 0, x = 0, sum = 0, fast = 0, w_10 = 0, volts = 0;
  std::vector<double> speeds(static_cast<std::size_t>(boxcar / dt), 0.0);
  std::size_t oldest = 0;
  double mean = 0;
  for (int k = 0; k < 20000; ++k) {
    if (k == 10000) w_10 = w;
    mean += (w - speeds[oldest]) / static_cast<double>(speeds.size());
    speeds[oldest] = w;
    oldest = oldest + 1 == speeds.size() ? 0 : oldest + 1;
    filtered += dt / lag * (mean - filtered);
    x += dt * kG * (u + kG * kJ * filtered - x);
    const double hat = x - kG * kJ * filtered, error = -hat;
    if (kind == Kind::observer) u = (1 - kShare) * hat;
    if (kind == Kind::feed_forward) u = 0;
    if (kind == Kind::reaction) u = -hat;
    if (kind == Kind::pi || kind == Kind::pid) {
      sum += dt * kShare * kG * error;
      u = kShare * error + sum;
    }
    if (kind == Kind::pid) {
      // The same PI through the lead (1 + a s)/(1 + b s), b = a/4.
      constexpr double a = kWinding_s, b = a / 4;
      fast += dt / b * (u - fast);
      u = fast + a / b * (u - fast);
    }
    volts += dt / 20e-6 * (kR * u / kKt + kKt * filtered - volts);  // a PWM period
    i += dt / kL * (volts - kR * i - kKt * w);
    w += dt / kJ * (kKt * i + push);
  }
  return push * 0.01 / (w - w_10) / kJ;
}

}  // namespace

TEST_CASE("controllers: feed-forward is the twin's chain, bit by bit") {
  const Bench b = bench();
  const auto ours = make_chain(Kind::feed_forward, true, tuning_of(b, b.plant));
  const auto twin = make_real_chain("lever", "fixed");
  equal_in_every_bit(*ours, *twin, Map::A::setpoint_torque);
}

TEST_CASE("controllers: the observer's word is what the generator gives it") {
  design::Design d = bench().design.design;
  d.kp_1_kg_m2 = kShare / kJ;
  const auto e = design::elaborate(d, design::read_registers(kRoot + "/rtl/registers.toml"));
  const design::Word& gain = e.word("observer_gain");
  CHECK(gain.format == Format{1, 3, 14});
  CHECK(gain.si == Approx((1 - kShare) / kKt).epsilon(1e-9));
}

TEST_CASE("controllers: settling at stall as by partial fractions") {
  const Bench b = bench();
  constexpr double r = 1 / kWinding_s, pole = kShare * kG;
  // PI and observer: share*(s + g)/(s + share*g) through the winding.
  const double slow = settles_ms(
      [&](double t) { return second_order(pole * r, kShare * r, pole * r, pole + r, t); });
  const double fast = settles_ms([&](double t) { return 1 - std::exp(-r * t); });
  // PID: its zero cancels the winding; its filter and the slow pole are left.
  constexpr double f = kWinding_s / derivative_filter;
  const double with_rate = settles_ms([&](double t) {
    return second_order(pole / f, kShare / f, pole / f, (1 + pole * kWinding_s) / f, t);
  });
  CHECK(slow == Approx(6.28).margin(0.01));
  CHECK(fast == Approx(0.767).margin(0.002));
  for (const Kind k : kinds) {
    INFO(name_of(k));
    const double wanted = k == Kind::observer || k == Kind::pi ? slow
                          : k == Kind::pid                     ? with_rate
                                                               : fast;
    // A PWM period and a tick later; the last clock of the duty is 0.86 % of the step.
    within(stall_step(b, k, false, b.plant).settling_ms, wanted + 0.02, 0.01);
    within(stall_step(b, k, true, b.plant).settling_ms, wanted + 0.02, 0.07);
  }
}

TEST_CASE("controllers: the observer's time constant is 1/g") {
  const Bench b = bench();
  plant::HandPhase locked;
  locked.kind = plant::HandPhase::Kind::kLocked;
  Trial trial{Kind::feed_forward, true, b.plant, {}};
  trial.hand.phases = {locked};
  double begun_s = -1, reached_s = -1;
  run(
      b, trial, 0.02, [](double) { return 0.2; },
      [&](double t, const stability::BitLoop& loop) {
        if (begun_s < 0 && loop.tau_ref_nm() > 0) begun_s = t;
        if (reached_s < 0 && loop.tau_hat_nm() > 0.2 * (1 - std::exp(-1))) reached_s = t;
      });
  within(reached_s - begun_s, 1 / kG, 0.002);
}

TEST_CASE("controllers: at stall none of them sees R or Kt") {
  const Bench b = bench();
  for (const Kind k : kinds) {
    INFO(name_of(k));
    const auto at = [&](double r, double kt) {
      plant::Parameters p = b.plant;
      p.motor.resistance_ohm *= r;
      p.motor.torque_constant_nm_a *= kt;
      return stall_step(b, k, false, p).final_error_pct;
    };
    CHECK(at(1, 1) == Approx(0).margin(0.01));
    CHECK(at(1.2, 1) == Approx(100 * (1 / 1.2 - 1)).margin(0.01));
    CHECK(at(1, 0.5) == Approx(-50).margin(0.01));
  }
}

TEST_CASE("controllers: the inertia that a push feels") {
  const Bench b = bench();
  // What the back-EMF law gives back late: Kt*Ke/R over the estimator's delay.
  constexpr double late = kKt * kKt / kR * (767e-6 / 2 + 1 / kG) / kJ;
  within(felt_inertia(b, Kind::observer, false), 1 / kShare + late, 0.005);
  within(felt_inertia(b, Kind::feed_forward, false), 1 + late, 0.005);
  for (const Kind k : kinds) {
    INFO(name_of(k));
    const double by_hand = inertia_by_hand(k, 0.02);
    within(felt_inertia(b, k, false), by_hand, 0.01);
    within(felt_inertia(b, k, true), by_hand, 0.02);
  }
}

TEST_CASE("controllers: borders as by eigenvalues; PI and PID have none") {
  const Bench b = bench();
  stability::LoopModel model = stability::make_model(b.design, b.linear);
  constexpr double damping = 0.005;
  within(border(b, Kind::feed_forward, true), stability::border(model, damping, 1).stiffness_nm_rad,
         0.04);
  model.torque_gain = kShare / kKt;
  model.observer_gain = (1 - kShare) / kKt;
  const double fed = stability::border(model, damping, 1).stiffness_nm_rad;
  within(border(b, Kind::observer, true), fed, 0.04);
  within(border(b, Kind::observer, false), fed, 0.04);
  CHECK(border(b, Kind::pi, true) == 0);
  CHECK(border(b, Kind::pid, true) == 0);
  // The lever under PI at Jn > J runs away; at half of it a soft wall holds.
  CHECK(border(b, Kind::pi, true, 0.5) > 1);
  // A hand's damping is what makes it hold.
  CHECK(held_border(b, Kind::pi, true) == stiffest_nm_rad);
  CHECK(held_border(b, Kind::pi, true, 0.02) < 2);
}

TEST_CASE("controllers: friction that the observer sees is no reaction") {
  using axis::Fixed;
  const Bench b = bench();
  const axis::Design lever = axis::Design::of<Lever>();
  const int torque_f = lever["TORQUE_F"], velocity_f = lever["VELOCITY_F"];
  const double friction = b.plant.lugre.coulomb_nm;
  const auto torque = [&](double speed, double seen) {
    ReactionLaw<Fixed> law(lever, tuning_of(b, b.plant));
    return Fixed::value(law.tick(0, Fixed::of(seen, torque_f), Fixed::of(speed, velocity_f)),
                        torque_f);
  };
  constexpr double lsb = 1.0 / 65536;
  for (const double speed : {-5.0, -1.0, -0.5, 0.25, 1.0, 20.0}) {
    INFO(speed);
    const double sliding = friction * std::min(1.0, std::max(-1.0, speed));
    CHECK(torque(speed, sliding) == Approx(0).margin(1.01 * lsb));
    CHECK(torque(speed, sliding + 0.1) == Approx(-0.1).margin(1.01 * lsb));
  }
}

TEST_CASE("controllers: every encoder's velocity is in rad/s") {
  const Bench b = bench();
  for (const int lines : noise_lines) {
    INFO(lines);
    const auto chain = make_chain(Kind::observer, true, tuning_of(b, b.plant), lines);
    const double count_rad = 2 * 3.141592653589793 / (4 * lines), speed_rad_s = 30;
    ChainIn in;
    double sum = 0;
    for (int tick = 0; tick < 40000; ++tick) {
      in.position = static_cast<std::int32_t>(speed_rad_s * 1e-6 * tick / count_rad);
      in.travel = static_cast<std::int16_t>(in.position);
      chain->tick(in);
      if (tick >= 20000) sum += chain->out().velocity_rad_s / 20000;
    }
    within(sum, speed_rad_s, 1e-3);
  }
  CHECK_THROWS_AS(make_chain(Kind::pi, true, tuning_of(b, b.plant), 1000), std::invalid_argument);
}
