// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Keys, switches and lamps of the DE0-Nano top level, around a stub that shows what reaches the
// core. Verilated with -GDebounceBits=4 -GLoopBits=3 -GLongPressClocks=200 -GLampBits=5
// -GHeartbeatBits=6. Documentation: docs/boards/panel.md
#include <memory>

#include "Vde0_nano.h"
#include "catch.hpp"
#include "verilated.h"

// The Verilated DE0-Nano top level with its keys, lamps and scene.

inline constexpr int kSettle = 24;      // 2^DebounceBits at rest, and the way there and back
inline constexpr int kLongPress = 200;  // LongPressClocks
inline constexpr int kLamp = 32;        // 2^LampBits

class Board {
 public:
  Board() {
    top_->KEY = 3;
    clock(2 * kSettle);
  }

  void clock(int clocks) {
    for (int i = 0; i < clocks; ++i) {
      top_->CLOCK_50 = 0;
      top_->eval();
      top_->CLOCK_50 = 1;
      top_->eval();
      limit_seen_ = limit_seen_ || lamp(2);
    }
  }

  /// Moves a key without waiting: index 0 or 1.
  void key(int index, bool down) {
    const unsigned mask = 1U << index;
    const unsigned keys = top_->KEY;
    top_->KEY = static_cast<unsigned char>(down ? keys & ~mask : keys | mask);
    top_->eval();
  }

  /// Moves KEY[1] as a real contact does, then lets it rest for `rest` clocks.
  void bouncing_key(bool down, int rest) {
    for (int i = 0; i < 5; ++i) {
      key(1, down);
      clock(3);
      key(1, !down);
      clock(2);
    }
    key(1, down);
    clock(rest);
  }

  void short_press() {
    bouncing_key(true, kSettle);
    bouncing_key(false, kSettle);
  }

  void hold_key() {
    bouncing_key(true, kLongPress + kSettle);
    bouncing_key(false, kSettle);
  }

  bool lamp(int index) const { return (static_cast<unsigned>(top_->LED) >> index & 1U) != 0; }
  bool armed() const { return lamp(0); }
  bool fault() const { return lamp(1); }
  int scene() const { return (top_->LED >> 3) & 15; }

  /// The stub lights the limit lamp on set-zero: whether that happened since the last call.
  bool zero_was_set() {
    const bool seen = limit_seen_;
    limit_seen_ = false;
    return seen;
  }

  Vde0_nano& top() { return *top_; }

 private:
  std::unique_ptr<VerilatedContext> context_ = std::make_unique<VerilatedContext>();
  std::unique_ptr<Vde0_nano> top_ = std::make_unique<Vde0_nano>(context_.get());
  bool limit_seen_ = false;
};

TEST_CASE("de0_nano: KEY[1] pressed shortly arms on release and stops on press") {
  Board board;
  CHECK_FALSE(board.armed());
  board.bouncing_key(true, kSettle);
  CHECK_FALSE(board.armed());
  board.bouncing_key(false, kSettle);
  CHECK(board.armed());
  board.bouncing_key(true, kSettle);
  CHECK_FALSE(board.armed());
  board.bouncing_key(false, kSettle);
  CHECK_FALSE(board.armed());
  board.short_press();
  CHECK(board.armed());
  CHECK_FALSE(board.zero_was_set());
}

TEST_CASE("de0_nano: a pulse shorter than the debounce time is no press") {
  Board board;
  for (int i = 0; i < 20; ++i) {
    board.key(1, true);
    board.clock(12);
    board.key(1, false);
    board.clock(12);
  }
  board.clock(kSettle);
  CHECK_FALSE(board.armed());
}

TEST_CASE("de0_nano: KEY[1] held sets zero once and does not arm") {
  Board board;
  board.bouncing_key(true, kLongPress - 10);
  CHECK_FALSE(board.zero_was_set());
  board.clock(kSettle + 10);
  CHECK(board.zero_was_set());
  board.clock(kLamp + 1);
  CHECK(board.zero_was_set());
  board.clock(3 * kLongPress);
  board.zero_was_set();
  CHECK_FALSE(board.lamp(2));
  board.bouncing_key(false, kSettle);
  CHECK_FALSE(board.armed());
  CHECK_FALSE(board.zero_was_set());
}

TEST_CASE("de0_nano: KEY[1] held while armed stops first, then sets zero, and does not arm") {
  Board board;
  board.short_press();
  REQUIRE(board.armed());
  board.bouncing_key(true, kSettle);
  CHECK_FALSE(board.armed());
  board.clock(kLongPress + kSettle);
  CHECK(board.zero_was_set());
  board.bouncing_key(false, kSettle);
  CHECK_FALSE(board.armed());
}

TEST_CASE("de0_nano: KEY[0] resets at once and is released only after it is at rest") {
  Board board;
  board.short_press();
  REQUIRE(board.armed());
  board.key(0, true);
  CHECK(board.top().LED == 0);
  board.key(0, false);
  CHECK(board.top().LED == 0);
  board.clock(2 * kSettle);
  CHECK_FALSE(board.armed());
  board.short_press();
  CHECK(board.armed());
}

TEST_CASE("de0_nano: KEY[1] held through a reset means nothing until it was let go") {
  Board board;
  board.key(0, true);
  board.key(1, true);
  board.clock(kSettle);
  board.key(0, false);
  board.clock(2 * kLongPress);
  board.bouncing_key(false, kSettle);
  CHECK_FALSE(board.armed());
  CHECK_FALSE(board.zero_was_set());
  board.short_press();
  CHECK(board.armed());
}

TEST_CASE("de0_nano: an open stop circuit faults, and the fault takes the request to arm away") {
  Board board;
  board.short_press();
  REQUIRE(board.armed());
  board.top().estop = 1;
  board.clock(5);
  CHECK_FALSE(board.armed());
  CHECK(board.fault());
  board.top().estop = 0;
  board.clock(2 * kSettle);
  CHECK(board.fault());
  CHECK_FALSE(board.armed());
  // A press during a fault must not arm once the fault is gone.
  board.short_press();
  CHECK_FALSE(board.armed());
  board.hold_key();
  CHECK_FALSE(board.fault());
  CHECK_FALSE(board.armed());
  board.short_press();
  CHECK(board.armed());
}

TEST_CASE("de0_nano: KEY[1] held during a fault clears it and leaves the zero") {
  Board board;
  board.short_press();
  board.top().estop = 1;
  board.clock(5);
  board.top().estop = 0;
  REQUIRE(board.fault());
  board.clock(kLamp + 1);
  board.zero_was_set();
  board.hold_key();
  CHECK_FALSE(board.fault());
  CHECK_FALSE(board.zero_was_set());
  board.hold_key();
  CHECK(board.zero_was_set());
}

TEST_CASE("de0_nano: an encoder that is not plugged in stops, blinks, and must be armed anew") {
  Board board;
  board.short_press();
  REQUIRE(board.armed());
  // Shorter than the debounce of the loop: nothing.
  board.top().enc_loop = 1;
  board.clock(6);
  board.top().enc_loop = 0;
  board.clock(20);
  CHECK(board.armed());
  board.top().enc_loop = 1;
  board.clock(20);
  CHECK_FALSE(board.armed());
  int changes = 0;
  for (int i = 0; i < 64; ++i) {
    const bool before = board.fault();
    board.clock(1);
    changes += board.fault() != before;
  }
  CHECK(changes == 8);  // a bit of the counter that is two below the heartbeat's
  board.short_press();
  CHECK_FALSE(board.armed());
  board.top().enc_loop = 0;
  board.clock(2 * kSettle);
  CHECK_FALSE(board.armed());
  CHECK(board.fault());  // the stop, latched
  board.hold_key();
  CHECK_FALSE(board.fault());
  board.short_press();
  CHECK(board.armed());
}

TEST_CASE("de0_nano: a press while the encoder is not plugged in does nothing") {
  Board board;
  board.top().enc_loop = 1;
  board.clock(20);
  board.short_press();
  board.top().enc_loop = 0;
  board.clock(2 * kSettle);
  CHECK_FALSE(board.fault());
  CHECK_FALSE(board.armed());
}

TEST_CASE("de0_nano: a press during a fault does not arm when a host clears it") {
  for (int presses = 1; presses <= 2; ++presses) {
    INFO(presses << " presses");
    Board board;
    board.short_press();
    board.top().estop = 1;
    board.clock(5);
    board.top().estop = 0;
    for (int k = 0; k < presses; ++k) board.short_press();
    REQUIRE(board.fault());
    board.top().enc_a_i = board.top().enc_b_i = board.top().enc_z_i = 1;
    board.clock(2);
    board.top().enc_a_i = board.top().enc_b_i = board.top().enc_z_i = 0;
    board.clock(2);
    CHECK_FALSE(board.fault());
    CHECK_FALSE(board.armed());
  }
}

TEST_CASE("de0_nano: KEY[1] pressed while a host has armed is a stop, and does not arm") {
  Board board;
  board.top().enc_b_i = board.top().enc_z_i = 1;
  board.clock(3);
  REQUIRE(board.armed());
  board.bouncing_key(true, kSettle);
  CHECK_FALSE(board.armed());
  CHECK(board.fault());
  board.top().enc_b_i = board.top().enc_z_i = 0;
  board.bouncing_key(false, kSettle);
  CHECK(board.fault());
  board.hold_key();
  CHECK_FALSE(board.fault());
  CHECK_FALSE(board.armed());
  board.short_press();
  CHECK(board.armed());
}

TEST_CASE("de0_nano: KEY[1] asks for nothing that a host has ended, or that was in vain for long") {
  Board board;
  const auto host_has_the_say = [&](bool say) {
    board.top().enc_a_i = board.top().enc_b_i = say ? 1 : 0;
    board.clock(3);
  };
  for (const bool armed_before : {true, false}) {
    INFO("armed by the key before the host took the say: " << armed_before);
    if (armed_before) board.short_press();
    REQUIRE(board.armed() == armed_before);
    host_has_the_say(true);
    CHECK_FALSE(board.armed());
    if (!armed_before) {
      board.short_press();
      board.clock(kLongPress);
    }
    host_has_the_say(false);
    board.clock(kSettle);
    CHECK_FALSE(board.armed());
  }
  board.short_press();
  CHECK(board.armed());
  board.clock(3 * kLongPress);
  CHECK(board.armed());
}

TEST_CASE("de0_nano: KEY[1] held while a host arms asks for nothing when it is let go") {
  Board board;
  board.bouncing_key(true, kLongPress + kSettle);
  board.top().enc_b_i = board.top().enc_z_i = 1;
  board.clock(3);
  REQUIRE(board.armed());
  board.bouncing_key(false, kSettle);
  board.top().enc_b_i = board.top().enc_z_i = 0;
  board.clock(3);
  CHECK_FALSE(board.armed());
}

TEST_CASE("de0_nano: all switches on shows the encoder and disarms") {
  Board board;
  board.short_press();
  REQUIRE(board.armed());
  board.top().SW = 15;
  board.clock(2 * kSettle);
  board.top().SW = 0;  // the lamps show again what is armed
  board.clock(2 * kSettle);
  CHECK_FALSE(board.armed());
  board.top().SW = 15;
  board.clock(2 * kSettle);
  board.short_press();
  // The stub's position follows A and B, two bits, and Z three further up.
  const auto encoder = [&](int a, int b, int z) {
    board.top().enc_a_i = static_cast<unsigned char>(a);
    board.top().enc_b_i = static_cast<unsigned char>(b);
    board.top().enc_z_i = static_cast<unsigned char>(z);
    board.clock(5);
  };
  encoder(0, 0, 0);
  board.clock(kLamp + 1);
  CHECK_FALSE(board.lamp(2));
  encoder(1, 0, 0);
  CHECK(board.lamp(0));
  CHECK(board.lamp(3));
  CHECK_FALSE(board.lamp(4));
  encoder(1, 1, 0);
  CHECK(board.lamp(0));
  CHECK(board.lamp(4));
  encoder(1, 0, 0);
  CHECK_FALSE(board.lamp(0));
  encoder(0, 0, 0);
  CHECK_FALSE(board.lamp(0));
  CHECK((board.top().LED >> 5) == 0);
  encoder(0, 0, 1);
  CHECK(board.lamp(2));
  CHECK((board.top().LED >> 5) == 7);
  encoder(0, 0, 0);
  CHECK(board.lamp(2));
  board.clock(kLamp + 1);
  CHECK_FALSE(board.lamp(2));
}

TEST_CASE("de0_nano: switches select the scene as one word once they are at rest") {
  Board board;
  for (const int wanted : {14, 0, 5, 10, 4, 3, 12, 8, 7}) {
    const int before = board.scene();
    // One switch after the other, as a finger moves them: nothing in between is selected.
    for (int bit = 0; bit < 4; ++bit) {
      const unsigned flip = (static_cast<unsigned>(wanted) ^ board.top().SW) & 1U << bit;
      if (flip == 0) continue;
      board.top().SW = static_cast<unsigned char>(board.top().SW ^ flip);
      for (int i = 0; i < 10; ++i) {
        board.clock(1);
        CHECK(board.scene() == before);
      }
    }
    board.clock(kSettle);
    CHECK(board.scene() == wanted);
  }
}

TEST_CASE("de0_nano: encoder, gates and heartbeat are on their pins") {
  Board board;
  for (int levels = 0; levels < 8; ++levels) {
    board.top().enc_a_i = static_cast<unsigned char>(levels & 1);
    board.top().enc_b_i = static_cast<unsigned char>(levels >> 1 & 1);
    board.top().enc_z_i = static_cast<unsigned char>(levels >> 2 & 1);
    board.clock(1);
    CHECK(board.top().gate_a_hi_o == (levels & 1));
    CHECK(board.top().gate_a_lo_o == (levels >> 1 & 1));
    CHECK(board.top().gate_b_hi_o == (levels >> 2 & 1));
  }
  board.top().SW = 14;
  board.clock(2 * kSettle);
  CHECK(board.top().gate_b_lo_o == 1);
  const bool before = board.lamp(7);
  board.clock(32);
  CHECK(board.lamp(7) != before);
}
