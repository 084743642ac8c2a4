// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Twin of rtl/core/wave/multipliers.sv, clock by clock: one multiplier on the operand bus, or one
// per block. Documentation: docs/architecture.md
#pragma once

#include <cstdint>

#include "../mult/mult_twin.hpp"
#include "feltgate/words.hpp"

namespace feltgate {

/// Clocked twin.
template <class D>
class Multipliers {
 public:
  struct In {
    std::int64_t operand = 0;  ///< the whole bus
    std::int64_t velocity = 0, dob = 0, scene = 0, control = 0, supervisor = 0;
    bool is_signed = false;
    std::uint32_t param = 0;
    bool square_distance = false;
    std::int64_t distance = 0;  ///< 18 bits
    bool square_estimate = false;
    std::int64_t estimate = 0;  ///< 0 unless it is to be squared
    bool zero_control = false;  ///< control's factor is 0; so are distance and estimate
  };
  struct Out {
    std::int64_t velocity = 0, dob = 0, scene = 0, control = 0, supervisor = 0;
  };

  /// The pipelines have no reset; this clears them.
  void reset() { *this = Multipliers{}; }

  void clock(const In& in) {
    const Format word{in.is_signed ? 1 : 0, D::coefficient_bits, 0};
    const std::int64_t coefficient = decode_word(word, in.param);
    const std::int64_t by_scene = in.square_distance ? in.distance : coefficient;
    const std::int64_t by_supervisor = in.square_estimate ? in.estimate : coefficient;
    if constexpr (D::parallel_multipliers == 0) {
      const std::int64_t factor = in.zero_control ? 0 : by_supervisor;
      velocity_.clock({in.operand, in.square_distance ? in.distance : factor});
      const std::int64_t product = velocity_.out().product;
      out_ = {product, product, product, product, product};
    } else {
      velocity_.clock({in.velocity, coefficient});
      dob_.clock({in.dob, coefficient});
      scene_.clock({in.scene, by_scene});
      control_.clock({in.control, in.zero_control ? 0 : coefficient});
      supervisor_.clock({in.supervisor, by_supervisor});
      out_ = {velocity_.out().product, dob_.out().product, scene_.out().product,
              control_.out().product, supervisor_.out().product};
    }
  }

  const Out& out() const { return out_; }

 private:
  Mult velocity_, dob_, scene_, control_, supervisor_;  ///< the first for all where one is shared
  Out out_;
};

}  // namespace feltgate
