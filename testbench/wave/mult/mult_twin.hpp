// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Twin of rtl/core/wave/mult.sv: the chain's one multiplier, 35 x 18 bits signed, product four
// clocks after the operands. Documentation: docs/architecture.md
#pragma once

#include <array>
#include <cstdint>

#include "random.hpp"

namespace feltgate {

class Mult {
 public:
  struct In {
    std::int64_t a = 0;  ///< 35 bits, signed
    std::int64_t b = 0;  ///< 18 bits, signed
  };
  struct Out {
    std::int64_t product = 0;  ///< 53 bits, signed; of the operands four clocks ago
  };

  /// The pipeline has no reset; this clears it, as simulation does before the first clock.
  void reset() {
    pipeline_.fill(0);
    out_ = {};
  }

  void clock(const In& in) {
    out_.product = pipeline_[2];
    pipeline_[2] = pipeline_[1];
    pipeline_[1] = pipeline_[0];
    pipeline_[0] = in.a * in.b;
  }

  const Out& out() const { return out_; }

 private:
  std::array<std::int64_t, 3> pipeline_{};
  Out out_;
};

}  // namespace feltgate

// The shared multiplier as a block under test sees it: its own products four clocks after their
// operands, products of random operands in every other clock, so that taking one a clock early or
// late shows.

namespace feltgate::test {

class SharedMult {
 public:
  explicit SharedMult(std::uint64_t seed) : random_(seed) {}

  /// On the product bus in this clock. Call it once per clock, before operands() or others().
  std::int64_t product() const { return mult_.out().product; }
  /// This clock belongs to the block under test.
  void operands(std::int64_t a, std::int64_t b) { mult_.clock({a, b}); }
  /// This clock belongs to another block.
  void others() {
    constexpr std::int64_t a = std::int64_t{1} << 34;
    constexpr std::int64_t b = std::int64_t{1} << 17;
    const auto upper = static_cast<std::int64_t>(random_.bits() % (2 * a));
    mult_.clock({upper - a, random_.between(-b, b - 1)});
  }

 private:
  Random random_;
  Mult mult_;
};

}  // namespace feltgate::test
