// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The Verilated core as a board's core. Documentation: docs/board.md
#pragma once

#include <array>
#include <cstdint>

#include "engines/rtl_core.hpp"

namespace feltgate::board {

/// Rtl is Verilator's class of feltgate_core for design D.
template <class Rtl, class D>
class RtlClocked {
 public:
  void clock(const CoreIn& in) {
    core_.clock(in);
    show();
  }
  template <class OnSnapshot>
  void run(const CoreIn& in, std::int64_t clocks, OnSnapshot&& on_snapshot) {
    core_.drive(in);
    for (; clocks > 0; --clocks) {
      core_.edge();
      show();
      if (out_.snapshot_valid) on_snapshot();
    }
  }
  const CoreOut& out() const { return out_; }
  void keep_words(bool) {}
  std::uint32_t word(int slot) const { return words_[static_cast<std::size_t>(slot)]; }

 private:
  void show() {
    out_ = core_.out();
    if (out_.word_valid) words_[out_.word_slot] = out_.word_data;
  }

  RtlCore<Rtl, D> core_;
  CoreOut out_;
  std::array<std::uint32_t, 64> words_{};
};

}  // namespace feltgate::board
