// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// RTL against the ECP5 netlist that Yosys made of it, every output bit in every clock. Inputs are
// random words, in turns: all new in each clock, or each bit flipping now and then, so that slow
// things (ticks, timers, encoder filters) get somewhere too. docs/synthesis.md
#include <Vpair.h>

#include <array>
#include <cstdint>
#include <iostream>
#include <memory>
#include <string>
#include <type_traits>

#include "catch.hpp"
#include "mismatch.hpp"
#include "pair_ports.hpp"
#include "random.hpp"

namespace {

using feltgate::test::port_bit;
using feltgate::test::Random;

constexpr int kWords = (kInputBits + 63) / 64;

template <class Port>
void set(Port& port, const std::array<std::uint64_t, kWords>& words) {
  if constexpr (std::is_integral_v<Port>) {
    port = static_cast<Port>(words[0] >> (64 * kWords - kInputBits));
  } else {
    for (int n = 0; n < (kInputBits + 31) / 32; ++n) {
      const int left = kInputBits - 32 * n;
      const std::uint32_t mask = left >= 32 ? ~0U : (1U << left) - 1;
      const auto word = words[static_cast<std::size_t>(n / 2)] >> (32 * (n % 2));
      port[static_cast<std::size_t>(n)] = static_cast<std::uint32_t>(word) & mask;
    }
  }
}

template <class Port>
bool same(const Port& a, const Port& b) {
  if constexpr (std::is_integral_v<Port>) {
    return a == b;
  } else {
    for (int n = 0; n < (kOutputBits + 31) / 32; ++n) {
      if (a[static_cast<std::size_t>(n)] != b[static_cast<std::size_t>(n)]) return false;
    }
    return true;
  }
}

std::string first_difference(const Vpair& pair) {
  for (const Field& field : kFields) {
    for (int n = field.first; n < field.first + field.width; ++n) {
      if (port_bit(pair.rtl_o, n) != port_bit(pair.netlist_o, n)) {
        return std::string(field.name) + "[" + std::to_string(n - field.first) + "]";
      }
    }
  }
  return "nothing";
}

/// Each bit set with probability 2^-k.
std::uint64_t flips(Random& random, int k) {
  std::uint64_t word = random.bits();
  for (int n = 1; n < k; ++n) word &= random.bits();
  return word;
}

}  // namespace

TEST_CASE("post-synthesis: RTL and netlist agree in every clock") {
  const auto pair = std::make_unique<Vpair>();
  pair->rst_ni = 1;  // so that the reset has an edge, before any of the clock
  pair->eval();
  const std::int64_t clocks = feltgate::test::scaled_clocks(250000);
  Random random{20260117};
  std::array<std::uint64_t, kWords> words{};
  std::int64_t changes = 0;
  std::int64_t resets = 0;
  std::uint64_t last = 0;
  int sparsity = 1;
  for (std::int64_t clock = 0; clock < clocks; ++clock) {
    if (clock % 2000 == 0) sparsity = std::array{1, 4, 6, 9}[random.below(4)];
    for (auto& word : words) word ^= flips(random, sparsity);
    const bool reset = clock < 4 || random.below(20000) == 0;
    resets += reset ? 1 : 0;
    set(pair->in_i, words);
    pair->rst_ni = reset ? 0 : 1;
    pair->clk_i = 0;
    pair->eval();
    if (!same(pair->rtl_o, pair->netlist_o)) {
      FAIL("mismatch at clock " << clock << ", " << first_difference(*pair));
    }
    pair->clk_i = 1;
    pair->eval();
    if (!same(pair->rtl_o, pair->netlist_o)) {
      FAIL("mismatch at clock " << clock << ", " << first_difference(*pair));
    }
    std::uint64_t seen = 0;
    for (int n = 0; n < kOutputBits; ++n) seen = seen * 3 + port_bit(pair->rtl_o, n);
    changes += seen != last ? 1 : 0;
    last = seen;
  }
  std::cout << clocks << " clocks, 0 mismatches, outputs changed in " << changes << ", " << resets
            << " in reset\n";
  REQUIRE(changes > clocks / 100);  // else nothing was tested
  REQUIRE(resets > 4);
}
