// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// velocity_n of a design: adapter, a stimulus that moves an encoder, and the N-method once more in
// plain integers. Documentation: docs/blocks/velocity_n.md
#pragma once

#include <Vvelocity_n.h>

#include <vector>

#include "../../wave/mult/shared_mult.hpp"
#include "../lowpass/exact.hpp"
#include "feltgate/words.hpp"
#include "lock_step.hpp"
#include "ports.hpp"
#include "velocity_n_twin.hpp"

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

struct Tally {
  std::int64_t ticks = 0, saturated = 0, unfilled = 0, wrapped = 0;
  std::int64_t last_velocity = 0;
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
  Tally* tally;
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
    tally->last_velocity = velocity;
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
    if (difference > 32767 || difference < -32768) {
      difference += difference > 0 ? -65536 : 65536;
      ++tally->wrapped;
    }
    constexpr std::int64_t limit = std::int64_t{1} << (Design::f.velocity.width() - 1);
    std::int64_t raw = Design::velocity_gain != 0
                           ? difference * Design::velocity_gain * 32  // 16 to 21 fraction bits
                           : difference * (std::int64_t{1} << (Design::velocity_shift + 21));
    ++tally->ticks;
    if (!filled) ++tally->unfilled;
    if (raw >= limit || raw < -limit) {
      ++tally->saturated;
      raw = raw < 0 ? -limit : limit - 1;
    }
    const int128_t product = static_cast<int128_t>(raw - y) * design_a1().raw();
    return y + static_cast<std::int64_t>((product + (int128_t{1} << 26)) >> 27);
  }
};

}  // namespace feltgate::test
