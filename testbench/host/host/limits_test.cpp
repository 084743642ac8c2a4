// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// A limit is a magnitude: under load a negative word acts as 0, and no word lets more through than
// its value. The whole core, RTL against twin. Documentation: docs/blocks/torque_control.md
#include <algorithm>

#include "core_script.hpp"
#include "feltgate/generated/lever.hpp"

using namespace feltgate;
using namespace feltgate::test;

namespace {

using D = Lever;
using A = D::A;
using C = D::C;
using S = D::S;
using Script = CoreScript<D>;

constexpr std::int64_t kMilli = 66;
constexpr int kFine = D::f.ramp.fraction - D::f.torque.fraction;
constexpr std::int64_t kExtremes[] = {-1,
                                      -65536,
                                      -(1 << 20),
                                      -(1 << 21),
                                      INT32_MIN,
                                      INT32_MIN + 1000,
                                      INT32_MAX,
                                      (1 << 20) - 1,
                                      1 << 20,
                                      (1 << 21) - 1,
                                      1 << 21,
                                      1 << 22,
                                      (1 << 22) + 1000,
                                      0x40000000};

/// One tick of a core with about 0.46 Nm from a spring whose rest position is beside the lever.
struct Tick {
  std::int64_t tau_ref, current, voltage, duty;
  bool operator==(const Tick& o) const {
    return tau_ref == o.tau_ref && current == o.current && voltage == o.voltage && duty == o.duty;
  }
};

/// Writes `word` to `address` while disarmed, then arms; returns the ticks.
std::vector<Tick> under_load(int address, std::int64_t word, Script& s, int scene, int position) {
  s.skip_self_test();
  s.write(A::ramp_step, (5 * kMilli) << kFine);
  s.write(A::tension_rest, -600 * 256);
  s.write(address, word);
  if (position != 0) s.move(position, 400).ticks(4000);
  s.control(scene, false).ticks(2);
  s.control(scene, true).ticks(2);
  REQUIRE(s.out().armed);
  if (scene == S::membrane) s.move(-position / 4, 400);
  std::vector<Tick> seen;
  for (int k = 0; k < 400; ++k) {
    s.ticks(1);
    seen.push_back({s.out().tau_ref, s.out().current_ref, s.out().voltage, s.out().duty});
  }
  return seen;
}
std::vector<Tick> under_load(int address, std::int64_t word, int scene = S::spring_tension,
                             int position = 0) {
  Script s;
  const auto seen = under_load(address, word, s, scene, position);
  s.play();
  return seen;
}

/// Returns the largest value that a limit may let through: the nearest that its format holds, and
/// nothing of a negative word.
std::int64_t allowed(std::int64_t word, int signal_bits) {
  return std::clamp<std::int64_t>(word, 0, (std::int64_t{1} << (signal_bits - 1)) - 1);
}

std::int64_t size(std::int64_t x) { return x < 0 ? -x : x; }

}  // namespace

TEST_CASE(
    "limits: no word of a limit lets more torque, current, voltage or duty out than it says") {
  struct Limit {
    int address, bits;
    std::int64_t Tick::*signal;
  };
  for (const Limit& limit : {Limit{A::torque_limit, D::f.torque.width(), &Tick::tau_ref},
                             Limit{A::current_limit, D::f.current.width(), &Tick::current},
                             Limit{A::voltage_window, D::f.voltage.width(), &Tick::voltage},
                             Limit{A::duty_limit, D::f.duty.width(), &Tick::duty}}) {
    const auto at_0 = under_load(limit.address, 0);
    int let_through = 0;
    for (const std::int64_t word : kExtremes) {
      INFO("address " << limit.address << ", word " << word);
      const auto seen = under_load(limit.address, word);
      const std::int64_t most = allowed(word, limit.bits);
      for (const Tick& t : seen) REQUIRE(size(t.*limit.signal) <= most);
      if (most == 0) REQUIRE(seen == at_0);
      let_through += size(seen.back().*limit.signal) > 0 ? 1 : 0;
    }
    REQUIRE(let_through > 0);
  }
}

TEST_CASE("limits: a negative ramp is the slowest, a negative dead voltage or membrane is none") {
  for (const std::int64_t word : {-1, -65536, INT32_MIN}) {
    INFO("word " << word);
    const auto slow = under_load(A::ramp_step, word);
    for (const Tick& t : slow) REQUIRE(size(t.tau_ref) <= 2);  // 402 steps of 1/256 LSB
    REQUIRE(slow.back().tau_ref != 0);
    REQUIRE(under_load(A::dead_voltage, word) == under_load(A::dead_voltage, 0));
    REQUIRE(under_load(A::membrane_torque, word, S::membrane, 500) ==
            under_load(A::membrane_torque, 0, S::membrane, 500));
    // The border between the regions: a negative border acts as 0.
    REQUIRE(under_load(A::region_torque, word) == under_load(A::region_torque, 0));
  }
  REQUIRE(size(under_load(A::membrane_torque, 500 * kMilli, S::membrane, 500).back().tau_ref) > 0);
}

TEST_CASE("limits: the same words written to an armed core") {
  for (const int address : {A::torque_limit, A::current_limit, A::voltage_window, A::duty_limit,
                            A::region_torque, A::dead_voltage, A::ramp_step}) {
    for (const std::int64_t word : kExtremes) {
      Script s;
      const Tick before = under_load(A::setpoint_torque, 0, s, S::spring_tension, 0).back();
      s.write(address, word).ticks(300);
      const Tick after{s.out().tau_ref, s.out().current_ref, s.out().voltage, s.out().duty};
      INFO("address " << address << ", word " << word);
      if (address == A::torque_limit) {
        REQUIRE(size(after.tau_ref) ==
                std::min(allowed(word, D::f.torque.width()), size(before.tau_ref)));
      } else {
        REQUIRE(after == before);
      }
      s.play();
    }
  }
}

TEST_CASE("limits: a negative limit of the supervisor takes the torque away") {
  for (const std::int64_t word : {-1, -1000, INT32_MIN}) {
    INFO("word " << word);
    {  // every speed is too fast, armed or not
      Script s;
      under_load(A::setpoint_torque, 0, s, S::spring_tension, 0);
      s.write(A::overspeed, word).ticks(1);
      REQUIRE_FALSE(s.out().gates_enable);
      REQUIRE(s.out().first_fault == static_cast<int>(Fault::speed));
      s.play();
    }
    {  // the watchdog trips at once
      Script s;
      s.command(C::command_kick);
      under_load(A::setpoint_torque, 0, s, S::spring_tension, 0);
      s.write(A::watchdog_ticks, word).ticks(2);
      REQUIRE_FALSE(s.out().gates_enable);
      REQUIRE(s.out().first_fault == static_cast<int>(Fault::watchdog));
      s.play();
    }
    // A negative nominal current acts as 0: the heat of every tick counts.
    int ticks[2] = {};
    for (const bool negative : {false, true}) {
      Script s;
      s.write(A::nominal_current_squared, negative ? word : 0);
      under_load(A::setpoint_torque, 0, s, S::spring_tension, 0);
      s.write(A::i2t_budget, 0xffffffff).ticks(10);
      REQUIRE(s.out().gates_enable);
      // After power-up the sum is half the design's budget, and it grows.
      s.write(A::i2t_budget, D::i2t_start + 1'000'000);
      while (s.out().gates_enable && ticks[negative] < 5'000) s.ticks(1), ++ticks[negative];
      REQUIRE(s.out().first_fault == static_cast<int>(Fault::i2t));
      s.play();
    }
    REQUIRE(ticks[0] == ticks[1]);
  }
  Script s;  // a budget of zero
  under_load(A::setpoint_torque, 0, s, S::spring_tension, 0);
  s.write(A::i2t_budget, 0).ticks(1);
  REQUIRE(s.out().first_fault == static_cast<int>(Fault::i2t));
  s.play();
}
