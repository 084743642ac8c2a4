// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// velocity_n: RTL against twin and plain integers on every clock; gain error of the N-method,
// and distance from quad precision. docs/blocks/velocity.md
#include <Vvelocity_n.h>

#include <cmath>
#include <cstdint>
#include <functional>
#include <vector>

#include "../../wave/mult/mult_twin.hpp"
#include "../lowpass/exact.hpp"
#include "../lowpass/lowpass_twin.hpp"
#include "catch.hpp"
#include "feltgate/generated/map.hpp"
#include "feltgate/largest.hpp"
#include "feltgate/velocity_n.hpp"
#include "feltgate/words.hpp"
#include "lock_step.hpp"
#include "ports.hpp"

// Twin of rtl/core/estimators/velocity_n.sv, clock by clock, by the law of the chain.

namespace feltgate {

/// Clocked twin.
template <class D>
class VelocityN {
 public:
  using Law = VelocityLaw<D, Fixed>;
  using Velocity = typename Law::Velocity;
  using A1 = fixed_of<D::P::velocity_a1.key()>;

  struct In {
    std::uint64_t wave = 0;
    std::int16_t travel = 0;   ///< taken in T::sample
    std::int64_t product = 0;  ///< in T::velocity: a1 * operand
  };
  struct Out {
    std::int64_t operand = 0;
    std::int64_t velocity = 0;
    bool saturated = false;
  };

  void reset() {
    line_.reset();
    filter_.reset();
    travel_ = oldest_ = difference_ = 0;
    raw_ = Velocity{};
    out_ = {};
  }

  void clock(const In& in) {
    const auto at = [&in](int t) { return ((in.wave >> t) & 1u) != 0; };
    using T = Map::T;
    filter_.clock({at(T::velocity_difference), at(T::velocity), false, raw_.raw(), in.product});
    if (at(T::velocity_difference)) line_.push(travel_);
    if (at(T::velocity_raw)) {
      out_.saturated = false;
      raw_ = Law::raw(difference_, &out_.saturated);
    }
    if (at(T::travel)) difference_ = travel_difference(travel_, oldest_);
    if (at(T::sample)) {
      travel_ = in.travel;
      oldest_ = line_.oldest();
    }
    out_.operand = filter_.out().operand;
    out_.velocity = filter_.out().y;
  }

  const Out& out() const { return out_; }
  Velocity velocity() const { return filter_.state(); }

 private:
  DelayLine<D::m1> line_;
  Lowpass<D::f.velocity.key(), D::f.velocity_difference.key(), D::P::velocity_a1.key(), D::rounding>
      filter_;
  std::int16_t travel_ = 0, oldest_ = 0, difference_ = 0;
  Velocity raw_{};
  Out out_;
};

}  // namespace feltgate

namespace feltgate::test {

using Velocity = VelocityN<Design>;
using A1 = Velocity::A1;

struct NoAside {};
using Twin = Watched<Velocity, NoAside>;

/// The design's low-pass coefficient.
inline A1 design_a1() { return A1::from_raw(parameter(Design::A::velocity_a1).raw); }

struct Adapter {
  static void drive(Vvelocity_n& rtl, const Twin::In& in) {
    FELTGATE_STROBES(rtl, in.port.wave, at, T, sample, travel, velocity_raw, velocity_difference,
                     velocity);
    rtl.travel_i = port_bits<16, std::uint16_t>(in.port.travel);
    rtl.product_i = port_bits<53, std::uint64_t>(in.port.product);
  }
  template <class Check>
  static void compare(Check& check, const Vvelocity_n& rtl, const Twin::Out& out) {
    if (out.clocked) {
      check("operand", sign_extend<Design::f.velocity_difference.width()>(rtl.operand_o),
            out.port.operand);
    }
    check("velocity", sign_extend<Design::f.velocity.width()>(rtl.velocity_o), out.port.velocity);
    check("saturated", rtl.saturated_o, out.port.saturated);
  }
};

using Bench = LockStep<Vvelocity_n, Twin, Adapter>;

/// Travel is taken in this clock.
inline bool sampled(const Twin::In& in) { return ((in.port.wave >> Map::T::sample) & 1u) != 0; }

/// The last bits of a count that never stops.
inline std::int16_t wrapped_travel(std::int64_t count) {
  return static_cast<std::int16_t>(static_cast<std::uint16_t>(count & 0xffff));
}

/// A wave every ten clocks or more; count(tick) is the encoder's count, tick 0 the first after
/// reset. In the clocks between the waves travel is garbage.
template <class Count>
struct Waves {
  Waves(std::uint64_t seed, Count c, std::uint32_t more_clocks)
      : count(c), mult(seed), random(seed + 1), spread(more_clocks) {}

  Twin::In operator()(std::int64_t, const Twin::Out& out) {
    if (out.resets != resets) {
      resets = out.resets;
      clock = 0;
      tick = 0;
    }
    Twin::In in;
    in.port.wave = std::uint64_t{1} << clock;
    in.port.travel = wrapped_travel(static_cast<std::int64_t>(random.bits() >> 1));
    if (clock == 0) {
      in.port.travel = wrapped_travel(count(tick++));
      period = kShortest + static_cast<int>(random.below(spread));
    }
    in.port.product = mult.product();
    if (clock == Map::W::velocity_a1) {
      mult.operands(out.port.operand, design_a1().raw());
    } else {
      mult.others();
    }
    clock = clock + 1 == period ? 0 : clock + 1;
    return in;
  }

  static constexpr int kShortest = Map::T::velocity + 2;
  Count count;
  SharedMult mult;
  Random random;
  std::uint32_t spread;
  std::int64_t resets = 0, tick = 0;
  int clock = 0, period = kShortest;
};

/// A hand on the encoder: rest, slow, fast, faster than the format, reversals; rarely a count that
/// is anywhere, as no encoder would show it.
struct RandomMotion {
  Random random{11};
  std::int64_t position = 0, phase = 0, step = 0;  // step: counts per 1024 ticks
  int left = 0;

  std::int64_t operator()(std::int64_t tick) {
    if (tick == 0) position = phase = left = 0;
    if (left-- == 0) {
      left = static_cast<int>(random.between(50, 2500));
      constexpr std::int64_t speeds[] = {0, 2, 30, 200, 400, 600, 650, 1000};
      const std::int64_t speed = speeds[random.one_in(3) ? random.below(8) : random.below(5)];
      step = random.coin() ? speed : -speed;
      if (random.one_in(40)) position = static_cast<std::int64_t>(random.below(65536));
    }
    phase += step;
    const std::int64_t counts = phase >> 10;
    phase -= counts * 1024;
    position += counts;
    return position;
  }
};

/// The chain's velocity, tick by tick.
struct Ticks {
  Words<Design, Fixed> words;
  DelayLine<Design::m1> line;
  EstimatorStep<Design, Fixed> step;

  void reset() { *this = Ticks{}; }
  void tick(std::int16_t travel) {
    const std::int16_t counts = travel_difference(travel, line.oldest());
    line.push(travel);
    step.tick(words, counts);
  }
};

/// The chain beside clock(), and the N-method in plain integers, both due in the clock after the
/// velocity's step.
struct Reference {
  std::int64_t last_velocity = 0, ticks = 0, saturated = 0, wrapped = 0;
  std::vector<std::int64_t> counts{};  // of every tick since reset, as 16-bit numbers
  Ticks shadow{};
  std::int64_t y = 0;

  const char* operator()(const Twin::In& in, const Vvelocity_n& rtl, const Twin& twin,
                         bool in_reset) {
    if (in_reset) {
      shadow.reset();
      counts.clear();
      y = 0;
      return nullptr;
    }
    if (sampled(in)) {
      shadow.tick(in.port.travel);
      counts.push_back(in.port.travel);
    }
    const std::int64_t velocity = sign_extend<Design::f.velocity.width()>(rtl.velocity_o);
    last_velocity = velocity;
    if (((in.port.wave >> Map::T::velocity) & 1u) != 0) {
      y = next();
      if (shadow.step.velocity != twin.block.velocity())
        return "velocity of the chain is that of clock()";
      if (shadow.step.limit != twin.out().port.saturated) return "saturated of the chain";
    }
    return velocity == y ? nullptr : "velocity of the law in plain integers";
  }

  std::int64_t next() {
    const std::size_t now = counts.size() - 1;
    const bool filled = now >= Design::m1;
    const std::int64_t oldest = filled ? counts[now - Design::m1] : 0;
    std::int64_t difference = counts[now] - oldest;
    ++ticks;
    if (difference > 32767 || difference < -32768) {
      difference += difference > 0 ? -65536 : 65536;
      ++wrapped;
    }
    constexpr std::int64_t limit = std::int64_t{1} << (Design::f.velocity.width() - 1);
    std::int64_t raw = Design::velocity_gain != 0
                           ? difference * Design::velocity_gain * 32  // 16 to 21 fraction bits
                           : difference * (std::int64_t{1} << (Design::velocity_shift + 21));
    if (raw >= limit || raw < -limit) {
      raw = raw < 0 ? -limit : limit - 1;
      ++saturated;
    }
    const int128_t product = static_cast<int128_t>(raw - y) * design_a1().raw();
    return y + static_cast<std::int64_t>((product + (int128_t{1} << 26)) >> 27);
  }
};

}  // namespace feltgate::test

using namespace feltgate;
using namespace feltgate::test;

namespace {

/// One count every `ticks` ticks; where `ticks` divides m1 the counts in the window never change.
struct Uniform {
  std::int64_t ticks;
  int direction = 1;
  std::int64_t operator()(std::int64_t tick) const { return direction * (tick / ticks); }
};

/// The fastest speed whose counts in the window are exact and which fits the format.
constexpr int exact_ticks() {
  for (int ticks = 2;; ++ticks) {
    if (Design::m1 % ticks == 0) return ticks;
  }
}

/// Gain error as the literature and the docs round it.
constexpr double stated_percent() {
  if (Design::velocity_gain != 0) return -0.0003;  // what is left is its quantisation
  return kIsPaper ? 0.653 : Design::m1 == Shortest::m1 ? 0.132 : 0.0013;
}

double rad_s(std::int64_t raw) { return static_cast<double>(raw) / (1 << 21); }

/// |velocity - low-pass of the same raw values| <= this: coefficient error over the largest
/// difference that reached the filter, half an LSB of rounding, both over a1.
quad error_bound(quad largest_difference) {
  const ParameterInfo& a1 = parameter(Design::A::velocity_a1);
  const quad quantised = static_cast<quad>(a1.raw) * lsb(a1.format.fraction);
  return (coefficient_error(a1) * largest_difference + lsb(21) / 2) / quantised;
}

}  // namespace

TEST_CASE("velocity_n: before the first tick nothing has saturated") {
  const EstimatorStep<Design, Fixed> step;
  CHECK_FALSE(step.limit);
  CHECK(step.velocity.raw() == 0);
}

TEST_CASE("velocity_n: random motion, gaps and resets") {
  Reference seen;
  Bench bench("velocity_n", 1);
  bench.run(Waves<RandomMotion>(3, {}, 30), scaled_clocks(1000000), {60000}, std::ref(seen));
  bench.run(Waves<RandomMotion>(4, {}, 1), scaled_clocks(1000000), {200000}, std::ref(seen));
  bench.run(Waves<RandomMotion>(5, {}, 41), scaled_clocks(200000), {3000}, std::ref(seen));
  REQUIRE(seen.saturated * 100 > seen.ticks);
  REQUIRE(seen.saturated * 5 < seen.ticks);
  REQUIRE(seen.wrapped > Design::m1 / 2);
}

TEST_CASE("velocity_n: gain error of the N-method at a constant speed") {
  for (const int direction : {1, -1}) {
    Reference seen;
    Bench bench("velocity_n", 6);
    constexpr int ticks = exact_ticks();
    bench.run(Waves<Uniform>(6, {ticks, direction}, 1), 700000, {}, std::ref(seen));
    // One count in `ticks` microseconds, 4096 counts per turn.
    const double turn = 2 * std::acos(-1.0);
    const double truth = direction * turn / 4096 / (ticks * 1e-6);
    // 2^n against the exact factor 2*pi / (4096 * tick * m1).
    const double expected = kRadSPerCount * 4096e-6 * Design::m1 / turn - 1;
    const double gain_error = rad_s(seen.last_velocity) / truth - 1;
    const double dead_band = 1001.0 / (1 << 21) / std::fabs(truth);
    INFO("true " << truth << " rad/s, gain error " << 100 * gain_error << " %");
    REQUIRE(seen.saturated == 0);
    REQUIRE(std::fabs(gain_error - expected) < dead_band);
    REQUIRE(std::fabs(100 * gain_error - stated_percent()) < 5e-4);
  }
}

TEST_CASE("velocity_n: distance from quad precision") {
  using Law = VelocityLaw<Design, Real<quad>>;
  Ticks chain;
  RandomMotion motion;
  motion.random = Random(21);
  std::vector<std::int64_t> counts;
  quad state = 0, worst = 0, largest = 0;
  std::int64_t saturated = 0;
  const quad a1 = static_cast<quad>(parameter(Design::A::velocity_a1).si);
  const std::int64_t ticks = scaled_clocks(100000);
  for (std::int64_t tick = 0; tick < ticks; ++tick) {
    counts.push_back(motion(tick));
    chain.tick(wrapped_travel(counts.back()));
    const auto now = static_cast<std::size_t>(tick);
    const std::int64_t oldest = now >= Design::m1 ? counts[now - Design::m1] : 0;
    bool unused = false;
    quad raw =
        Law::raw(travel_difference(wrapped_travel(counts.back()), wrapped_travel(oldest)), &unused);
    if (chain.step.limit) {
      ++saturated;
      raw = raw < 0 ? quad{-1024} : 1024 - lsb(21);
    }
    const quad difference = Law::Filter::operand(raw, state);
    if (magnitude(difference) > largest) largest = magnitude(difference);
    state = Law::Filter::next(state, a1 * difference);
    const quad error = magnitude(exact(chain.step.velocity) - state);
    worst = feltgate::larger(worst, error);
  }
  INFO("worst " << static_cast<double>(worst) << " rad/s, bound "
                << static_cast<double>(error_bound(largest)));
  REQUIRE(saturated > ticks / 100);
  REQUIRE(worst <= error_bound(largest));
  REQUIRE(worst > error_bound(largest) / 100);
  REQUIRE(error_bound(largest) < quad{1} / 64);
}
