// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Twin of rtl/core/wave/mult.sv: the chain's one multiplier, 35 x 18 bits signed, product four
// clocks after the operands. Documentation: docs/architecture.md
#pragma once

#include <array>
#include <cstdint>

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
