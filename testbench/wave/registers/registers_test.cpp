// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// registers: RTL against twin on every clock, and both against the documented behaviour of the
// port. Documentation: docs/architecture.md
#include <set>

#include "catch.hpp"
#include "host.hpp"

using namespace feltgate::test;
using feltgate::Lever;
using feltgate::Map;

namespace {

constexpr int kCommandBits = 6;
constexpr int kLast = Lever::clocks_per_tick - 1;

}  // namespace

TEST_CASE("registers: after configuration the RAM holds the design's values") {
  Script host;
  std::set<int> named;
  for (const auto& p : Lever::parameters) {
    named.insert(p.address);
    REQUIRE(host.twin().parameter(p.address) == static_cast<std::uint32_t>(p.raw));
  }
  for (int address = 0; address < 512; ++address) {
    if (named.count(address) == 0) REQUIRE(host.twin().parameter(address) == 0);
    if (READ_BACK != 0) {
      REQUIRE(host.read(static_cast<std::uint16_t>(address)) == host.twin().parameter(address));
    }
  }
  // Every word through the bus as well: common slots once, scene slots of every bank.
  for (std::uint8_t scene = 0; scene < 16; ++scene) {
    host.scene = scene;
    for (int slot = 0; slot < 48; ++slot) {
      const bool of_scene = ((Map::scene_slots >> slot) & 1u) != 0;
      const int address = of_scene                     ? scene * 32 + slot
                          : slot == Map::T::least_full ? Lever::A::torque_limit
                          : slot == Map::T::least_hold ? Lever::A::hold_limit
                          : slot == Map::T::least_test ? Lever::A::self_test_torque
                                                       : slot;
      REQUIRE(host.bus(slot) == host.twin().parameter(address));
    }
  }
  host.play();
}

TEST_CASE("registers: a write takes effect at the end of the tick, whenever it is made") {
  Script host;
  std::uint32_t word = 100;
  for (int c = 0; c <= kLast; ++c) {
    host.until(c);
    const std::uint32_t old = host.twin().parameter(Lever::A::velocity_a1);
    REQUIRE_FALSE(host.out().reg_busy);
    host.write(Lever::A::velocity_a1, ++word);
    REQUIRE(host.out().reg_busy);
    // A write in the last clock waits for the next tick's.
    const std::uint32_t commits = host.tick();
    while (host.tick() == commits) {
      REQUIRE(host.out().reg_busy);
      REQUIRE(host.twin().parameter(Lever::A::velocity_a1) == old);
      if (host.clock_of_tick() == 6) REQUIRE(host.out().param == old);
      host.clock();
    }
    REQUIRE_FALSE(host.out().reg_busy);
    REQUIRE(host.twin().parameter(Lever::A::velocity_a1) == word);
    REQUIRE(host.bus(4) == word);
    if (READ_BACK != 0) REQUIRE(host.read(Lever::A::velocity_a1) == word);
  }
  host.play();
}

TEST_CASE("registers: a write is taken when none waits; one that is not taken leaves no trace") {
  Script host;
  for (int c = 3; c < kLast - 2; c += 5) {
    host.until(c);
    host.write(Lever::A::overspeed, 1000U + static_cast<std::uint32_t>(c));
    host.write(Lever::A::i2t_budget, 77);
    host.write(kControl, 0x7fff);
    host.until(0);
    REQUIRE(host.bus(Lever::A::overspeed) == 1000U + static_cast<std::uint32_t>(c));
    REQUIRE(host.bus(Lever::A::i2t_budget) == 2920000000U);
    REQUIRE(host.out().control == Lever::control_reset);
  }
  // A write to an unused address or to a read-only word does not make the port busy either.
  for (const int address : {0x202, 0x2ff, 0x300, 0x33f, 0x340, 0xfff}) {
    host.write(static_cast<std::uint16_t>(address), 0xffffffffU);
    REQUIRE_FALSE(host.out().reg_busy);
  }
  host.play();
}

TEST_CASE("registers: held writes are taken one per tick, each once, in their order") {
  Script host;
  Random random(3);
  host.until(0);
  std::uint32_t tick = host.tick();
  for (std::uint32_t k = 0; k < 300; ++k) {
    // Nothing between two of them: the second waits for the end of the tick, and not a clock more.
    const auto at = static_cast<std::uint16_t>(64 + random.below(448));
    host.hold(at, k + 1);
    REQUIRE(host.tick() == tick + k);
    if (k > 0) REQUIRE(host.clock_of_tick() == 1);
    const std::uint32_t old = host.twin().parameter(at);
    REQUIRE(old != k + 1);
    if (random.one_in(10)) {  // or a pause, which loses nothing either
      host.until(0);
      REQUIRE(host.twin().parameter(at) == k + 1);
      tick = host.tick() - k - 1;
      host.clock();
      host.until(0);
      tick = host.tick() - k - 1;
    }
  }
  host.play();
}

TEST_CASE("registers: a disarm passes a waiting write, whichever, in any clock") {
  constexpr std::uint32_t kHost = 1U << Lever::C::control_host, kArm = 1U << Lever::C::control_arm;
  for (const bool held : {false, true}) {
    for (int c = 1; c + 1 < kLast; ++c) {
      for (const bool arms : {false, true}) {
        Script host;
        host.hold(kControl, kHost | kArm);
        host.until(0);
        REQUIRE((host.out().control & kArm) != 0);
        // An arm with another scene, or a parameter, waits.
        host.hold(arms ? kControl : Lever::A::ramp_step, arms ? (kHost | kArm | 5U << 2) : 4711U);
        host.until(c + 1);
        REQUIRE_FALSE(host.out().disarm);
        REQUIRE(host.out().reg_busy);
        host.write(kControl, kHost | 3U << 2);
        REQUIRE(host.out().disarm);
        if (held) {
          host.hold(kControl, kHost | 3U << 2);
        } else {
          host.until(0);
        }
        REQUIRE((host.out().control & (kHost | kArm)) == kHost);
        // What was taken is not lost, and the disarm's own word follows if it is held.
        if (arms) REQUIRE(((host.out().control >> 2) & 15U) == 5);
        if (!arms) REQUIRE(host.twin().parameter(Lever::A::ramp_step) == 4711);
        if (!held) REQUIRE_FALSE(host.out().disarm);
        host.until(0).until(0);
        REQUIRE(((host.out().control >> 2) & 15U) == (held ? 3U : arms ? 5U : 0U));
        REQUIRE((host.out().control & (kHost | kArm)) == kHost);
        REQUIRE_FALSE(host.out().disarm);
        host.play();
      }
    }
  }
}

TEST_CASE("registers: a stop passes a waiting write and stands to the end of the tick") {
  constexpr std::uint32_t kStop = 1U << Lever::C::command_stop;
  for (int c = 1; c <= kLast; ++c) {
    Script host;
    host.until(0);
    host.write(kCommand, 1U << Lever::C::command_clear_faults);
    if (c > 1) host.until(c);
    REQUIRE_FALSE(host.out().stop);
    host.write(kCommand, kStop);
    // In the last clock of a tick it stands for the tick to come.
    const int clocks = c == kLast ? kLast + 1 : kLast - c;
    for (int k = 0; k < clocks; ++k) {
      REQUIRE(host.out().stop);
      if (k == 3 && host.clock_of_tick() != kLast) {
        host.write(kCommand, kStop);  // again: nothing more
      } else {
        host.clock();
      }
    }
    REQUIRE_FALSE(host.out().stop);
    host.play();
  }
}

TEST_CASE("registers: while armed a word acts, ramps or is refused, as the map says") {
  for (const bool armed : {false, true}) {
    Script host;
    host.armed = armed;
    for (const auto& p : Lever::parameters) {
      for (const int number : {0, 1, 2, 3, p.address / 32}) {
        const auto scene = static_cast<std::uint8_t>(number);
        host.scene = scene;
        const auto effect = feltgate::while_armed(p.address, scene);
        const std::uint32_t old = host.twin().parameter(p.address);
        host.until(1);
        host.write(static_cast<std::uint16_t>(p.address), old + 1);
        bool restarted = false;
        while (host.clock_of_tick() != 0) restarted = host.clock().restart || restarted;
        const bool refused = armed && effect == feltgate::WhileArmed::refused;
        REQUIRE(restarted == (effect == feltgate::WhileArmed::ramps));
        REQUIRE(host.out().refused == refused);
        REQUIRE(host.twin().parameter(p.address) == (refused ? old : old + 1));
      }
    }
    host.play();
  }
}

TEST_CASE("registers: setting zero restarts the ramp, but not of an input") {
  for (const bool pin : {false, true}) {
    Script host;
    for (std::uint8_t scene = 0; scene < 16; ++scene) {
      host.scene = scene;
      host.until(20);
      host.set_zero = pin;
      if (pin) host.clock();
      host.set_zero = false;
      if (!pin) host.write(kCommand, 1U << Lever::C::command_set_zero);
      for (bool last = false; !last;) {
        last = host.clock_of_tick() == kLast;
        const auto now = host.clock();
        REQUIRE(now.set_zero == last);
        REQUIRE(now.restart == (last && scene != Lever::S::setpoint));
      }
      host.until(kLast);
      REQUIRE_FALSE(host.clock().set_zero);
    }
    host.play();
  }
}

TEST_CASE("registers: while armed, mode, polarities, PWM mode and filter hold") {
  constexpr std::uint32_t kHost = 1U << Lever::C::control_host, kArm = 1U << Lever::C::control_arm;
  Script host;
  host.write(kControl, kHost | kArm).until(0);
  host.armed = true;
  for (int n = Lever::C::control_mode; n < Lever::C::control_width; ++n) {
    host.hold(kControl, kHost | kArm | 9U << 2 | 1U << n);
    host.until(0);
    REQUIRE(host.out().control == (kHost | kArm | 9U << 2));
    REQUIRE(host.read(kControl) == (READ_BACK != 0 ? host.out().control : 0U));
  }
  // The word that disarms also contains these changes.
  host.hold(kControl, kHost | 0x7fc0U);
  host.until(0);
  REQUIRE(host.out().control == (kHost | 0x7fc0U));
  host.armed = false;
  host.hold(kControl, kHost | kArm);
  host.until(0);
  REQUIRE(host.out().control == (kHost | kArm));
  host.play();
}

TEST_CASE("registers: the control word changes between two waves only") {
  Script host;
  host.until(20);
  host.write(kControl, 0xffffa5a5U);
  while (host.clock_of_tick() != 0) {
    REQUIRE(host.out().control == Lever::control_reset);
    host.clock();
  }
  REQUIRE(host.out().control == 0x25a5);
  REQUIRE(host.read(kControl) == (READ_BACK != 0 ? 0x25a5U : 0U));
  REQUIRE(host.read(kCommand) == 0);
  host.play();
}

TEST_CASE("registers: each command acts once, in the last clock of the tick") {
  Script host;
  for (std::uint32_t bits = 0; bits < (1U << kCommandBits); ++bits) {
    host.until(static_cast<int>(bits) % kLast);
    host.write(kCommand, bits);
    for (int k = 0; k < 2 * kLast; ++k) {
      const bool acts = host.clock_of_tick() == kLast && host.out().reg_busy;
      const auto now = host.clock();
      REQUIRE(now.set_zero == (acts && (bits & 1U) != 0));
      REQUIRE(now.clear_faults == (acts && (bits & 2U) != 0));
      REQUIRE(now.kick == (acts && (bits & 4U) != 0));
    }
  }
  host.play();
}

TEST_CASE("registers: slot 34 carries word 50 in the high region") {
  Script host;
  host.write(Lever::A::voltage_gain, 1111).until(0);
  host.write(Lever::A::voltage_gain_high, 2222).until(0);
  for (const bool high : {false, true, false}) {
    host.region_high = high;
    REQUIRE(host.bus(33) == host.twin().parameter(33));
    REQUIRE(host.bus(34) == (high ? 2222U : 1111U));
  }
  host.play();
}

TEST_CASE("registers: slot 24 carries the least of all that limit the torque") {
  Script host;
  for (const int full : {-5, 0, 300, 2000}) {
    for (const int hold : {-6, 100, 300, 1500}) {
      for (const int test : {-7, 200, 400, 1600}) {
        host.write(Lever::A::torque_limit, static_cast<std::uint32_t>(full)).until(0);
        host.write(Lever::A::hold_limit, static_cast<std::uint32_t>(hold)).until(0);
        host.write(Lever::A::self_test_torque, static_cast<std::uint32_t>(test)).until(0);
        for (const bool derated : {false, true}) {
          for (const bool testing : {false, true}) {
            host.derated = derated;
            host.testing = testing;
            host.until(0);
            int least = full;
            if (derated && hold < least) least = hold;
            if (testing && test < least) least = test;
            REQUIRE(host.bus(24) == static_cast<std::uint32_t>(least));
          }
        }
      }
    }
  }
  host.play();
}

TEST_CASE("registers: a word that does not fit its format becomes the nearest that does") {
  Script host;
  for (const auto& p : Lever::parameters) {
    const int bits = p.format.width() - p.format.sign;
    const bool judged = bits >= 31;  // all words fit, or the block that takes it judges it
    const std::int64_t most = (std::int64_t{1} << bits) - 1;
    const std::int64_t least = p.format.sign != 0 ? -most - 1 : 0;
    for (const std::int64_t asked : {most, most + 1, least, least - 1, 2 * most, std::int64_t{-1},
                                     std::int64_t{0x7fffffff}, -std::int64_t{0x80000000}}) {
      const auto word = static_cast<std::uint32_t>(asked);
      if (!judged && static_cast<std::int32_t>(word) != asked) continue;
      host.write(static_cast<std::uint16_t>(p.address), word).until(0);
      const std::int64_t fits = asked > most ? most : asked < least ? least : asked;
      INFO(p.name << " " << asked);
      REQUIRE(host.twin().parameter(p.address) ==
              (judged ? word : static_cast<std::uint32_t>(fits)));
      REQUIRE(host.out().saturated == (!judged && fits != asked));
    }
  }
  // What is no parameter takes its bits as they are, and says nothing of the last parameter.
  host.write(Lever::A::setpoint_torque, 17U << 16).until(0);
  host.write(kControl, 0xffffffffU).until(0);
  REQUIRE(host.out().control == (1U << Lever::C::control_width) - 1);
  REQUIRE(host.out().saturated);
  host.play();
}

TEST_CASE("registers: the encoder's polarity holds while it must") {
  constexpr std::uint32_t kPolarity = 1U << Lever::C::control_encoder_polarity;
  constexpr std::uint32_t kRest = ((1U << Lever::C::control_width) - 1) & ~kPolarity;
  Script host;
  for (const std::uint32_t before : {0U, kPolarity}) {
    host.polarity_holds = false;
    host.write(kControl, before).until(0);
    host.polarity_holds = true;
    for (const std::uint32_t asked : {0U, kPolarity}) {
      host.write(kControl, kRest | asked).until(0);
      REQUIRE(host.out().control == (kRest | before));
      REQUIRE_FALSE(host.out().word_error);
    }
  }
  host.play();
}

TEST_CASE("registers: read data follow the address by exactly three clocks") {
  if (READ_BACK == 0) return;
  Script host;
  std::vector<std::uint16_t> addresses;
  for (int k = 0; k < 500; ++k) {
    host.address = static_cast<std::uint16_t>((k * 37) % 0x201);  // parameters and control
    addresses.push_back(host.address);
    host.clock();
    if (k < 2) continue;
    const std::uint16_t asked = addresses[static_cast<std::size_t>(k - 2)];
    REQUIRE(host.out().reg_rdata ==
            (asked == kControl ? host.out().control : host.twin().parameter(asked)));
  }
  host.play();
}

TEST_CASE("registers: a snapshot is of one tick, and a frozen one stays") {
  if (READ_BACK == 0) return;
  Script host;
  Random random(5);
  const auto tick_read = [&host](int slot) {
    return (host.read(static_cast<std::uint16_t>(0x300 + slot)) - label(0, slot)) / 64;
  };
  host.until(0);
  for (int round = 0; round < 40; ++round) {
    // Following: a word is of the last whole tick when its address has stood for three clocks.
    host.until(static_cast<int>(random.below(kLast)));
    for (int k = 0; k < 20; ++k) {
      host.until(3 + static_cast<int>(random.below(kLast - 7)));
      REQUIRE(tick_read(static_cast<int>(random.below(47))) == host.tick() - 1);
    }
    host.until(static_cast<int>(random.below(kLast)));
    host.write(kCommand, 1U << Lever::C::command_freeze);
    const std::uint32_t held = host.tick();  // the tick that the command ends
    host.until(0);
    for (int k = 0; k < 60; ++k) {
      for (std::uint32_t wait = random.below(120); wait > 0; --wait) host.clock();
      REQUIRE(tick_read(static_cast<int>(random.below(47))) == held);
    }
    host.until(static_cast<int>(random.below(kLast)));
    host.write(kCommand, 1U << Lever::C::command_thaw).until(0).until(0);
    REQUIRE(tick_read(9) == host.tick() - 1);
  }
  // Both at once: freeze wins.
  host.until(10);
  host.write(kCommand, (1U << Lever::C::command_freeze) | (1U << Lever::C::command_thaw));
  const std::uint32_t held = host.tick();
  host.until(0).until(0).until(0);
  REQUIRE(tick_read(9) == held);
  host.play();
}

TEST_CASE("registers: any access at any time, with and without resets") {
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    const ResetPlan plan{seed % 2 == 0 ? 3000U : 0U};
    RegistersBench bench("registers", seed);
    bench.run(RandomHost(seed, plan), scaled_clocks(100000), plan);
  }
}

TEST_CASE("registers: skipping a tick is clocking through it") {
  Random random(9);
  Clock clock;
  Twin clocked;
  clocked.reset();
  const auto tick = [&](bool write) {
    const std::uint16_t address = static_cast<std::uint16_t>(0x300 + random.below(64));
    Twin skipped = clocked;
    for (int c = 0; c <= kLast; ++c) {
      auto in = inputs_of(clock.out());
      in.reg_addr = write && c == 7 ? kCommand : address;
      in.reg_write = write && c == 7;
      in.reg_wdata = 8U << random.below(2);  // freeze or thaw
      if (in.snap_valid) skipped.write_snapshot(in.snap_slot, in.snap_data);
      clocked.clock(in);
      clock.clock({});
    }
    if (write) return;
    skipped.skip_tick(address);
    for (int c = 0; c <= kLast; ++c) {
      REQUIRE(skipped.out().param == clocked.out().param);
      REQUIRE(skipped.out().reg_rdata == clocked.out().reg_rdata);
      auto in = inputs_of(clock.out());
      in.reg_addr = address;
      clocked.clock(in);
      skipped.clock(in);
      clock.clock({});
    }
  };
  tick(true);
  for (int k = 0; k < 200; ++k) tick(random.one_in(3));
}
