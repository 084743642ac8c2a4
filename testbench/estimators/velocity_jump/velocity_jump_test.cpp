// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// velocity_jump: RTL against twin on every clock; silent behind a low-pass with any coefficient and
// any input, and every flip of an upper bit found. Documentation: docs/blocks/velocity.md
#include <Vvelocity_jump.h>

#include <cstdint>

#include FELTGATE_DESIGN_HEADER

#include "catch.hpp"
#include "feltgate/generated/map.hpp"
#include "feltgate/lowpass.hpp"
#include "lock_step.hpp"
#include "ports.hpp"

// Twin of rtl/core/estimators/velocity_jump.sv, clock by clock.

namespace feltgate {

/// Clocked twin.
template <class D>
class VelocityJump {
 public:
  /// The low-pass changes in a tick by less than 2^weight bits of the velocity.
  static constexpr int weight =
      D::f.velocity.width() + D::coefficient_bits - D::P::velocity_a1.fraction;
  static constexpr bool compares = weight >= 0 && weight <= D::f.velocity.width() - 2;

  struct In {
    std::uint64_t wave = 0;
    std::int64_t velocity = 0;  ///< raw
  };
  struct Out {
    bool trip = false;
  };

  void reset() { *this = VelocityJump{}; }
  void clock(const In& in) {
    out_.trip = false;
    if (!compares || ((in.wave >> Map::T::jump) & 1u) == 0) return;
    const std::int64_t top = floor_of(in.velocity);
    out_.trip = top > before_ + 1 || top < before_ - 1;
    before_ = top;
  }
  const Out& out() const { return out_; }

 private:
  static std::int64_t floor_of(std::int64_t raw) {
    constexpr std::int64_t unit = std::int64_t{1} << (compares ? weight : 0);
    return raw >= 0 ? raw / unit : -((unit - 1 - raw) / unit);
  }
  std::int64_t before_ = 0;
  Out out_;
};

}  // namespace feltgate

using namespace feltgate;
using namespace feltgate::test;

namespace {

using D = FELTGATE_DESIGN;
using Twin = VelocityJump<D>;
using Velocity = fixed_of<D::f.velocity.key()>;

struct Adapter {
  static void drive(Vvelocity_jump& rtl, const Twin::In& in) {
    FELTGATE_STROBES(rtl, in.wave, at, T, jump);
    rtl.velocity_i = static_cast<std::uint32_t>(in.velocity);
  }
  template <class Check>
  static void compare(Check& check, const Vvelocity_jump& rtl, const Twin::Out& out) {
    check("trip", rtl.trip_o, out.trip);
  }
};

/// y + a1 * (x - y) of integers, floored: any word a1 of the coefficient's bits.
std::int64_t filtered(std::int64_t y, std::int64_t x, std::uint32_t a1) {
  return y + (((x - y) * std::int64_t{a1}) >> D::P::velocity_a1.fraction);
}

/// A wave per few clocks; the velocity of a low-pass that is driven from end to end, and flips.
struct Drive {
  Random random;
  bool flips = false;
  Random others{3};
  int clock = 0;
  std::int64_t y = 0, x = 0;
  std::uint32_t a1 = 0;
  bool reset_before = true;

  Twin::In operator()(std::int64_t cycle) {
    Twin::In in;
    if (cycle < LockStep<Vvelocity_jump, Twin, Adapter>::kFirstReset + 8) return in;
    clock = (clock + 1) % 5;
    if (clock == 0) {
      if (random.one_in(200))
        a1 = random.one_in(3) ? 0x1ffff : static_cast<std::uint32_t>(random.below(1u << 17));
      if (random.one_in(50)) x = random.coin() ? Velocity::max_raw() : Velocity::min_raw();
      if (random.one_in(50)) x = random.between(Velocity::min_raw(), Velocity::max_raw());
      y = filtered(y, x, a1);
      if (flips && random.one_in(20)) {
        y = static_cast<std::int32_t>(static_cast<std::uint32_t>(y) ^ (1u << random.below(32)));
      }
    }
    in.velocity = y;
    // Other clocks of the wave are not this block's.
    constexpr std::uint64_t own = std::uint64_t{1} << Map::T::jump;
    in.wave = clock == 2 ? own : others.bits() & ~own;
    return in;
  }
};

struct Count {
  std::int64_t* trips;
  const char* operator()(const Twin::In&, const Vvelocity_jump& rtl, const Twin&, bool) const {
    *trips += rtl.trip_o;
    return nullptr;
  }
};
using Bench = LockStep<Vvelocity_jump, Twin, Adapter>;

}  // namespace

TEST_CASE("velocity_jump: a low-pass never trips it, whatever its coefficient and its input") {
  std::int64_t trips = 0;
  Bench bench("velocity_jump", 1);
  bench.run(Drive{Random(1)}, scaled_clocks(2'000'000), {}, Count{&trips});
  REQUIRE(trips == 0);
}

TEST_CASE("velocity_jump: flips, with resets") {
  std::int64_t trips = 0;
  Drive drive{Random(2)};
  drive.flips = true;
  Bench bench("velocity_jump", 2);
  bench.run(drive, scaled_clocks(500'000), {}, Count{&trips});
  // Of 32 bits those above the weight are found, the lowest of them now and then.
  CHECK(trips > scaled_clocks(500'000) / 5 / 20 * (31 - Twin::weight) / 32 / 2);
  bench.run(drive, scaled_clocks(200'000), {900});
}
