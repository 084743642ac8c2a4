// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// What the laws of the chain must do, by their equations in real arithmetic: the distance stays
// within the bound. That the RTL is the twin: NAME_test.cpp. docs/testing.md
#include <cmath>
#include <functional>

#include "../campaigns/extremes/dead_band.hpp"
#include "catch.hpp"
#include "feltgate/axis/observer.hpp"
#include "feltgate/axis/ramp.hpp"
#include "feltgate/axis/scene.hpp"
#include "feltgate/axis/torque_law.hpp"
#include "feltgate/axis/velocity_estimator.hpp"
#include "feltgate/generated/exact.hpp"
#include "feltgate/generated/lever.hpp"
#include "feltgate/generated/paper.hpp"
#include "random.hpp"

using namespace feltgate::axis;
using feltgate::Map;
using feltgate::test::Random;

namespace {

constexpr double pi = 3.14159265358979;

/// A design's numbers in SI units and as the laws have them.
struct Numbers {
  explicit Numbers(Design design) : d(std::move(design)) {
    for (const Word& w : d.words) formats.load(p, w.address, w.reset);
  }
  double lsb(const std::string& signal) const { return std::ldexp(1.0, -d[signal + "_F"]); }
  std::int64_t raw(double value, const std::string& signal) const {
    return std::llround(value / lsb(signal));
  }
  double word(const std::string& name) const {
    for (const Word& w : d.words) {
      if (w.name != name) continue;
      const auto value =
          w.has_sign ? std::int64_t{static_cast<std::int32_t>(w.reset)} : std::int64_t{w.reset};
      return std::ldexp(static_cast<double>(value), -w.fraction);
    }
    FAIL("no word " << name);
    return 0;
  }
  /// Of the rounding at a register, in LSB.
  double rounding() const { return d.rounding() == Rounding::down ? 1 : 0.5; }

  double tick_s() const { return d["CLOCKS_PER_TICK"] / static_cast<double>(d["CLOCK_HZ"]); }
  /// Of a low-pass, in rad/s.
  double pole(const char* a1) const { return -std::log1p(-word(a1)) / tick_s(); }

  Design d;
  WordFormats formats{d};
  Words<std::int64_t> p;
};

template <class F>
void each_design(F&& f) {
  f(Numbers(Design::of<feltgate::Lever>()), "lever");
  f(Numbers(Design::of<feltgate::Paper>()), "paper");
  f(Numbers(Design::of<feltgate::Exact>()), "exact");
}
double limited(double x, double limit) { return std::fmax(-limit, std::fmin(limit, x)); }

}  // namespace

TEST_CASE("velocity: w += a1 (gain * counts - w), within the low-pass's dead band") {
  each_design([](const Numbers& n, const char* name) {
    CAPTURE(name);
    const double gain = n.d["VELOCITY_GAIN"] == 0
                            ? std::ldexp(1.0, n.d["VELOCITY_SHIFT"])
                            : std::ldexp(n.d["VELOCITY_GAIN"], -n.d["VELOCITY_GAIN_F"]);
    CHECK(gain ==
          Approx(2 * pi / 4096 / (n.d["M1"] * n.tick_s())).epsilon(0.0066));  // paper: 386 of 383.5
    const VelocityEstimator<Fixed> law(n.d);
    VelocityEstimator<Fixed>::State s;
    Random random(1);
    double exact = 0, worst = 0;
    std::int16_t counts = 0;
    const auto most = static_cast<std::int64_t>(400 / gain);
    const double a1 = n.word("velocity_a1");
    CHECK(n.pole("velocity_a1") == Approx(std::string(name) == "exact" ? 700 : 500).epsilon(1e-3));
    for (int k = 0; k < 100'000; ++k) {
      if (random.one_in(500)) counts = static_cast<std::int16_t>(random.between(-most, most));
      s = law.tick(s, n.p, counts);
      exact += a1 * (gain * counts - exact);
      worst =
          std::fmax(worst, std::fabs(static_cast<double>(s.velocity) * n.lsb("VELOCITY") - exact));
    }
    CHECK(worst <= n.rounding() * n.lsb("VELOCITY") / a1);
  });
}

TEST_CASE("velocity: where the low-pass comes to rest, by each rounding") {
  using feltgate::Round;
  for (const auto& [way, round] : {std::pair{Rounding::half_up, Round::half_up},
                                   {Rounding::down, Round::truncate},
                                   {Rounding::half_to_even, Round::convergent}}) {
    Design d = Design::of<feltgate::Lever>();
    d.constants["ROUNDING"] = static_cast<int>(way);
    const VelocityEstimator<Fixed> law(d);
    Words<std::int64_t> p;
    p.velocity_a1 = 67109;  // 500 rad/s
    std::int64_t low = 0, high = 0;
    for (const std::int16_t counts : std::array<std::int16_t, 5>{-100, -1, 0, 1, 100}) {
      for (const std::int64_t from : {-(1 << 20), 1 << 20}) {
        VelocityEstimator<Fixed>::State s, before;
        s.velocity = law.speed(counts) + from;
        do {
          before = s;
          s = law.tick(s, p, counts);
        } while (s.velocity != before.velocity);
        low = std::min(low, s.velocity - law.speed(counts));
        high = std::max(high, s.velocity - law.speed(counts));
      }
    }
    const auto band = feltgate::extremes::dead_band(round, p.velocity_a1, d["P_VELOCITY_A1_F"]);
    CHECK(low == band.low);
    CHECK(high == band.high);
  }
}

TEST_CASE("velocity: the window has the counts of the last ticks, from the reset on") {
  TravelWindow window;
  std::array<std::int16_t, 5> line{};
  for (int k = 0; k < 200; ++k) {
    const auto travel = [](int at) { return static_cast<std::int16_t>(at < 0 ? 0 : 7 * at * at); };
    CHECK(window.counts(travel(k)) == static_cast<std::int16_t>(travel(k) - travel(k - 5)));
    window.tick(line.data(), 5, travel(k));
  }
}

namespace {

struct Observed {
  explicit Observed(const Numbers& numbers) : n(numbers) {}
  double tick(double amperes, double rad_s, bool armed = true) {
    s = law.tick(s, n.p, armed, n.raw(amperes, "CURRENT"), n.raw(rad_s, "VELOCITY"));
    return static_cast<double>(s.tau_hat) * n.lsb("TORQUE");
  }
  const Numbers& n;
  Observer<Fixed> law{n.d};
  Observer<Fixed>::State s;
};

}  // namespace

TEST_CASE("observer: at stall tau_hat is the low-pass of Ktn * I; moving, the load with its sign") {
  each_design([](const Numbers& n, const char* name) {
    CAPTURE(name);
    const double pole = n.pole("observer_a1"), tick_s = n.tick_s(), lsb = n.lsb("TORQUE");
    const double ktn = n.word("torque_constant"), jn = n.word("inertia_gain") / pole;
    CHECK(pole == Approx(std::string(name) == "exact" ? 520 : 500).epsilon(1e-3));
    for (const double torque : {0.5, 0.1, -0.3}) {
      Observed stall(n);
      const double amperes = std::round(torque / ktn / n.lsb("CURRENT")) * n.lsb("CURRENT");
      double worst = 0;
      for (int k = 1; k <= 30'000; ++k) {
        const double exact = -ktn * amperes * std::expm1(-pole * tick_s * k);
        worst = std::fmax(worst, std::fabs(stall.tick(amperes, 0) - exact));
      }
      CHECK(worst <= 1.01 * lsb);
    }
    Observed free(n), braked(n);
    double load = 0, none = 0;
    for (int k = 1; k <= 40'000; ++k) {
      none = std::fmax(none, std::fabs(free.tick(0.1 / ktn, 0.1 / jn * tick_s * k)));
      load = braked.tick(0.1 / ktn, 10 - 0.05 / jn * tick_s * k);
    }
    CHECK(none <= 0.1 * pole * tick_s + 3 * lsb);
    CHECK(load == Approx(0.15).margin(5e-5 + 0.1 * pole * tick_s));
  });
}

TEST_CASE("observer: arming in motion makes no jump, disarming ends the estimate at once") {
  each_design([](const Numbers& n, const char* name) {
    CAPTURE(name);
    Observed o(n);
    const double gain = n.word("torque_constant") * 2,
                 limit = gain * n.pole("observer_a1") * n.tick_s() + n.word("inertia_gain") * 1e-4 +
                         2 * n.lsb("TORQUE");
    double before = 0, most = 0, jump = 0;
    for (int k = 0; k < 14'000; ++k) {
      const bool armed = k >= 1000 && k < 12'000;
      const double now = o.tick(2, 30 + k * 1e-4, armed);
      if (!armed && now != 0) FAIL("disarmed, tick " << k);
      if (k != 12'000) jump = std::fmax(jump, std::fabs(now - before));
      most = std::fmax(most, before = now);
    }
    CHECK(jump <= limit);
    CHECK(most > gain / 4);
  });
}

TEST_CASE("torque_law: current, voltage and duty by their equations") {
  each_design([](const Numbers& n, const char* name) {
    CAPTURE(name);
    const TorqueLaw<Fixed> law(n.d);
    const bool paper = std::string(name) == "paper";
    if (std::string(name) == "lever") {  // I = tau/Ktn, V = R I + Ke w + 0.34 V
      CHECK(n.word("torque_gain") == Approx(1 / 0.0302).epsilon(1e-4));
      CHECK(n.word("voltage_gain") == Approx(0.42).epsilon(1e-4));
      CHECK(n.word("emf_constant") == Approx(0.0302).epsilon(1e-4));
    } else if (paper) {  // reading A: Jn Kp = 0.78336
      CHECK(n.word("torque_gain") == Approx(0.78336 / 0.0605).epsilon(1e-4));
      CHECK(n.word("observer_gain") == Approx(0.21664 / 0.0605).epsilon(1e-4));
    }
    Random random(2);
    const auto any = [&](double range, const char* signal) {
      return std::round(range * static_cast<double>(random.between(-1000, 1000)) / 1000 /
                        n.lsb(signal)) *
             n.lsb(signal);
    };
    double worst_current = 0, worst_voltage = 0, worst_duty = 0;
    for (int k = 0; k < 50'000; ++k) {
      const double tau_ref = any(0.6, "TORQUE"), tau_hat = any(0.6, "TORQUE"),
                   w = any(100, "VELOCITY");
      const bool closed = random.coin();
      const auto s = law.tick({}, n.p, true, closed ? 0 : Map::mode_open, n.raw(tau_ref, "TORQUE"),
                              n.raw(tau_hat, "TORQUE"), n.raw(w, "VELOCITY"));
      const double current = limited(
          n.word("torque_gain") * tau_ref + (closed ? n.word("observer_gain") * tau_hat : 0),
          n.word("current_limit"));
      const bool high = std::fabs(tau_ref) > n.word("region_torque");
      const double emf = n.word("emf_constant") * w,
                   dead = limited(n.word("dead_voltage_slope") * tau_ref, n.word("dead_voltage"));
      const double r = n.word(high ? "voltage_gain_high" : "voltage_gain");
      const double over = r * current + dead - (n.d["EMF_IN_LAW"] != 0 ? 0 : emf);
      const double voltage = limited(over, n.word("voltage_window")) + emf;
      const double duty = limited(n.word("duty_gain") * voltage, n.word("duty_limit"));
      worst_current = std::fmax(
          worst_current, std::fabs(static_cast<double>(s.current) * n.lsb("CURRENT") - current));
      worst_voltage = std::fmax(
          worst_voltage, std::fabs(static_cast<double>(s.voltage) * n.lsb("VOLTAGE") - voltage));
      worst_duty = std::fmax(worst_duty, std::fabs(static_cast<double>(s.duty) - duty));
    }
    // Each product loses less than an LSB.
    const double volts = 4 * n.lsb("VOLTAGE") + 2 * n.lsb("CURRENT") * n.word("voltage_gain");
    CHECK(worst_current <= 2 * n.lsb("CURRENT"));
    CHECK(worst_voltage <= volts);
    CHECK(worst_duty <= n.rounding() + n.word("duty_gain") * volts);
  });
}

TEST_CASE("torque_law: voltage mode goes to its set-point by a step a tick; disarmed, all are 0") {
  each_design([](Numbers n, const char* name) {
    CAPTURE(name);
    const TorqueLaw<Fixed> law(n.d);
    n.p.voltage_setpoint = n.raw(1, "VOLTAGE");
    TorqueLaw<Fixed>::State s;
    const auto ticks = (n.p.voltage_setpoint + n.p.voltage_step - 1) / n.p.voltage_step;
    for (std::int64_t k = 1; k <= ticks + 2; ++k) {
      s = law.tick(s, n.p, true, Map::mode_voltage, 0, 0, 0);
      CHECK(s.voltage == std::min(k * n.p.voltage_step, n.p.voltage_setpoint));
      if (k > 2000) break;
    }
    s = law.tick(s, n.p, false, Map::mode_voltage, 1000, 1000, 1000);
    CHECK(
        (s.current == 0 && s.voltage == 0 && s.duty == 0 && !s.limit_current && !s.limit_voltage));
  });
}

TEST_CASE("torque_law: with the observer at stall, paper's loop has its pole at 391.68 rad/s") {
  const Numbers n(Design::of<feltgate::Paper>());
  const TorqueLaw<Fixed> law(n.d);
  Observer<Fixed> observer(n.d);
  Observer<Fixed>::State o;
  TorqueLaw<Fixed>::State s;
  const auto tau_ref = n.raw(0.2, "TORQUE");
  double at_1ms = 0, at_5ms = 0;
  for (int k = 1; k <= 40'000; ++k) {
    o = observer.tick(o, n.p, true, s.current, 0);
    s = law.tick(s, n.p, true, 0, tau_ref, o.tau_hat, 0);
    (k <= 1000   ? at_1ms
     : k <= 5000 ? at_5ms
                 : at_5ms) = k <= 5000 ? static_cast<double>(o.tau_hat) : at_5ms;
  }
  const auto target = static_cast<double>(tau_ref);
  CHECK(std::log((target - at_1ms) / (target - at_5ms)) / 0.004 == Approx(391.68).epsilon(0.002));
  CHECK(std::fabs(static_cast<double>(o.tau_hat) - target) <= 1);
}

TEST_CASE(
    "ramp: at most a step a tick until the target is reached, then not slowed; never beyond a "
    "limit") {
  Numbers n(Design::of<feltgate::Lever>());
  const Ramp<Fixed> law(n.d);
  Ramp<Fixed>::State s;
  Random random(3);
  Ramp<Fixed>::In in;
  bool reached = false;
  std::int64_t steps = 0, follows = 0, frozen = 0;
  for (int k = 0; k < 200'000; ++k) {
    const auto before = s;
    const bool scene = random.one_in(3000), arms = !in.armed;
    if (random.one_in(40)) in.torque = random.between(-70'000, 70'000);
    if (random.one_in(500)) in.frozen = random.coin();
    if (random.one_in(2000)) in.derated = random.coin();
    if (random.one_in(2000)) n.p.ramp_step = random.between(1, 1 << 16);
    in.armed = !random.one_in(1500);
    if (scene) in.scene ^= 1;
    s = law.tick(s, n.p, in);
    const std::int64_t limit =
        in.derated ? std::min(n.p.torque_limit, n.p.hold_limit) : n.p.torque_limit;
    const std::int64_t target = Fixed::limited(in.torque, limit), moved = s.ramp - before.ramp;
    CHECK_FALSE((in.armed && s.limit_torque) != (in.torque != target && in.armed));
    if (scene || arms || !in.armed || in.derated != before.limit_hold) reached = false;
    if (!in.armed) continue;
    if (in.frozen) {
      ++frozen;
      if (std::abs(s.tau_ref) > std::abs(before.tau_ref) || (s.ramp < 0) != (before.ramp < 0)) {
        if (s.ramp != 0) FAIL("frozen, it grows or turns, tick " << k);
      }
    } else if (!reached) {
      ++steps;
      const bool there = s.tau_ref == target;
      if (!there && std::abs(moved) > n.p.ramp_step) FAIL("more than a step, tick " << k);
      if (there) reached = true;
    } else {
      ++follows;
      if (s.tau_ref != target) FAIL("slowed, tick " << k);
    }
  }
  CHECK((steps > 1000 && follows > 1000 && frozen > 1000));
}

namespace {

/// Torque of a scene as the twin has it and by its equation, in LSB.
struct Scenes {
  explicit Scenes(const Numbers& n)
      : law(n.d), p(n.p), lsb(n.lsb("TORQUE")), velocity_lsb(n.lsb("VELOCITY")), position_w(26) {
    charge_lsb = n.lsb("CHARGE");
    fraction = [&n](const char* word) {
      return std::ldexp(1.0, -n.d[std::string("P_") + word + "_F"]);
    };
  }
  double torque(int scene, std::int32_t position, std::int64_t velocity) {
    s = law.tick(s, p, true, scene, position, velocity, {});
    return static_cast<double>(s.torque) * lsb;
  }
  Scene<Fixed> law;
  Scene<Fixed>::State s;
  Words<std::int64_t> p;
  double lsb, velocity_lsb, charge_lsb = 0;
  int position_w;
  std::function<double(const char*)> fraction;
};

}  // namespace

TEST_CASE("scene: within one step of torque of the equations") {
  using S = Map::S;
  each_design([](const Numbers& n, const char* name) {
    CAPTURE(name);
    Scenes scenes(n);
    auto& p = scenes.p;
    Random random(4);
    for (const int scene : {S::setpoint, S::spring_compression, S::spring_tension, S::damper,
                            S::charge_attract, S::charge_repel, S::wall}) {
      double worst = 0;
      int acting = 0;
      for (int k = 0; k < 20'000; ++k) {
        const auto range = std::int64_t{1} << random.between(2, 14);
        const auto position = static_cast<std::int32_t>(random.between(-range, range));
        const auto velocity = random.between(-(1 << 28), 1 << 28);
        p.first = random.between(-range, range) << 8 | random.between(0, 255);
        p.stiffness = random.between(0, 131'071), p.slope = random.between(0, 131'071),
        p.damping = random.between(0, 131'071);
        p.core = random.between(0, 400), p.strength = random.between(0, 0xffff'ffff),
        p.torque = random.between(-65'536, 65'536);
        const double got = scenes.torque(scene, position, velocity);
        const double x =
            position - static_cast<double>(p.first) / 256;  // counts above the reference
        const auto whole = static_cast<double>(position - (p.first >> 8));  // of a charge
        const double w = static_cast<double>(velocity) * scenes.velocity_lsb;
        const auto k_of = [&](const char* word) {
          return static_cast<double>(p.stiffness) * scenes.fraction(word);
        };
        double exact = 0, bound = 1;
        if (scene == S::setpoint) exact = static_cast<double>(p.torque) * scenes.lsb;
        if (scene == S::spring_tension || (scene == S::spring_compression && x <= 0))
          exact = -k_of("TENSION_STIFFNESS") * x;
        if (scene == S::damper)
          exact = -static_cast<double>(p.damping) * scenes.fraction("DAMPER_DAMPING") * w;
        if (scene == S::wall && x > 0) {
          const double push = -k_of("WALL_STIFFNESS") * x,
                       most = std::ldexp(1.0, n.d["SCENE_PART_W"] - 1 - n.d["SCENE_PART_F"]);
          exact = std::fmin(0, limited(push, most) - static_cast<double>(p.damping) *
                                                         scenes.fraction("WALL_DAMPING") * w);
        }
        if (scene == S::charge_attract || scene == S::charge_repel) {
          const double sign = scene == S::charge_attract ? -1 : 1;
          if (std::fabs(whole) <= static_cast<double>(p.core) && p.core != 0) {
            exact =
                sign * static_cast<double>(p.slope) * scenes.fraction("ATTRACT_CORE_SLOPE") * whole;
          } else {
            const double most = 65'535 * scenes.charge_lsb;  // the divider gives 16 bits
            const double size = whole == 0
                                    ? most
                                    : std::fmin(most, std::floor(static_cast<double>(p.strength) /
                                                                 (whole * whole)) *
                                                          scenes.charge_lsb);
            exact = whole < 0 ? -sign * size : whole > 0 ? sign * size : got < 0 ? -size : size;
          }
        }
        if (scene == S::wall) bound = 1.5;  // two products
        worst = std::fmax(worst, std::fabs(got - exact) / scenes.lsb / bound);
        acting += got != 0;
      }
      CAPTURE(scene);
      CHECK((worst <= 1 || !scenes.law.has(scene)));
      CHECK((acting > 500) == scenes.law.has(scene));
    }
  });
}

TEST_CASE(
    "scene: membrane, damper and wall only take energy; a membrane's sign is of the side of "
    "entry") {
  using S = Map::S;
  Numbers n(Design::of<feltgate::Lever>());
  Scenes scenes(n);
  scenes.p.first = 300 << 8, scenes.p.second = 420 << 8, scenes.p.torque = n.raw(0.5, "TORQUE");
  Random random(5);
  double work = 0;
  int position = 0, drift = 0, inside = 0;
  for (int k = 0; k < 200'000; ++k) {
    if (random.one_in(100)) drift = static_cast<int>(random.between(-1, 1));
    const int step = position > 900 ? -1 : position < -200 ? 1 : drift;
    const double torque = scenes.torque(S::membrane, position, 0);
    work += torque * step;  // of the motor on the hand
    if (work > 1) FAIL("the membrane gives energy, tick " << k);
    if (position < 300 || position > 420)
      work = 0;
    else
      ++inside;
    if (torque != 0 && std::fabs(torque) != 0.5) FAIL("torque " << torque);
    position += step;
  }
  CHECK(inside > 1000);
  scenes.p.damping = 40'000, scenes.p.stiffness = 40'000, scenes.p.first = 0;
  for (int k = 0; k < 20'000; ++k) {
    const auto velocity = random.between(-(1 << 30), 1 << 30);
    CHECK_FALSE(scenes.torque(S::damper, 0, velocity) * static_cast<double>(velocity) > 0);
    CHECK_FALSE(
        scenes.torque(S::wall, static_cast<std::int32_t>(random.between(-500, 500)), velocity) > 0);
  }
}
