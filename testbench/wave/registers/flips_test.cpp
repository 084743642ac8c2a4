// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// registers: functions that only the twin has, for fault campaigns, for skipping and for the core:
// flipped bits, words in the pipeline, waiting writes. Documentation: docs/architecture.md
#include "catch.hpp"
#include "host.hpp"

using namespace feltgate::test;
using feltgate::Lever;

namespace {

constexpr int kWord = Lever::A::velocity_a1;   // refused while armed
constexpr int kFree = Lever::A::tension_rest;  // of a scene: not refused while armed
constexpr int kWidth = Lever::C::control_width;

unsigned ones(std::uint32_t word) {
  unsigned n = 0;
  for (; word != 0; word &= word - 1) ++n;
  return n;
}

/// The twin with a host, and without RTL: no write makes a flip.
struct Flipped {
  Twin twin;
  Twin::In in;

  Flipped() {
    twin.reset();
    twin.clock(in);
    twin.clock(in);
  }
  void tick() {
    in.tick = true;
    twin.clock(in);
    in.tick = in.reg_write = false;
  }
  void ask(std::uint16_t address, std::uint32_t word) {
    in.reg_addr = address;
    in.reg_wdata = word;
    in.reg_write = true;
    twin.clock(in);
    in.reg_write = false;
  }
  void write(std::uint16_t address, std::uint32_t word) {
    ask(address, word);
    tick();
  }
  /// Runs three clocks. Returns whether an error is reported: a wrong word that is or was fetched.
  bool told() {
    bool error = false;
    for (int k = 0; k < 3; ++k) {
      twin.clock(in);
      error = error || twin.out().word_error;
    }
    return error;
  }
};

}  // namespace

TEST_CASE("registers: the check of a word is the parity of every fourth bit, 0 and 2 inverted") {
  Random random(5);
  for (int k = 0; k < 2000; ++k) {
    const auto word = static_cast<std::uint32_t>(k < 32 ? std::uint64_t{1} << k : random.bits());
    unsigned check = 5;
    for (unsigned bit = 0; bit < 4; ++bit) {
      check ^= (ones(word & 0x11111111U << bit) & 1U) << bit;
    }
    REQUIRE(feltgate::check_of(word) == check);
  }
}

TEST_CASE("registers: a word that has flipped is told when it is fetched, until it is written") {
  for (int k = 0; k < 2 * (32 + 4); ++k) {
    const int bit = k / 2;
    Flipped f;
    const std::uint32_t word = f.twin.parameter(kWord);
    f.in.slot_fetch = kWord;
    REQUIRE_FALSE(f.told());
    f.twin.flip(kWord, bit);
    REQUIRE(f.twin.flipped());
    REQUIRE(f.told());
    REQUIRE(f.twin.parameter(kWord) == (bit < 32 ? word ^ 1U << bit : word));
    f.in.slot_fetch = kWord + 1;
    f.told();  // what was under way
    REQUIRE_FALSE(f.told());
    f.in.slot_fetch = kWord;
    REQUIRE(f.told());
    if (k % 2 == 0) {
      f.twin.flip(kWord, bit);  // back
      REQUIRE(f.twin.parameter(kWord) == word);
    } else {
      f.write(kWord, word);
    }
    REQUIRE_FALSE(f.twin.flipped());
    f.told();
    REQUIRE_FALSE(f.told());
  }
}

TEST_CASE("registers: a flip is not looked at in the clock in which a parameter is written") {
  for (const bool writes : {false, true}) {
    Flipped f;
    f.in.slot_fetch = kWord;
    f.twin.flip(kWord, 3);
    f.twin.clock(f.in);
    if (writes) f.ask(kWord + 1, 0);
    f.told();
    f.tick();  // this fetch
    f.in.slot_fetch = 0;
    f.twin.clock(f.in);  // and those before it
    f.twin.clock(f.in);
    REQUIRE(f.twin.out().word_error == !writes);
  }
}

TEST_CASE("registers: a control bit that flips is told until one is written that does not hold") {
  for (int k = 0; k < 2 * (kWidth + 1); ++k) {
    const int bit = k / 2;
    Flipped f;
    const unsigned control = f.twin.out().control;
    f.twin.flip_control(bit);
    REQUIRE(f.twin.out().control == (bit < kWidth ? control ^ 1U << bit : control));
    REQUIRE(f.twin.flipped());
    REQUIRE(f.told());
    f.in.armed = true;
    f.write(kControl, control | 1U << Lever::C::control_host | 1U << Lever::C::control_arm);
    REQUIRE(f.told());
    f.in.armed = k % 2 == 0;  // and disarmed in the same tick, or not armed
    f.write(kControl, 1U << (f.in.armed ? Lever::C::control_host : Lever::C::control_arm));
    REQUIRE_FALSE(f.twin.flipped());
    f.told();
    REQUIRE_FALSE(f.told());
  }
}

TEST_CASE("registers: what waits for the end of the tick, and what passes it") {
  Flipped f;
  REQUIRE(f.twin.at_rest());
  REQUIRE(f.twin.parameter_waiting(false) == -1);
  f.ask(kFree, 7);
  REQUIRE_FALSE(f.twin.at_rest());
  REQUIRE(f.twin.parameter_waiting(false) == kFree);
  REQUIRE(f.twin.parameter_waiting(true) == kFree);
  f.tick();
  REQUIRE(f.twin.at_rest());
  REQUIRE(f.twin.parameter_waiting(false) == -1);
  REQUIRE(f.twin.parameter(kFree) == 7);

  f.ask(kWord, 7);  // refused while armed
  REQUIRE(f.twin.parameter_waiting(false) == kWord);
  REQUIRE(f.twin.parameter_waiting(true) == -1);
  f.in.tick = true;  // a stop in the last clock passes it, and is of the next tick
  f.ask(kCommand, 1U << Lever::C::command_stop);
  f.in.tick = false;
  REQUIRE(f.twin.parameter_waiting(false) == -1);
  REQUIRE(f.twin.out().stop);
  REQUIRE_FALSE(f.twin.at_rest());
  f.tick();
  REQUIRE(f.twin.at_rest());

  f.twin.set_parameter(kFree, 8);
  REQUIRE(f.twin.parameter(kFree) == 8);
}

TEST_CASE("registers: only the word that was written last can be lost") {
  for (const int slot : {0, 1, 2, 33, 63}) {
    Flipped f;
    f.twin.write_snapshot(slot, 11);
    f.twin.write_snapshot(slot, 12);
    REQUIRE(f.twin.running_word(slot) == 12);
    f.twin.lose_snapshot(slot ^ 1);
    f.twin.lose_snapshot(-1);
    REQUIRE(f.twin.running_word(slot) == 12);
    f.twin.lose_snapshot(slot);
    REQUIRE(f.twin.running_word(slot) == 11);
  }
}
