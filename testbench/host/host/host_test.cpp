// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The torque must not jump, and no disarm may be lost, for every action of a host or a panel on an
// armed core. The whole core, RTL against twin. Documentation: docs/blocks/torque_control.md
#include "core_script.hpp"
#include "feltgate/generated/lever.hpp"
#include "feltgate/while_armed.hpp"

using namespace feltgate;
using namespace feltgate::test;

namespace {

using D = Lever;
using A = D::A;
using C = D::C;
using S = D::S;
using Script = CoreScript<D>;

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
  return (std::int64_t{1} << (p.format.width() - p.format.sign)) - 1;
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
      s.control(scene, false).ticks(2);
      s.control(scene, true).ticks(4000);
      REQUIRE(s.out().armed);
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
  int refused = 0;
  for (const ParameterInfo& p : D::parameters) {
    if (while_armed(p.address, S::spring_tension) != WhileArmed::refused) continue;
    ++refused;
    Script s = under_the_spring(false);
    s.ticks(3000).steps();
    const CoreOut before = s.out();
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
    // When disarmed, the write is accepted.
    s.control(S::spring_tension, false).ticks(1);
    s.write(p.address, highest(p) / 2);
    REQUIRE(s.read(p.address) == static_cast<std::uint32_t>(highest(p) / 2));
    REQUIRE((s.status() >> C::status_refused & 1U) == 0);
    s.play();
  }
  REQUIRE(refused == 24);
}

TEST_CASE("host: mode, polarities, PWM mode and filter hold while armed") {
  for (int n = C::control_mode; n < C::control_width; ++n) {
    Script s = under_the_spring(false);
    s.ticks(3000).steps();
    const CoreOut before = s.out();
    s.control(S::spring_tension, true, 1U << n).ticks(3);
    REQUIRE(s.out().duty == before.duty);
    // The lever moves further; the position must count in the same direction.
    const std::int32_t position = s.out().position;
    s.move(8, 400).ticks(2);
    REQUIRE(s.out().position == position + 8);
    s.move(-8, 400);
    REQUIRE(s.read(C::control) == Script::control_word(S::spring_tension, true));
    REQUIRE((s.status() >> C::status_mode & 3U) == 0);
    REQUIRE(s.out().gates_enable);
    // The word that disarms also contains the change.
    s.control(S::spring_tension, false, 1U << n);
    REQUIRE(s.read(C::control) == Script::control_word(S::spring_tension, false, 1U << n));
    s.play();
  }
}

TEST_CASE("host: a disarm acts at the end of the running tick, whatever waits") {
  for (int c = 0; c < Script::kLast; c += 3) {
    for (const bool held : {false, true}) {
      Script s = under_the_spring();
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
      // Arming works again afterwards.
      s.control(S::spring_tension, true).ticks(2);
      REQUIRE(s.out().armed);
      s.play();
    }
  }
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
  for (int c = 0; c <= Script::kLast; ++c) {
    for (const int again : {0, 1, 5, 60}) {
      Script s = under_the_spring();
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
      s.control(S::free, false).ticks(1);
      s.control(S::free, true).ticks(2);
      REQUIRE_FALSE(s.out().armed);
      s.control(S::free, false).command(C::command_clear_faults).ticks(1);
      s.control(S::free, true).ticks(2);
      REQUIRE(s.out().armed);
      if (c % 7 == 0) s.play();
    }
  }
}
