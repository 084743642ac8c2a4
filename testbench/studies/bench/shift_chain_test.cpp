// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The chain written by hand in shifts against the laws in `fixed`: every result of every tick of a
// random life. Documentation: docs/bench.md
#include "studies/bench/shift_chain.hpp"
#include "catch.hpp"
#include "chain_life.hpp"

namespace {

using namespace feltgate;
using namespace feltgate::test;

/// The hand-written chain as compare_lives() drives one.
class Shifts {
 public:
  void write(int address, std::uint32_t data) { chain_.set_word(address, data); }
  ChainResults tick(const ChainIn& in) {
    chain_.tick(in);
    return {chain_.velocity,         chain_.tau_hat,    chain_.tau_ref,
            chain_.current,          chain_.voltage,    chain_.duty,
            chain_.limit_torque,     chain_.limit_ramp, chain_.limit_current,
            chain_.limit_voltage,    chain_.limit_duty, chain_.velocity_saturated,
            chain_.tau_hat_saturated};
  }

 private:
  ShiftChain chain_;
};

}  // namespace

TEST_CASE("shifts and fixed agree on a random life") {
  const long ticks = 2'000'000;
  Laws<Lever, Fixed> laws;
  Shifts shifts;
  const ChainComparison c = compare_lives<Lever>(41, ticks, laws, shifts);
  INFO("first divergence: " << c.first_divergence);
  CHECK(c.first_divergence.empty());
  CHECK(not_exercised(c, ticks).empty());
}
