// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// What the safety blocks must do, by their definitions. That the RTL is the twin: NAME_test.cpp.
// docs/safety.md
#include <cmath>
#include <string>

#include "block_design.hpp"
#include "catch.hpp"
#include "feltgate/axis/safety.hpp"
#include "random.hpp"

using namespace feltgate::test;

namespace {

/// The design's words.
Words<std::int64_t> words() {
  Words<std::int64_t> p;
  for (const Word& w : design().words) formats().load(p, w.address, w.reset);
  return p;
}
double lsb(const std::string& signal) { return std::ldexp(1.0, -design()[signal + "_F"]); }

}  // namespace

TEST_CASE("motor_heat: trips when sum = max(sum - Inom^2, 0) + I^2 says, and only armed") {
  const MotorHeat<Fixed> law(design());
  for (const double volts : {6.95, 12.0, -9.5}) {
    const Words<std::int64_t> p = words();
    const auto voltage = std::llround(volts / lsb("VOLTAGE"));
    std::int64_t sum = law.start, ticks = 0;
    const double current = volts * std::ldexp(static_cast<double>(p.inverse_resistance),
                                              -design()["P_INVERSE_RESISTANCE_F"]);
    const double nominal = static_cast<double>(p.nominal_current_squared) * lsb("CURRENT_SQUARED");
    const double budget = static_cast<double>(p.i2t_budget - law.start) * lsb("CURRENT_SQUARED");
    const double expected = budget / (current * current - nominal);
    CHECK(law.start == Approx(p.i2t_budget / 2).epsilon(0.01));  // nobody knows how hot it is
    for (const auto heat = law.tick(p, voltage, 0).current; !law.heat(sum, p, true, heat);
         ++ticks) {
    }
    CHECK(static_cast<double>(ticks) == Approx(expected).epsilon(0.002).margin(2));
    for (ticks = 0; sum > 0; ++ticks) law.heat(sum, p, false, law.tick(p, voltage, 0).current);
    CHECK(static_cast<double>(ticks) * nominal ==
          Approx(static_cast<double>(p.i2t_budget) * lsb("CURRENT_SQUARED")).epsilon(0.01));
  }
  // A lever that turns takes the back-EMF off the voltage.
  const double speed = 20, emf = 0.0302 * speed;
  const auto s =
      law.tick(words(), std::llround(emf / lsb("VOLTAGE")), std::llround(speed / lsb("VELOCITY")));
  CHECK(static_cast<double>(s.current) * lsb("CURRENT_ESTIMATE") == Approx(0).margin(0.03));
}

TEST_CASE("overspeed: above the limit, either way; no low-pass can jump, a flipped bit does") {
  const Overspeed<Fixed> law(design());
  const Words<std::int64_t> p = words();
  for (const int sign : {1, -1}) {
    CHECK_FALSE(law.tick({}, p, sign * p.overspeed).too_fast);
    CHECK(law.tick({}, p, sign * (p.overspeed + 1)).too_fast);
  }
  Random random(1);
  Overspeed<Fixed>::State s;
  const std::int64_t most = (std::int64_t{1} << (design()["VELOCITY_W"] - 1)) - 1;
  std::int64_t velocity = 0;
  for (int k = 0; k < 20'000; ++k) {
    const std::int64_t a1 = random.between(0, 131'071),
                       raw = random.coin() ? most : random.between(-most, most);
    velocity = Fixed::add_rounded(velocity, (raw - velocity) * a1,
                                  {design()["P_VELOCITY_A1_F"], Rounding::half_up});
    s = law.tick(s, p, velocity);
    if (s.jumped) FAIL("a low-pass jumps, tick " << k);
  }
  CHECK((!law.jumps ||
         law.tick(s, p, velocity ^ std::int64_t{1} << (design()["VELOCITY_W"] - 2)).jumped));
}

TEST_CASE(
    "polarity: trips after two windows of growth against the current, never on a steady speed") {
  const Polarity<Fixed> law(design());
  const Words<std::int64_t> p = words();
  const auto ticks_to_trip = [&](double rad_s2, double rad_s, double amperes, bool open) {
    Polarity<Fixed>::State s;
    for (int k = 1; k < 500'000; ++k) {
      const auto velocity = std::llround((rad_s + rad_s2 * k * 1e-6) / lsb("VELOCITY"));
      const auto j = law.tick(s, p, open, velocity, std::llround(amperes / lsb("CURRENT")));
      if (j.trip) return k;
      if (std::fabs(rad_s + rad_s2 * k * 1e-6) > 900) break;
      s = j.next;
    }
    return 0;
  };
  const double growth = 1.1 * static_cast<double>(p.polarity_speed) * lsb("VELOCITY") /
                        (static_cast<double>(p.polarity_ticks) * 1e-6);
  for (const int sign : {1, -1}) {
    const int ticks = ticks_to_trip(sign * growth, sign, -10 * sign, true);
    CHECK(ticks == Approx(static_cast<double>(Map::runaway_windows * p.polarity_ticks)).margin(3));
    CHECK(ticks_to_trip(sign * growth, sign, 10 * sign, true) == 0);    // along the current
    CHECK(ticks_to_trip(sign * growth, sign, -10 * sign, false) == 0);  // the gates are closed
    CHECK(ticks_to_trip(0.8 * sign * growth, sign, -10 * sign, true) == 0);
    CHECK(ticks_to_trip(0, 65 * sign, -10 * sign, true) == 0);
  }
}

TEST_CASE("hold_timer: derates after hold_time of a held torque; a count, or disarming, ends it") {
  Words<std::int64_t> p = words();
  p.hold_torque = 1000, p.hold_time = 3;
  HoldTimer<Fixed> timer;
  const std::uint32_t unit = 1U << Map::hold_unit_bits;
  std::uint32_t tick = 1;
  for (; !timer.derated && tick < 10 * unit; ++tick) timer.tick(p, true, tick, -1001, false);
  CHECK(tick == 3 * unit + 2);
  timer.tick(p, true, tick, 0, false);
  CHECK(timer.derated);  // a weak torque does not end it
  timer.tick(p, true, tick, -1001, true);
  CHECK_FALSE(timer.derated);
  for (std::uint32_t k = 0; k < 10 * unit; ++k) timer.tick(p, true, k, 1000, false);
  CHECK_FALSE(timer.derated);  // not above
  for (std::uint32_t k = 0; k < 10 * unit; ++k) timer.tick(p, k % unit != 1, k, 1001, false);
  CHECK_FALSE(timer.derated);
}

TEST_CASE("encoder_errors: eight trip, one is forgiven every 1024 ticks") {
  EncoderErrors e;
  const auto errors = [&e](int n) {
    int trips = 0;
    for (; n > 0; --n) trips += e.trip(true), e.clock(false, true);
    return trips;
  };
  const auto ticks = [&e](int n) {
    for (; n > 0; --n) e.clock(true, false);
  };
  CHECK(errors(7) == 0);
  CHECK(errors(1) == 1);
  CHECK(errors(7) == 0);
  ticks(1024);
  CHECK(errors(1) == 0);
  CHECK(errors(1) == 1);
  for (int k = 0; k < 30; ++k) {
    CHECK(errors(1) == 0);
    ticks(1030);
  }
}

TEST_CASE("watchdog: sleeps until the first kick, then trips after its ticks without one") {
  Words<std::int64_t> p = words();
  p.watchdog_ticks = 100;
  Watchdog dog;
  const auto ticks_to_trip = [&](int most) {
    for (int k = 1; k <= most; ++k) {
      dog.tick(true, true, false);
      dog.start(p);
      if (dog.trip(true)) return k;
    }
    return 0;
  };
  CHECK(ticks_to_trip(1000) == 0);
  dog.tick(true, true, true);
  CHECK(ticks_to_trip(1000) == 100);
  CHECK_FALSE(dog.trip(false));  // with closed gates
}

TEST_CASE("fault_latch: the first cause stays, of two at once the lower number, until the clear") {
  FaultLatch latch;
  latch.clock(false, 1U << 9 | 1U << 4);
  latch.clock(false, 1U << 2);
  CHECK((latch.first == 4 && latch.faults == (1U << 9 | 1U << 4 | 1U << 2)));
  latch.clock(true, 1U << 7);
  CHECK((latch.first == 7 && latch.faults == 1U << 7));  // a cause in the clock of the clear
}

TEST_CASE("stop_latch: a stop trips after two clocks and holds until no fault is latched") {
  StopLatch s;
  for (int k = 0; k < 6; ++k) s.clock(false, false, false);
  CHECK_FALSE((s.stopped() || s.gates_clear(false)));
  CHECK(s.gates_clear(true));  // without a clock
  s.see(true);
  int clocks = 0;
  for (; !s.trip(true); ++clocks) {
    CHECK(s.gates_clear(false));
    s.clock(false, true, false);
  }
  CHECK(clocks == 2);
  for (int k = 0; k < 100; ++k) s.clock(false, false, true);
  CHECK(s.stopped());
  for (int k = 0; k < 4; ++k) s.clock(false, false, false);
  CHECK_FALSE((s.stopped() || s.gates_clear(false)));
}

TEST_CASE(
    "tick_monitor: trips one PWM period after the longest tick, whether the tick is stuck low or "
    "high") {
  const int most = TickMonitor::most(design());
  CHECK(most * design()["PWM_PERIOD"] >= design()["CLOCKS_PER_TICK"]);
  for (const bool stuck : {false, true}) {
    TickMonitor m;
    for (int k = 0; k < 10; ++k) m.clock(k % 2 == 0, true, most);
    m.clock(true, false, most), m.clock(stuck, false, most);
    int periods = 0;
    for (; !m.trip(true, most) && periods < 100; ++periods) m.clock(stuck, true, most);
    CHECK(periods == most);
  }
}

TEST_CASE(
    "arming: a rising request of the owner opens the gates, and what stands against it refuses it "
    "for good") {
  const int wait = Arming::wait_ticks(design());
  CHECK((wait + 1) * design()["CLOCKS_PER_TICK"] == Approx(0.020 * design()["CLOCK_HZ"]));
  const auto opens = [wait](auto&& change, int ticks = 1) {
    Arming a;
    Arming::In in;
    in.panel_arm = true;
    a.clock(true, in, false, wait);  // high since the reset
    CHECK_FALSE(a.open());
    in.panel_arm = false;
    a.clock(true, in, false, wait);
    in.panel_arm = true;
    change(in, true);
    for (int k = 0; k < ticks; ++k) a.clock(true, in, false, wait);
    CHECK_FALSE((ticks > 1 && a.open()));
    change(in, false);
    a.clock(true, in, false, wait);
    return a.open();
  };
  CHECK(opens([](Arming::In&, bool) {}));
  CHECK_FALSE(opens([](Arming::In& in, bool on) { in.fault = on; }));
  CHECK_FALSE(opens([](Arming::In& in, bool on) { in.stopped = on; }));
  CHECK_FALSE(opens([](Arming::In& in, bool on) { in.kick_missing = on; }));
  CHECK_FALSE(opens([](Arming::In& in, bool on) { in.refuse = on; }));
  CHECK_FALSE(opens([](Arming::In& in, bool on) { in.host = on; }));
  const auto waits = [](Arming::In& in, bool on) { in.wait = on; };
  CHECK(opens(waits, wait - 1));  // another axis does not request yet
  CHECK_FALSE(opens(waits, wait + 1));
}

TEST_CASE(
    "arming: a trip closes the gates in the next clock, a change of owner or a disarm at the "
    "tick's end") {
  Random random(2);
  Arming a;
  Arming::In in;
  bool stopped = false, owner = false;
  int opened = 0;
  const int wait = Arming::wait_ticks(design());
  for (int k = 0; k < 500'000; ++k) {
    const bool tick = random.one_in(4), trip = random.one_in(200);
    const auto flip = [&random](bool& bit, int on, int off) {
      if (random.one_in(static_cast<std::uint64_t>(bit ? on : off))) bit = !bit;
    };
    flip(in.host_arm, 100, 20), flip(in.panel_arm, 100, 20), flip(in.host, 500, 500);
    flip(in.fault, 20, 400), flip(in.stopped, 5, 400), flip(in.disarm, 1, 300);
    flip(in.wait, 20, 100), flip(in.refuse, 20, 200), flip(in.kick_missing, 20, 400);
    const bool open = a.open(), armed = a.armed();
    const bool asked = (in.host ? in.host_arm : in.panel_arm) && !in.disarm;
    stopped = stopped || in.stopped;
    a.clock(tick, in, trip, wait);
    if (a.open() && (trip || (tick && (!asked || in.fault || stopped)))) FAIL("open, clock " << k);
    if (a.open() && !open && (!tick || in.kick_missing || in.wait || in.refuse))
      FAIL("opens, clock " << k);
    if (a.open() && open && tick && in.host != owner) FAIL("the other's, clock " << k);
    if (a.armed() != armed && !tick) FAIL("armed changes amid a tick, clock " << k);
    opened += a.open() && !open;
    if (tick) owner = in.host, stopped = false;
  }
  CHECK(opened > 300);
}

TEST_CASE(
    "self_test: a lever that answers is right, the wrong way trips, held or never at rest as the "
    "words say") {
  const auto result = [](int direction, bool rests, unsigned arms) {
    Words<std::int64_t> p = words();
    p.self_test_quiet = 2, p.self_test_pulse = 3, p.self_test_arms = arms;
    SelfTest test;
    int travel = 0, trips = 0, pulses = 0;
    std::uint32_t count = 0;
    test.start(p, false, false, false, count);
    for (; count < (4U << Map::self_test_patience_bits) && (count == 0 || test.busy(true));
         ++count) {
      pulses += test.pulse();
      if (!rests || (direction != 0 && count % 64 == 0))
        travel += rests ? direction * test.pulse() : 1;
      test.sample(static_cast<unsigned>(travel) & 3);
      test.start(p, true, false, false, count);
      trips += test.failed();
      if (trips != 0) break;
    }
    CHECK((trips != 0 || pulses == 0));  // a pulse and its opposite are equally long
    return 10 * trips + test.result();
  };
  CHECK(result(1, true, 0) == Map::self_test_right);
  CHECK(result(-1, true, 3) == 10);
  CHECK(result(0, true, 0) == 10 + Map::self_test_held);
  CHECK(result(0, true, 1U << Map::self_test_held_bit) == Map::self_test_held);
  CHECK(result(1, false, 0) == 10 + Map::self_test_moving);
  CHECK(result(1, false, 1U << Map::self_test_moving_bit) == Map::self_test_moving);
}
