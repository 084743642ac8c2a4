// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
#include "feltgate/axis/motor_heat.hpp"

#include "ports/motor_heat.hpp"

using namespace feltgate::test;

namespace {

struct Twin : BlockTwin<ports::motor_heat> {
  using Law = MotorHeat<Fixed>;
  static constexpr int holds = Law::summed + 2;
  static void strobes(In& in, int clock) { in.start = clock == 0; }
  /// Budgets near the sum.
  void legal(In& in, Random& random) {
    if (random.one_in(3)) in.p.i2t_budget = static_cast<std::uint32_t>(sum + random.between(-1, 1));
  }
  /// They hold between the edges, too.
  static void asynchronous(In& between, const In& in) { between = in; }
  bool summed() const { return block.at(Law::summed); }
  void clock(const In& in) {
    if (summed())
      law.heat(sum, in.p, in.armed,
               in.measured ? law.measured(in.measured_current) : block.shown().current);
    block.clock(in.start, [&] { return law.tick(in.p, in.voltage, in.velocity); });
  }
  Out out(const In& in) const {
    return {block.shown().current, summed() && sum >= std::int64_t{in.p.i2t_budget}};
  }
  void reset(const In&) { block = {}; }  // the motor stays hot

  Law law{design()};
  Clocked<Law> block;
  std::int64_t sum = law.start;
};

}  // namespace

TEST_CASE("motor_heat: RTL and twin, every clock") { lock_step(Twin(), {800'000}); }
