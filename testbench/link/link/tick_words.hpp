// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The words of the snapshot as the core sends them, tick by tick, each told apart from all others.
// Documentation: docs/link.md
#pragma once

#include <cstdint>

#include "feltgate/generated/link.hpp"
#include "random.hpp"

namespace feltgate::test {

/// Word k of tick n where nothing else is asked for; the word `tick` is n itself.
constexpr std::uint32_t tick_word(std::uint32_t n, int k) {
  if (k == LinkMap::N::tick) return n;
  std::uint32_t x = (n * 16u + static_cast<std::uint32_t>(k)) * 0x9e3779b1u;
  return x ^ x >> 15;
}

/// Twelve words, some clocks apart, a clock or more between two ticks. Call next() once per clock.
class TickWords {
 public:
  explicit TickWords(std::uint64_t seed, bool dense = false, bool stray = false)
      : random_(seed), dense_(dense), stray_(stray) {}

  struct Word {
    bool valid = false;
    std::uint8_t slot = 0;
    std::uint32_t data = 0;
    int number = -1;  ///< of the word, where valid
  };

  /// `word(n, k)` says what word k of tick n is.
  template <class Content>
  Word next(const Content& word) {
    if (wait_-- > 0) return idle_;
    if (extra_ > 0) {
      --extra_;
      idle_.slot = static_cast<std::uint8_t>(1 + random_.below(63));
      idle_.data = static_cast<std::uint32_t>(random_.bits());
      Word stray = idle_;
      stray.valid = true;
      wait_ = 1;
      return stray;
    }
    idle_.slot = static_cast<std::uint8_t>(LinkMap::slots[number_]);
    idle_.data = word(tick_, number_);
    Word now = idle_;
    now.valid = true;
    now.number = number_;
    wait_ = dense_ ? 0 : static_cast<int>(random_.below(5));
    if (++number_ >= LinkMap::snapshot_words) begin_anew();
    if (stray_ && random_.one_in(200)) begin_anew();
    return now;
  }
  /// The tick that runs, or that begins next.
  std::uint32_t tick() const { return tick_; }

 private:
  /// With `stray`, as no core does it: ticks that break off, words before the first or after the
  /// last.
  void begin_anew() {
    number_ = 0;
    ++tick_;
    ++wait_;
    if (stray_ && random_.one_in(8)) extra_ = static_cast<int>(random_.below(24));
  }
  Random random_;
  bool dense_, stray_;
  int extra_ = 0;
  int number_ = 0, wait_ = 3;
  std::uint32_t tick_ = 0;
  Word idle_;
};

}  // namespace feltgate::test
