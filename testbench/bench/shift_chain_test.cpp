// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The chain written by hand in shifts against the laws in `fixed`: every result of every tick on a
// random life with random parameter words. FELTGATE_DEFECT=1..3 breaks one of the words.
// Documentation: docs/bench.md
#include <array>
#include <string>

#include "../fixed/seeded_defect.hpp"
#include "bench/shift_chain.hpp"
#include "catch.hpp"
#include "random.hpp"
#include "reference/control_chain.hpp"

namespace {

using namespace feltgate;
using Results = std::array<std::int64_t, 13>;

Results results(const ControlChain<Lever, Fixed>& c) {
  const auto& control = c.control();
  return {c.velocity().raw(),    c.tau_hat().raw(),     c.tau_ref().raw(),  control.current.raw(),
          control.voltage.raw(), control.duty.raw(),    c.limit_torque(),   c.limit_ramp(),
          control.limit.current, control.limit.voltage, control.limit.duty, c.limit_velocity(),
          c.limit_tau_hat()};
}

Results results(const ShiftChain& c) {
  return {c.velocity,         c.tau_hat,       c.tau_ref,      c.current,
          c.voltage,          c.duty,          c.limit_torque, c.limit_ramp,
          c.limit_current,    c.limit_voltage, c.limit_duty,   c.velocity_saturated,
          c.tau_hat_saturated};
}

/// The word that the hand-written chain gets: the same, or with a defect.
std::uint32_t seeded(int address, std::uint32_t word) {
  switch (test::seeded_defect()) {
    case 1:
      return address == Lever::A::damper_damping ? word ^ 1u : word;
    case 2:
      return address == Lever::A::voltage_limit ? word + 1 : word;
    case 3:
      return address == Lever::A::observer_a1 ? word + 1 : word;
    default:
      return word;
  }
}

}  // namespace

TEST_CASE("shifts and fixed agree on a random life") {
  test::Random random(41);
  ShiftChain shifts;
  ControlChain<Lever, Fixed> laws;
  laws.reset();
  ChainIn in;
  Results seen{};
  long different = 0;
  const long ticks = 1'500'000;
  for (long k = 0; k < ticks; ++k) {
    if (random.one_in(50)) {
      const int step = static_cast<int>(random.below(5)) - 2;
      in.position += step;
      in.travel = static_cast<std::int16_t>(in.travel + step);
    }
    // A burst faster than the velocity's format.
    if (k % 150'000 > 148'800) in.travel = static_cast<std::int16_t>(in.travel + 1);
    if (random.one_in(20'000)) in.armed = !random.one_in(4);
    if (random.one_in(30'000)) in.scene = static_cast<int>(random.below(10));
    if (random.one_in(40'000)) in.mode = static_cast<int>(random.below(3));
    if (random.one_in(30'000)) in.position = static_cast<std::int32_t>(random.below(4000)) - 2000;
    if (random.one_in(1000)) {
      const auto& p = Lever::parameters[random.below(std::size(Lever::parameters))];
      // A filter's coefficient above 1 would make it grow without end.
      const bool filter = p.address == Lever::A::velocity_a1 || p.address == Lever::A::observer_a1;
      const auto word = filter || random.one_in(2)
                            ? static_cast<std::uint32_t>(p.raw & 0xffffffff)
                            : static_cast<std::uint32_t>(random.bits() >> 32);
      laws.words().set_raw(p.address, word);
      shifts.set_word(p.address, seeded(p.address, word));
    }
    laws.tick(in);
    shifts.tick(in);
    const Results a = results(laws), b = results(shifts);
    if (a != b && different++ == 0) {
      for (std::size_t s = 0; s < a.size(); ++s) {
        if (a[s] != b[s]) {
          WARN("tick " << k << ", scene " << in.scene << ", result " << s << ": fixed " << a[s]
                       << ", shifts " << b[s]);
        }
      }
    }
    for (std::size_t s = 0; s < a.size(); ++s) seen[s] += a[s] != 0 ? 1 : 0;
  }
  CHECK(different == 0);
  // Every limit has acted and every signal moved, but not always.
  for (std::size_t s = 0; s < seen.size(); ++s) {
    INFO("result " << s << ": " << seen[s]);
    CHECK(seen[s] > ticks / 1000);
    CHECK(seen[s] < ticks);
  }
}
