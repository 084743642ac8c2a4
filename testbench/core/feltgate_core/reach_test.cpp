// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Directed tests of states that a random run would reach only by luck: each word of the snapshot,
// positions at the ends of the scenes' range, the torque limit, the watchdog, and known heat.
// Twin against expected values, RTL against twin. Documentation: docs/architecture.md
#include "core_coverage.hpp"
#include "core_life.hpp"

using namespace feltgate::test;
using feltgate::CoreOut;
using feltgate::Fault;
using feltgate::Map;
using D = feltgate::test::Design;
using R = Map::R;

TEST_CASE("core: each word of the snapshot is that of the pins, in every phase of the motion") {
  Life s;
  s.arm(D::S::spring_tension);
  std::int64_t index = 0, errors = 0;
  std::array<std::int64_t, 64> changes{};
  std::array<std::uint32_t, 64> before{};
  for (int k = 0; k < 200; ++k) {
    // An event in each clock of a tick: an edge, an index, an illegal step.
    s.to_clock(0);
    s.clocks(k % kTick);
    if (k % 7 == 6) {
      s.in.encoder.a = !s.in.encoder.a;
      s.in.encoder.b = !s.in.encoder.b;
      ++errors;
      s.clocks(kTick);
      s.in.encoder.a = !s.in.encoder.a;
      s.in.encoder.b = !s.in.encoder.b;
      ++errors;
    } else if (k % 3 == 2) {
      s.in.encoder.z = !s.in.encoder.z;
      if (s.in.encoder.z) index = s.out().position;
    } else {
      s.step(k % 50 < 40);
    }
    s.to_clock(0);
    if (k % 5 == 0) s.ticks(1);
    // All words are of the tick that ended, and are read in one tick.
    const CoreOut o = s.shown();
    const auto check = [&](const char* name, int slot, std::uint32_t expected) {
      const std::uint32_t word = s.read(C::snapshot + slot);
      INFO(name << ", round " << k);
      REQUIRE(word == expected);
      const auto at = static_cast<std::size_t>(slot);
      changes[at] += word != before[at];
      before[at] = word;
    };
    check("tick", R::tick, o.tick_count);
    check("position", R::position, low(o.position));
    check("velocity", R::velocity, low(o.velocity));
    check("tau_hat", R::tau_hat, low(o.tau_hat));
    check("tau_ref", R::tau_ref, low(o.tau_ref));
    check("current_ref", R::current_ref, low(o.current_ref));
    check("voltage", R::voltage, low(o.voltage));
    check("duty", R::duty, low(o.duty));
    const std::uint32_t status = s.read(C::snapshot + R::status);
    changes[R::status] += status != before[R::status];
    before[R::status] = status;
    CHECK(((status >> C::status_scene) & 15u) == o.scene);
    CHECK(((status >> C::status_armed) & 1u) == o.armed);
    CHECK(((status >> C::status_encoder_error) & 1u) == (errors > 0));
    // These values change in the middle of a tick: they are checked when they are at rest.
    if (k % 5 != 0) continue;
    check("faults", R::faults,
          std::uint32_t{o.faults} << C::faults_seen | std::uint32_t{o.first_fault}
                                                          << C::faults_first);
    CHECK(s.read(C::snapshot + R::encoder) == low(errors));
    const std::uint32_t seen = s.read(C::snapshot + R::index);
    CHECK(std::abs(static_cast<std::int32_t>(seen) - index) <= 1);
    changes[R::encoder] += s.out().reg_rdata != before[R::encoder];
    changes[R::index] += seen != before[R::index];
    before[R::index] = seen;
  }
  for (const int slot : feltgate::test::snapshot_slots) {
    INFO("slot " << slot);
    CHECK(changes[static_cast<std::size_t>(slot)] > 0);
  }
  s.play();
}

TEST_CASE("core: scenes see positions up to both ends of 18 bits, and the end beyond") {
  constexpr std::int32_t end = (1 << (D::f.scene_position.width() - 1)) - 1;
  for (const bool up : {true, false}) {
    Life s;
    s.write(A::overspeed, 0x7fffffff);
    s.write(A::polarity_speed, 0x7fffffff);
    // A spring that begins a few counts before the end, with a visible torque per count.
    constexpr int counts_fraction = 8;
    const std::int64_t rest = (up ? end - 3 : -end - 1 + 3) * (std::int64_t{1} << counts_fraction);
    s.write(A::tension_rest, low(rest));
    s.write(A::tension_stiffness, (1u << D::P::tension_stiffness.width()) / 4);
    s.write(C::control, kHost & ~(15u << C::control_filter));
    s.move((up ? 1 : -1) * (std::int64_t{end} - 6), 1);
    s.arm(D::S::spring_tension);
    s.ticks(4);
    REQUIRE(std::abs(s.out().position) == end - 6);
    std::vector<std::int32_t> torques;
    for (int k = -6; k < 12; ++k) {
      s.ticks(2);
      torques.push_back(s.shown().tau_ref);
      REQUIRE(s.out().position == (up ? end + k : -end - k));
      s.move(up ? 1 : -1, kTick);
    }
    // Each count is a step of torque up to the end and has no effect beyond it; the lower end is
    // one count further.
    const std::size_t last = up ? 6 : 7;
    for (std::size_t k = 1; k < torques.size(); ++k) {
      INFO("up " << up << ", count " << k << ": " << torques[k - 1] << ", " << torques[k]);
      REQUIRE((torques[k] != torques[k - 1]) == (k <= last));
    }
    s.disarm();
    s.move((up ? 1 : -1) * (std::int64_t{end} - 100), 1);  // just before the next higher bit
    s.arm(D::S::spring_tension);
    s.ticks(4);
    CHECK(s.shown().tau_ref == torques.back());
    s.play();
  }
}

TEST_CASE("core: every scene with a force comes to the torque limit, and no further") {
  constexpr std::int32_t limit = 40;
  for (const int scene :
       {D::S::setpoint, D::S::membrane, D::S::spring_compression, D::S::spring_tension,
        D::S::damper, D::S::charge_attract, D::S::charge_repel, D::S::wall}) {
    Life s;
    s.write(A::torque_limit, limit);
    s.write(A::setpoint_torque, 5'000);
    s.write(A::membrane_lower, low(-20 * 256));
    s.write(A::membrane_upper, 20 * 256);
    s.write(A::wall_contact, 0);
    s.move(-60, kTick);
    s.arm(scene);
    int reached = 0;
    for (int k = 0; k < 240; ++k) {
      s.move(k < 120 ? 1 : -1, 150);
      s.ticks(1);
      INFO("scene " << scene << ", step " << k);
      REQUIRE(std::abs(s.shown().tau_ref) <= limit);
      reached += s.shown().limits >> Map::L::torque & 1;
    }
    INFO("scene " << scene);
    CHECK(reached > 0);
    s.play();
  }
}

TEST_CASE("core: the watchdog is fed by a kick alone, and by one beside a clear") {
  constexpr int ticks = 40;
  for (const std::uint32_t others : {0u, 1u << C::command_clear_faults}) {
    Life s;
    s.write(A::watchdog_ticks, ticks);
    s.arm(D::S::free);
    s.ticks(3 * ticks);
    REQUIRE(s.out().gates_enable);  // the watchdog is off
    for (int k = 0; k < 4; ++k) {
      s.write(C::command, 1u << C::command_kick | others);
      s.ticks(ticks - 2);
    }
    REQUIRE(s.out().gates_enable);
    REQUIRE(s.ticks_to_fall(2 * ticks) <= 4);
    REQUIRE(s.only(Fault::watchdog));
    s.play();
  }
}

TEST_CASE("core: heat is that of the voltage less the back-EMF") {
  const auto design = [](int address) {
    for (const auto& p : D::parameters) {
      if (p.address == address) return std::ldexp(static_cast<double>(p.raw), -p.format.fraction);
    }
    return 0.0;
  };
  for (const int direction : {1, -1}) {
    Life s;
    s.write(A::overspeed, 0x7fffffff);
    s.write(A::polarity_speed, 0x7fffffff);
    s.write(A::nominal_current_squared, 0x7fffffff);
    s.write(A::voltage_window, (1u << (D::f.voltage.width() - 1)) - 1);
    s.write(A::voltage_setpoint, low(std::int64_t{6} << D::f.voltage.fraction));
    s.arm(D::S::free, Map::mode_voltage);
    s.move(direction * 1000, 2 * kTick);
    REQUIRE(s.out().gates_enable);
    // The sum is 0 until here; a tick adds the square of what voltage and velocity of the tick
    // before make.
    const auto current = [&](bool with_emf) {
      const double v = std::ldexp(s.shown().voltage, -D::f.voltage.fraction);
      const double w = std::ldexp(static_cast<double>(s.shown().velocity), -D::f.velocity.fraction);
      return v * design(A::inverse_resistance) -
             (with_emf ? w * design(A::emf_over_resistance) : 0.0);
    };
    const double budget = 150 * current(true) * current(true);
    REQUIRE(std::fabs(current(true) * current(true) / (current(false) * current(false)) - 1) > 0.2);
    s.write(A::i2t_budget, low(std::llround(4 * budget)));
    s.write(A::nominal_current_squared, 0);
    double sum = 0;
    int n = 0;
    while (s.out().gates_enable && n < 1'000) {
      if (n % 2 == 0) s.step(direction > 0);
      sum += current(true) * current(true);
      s.ticks(1);
      ++n;
    }
    INFO("direction " << direction << ", ticks " << n << ", sum " << sum << ", budget " << budget);
    REQUIRE(s.only(Fault::i2t));
    CHECK(n > 80);
    CHECK(std::fabs(sum / budget - 1) < 0.03);
    s.play();
  }
}

TEST_CASE("core: heat while the lever gathers speed is that of the velocity of each tick") {
  // Currents from 14 A to almost 0: a tick too early or too late would become many ticks at the
  // end.
  std::int64_t budget = 0xffffffff;
  for (const bool first : {true, false}) {
    Life s;
    s.write(A::overspeed, 0x7fffffff);
    s.write(A::polarity_speed, 0x7fffffff);
    s.write(A::nominal_current_squared, 0x7fffffff);
    s.write(A::voltage_setpoint, low(std::int64_t{6} << D::f.voltage.fraction));
    s.arm(D::S::free, Map::mode_voltage);
    s.ticks(4);
    s.write(A::i2t_budget, low(budget));
    s.write(A::nominal_current_squared, 0);
    const auto current = [&s] {
      const double v = std::ldexp(s.shown().voltage, -D::f.voltage.fraction);
      const double w = std::ldexp(static_cast<double>(s.shown().velocity), -D::f.velocity.fraction);
      return (v - 0.0302 * w) / 0.42;
    };
    double sum = 0;
    int n = 0;
    for (; s.out().gates_enable && (!first || current() > 2) && n < 2'000; ++n) {
      s.step(true);
      s.ticks(1);
      sum += current() * current();
    }
    INFO("ticks " << n << ", current " << current() << ", sum " << sum);
    REQUIRE(n < 2'000);
    if (first) {
      REQUIRE(s.out().gates_enable);
      budget = std::llround(4 * sum);
      continue;
    }
    REQUIRE(s.only(Fault::i2t));
    CHECK(std::fabs(current()) < 5);
    s.play();
  }
}
