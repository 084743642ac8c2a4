// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The Verilated DE0-Nano top level with its keys, lamps and scene.
#pragma once

#include <memory>

#include "Vde0_nano.h"
#include "verilated.h"

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
