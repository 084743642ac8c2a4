// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// multipliers: RTL against twin on every clock, one for all or one per block, and both against the
// products of the operands four clocks ago. Documentation: docs/architecture.md
#include <Vmultipliers.h>

#include <array>
#include <cstdint>

#ifdef FELTGATE_DESIGN_HEADER
#include FELTGATE_DESIGN_HEADER
#endif
#include "../../estimators/lowpass/exact.hpp"
#include "../mult/mult_twin.hpp"
#include "catch.hpp"
#include "feltgate/words.hpp"
#include "lock_step.hpp"
#include "unreset.hpp"

// Twin of rtl/core/wave/multipliers.sv, clock by clock: one multiplier on the operand bus, or one
// per block.

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

using namespace feltgate;
using namespace feltgate::test;

namespace {

constexpr bool kShared = Design::parallel_multipliers == 0;
constexpr int kBus = Design::multiplier_a_bits;
constexpr int kDifference = Design::f.velocity_difference.width();
constexpr int kEstimate = Design::f.current_estimate.width();
constexpr int kLatency = Map::multiplier_latency;

using Twin = Filled<Multipliers<Design>, kLatency>;
using Rtl = Unreset<Vmultipliers>;

template <class Word>
std::int64_t product(Word word) {
  return sign_extend<Design::product_bits>(static_cast<std::uint64_t>(word));
}

struct Adapter {
  static void drive(Rtl& rtl, const Twin::In& in) {
    using Long = std::uint64_t;
    rtl.operand_i = port_bits<kBus, Long>(in.operand);
    rtl.velocity_i = port_bits<kDifference, Long>(in.velocity);
    rtl.dob_i = port_bits<kBus, Long>(in.dob);
    rtl.scene_i = port_bits<kBus, Long>(in.scene);
    rtl.control_i = port_bits<kBus, Long>(in.control);
    rtl.supervisor_i = port_bits<kBus, Long>(in.supervisor);
    rtl.signed_i = in.is_signed;
    rtl.param_i = in.param;
    rtl.square_distance_i = in.square_distance;
    rtl.distance_i = port_bits<18>(in.distance);
    rtl.square_estimate_i = in.square_estimate;
    rtl.estimate_i = port_bits<kEstimate>(in.estimate);
    rtl.zero_control_i = in.zero_control;
  }
  template <class Check>
  static void compare(Check& check, const Rtl& rtl, const Twin::Out& out) {
    if (!out.known) return;
    check("velocity_product", product(rtl.velocity_product_o), out.velocity);
    check("dob_product", product(rtl.dob_product_o), out.dob);
    check("scene_product", product(rtl.scene_product_o), out.scene);
    check("control_product", product(rtl.control_product_o), out.control);
    check("supervisor_product", product(rtl.supervisor_product_o), out.supervisor);
  }
};

using Bench = LockStep<Rtl, Twin, Adapter>;

enum Kind { kWord, kSignedWord, kSquareDistance, kSquareEstimate, kZeroControl, kKinds };

Kind kind(const Twin::In& in) {
  if (in.square_distance) return kSquareDistance;
  if (in.square_estimate) return kSquareEstimate;
  if (in.zero_control) return kZeroControl;
  return in.is_signed ? kSignedWord : kWord;
}

struct Stimulus {
  Random random;

  template <int Width>
  std::int64_t any() {
    const auto word = static_cast<std::int64_t>(random.bits()) >> (64 - Width);
    return word >> random.below(Width);
  }
  Twin::In operator()(std::int64_t) {
    Twin::In in;
    in.operand = any<kBus>();
    in.velocity = any<kDifference>();
    in.dob = any<kBus>();
    in.scene = any<kBus>();
    in.control = any<kBus>();
    in.supervisor = any<kBus>();
    in.param = static_cast<std::uint32_t>(random.bits() >> 32);
    in.distance = any<18>();
    const auto what = static_cast<Kind>(random.below(kKinds));
    in.is_signed = what == kSignedWord;
    in.square_distance = what == kSquareDistance;
    in.square_estimate = what == kSquareEstimate;
    if (what == kSquareEstimate) {  // of the two that are squared one is 0
      in.estimate = any<kEstimate>();
      in.distance = 0;
    }
    in.zero_control = what == kZeroControl;
    if (what == kZeroControl) in.distance = 0;
    return in;
  }
};

/// The product of each block, of its own operand or of the whole bus, four clocks ago.
struct ClocksAgo {
  std::array<std::array<std::int64_t, 2>, kKinds>* seen;  ///< by kind and sign of the factor
  std::array<Twin::In, kLatency> past{};
  int filled = 0;

  const char* operator()(const Twin::In& in, const Rtl& rtl, const Twin&, bool in_reset) {
    filled = in_reset ? 0 : filled + 1;
    for (std::size_t k = kLatency - 1; k > 0; --k) past[k] = past[k - 1];
    past[0] = in;
    if (filled < kLatency) return nullptr;
    const Twin::In& then = past[kLatency - 1];
    const std::int64_t scale = std::int64_t{1} << Design::coefficient_bits;
    std::int64_t word = then.param % scale;
    if (kind(then) == kSignedWord && (then.param / scale) % 2 != 0) word -= scale;
    const std::int64_t by_scene = then.square_distance ? then.distance : word;
    const std::int64_t by_supervisor = then.square_estimate ? then.estimate : word;
    const std::int64_t by_control = then.zero_control ? 0 : word;
    const std::int64_t by_all = then.zero_control      ? 0
                                : then.square_distance ? then.distance
                                                       : by_supervisor;
    ++(*seen)[kind(then)][by_all < 0];
    const auto is = [&then](std::int64_t shown, std::int64_t own, std::int64_t factor,
                            std::int64_t shared_factor) {
      return shown == (kShared ? then.operand * shared_factor : own * factor);
    };
    if (!is(product(rtl.velocity_product_o), then.velocity, word, by_all)) return "velocity's";
    if (!is(product(rtl.dob_product_o), then.dob, word, by_all)) return "dob's product";
    if (!is(product(rtl.scene_product_o), then.scene, by_scene, by_all)) return "scenes' product";
    if (!is(product(rtl.control_product_o), then.control, by_control, by_all)) {
      return "control's product";
    }
    if (!is(product(rtl.supervisor_product_o), then.supervisor, by_supervisor, by_all)) {
      return "supervisor's product";
    }
    return nullptr;
  }
};

}  // namespace

TEST_CASE("multipliers: words with and without a sign, and both squares") {
  std::array<std::array<std::int64_t, 2>, kKinds> seen{};
  const std::int64_t clocks = scaled_clocks(400000);
  Bench bench("multipliers", 1);
  bench.run(Stimulus{Random(2)}, clocks, {1000}, ClocksAgo{&seen, {}, 0});
  for (int k = 0; k < kKinds; ++k) {
    const auto& of_kind = seen[static_cast<std::size_t>(k)];
    INFO("kind " << k << ", factors from 0 " << of_kind[0] << ", below " << of_kind[1]);
    REQUIRE(of_kind[0] * 20 > clocks);
    REQUIRE((of_kind[1] * 20 > clocks) == (k != kWord && k != kZeroControl));
  }
}
