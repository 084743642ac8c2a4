// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The torque must not jump, and no disarm may be lost, for every action of a host or a panel on an
// armed core. The whole core, RTL against twin. Documentation: docs/blocks/ramp.md
#include <algorithm>

#include "core_script.hpp"
#include "feltgate/while_armed.hpp"

using namespace feltgate;
using namespace feltgate::test;

namespace {

using D = Design;
using A = D::A;
using C = D::C;
using S = D::S;
using Script = CoreScript;

constexpr std::int64_t kMilli = 66;  // 1 mNm in torque LSB
constexpr int kFine = D::f.ramp.fraction - D::f.torque.fraction;
constexpr std::int64_t kStep = kMilli;  // step of the ramp in these tests: 1 mNm per tick

/// Arms with about 0.46 Nm from the spring, 600 counts from its rest position. Either the lever
/// moves there, or the rest position is set and the lever does not move.
Script under_the_spring(bool moved = true) {
  Script s;
  s.skip_self_test().write(A::ramp_step, kStep << kFine);
  if (moved) s.move(600).ticks(800);  // waits for the velocity's window
  if (!moved) s.write(A::tension_rest, -600 * 256);
  s.arm(S::spring_tension);
  REQUIRE(s.out().tau_ref < -400 * kMilli);
  s.steps();
  return s;
}

/// Checks that the torque changed by at least `least` in all, and by at most one step of the ramp
/// per tick.
void check_ramped(Script& s, std::int64_t before, std::int64_t least) {
  REQUIRE((s.out().limits >> Map::L::ramp & 1U) != 0);
  s.settle();
  const auto seen = s.steps();
  REQUIRE(std::abs(s.out().tau_ref - before) >= least);
  REQUIRE(seen.tau_ref <= kStep);
  REQUIRE(s.out().armed);
  s.play();
}

std::int64_t highest(const ParameterInfo& p) {
  return (std::int64_t{1} << (p.field.width() - p.field.sign)) - 1;
}

}  // namespace

TEST_CASE("host: set_zero under a spring ramps, by the pin and by the host") {
  for (const bool pin : {true, false}) {
    Script s = under_the_spring();
    const std::int64_t before = s.out().tau_ref;
    if (pin) {
      s.until(7).in.set_zero = true;
      s.clock();
      s.in.set_zero = false;
      s.until(0);
    } else {
      s.command(C::command_set_zero);
    }
    s.ticks(1);
    REQUIRE(s.out().position == 0);
    check_ramped(s, before, 400 * kMilli);
    REQUIRE(s.out().tau_ref == 0);
  }
}

TEST_CASE("host: a change of scene and each word of the scene in use ramp") {
  {
    Script s = under_the_spring();
    const std::int64_t before = s.out().tau_ref;
    s.control(S::free, true).ticks(2);
    check_ramped(s, before, 400 * kMilli);
  }
  // Sets every word of every scene to 0, to half and to its end value, with the lever where the
  // word may have an effect.
  int moved = 0, words = 0;
  for (const ParameterInfo& p : D::parameters) {
    const int scene = p.address / 32;
    if (p.address < 64 || is_input_scene(scene)) continue;
    ++words;
    bool felt = false;
    for (const int position : {600, 250, 80}) {
      Script s;
      s.skip_self_test().write(A::ramp_step, kStep << kFine);
      // Moves through the membrane's face and into the wall; the speed lasts for the velocity's
      // window, for a damper.
      s.move(position, 120);
      s.arm(scene);
      if (scene == S::wall) s.ticks(3000);  // without the torque of its damping
      if (scene == S::membrane) s.move(400 - position, 120).settle();
      const bool speed = scene == S::damper || p.address == A::wall_damping;
      for (const std::int64_t word :
           {std::int64_t{0}, highest(p), highest(p) / 2, std::int64_t{1}}) {
        if (speed) s.move(20, 100);
        s.settle().steps();
        const std::int64_t before = s.out().tau_ref;
        s.write(p.address, word);
        for (int k = 0; k < 20; ++k) {
          s.ticks(1);
          REQUIRE(s.steps().tau_ref <= kStep);
        }
        felt = felt || std::abs(s.out().tau_ref - before) >= 15 * kStep;
      }
      s.play();
      if (felt) break;
    }
    if (felt) ++moved;
    INFO(p.name);
    CHECK(felt);
  }
  REQUIRE(words == 19);
  REQUIRE(moved == words);
}

TEST_CASE(
    "host: a torque limit, lowered or raised, ramps; at a negative one the torque goes to 0") {
  for (const std::int64_t limit :
       {200 * kMilli, std::int64_t{0}, std::int64_t{-1}, -200 * kMilli}) {
    Script s = under_the_spring();
    const std::int64_t before = s.out().tau_ref;
    s.write(A::torque_limit, limit).ticks(1);
    REQUIRE((s.out().limits >> Map::L::ramp & 1U) != 0);
    s.settle();
    REQUIRE(s.out().tau_ref == -std::max<std::int64_t>(limit, 0));
    s.write(A::torque_limit, 500 * kMilli).ticks(1);
    s.settle();
    REQUIRE(s.out().tau_ref == before);
    REQUIRE(s.steps().tau_ref <= kStep);
    s.play();
  }
}

TEST_CASE("host: the set-point acts at once, also where the zero is set") {
  Script s;
  s.skip_self_test().write(A::ramp_step, kStep << kFine).arm(S::setpoint).steps();
  s.write(A::setpoint_torque, 300 * kMilli);
  s.ticks(1);
  REQUIRE(s.out().tau_ref == 300 * kMilli);
  s.hold(A::setpoint_torque, static_cast<std::uint32_t>(100 * kMilli));
  s.in.set_zero = true;
  s.clock();
  s.in.set_zero = false;
  s.until(0).ticks(1);
  REQUIRE(s.out().tau_ref == 100 * kMilli);
  s.play();
}

TEST_CASE("host: words behind the ramp are refused while armed, and it shows") {
  std::vector<ParameterInfo> refused;
  for (const ParameterInfo& p : D::parameters) {
    if (while_armed(p.address, S::spring_tension) == WhileArmed::refused) refused.push_back(p);
  }
  REQUIRE(refused.size() == 24);
  Script s = under_the_spring(false);
  s.ticks(3000).steps();
  const CoreOut before = s.out();
  for (const ParameterInfo& p : refused) {
    const std::uint32_t held = s.read(p.address);
    for (const std::int64_t word : {std::int64_t{0}, highest(p), highest(p) / 2}) {
      s.write(p.address, word).ticks(2);
      INFO(p.name);
      REQUIRE((s.status() >> C::status_refused & 1U) != 0);
      REQUIRE(s.read(p.address) == held);
    }
    const auto seen = s.steps();
    REQUIRE(seen.tau_ref == 0);
    REQUIRE(seen.current == 0);
    REQUIRE(seen.voltage == 0);
    REQUIRE(seen.duty == 0);
    REQUIRE(s.out().duty == before.duty);
  }
  s.control(S::spring_tension, false).ticks(1);
  for (const ParameterInfo& p : refused) {  // now accepted
    s.write(p.address, highest(p) / 2);
    REQUIRE(s.read(p.address) == static_cast<std::uint32_t>(highest(p) / 2));
    REQUIRE((s.status() >> C::status_refused & 1U) == 0);
  }
  s.play();
}

TEST_CASE("host: mode, polarities, PWM mode and filter hold while armed") {
  Script s = under_the_spring(false);
  s.ticks(3000);
  const CoreOut before = s.out();
  for (int n = C::control_mode; n < C::control_width; ++n) {
    s.control(S::spring_tension, true, 1U << n).ticks(3);
    REQUIRE(s.out().duty == before.duty);
  }
  for (int n = C::control_mode; n < C::control_width; ++n) {
    s.control(S::spring_tension, true, 1U << n);
    // The lever moves further; the position must count in the same direction.
    const std::int32_t position = s.out().position;
    s.move(8, 400).ticks(2);
    REQUIRE(s.out().position == position + 8);
    s.move(-8, 400);
    REQUIRE(s.read(C::control) == Script::control_word(S::spring_tension, true));
    REQUIRE((s.status() >> C::status_mode & 3U) == 0);
    REQUIRE(s.out().gates_enable);
  }
  for (int n = C::control_mode; n < C::control_width; ++n) {
    // The word that disarms also contains the change.
    s.control(S::spring_tension, false, 1U << n);
    REQUIRE(s.read(C::control) == Script::control_word(S::spring_tension, false, 1U << n));
    s.arm(S::spring_tension);
  }
  s.play();
}

TEST_CASE("host: a disarm acts at the end of the running tick, whatever waits") {
  Script s = under_the_spring(false);
  for (int c = 0; c < Script::kLast; c += 3) {
    for (const bool held : {false, true}) {
      s.hold(A::torque_limit, 1000);  // waits
      if (c > 0) s.until(std::max(c, 2));
      const std::uint32_t word = Script::control_word(S::spring_tension, false);
      REQUIRE(s.out().reg_busy);
      s.pulse(C::control, word);
      REQUIRE(s.out().armed);
      if (held) {
        s.hold(C::control, word);
      } else {
        s.until(0);
      }
      REQUIRE_FALSE(s.out().armed);
      REQUIRE_FALSE(s.out().gates_enable);
      s.ticks(3);
      REQUIRE_FALSE(s.out().armed);
      REQUIRE(s.out().tau_ref == 0);
      s.arm(S::spring_tension);  // works again afterwards
    }
  }
  s.play();
}

TEST_CASE("host: an arm that waits does not pass a disarm or a stop") {
  for (const bool stop : {false, true}) {
    for (int c = 1; c < Script::kLast; c += 4) {
      Script s;
      s.control(S::free, false).ticks(2);
      s.hold(C::control, Script::control_word(S::free, true));
      if (c > 1) s.until(c);
      if (stop) s.pulse(C::command, 1U << C::command_stop);
      if (!stop) s.pulse(C::control, Script::control_word(S::free, false));
      for (int k = 0; k < 300; ++k) {
        s.clock();
        REQUIRE_FALSE(s.out().gates_enable);
      }
      REQUIRE(s.out().first_fault == (stop ? static_cast<int>(Fault::stop) : 0));
      s.play();
    }
  }
}

TEST_CASE("host: a stop acts in three clocks, beside whatever waits, and stays") {
  Script s = under_the_spring(false);
  for (int c = 0; c <= Script::kLast; ++c) {
    for (const int again : {0, 1, 5, 60}) {
      s.hold(C::command, 1U << C::command_clear_faults);  // waits; the stop lasts longer
      if (c > 0) s.until(std::max(c, 2));
      s.pulse(C::command, 1U << C::command_stop);
      for (int k = 0; k < again; ++k) s.pulse(C::command, 1U << C::command_stop);
      s.clock();
      s.clock();
      REQUIRE_FALSE(s.out().gates_enable);
      s.ticks(3);
      REQUIRE_FALSE(s.out().armed);
      REQUIRE(s.out().first_fault == static_cast<int>(Fault::stop));
      // Arming needs a falling request and a cleared fault.
      s.control(S::spring_tension, false).ticks(1);
      s.control(S::spring_tension, true).ticks(2);
      REQUIRE_FALSE(s.out().armed);
      s.control(S::spring_tension, false).command(C::command_clear_faults).ticks(1);
      s.control(S::spring_tension, true).ticks(2);
      REQUIRE(s.out().armed);
    }
  }
  s.play();
}

// A limit is a magnitude: under load a negative word acts as 0, and no word lets more through than
// its value. The whole core, RTL against twin.

namespace {

constexpr std::int64_t kExtremes[] = {-1,        -(1 << 20),    INT32_MIN, INT32_MIN + 1000,
                                      INT32_MAX, (1 << 20) - 1, 1 << 20,   1 << 22,
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
  if (position != 0) s.move(position, 120).ticks(2500);
  s.control(scene, false).ticks(2);
  s.control(scene, true).ticks(2);
  REQUIRE(s.out().armed);
  if (scene == S::membrane) s.move(-position / 4, 120);
  std::vector<Tick> seen;
  for (int k = 0; k < 200; ++k) {
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
  const auto no_membrane = under_load(A::membrane_torque, 0, S::membrane, 500);
  for (const std::int64_t word : {-1, INT32_MIN}) {
    INFO("word " << word);
    const auto slow = under_load(A::ramp_step, word);
    for (const Tick& t : slow) REQUIRE(size(t.tau_ref) <= 2);  // 202 steps of 1/256 LSB
    REQUIRE(slow.back().tau_ref != 0);
    REQUIRE(under_load(A::dead_voltage, word) == under_load(A::dead_voltage, 0));
    REQUIRE(under_load(A::membrane_torque, word, S::membrane, 500) == no_membrane);
    // The border between the regions: a negative border acts as 0.
    REQUIRE(under_load(A::region_torque, word) == under_load(A::region_torque, 0));
  }
  REQUIRE(size(under_load(A::membrane_torque, 500 * kMilli, S::membrane, 500).back().tau_ref) > 0);
}

TEST_CASE("limits: the same words written to an armed core") {
  Script s;
  const Tick before = under_load(A::setpoint_torque, 0, s, S::spring_tension, 0).back();
  for (const int address : {A::current_limit, A::voltage_window, A::duty_limit, A::region_torque,
                            A::dead_voltage, A::torque_limit, A::ramp_step}) {
    for (const std::int64_t word : kExtremes) {
      s.write(address, word).ticks(120);
      const Tick after{s.out().tau_ref, s.out().current_ref, s.out().voltage, s.out().duty};
      INFO("address " << address << ", word " << word);
      if (address == A::torque_limit) {
        REQUIRE(size(after.tau_ref) ==
                std::min(allowed(word, D::f.torque.width()), size(before.tau_ref)));
      } else {
        REQUIRE(after == before);
      }
    }
  }
  s.play();
}

TEST_CASE("limits: a negative limit of the supervisor takes the torque away") {
  for (const std::int64_t word : {-1, INT32_MIN}) {
    INFO("word " << word);
    {  // it acts as 0: every motion is too fast
      Script s;
      under_load(A::setpoint_torque, 0, s, S::spring_tension, 0);
      s.write(A::overspeed, word).ticks(1);
      s.move(1, 400).ticks(2);
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
      CAPTURE(ticks[0], ticks[1], s.out().current_ref, D::i2t_start);
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
