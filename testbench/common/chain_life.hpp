// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// A random stimulus for a chain of laws. Two implementations of the chain run it side by side:
// counts, bursts that saturate the velocity, arming, scenes, modes, parameter words. Documentation:
// docs/fixed-point.md
#pragma once

#include <array>
#include <cstdint>
#include <iterator>
#include <optional>
#include <string>

#include "random.hpp"
#include "sim/reference/control_chain.hpp"

namespace feltgate::test {

constexpr std::size_t chain_results = 13;
/// The results of one tick, in the order of chain_result_names.
using ChainResults = std::array<std::int64_t, chain_results>;
constexpr std::array<const char*, chain_results> chain_result_names = {
    "velocity",   "tau_hat",        "tau_ref",      "current",       "voltage",
    "duty",       "limit torque",   "limit ramp",   "limit current", "limit voltage",
    "limit duty", "limit velocity", "limit tau_hat"};

/// The results of the laws in the fixed-point policy N.
template <class D, class N>
ChainResults results_of(const ControlChain<D, N>& c) {
  const auto& control = c.control();
  return {N::raw(c.velocity()),    N::raw(c.tau_hat()),     N::raw(c.tau_ref()),
          N::raw(control.current), N::raw(control.voltage), N::raw(control.duty),
          c.limit_torque(),        c.limit_ramp(),          control.limit.current,
          control.limit.voltage,   control.limit.duty,      c.limit_velocity(),
          c.limit_tau_hat()};
}

template <class D>
class ChainLife {
 public:
  struct Word {
    int address = 0;
    std::uint32_t data = 0;
  };

  explicit ChainLife(std::uint64_t seed) : random_(seed) {}

  /// Makes the inputs of the next tick. A returned write must be done before that tick.
  std::optional<Word> next() {
    if (random_.one_in(50)) move(static_cast<int>(random_.between(-2, 2)));
    // One count per tick is faster than the velocity's format can show.
    if (++tick_ % 30'000 > 28'800) move(1);
    if (random_.one_in(5'000)) in_.armed = !random_.one_in(4);
    if (random_.one_in(4'000)) in_.scene = static_cast<int>(random_.below(11));
    in_.restart = random_.one_in(3'000);
    if (random_.one_in(9'000)) in_.mode = static_cast<int>(random_.below(3));
    if (random_.one_in(6'000))
      in_.position = static_cast<std::int32_t>(random_.between(-2000, 2000));
    // With the design's ramp the output would be almost always a ramp, which hides the position.
    if (!ramp_written_ || random_.one_in(4'000)) {
      ramp_written_ = true;
      return Word{D::A::ramp_step, random_.below(1u << 18)};
    }
    if (!random_.one_in(250)) return std::nullopt;
    const auto& p = D::parameters[random_.below(std::size(D::parameters))];
    // A random filter coefficient would hide the rest of the chain.
    const bool filter = p.address == D::A::velocity_a1 || p.address == D::A::observer_a1;
    if (filter || random_.coin())
      return Word{p.address, static_cast<std::uint32_t>(p.raw & 0xffffffff)};
    return Word{p.address, static_cast<std::uint32_t>(random_.bits() >> 32)};
  }
  const ChainIn& in() const { return in_; }

 private:
  void move(int counts) {
    in_.position += counts;
    in_.travel = static_cast<std::int16_t>(in_.travel + counts);
  }

  Random random_;
  ChainIn in_;
  long tick_ = 0;
  bool ramp_written_ = false;
};

struct ChainComparison {
  std::string first_divergence;  ///< empty if the chains never differ
  ChainResults seen{};           ///< ticks in which each result was not 0
};

/// Lists the signals that stayed at rest and the limits that never or always acted. Empty if all
/// was exercised.
inline std::string not_exercised(const ChainComparison& c, long ticks) {
  constexpr std::size_t first_limit = 6;
  std::string names;
  for (std::size_t s = 0; s < chain_results; ++s) {
    const bool always = s >= first_limit && c.seen[s] > ticks - ticks / 1000;
    if (c.seen[s] < ticks / 1000 || always) names += std::string(chain_result_names[s]) + "; ";
  }
  return names;
}

/// Runs `ticks` ticks of one stimulus in two chains. Each chain offers write(address, data) and
/// tick(in), which returns the results.
template <class D, class A, class B>
ChainComparison compare_lives(std::uint64_t seed, long ticks, A& a, B& b) {
  ChainLife<D> life(seed);
  ChainComparison c;
  for (long k = 0; k < ticks && c.first_divergence.empty(); ++k) {
    if (const auto word = life.next()) {
      a.write(word->address, word->data);
      b.write(word->address, word->data);
    }
    const ChainResults x = a.tick(life.in()), y = b.tick(life.in());
    for (std::size_t s = 0; s < chain_results; ++s) {
      c.seen[s] += x[s] != 0 ? 1 : 0;
      if (x[s] == y[s] || !c.first_divergence.empty()) continue;
      c.first_divergence = "tick " + std::to_string(k) + ", " + chain_result_names[s] + ": " +
                           std::to_string(x[s]) + " and " + std::to_string(y[s]);
    }
  }
  return c;
}

/// The laws of design D in policy N, for compare_lives().
template <class D, class N>
class Laws {
 public:
  Laws() { chain_.reset(); }
  void write(int address, std::uint32_t data) { chain_.words().set_raw(address, data); }
  ChainResults tick(const ChainIn& in) {
    chain_.tick(in);
    return results_of<D, N>(chain_);
  }

 private:
  ControlChain<D, N> chain_;
};

}  // namespace feltgate::test
