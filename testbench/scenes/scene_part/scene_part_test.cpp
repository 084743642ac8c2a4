// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// scene_part: RTL against twin, and both against plain integers; rounding a part gives what
// rounding the product gives. Documentation: docs/blocks/scenes.md
#include <Vscene_part.h>

#include "../scenes/scene_bench.hpp"
#include "../scenes/scene_twins.hpp"
#include "catch.hpp"
#include "feltgate/quad.hpp"

using namespace feltgate;
using namespace feltgate::test;

namespace {

constexpr int kFraction = 30;  // the RTL's defaults
using Twin = ScenePart<Design, kFraction>;
constexpr int kDrop = kFraction - Design::f.scene_part.fraction;
constexpr bool kToEven = Design::rounding == Round::convergent;

/// It is combinational; the bench wants to drive a clock and a reset.
struct Rtl : Vscene_part {
  using Vscene_part::Vscene_part;
  int clk_i = 0, rst_ni = 0;
};

struct Adapter {
  static void drive(Rtl& rtl, const Twin::In& in) {
    rtl.product_i = port_bits<53, std::uint64_t>(in.product);
  }
  template <class Check>
  static void compare(Check& check, const Rtl& rtl, const Twin::Out& out) {
    check("part", sign_extend<kPartWidth>(rtl.part_o), out.part);
  }
};

/// Products that a part holds, of every size; every pattern of the bits that are dropped.
struct Products {
  Random random{3};
  Twin::In operator()(std::int64_t clock) {
    if (clock < LockStep<Rtl, Twin, Adapter>::kFirstReset + 1) return {};
    const int width = std::min(kPartWidth + kDrop, 53);
    std::int64_t x = (static_cast<std::int64_t>(random.bits()) >> (64 - width)) >>
                     random.below(static_cast<std::uint64_t>(width));
    if (random.one_in(4)) x &= -(std::int64_t{1} << random.below(kDrop + 3));  // nothing below
    return {x};
  }
};

struct Tally {
  std::int64_t clocks = 0, negative = 0, ties = 0, exact = 0;
};

struct Integers {
  Tally* tally;
  const char* operator()(const Twin::In& in, const Rtl& rtl, const Twin&, bool in_reset) {
    if (in_reset) return nullptr;
    const std::int64_t part = sign_extend<kPartWidth>(rtl.part_o);
    const std::int64_t dropped = in.product & ((std::int64_t{1} << kDrop) - 1);
    ++tally->clocks;
    tally->negative += in.product < 0;
    tally->exact += dropped == 0;
    const std::int64_t whole = in.product >> kDrop;
    if (part != (kToEven && dropped != 0 ? whole | 1 : whole)) return "the product's upper bits";
    const Quad lsb = Quad{1} / static_cast<Quad>(std::int64_t{1} << kDrop);
    const Quad error = static_cast<Quad>(in.product) * lsb - static_cast<Quad>(part);
    if (!kToEven && (error < 0 || error >= 1)) return "within a part's last bit, and never above";

    // The one rounding of the part is that of the product.
    constexpr int drop = kFraction - kTorque.fraction;
    const std::int64_t half = std::int64_t{1} << (drop - 1);
    const bool tie = (in.product & (2 * half - 1)) == half;
    tally->ties += tie;
    std::int64_t up = (in.product + half) >> drop;
    if (kToEven && tie && (up & 1) != 0) --up;
    return rounded(part) == up ? nullptr : "rounds as the product does";
  }
};

}  // namespace

TEST_CASE("scene_part: products of every size") {
  Tally tally;
  LockStep<Rtl, Twin, Adapter> bench("scene_part", 1);
  bench.run(Products{}, scaled_clocks(400000), {}, Integers{&tally});
  INFO("negative " << tally.negative << ", ties " << tally.ties << ", exact " << tally.exact);
  REQUIRE(tally.negative > tally.clocks / 3);
  REQUIRE(tally.negative < tally.clocks * 2 / 3);
  REQUIRE(tally.ties > 1000);
  REQUIRE(tally.exact > 1000);
}
