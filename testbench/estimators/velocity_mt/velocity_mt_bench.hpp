// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// velocity_mt of a design: adapter, a stimulus that moves an encoder clock by clock, and the block
// once more from a list of all edges, in plain integers. Documentation: docs/blocks/velocity.md
#pragma once

#include <Vvelocity_mt.h>

#include <cmath>
#include <vector>

#include "../../wave/mult/mult_twin.hpp"
#include "../lowpass/exact.hpp"
#include "feltgate/largest.hpp"
#include "lock_step.hpp"
#include "ports.hpp"
#include "velocity_mt_twin.hpp"

#ifndef FELTGATE_WINDOW
#define FELTGATE_WINDOW 0
#define FELTGATE_DOUBLINGS 0
#define FELTGATE_STAMP_BITS 26
#endif

namespace feltgate::test {

using Velocity = VelocityMt<Design, FELTGATE_WINDOW, FELTGATE_DOUBLINGS, 4096, FELTGATE_STAMP_BITS>;
struct NoAside {};
using Twin = Watched<Velocity, NoAside>;

/// The design's low-pass coefficient.
inline Velocity::A1 design_a1() {
  return Velocity::A1::from_raw(parameter(Design::A::velocity_a1).raw);
}

struct Adapter {
  static void drive(Vvelocity_mt& rtl, const Twin::In& in) {
    FELTGATE_STROBES(rtl, in.port.wave, at, T, sample, velocity_raw, velocity_difference, velocity);
    rtl.travel_i = port_bits<16, std::uint16_t>(in.port.travel);
    rtl.product_i = port_bits<53, std::uint64_t>(in.port.product);
  }
  template <class Check>
  static void compare(Check& check, const Vvelocity_mt& rtl, const Twin::Out& out) {
    if (out.clocked) {
      check("operand", sign_extend<Design::f.velocity_difference.width()>(rtl.operand_o),
            out.port.operand);
    }
    check("velocity", sign_extend<Design::f.velocity.width()>(rtl.velocity_o), out.port.velocity);
    check("saturated", rtl.saturated_o, out.port.saturated);
  }
};

using Bench = LockStep<Vvelocity_mt, Twin, Adapter>;

inline bool at(const Twin::In& in, int step) { return ((in.port.wave >> step) & 1U) != 0; }

/// The last bits of a count that never stops.
inline std::int16_t wrapped_travel(std::int64_t count) {
  return static_cast<std::int16_t>(static_cast<std::uint16_t>(count & 0xffff));
}

/// Waves of `shortest` clocks or more; count(clock) is the encoder's count, clock 0 the first after
/// reset.
template <class Count>
struct Waves {
  Waves(std::uint64_t seed, Count c, int shortest_wave, std::uint32_t more_clocks)
      : count(c), mult(seed), random(seed + 1), shortest(shortest_wave), spread(more_clocks) {}

  Twin::In operator()(std::int64_t, const Twin::Out& out) {
    if (out.resets != resets) {
      resets = out.resets;
      clock = 0;
      clocks = 0;
      period = shortest;
    }
    Twin::In in;
    in.port.wave = clock < 64 ? std::uint64_t{1} << clock : 0;
    in.port.travel = wrapped_travel(count(clocks++));
    if (clock == 0) period = shortest + static_cast<int>(random.below(spread));
    in.port.product = mult.product();
    if (clock == Map::W::velocity_a1) {
      mult.operands(out.port.operand, design_a1().raw());
    } else {
      mult.others();
    }
    clock = clock + 1 >= period ? 0 : clock + 1;
    return in;
  }

  Count count;
  SharedMult mult;
  Random random;
  int shortest;
  std::uint32_t spread;
  std::int64_t resets = 0, clocks = 0;
  int clock = 0, period = 1;
};

/// A hand on the encoder, of the time scale `rest` in clocks: rest, slow, fast, faster than the
/// format, reversals, an edge that chatters; rarely a count that jumps, as no decoder lets it.
struct RandomMotion {
  std::int64_t rest;
  Random random{11};
  std::int64_t position = 0, left = 0, next = 0, per_count = 0;
  int direction = 1;
  bool chatters = false;

  std::int64_t operator()(std::int64_t clock) {
    if (clock == 0) position = left = next = 0;
    if (left-- <= 0) {
      unsigned octaves = 1;
      while ((8 * rest) >> octaves > 40) ++octaves;
      per_count = 60 + ((8 * rest) >> random.below(octaves));
      if (random.one_in(10)) per_count = random.one_in(3) ? 3 : 45;
      left = random.one_in(8) && per_count > 60 ? 8 * rest
                                                : std::min(rest, per_count * random.between(1, 60));
      if (random.one_in(3)) direction = -direction;
      chatters = random.one_in(6);
      if (random.one_in(40)) position += 2 + 4 * static_cast<std::int64_t>(random.below(16384));
      next = -1;
    }
    if (++next >= per_count) {
      next = static_cast<std::int64_t>(random.below(1 + static_cast<std::uint64_t>(per_count) / 4));
      position += direction;
      if (chatters) direction = -direction;
    }
    return position;
  }
};

constexpr double kCountRad = Design::count_rad;

/// Where the edges of an encoder are, in counts: edge p lies at p + offset[p mod 4].
struct Encoder {
  double offset[4];
  double per_line = 0;  ///< rms of what each line adds

  static constexpr Encoder ideal() { return {{0, 0, 0, 0}}; }
  /// High for 45 % of a cycle, the channels 90 + 20 or 90 - 20 degrees apart: cells of 0.58 to 1.42
  /// counts.
  static constexpr Encoder cheap(int side = 1) {
    const double phase = side * 4.0 * 20 / 360, duty = 4 * -0.05;
    return {{0, phase, duty, duty + phase}};
  }
  double edge(std::int64_t p) const {
    double at = static_cast<double>(p) + offset[p & 3];
    if (per_line > 0) {
      Random line(static_cast<std::uint64_t>((p >> 2) + 100000) * 7919);  // apart: no shared draws
      double sum = -6;
      for (int k = 0; k < 12; ++k) sum += std::ldexp(static_cast<double>(line.bits() >> 11), -53);
      at += per_line * sum;
    }
    return at;
  }
};

/// A twin behind an encoder that is moved; ticks of 50 clocks.
template <class Block>
struct Moved {
  explicit Moved(const Encoder& e) : encoder(e), below(e.edge(0)), above(e.edge(1)) {
    twin.reset();
  }

  /// Calls each(t) in every tick, once raw and filtered velocity are new. angle(t) in rad, from
  /// about 0.
  template <class Angle, class Each>
  void run(double end_s, const Angle& angle, const Each& each) {
    std::int64_t operand = 0;
    for (std::int64_t clock = 0, phase = 0;; ++clock, phase = phase == kTick - 1 ? 0 : phase + 1) {
      const double t = static_cast<double>(clock) / Design::clock_hz;
      if (t >= end_s) return;
      if (phase == 0) sampled(clock);
      move(angle(t) / kCountRad + 0.5, clock);
      typename Block::In in;
      in.wave = std::uint64_t{1} << phase;
      in.travel = wrapped_travel(count);
      if (phase == 0) sampled_count = count;
      if (phase == Map::W::velocity_a1) operand = twin.out().operand;
      if (phase == Map::T::velocity) in.product = operand * design_a1().raw();
      twin.clock(in);
      if (phase == Map::T::velocity + 1) each(t);
    }
  }

  static constexpr std::int64_t kTick = 50;
  Encoder encoder;
  double below, above;
  Block twin;
  std::int64_t count = 0, sampled_count = 0, last_edge = 0, edges = 0;
  int direction = 0;
  bool turned = false;
  // Up to the sample before the last one: what the raw velocity is of.
  std::int64_t edges_seen = 0, age_seen = 0;
  int direction_seen = 0;
  bool turned_seen = false;

 private:
  struct Sample {
    std::int64_t edges = 0, age = 0;
    int direction = 0;
    bool turned = false;
  } newest_;

  void move(double at, std::int64_t clock) {
    if (at >= above) {
      stepped(1, clock);
    } else if (at < below) {
      stepped(-1, clock);
    }
  }
  void stepped(int step, std::int64_t clock) {
    count += step;
    below = encoder.edge(count);
    above = encoder.edge(count + 1);
    turned = step == -direction;
    direction = step;
    last_edge = clock;
    ++edges;
  }
  void sampled(std::int64_t clock) {
    edges_seen = newest_.edges;
    age_seen = newest_.age;
    direction_seen = newest_.direction;
    turned_seen = newest_.turned;
    newest_ = {edges, clock - last_edge, direction, turned};
  }
};

/// The largest errors of raw and filtered velocity, and the largest difference, in rad/s; how often
/// the bound of a wait, the most cycles and a step to 0 came.
struct Worst {
  quad raw = 0, filtered = 0, difference = 0;
  std::int64_t lowered = 0, longest = 0, followed = 0;
};

/// The block from a list of all edges of the run. Raw values appear in the tick after their sample.
struct Reference {
  Worst* worst;
  std::vector<std::int64_t> run{};  // clocks of the edges since the last turn, rest or jump
  std::int64_t clock = 0, y = 0, raw = 0, due_raw = 0, next_raw = 0, span = 0;
  std::int64_t quiet = 0;  // clocks since the last edge, or since the reset
  quad exact_raw = 0, due_exact = 0, next_exact = 0, exact_y = 0;
  std::int16_t travel = 0;
  int direction = 0, doublings = 0, decided = 0;
  bool fresh = false, limited = false, due_limited = false, next_limited = false, still = false,
       follows = false;

  const char* operator()(const Twin::In& in, const Vvelocity_mt& rtl, const Twin& twin,
                         bool in_reset) {
    if (in_reset) {
      *this = Reference{worst};
      return nullptr;
    }
    if (at(in, Map::T::velocity)) filter();
    if (at(in, Map::T::velocity_raw)) {
      raw = due_raw;
      limited = due_limited;
      exact_raw = due_exact;
      follows = still;
      if (raw != twin.block.raw()) return "raw velocity from the list of edges";
    }
    if (decided > 0 && --decided == 0) choose_cycles();
    if (at(in, Map::T::sample)) sample();
    edge(in.port.travel);
    ++clock;
    ++quiet;
    if (limited != (rtl.saturated_o != 0)) return "saturated from the list of edges";
    return sign_extend<Design::f.velocity.width()>(rtl.velocity_o) == y
               ? nullptr
               : "velocity from the list of edges";
  }

  using Real = SpanLaw<Design, feltgate::Real<quad>>;
  static constexpr std::int64_t kRest = std::int64_t{1} << (Velocity::stamp_bits - 3);
  static constexpr std::int64_t kMost = (std::int64_t{1} << (Design::f.velocity.width() - 1)) - 1;

  /// Of the bits above, which velocity_jump compares, a step may change one by one: 2 rad/s.
  static constexpr std::int64_t kSlow = std::int64_t{1}
                                        << (Design::f.velocity.width() + Design::coefficient_bits -
                                            Design::P::velocity_a1.fraction);

  void filter() {
    if (follows && y >= -kSlow && y < kSlow) {
      ++worst->followed;
      y = 0;
      exact_y = 0;
      return;
    }
    const int128_t product = static_cast<int128_t>(raw - y) * design_a1().raw();
    y += static_cast<std::int64_t>((product + (int128_t{1} << 26)) >> 27);
    // The same in real arithmetic.
    const quad difference = exact_raw - exact_y;
    worst->difference = larger(worst->difference, magnitude(difference));
    exact_y += static_cast<quad>(parameter(Design::A::velocity_a1).si) * difference;
    worst->raw = larger(worst->raw, magnitude(in_rad_s(raw) - exact_raw));
    worst->filtered = larger(worst->filtered, magnitude(in_rad_s(y) - exact_y));
  }
  static quad in_rad_s(std::int64_t fixed) {
    return static_cast<quad>(fixed) * lsb(Design::f.velocity.fraction);
  }
  void edge(std::int16_t now) {
    const std::int64_t moved = static_cast<std::int16_t>(now - travel);
    travel = now;
    const std::int64_t low = moved & 3;
    if (low == 0) return;
    still = still && low == 2;
    quiet = low == 2 ? quiet : 0;
    if (low == 2) {
      run.clear();
      fresh = false;
      return;
    }
    const int up = low == 1 ? 1 : -1;
    if (run.empty() || up != direction) {
      run.clear();
      doublings = 0;
    }
    direction = up;
    run.push_back(clock);
    if (run.size() > 2000) run.erase(run.begin(), run.begin() + 1000);
    fresh = true;
  }
  /// half counts over clocks, as an integer of the format; 2 pi clock/4096 to 18 digits
  std::int64_t speed(std::int64_t halves, std::int64_t clocks) {
    const auto one = static_cast<std::int64_t>(
        static_cast<quad>(3.14159265358979323846264338327950288L) / 4096 *
        static_cast<quad>(Design::clock_hz) * static_cast<quad>(1 << Design::f.velocity.fraction));
    return one * halves / clocks;
  }
  void sample() {
    still = still || (run.empty() && quiet >= 4 * kRest);
    due_raw = next_raw;
    due_limited = next_limited;
    due_exact = next_exact;
    if (fresh && run.size() == 1) {
      next_raw = 0;
      next_exact = 0;
      next_limited = false;
    } else if (fresh) {
      const std::size_t known = run.size() - 1;
      const std::size_t counts = known < 4 ? known : std::size_t{4} << doublings;
      span = run.back() - run[known - counts];
      const std::int64_t value = speed(2 * static_cast<std::int64_t>(counts), span);
      next_limited = value > kMost;
      next_raw = direction * std::min(value, kMost);
      next_exact = next_limited ? in_rad_s(next_raw)
                                : direction * Real::magnitude(4096, 2 * static_cast<int>(counts),
                                                              span, nullptr);
      decided = 2;
      worst->longest += counts == (std::size_t{4} << Velocity::doublings);
    } else if (run.empty() || clock - run.back() >= kRest) {
      run.clear();
      next_raw = 0;
      next_exact = 0;
      next_limited = false;
    } else {
      const std::int64_t most = speed(3, clock - run.back());
      if (most <= kMost && most < std::abs(next_raw)) {
        next_exact = Real::magnitude(4096, 3, clock - run.back(), nullptr);
        if (next_raw < 0) next_exact = -next_exact;
        next_raw = next_raw < 0 ? -most : most;
        next_limited = false;
        ++worst->lowered;
      }
    }
    fresh = false;
  }
  void choose_cycles() {
    const std::size_t known = run.size() - 1;
    if (run.empty()) return;
    if (span < Velocity::window && doublings < Velocity::doublings &&
        known >= std::size_t{8} << doublings) {
      ++doublings;
    } else if (span >= 2 * Velocity::window && doublings > 0) {
      --doublings;
    }
  }
};

}  // namespace feltgate::test
