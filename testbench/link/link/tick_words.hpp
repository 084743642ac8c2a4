// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The words of the snapshot by number, tick by tick, each told apart from all others. They come in
// any order; the status is the last. Documentation: docs/link.md
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "feltgate/generated/link.hpp"
#include "random.hpp"

namespace feltgate::test {

/// Word k of tick n where nothing else is asked for; the word `tick` is n itself.
constexpr std::uint32_t tick_word(std::uint32_t n, int k) {
  if (k == LinkMap::N::tick) return n;
  std::uint32_t x = (n * 16u + static_cast<std::uint32_t>(k)) * 0x9e3779b1u;
  return x ^ x >> 15;
}

/// Number of the word that comes at this place, where nothing else is asked for.
constexpr int number_at(int place) { return (place + 1) % LinkMap::snapshot_words; }

/// Twelve words, some clocks apart. Call next() once per clock.
class TickWords {
 public:
  explicit TickWords(std::uint64_t seed, bool dense = false, bool stray = false)
      : random_(seed), dense_(dense), stray_(stray) {
    for (std::size_t k = 0; k < order_.size(); ++k) order_[k] = number_at(static_cast<int>(k));
    shuffle();
  }

  struct Word {
    bool valid = false;
    std::uint8_t number = 0;
    std::uint32_t data = 0;
  };

  /// `word(n, k)` says what word k of tick n is.
  template <class Content>
  Word next(const Content& word) {
    if (wait_-- > 0) return idle_;
    if (extra_ > 0) {
      --extra_;
      idle_.number = static_cast<std::uint8_t>(random_.below(16));
      idle_.data = static_cast<std::uint32_t>(random_.bits());
      Word stray = idle_;
      stray.valid = true;
      wait_ = 1;
      return stray;
    }
    idle_.number = static_cast<std::uint8_t>(order_[at_]);
    idle_.data = word(tick_, order_[at_]);
    Word now = idle_;
    now.valid = true;
    wait_ = dense_ ? 0 : static_cast<int>(random_.below(5));
    if (++at_ >= order_.size()) begin_anew();
    if (stray_ && random_.one_in(200)) begin_anew();
    return now;
  }
  /// The tick that runs, or that begins next.
  std::uint32_t tick() const { return tick_; }

 private:
  /// With `stray`, as no core does it: ticks that break off, and words beside them.
  void begin_anew() {
    at_ = 0;
    shuffle();
    ++tick_;
    ++wait_;
    if (stray_ && random_.one_in(8)) extra_ = static_cast<int>(random_.below(24));
  }
  /// All but the last.
  void shuffle() {
    for (std::size_t k = order_.size() - 2; k > 0; --k) {
      std::swap(order_[k], order_[random_.below(static_cast<std::uint32_t>(k) + 1)]);
    }
  }
  Random random_;
  bool dense_, stray_;
  int extra_ = 0;
  std::array<int, LinkMap::snapshot_words> order_{};
  std::size_t at_ = 0;
  int wait_ = 3;
  std::uint32_t tick_ = 0;
  Word idle_;
};

}  // namespace feltgate::test
