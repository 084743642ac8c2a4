// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Encoder motions made by rule. Documentation: docs/traces.md
#include "synthetic.hpp"

#include <cmath>
#include <cstdlib>
#include <stdexcept>

#include "feltgate/fixed.hpp"
#include "sim/traces/phase.hpp"
#include "sim/traces/place.hpp"

namespace feltgate::traces {

std::optional<EncoderEvent> Synthetic::next() {
  const std::optional<Move> move = rule_();
  if (!move) return std::nullopt;
  clock_ += move->wait;
  phase_ += static_cast<unsigned>(move->turn);
  return EncoderEvent{clock_, pins_at(phase_)};
}

namespace synthetic {
namespace {

using Move = Synthetic::Move;

constexpr double kPi = 3.14159265358979323846;

Source make(Synthetic::Rule rule, Clock rest = 1) {
  return std::make_unique<Synthetic>(std::move(rule), rest);
}

}  // namespace

Source constant_speed(double counts_per_s, std::int64_t counts, std::int64_t clock_hz) {
  constexpr std::int64_t kMicro = 1'000'000;
  const std::int64_t rate = std::llabs(std::llround(counts_per_s * static_cast<double>(kMicro)));
  demand(rate > 0 && rate <= clock_hz * kMicro, "constant_speed: 0, or over one count per clock");
  const int turn = counts_per_s > 0 ? 1 : -1;
  return make([=, k = std::int64_t{0}, last = Clock{0}]() mutable -> std::optional<Move> {
    if (k == counts) return std::nullopt;
    const int128_t clock = (static_cast<int128_t>(++k) * clock_hz * kMicro + rate / 2) / rate;
    const Clock wait = static_cast<Clock>(clock) - last;
    last += wait;
    return Move{wait, turn};
  });
}

Source fast_run(std::int64_t counts, Clock clocks_per_count, int direction) {
  demand(clocks_per_count >= 1 && std::abs(direction) == 1, "fast_run: wait or direction");
  return make([=, k = std::int64_t{0}]() mutable -> std::optional<Move> {
    if (k++ == counts) return std::nullopt;
    return Move{clocks_per_count, direction};
  });
}

Source one_count_per_second(std::int64_t counts, std::int64_t clock_hz) {
  return constant_speed(1.0, counts, clock_hz);
}

Source reversals(std::int64_t rounds, std::int64_t reach, Clock clocks_per_count) {
  demand(reach >= 1 && clocks_per_count >= 1, "reversals: reach or wait");
  const std::int64_t round = 2 * reach + 1;
  return make([=, k = std::int64_t{0}]() mutable -> std::optional<Move> {
    if (k == rounds * round) return std::nullopt;
    const std::int64_t place = k++ % round;
    return Move{clocks_per_count, place < reach || place == 2 * reach ? 1 : -1};
  });
}

Source dither(std::int64_t edges, Clock clocks_per_edge) {
  demand(clocks_per_edge >= 1, "dither: wait");
  return make([=, k = std::int64_t{0}]() mutable -> std::optional<Move> {
    if (k == edges) return std::nullopt;
    return Move{clocks_per_edge, k++ % 2 == 0 ? 1 : -1};
  });
}

Source steps(std::int64_t bursts, std::int64_t counts, Clock clocks_per_count, Clock rest) {
  demand(counts >= 1 && clocks_per_count >= 1 && rest >= 1, "steps: counts, wait or rest");
  const auto rule = [=, k = std::int64_t{0}]() mutable -> std::optional<Move> {
    if (k == bursts * counts) return std::nullopt;
    const bool first = k % counts == 0;
    const bool up = k++ / counts % 2 == 0;
    return Move{first ? rest : clocks_per_count, up ? 1 : -1};
  };
  return make(rule, rest);
}

Source chirp(std::int64_t amplitude, double f0_hz, double f1_hz, double duration_s,
             std::int64_t clock_hz, Clock grid) {
  const auto a = static_cast<double>(amplitude);
  const double grid_s = static_cast<double>(grid) / static_cast<double>(clock_hz);
  demand(
      grid >= 1 && 2 * kPi * std::fmax(f0_hz, f1_hz) * a * grid_s + 1 <= static_cast<double>(grid),
      "chirp: over one count per clock");
  const auto points = static_cast<std::int64_t>(duration_s / grid_s);
  const auto rule = [=, k = std::int64_t{0}, position = std::int64_t{0}, target = std::int64_t{0},
                     next = Clock{0}, last = Clock{0}]() mutable -> std::optional<Move> {
    while (position == target) {
      if (k == points) return std::nullopt;
      const double t = static_cast<double>(++k) * grid_s;
      const double turns = f0_hz * t + (f1_hz - f0_hz) * t * t / (2 * duration_s);
      target = std::llround(a * std::sin(2 * kPi * turns));
      next = k * grid;
    }
    const int turn = target > position ? 1 : -1;
    const Clock wait = next++ - last;
    last += wait;
    position += turn;
    return Move{wait, turn};
  };
  return make(rule, grid);
}

Source random_walk(std::uint64_t seed, std::int64_t counts, Clock min_wait, Clock max_wait) {
  return illegal(seed, counts, 0, min_wait, max_wait);
}

Source illegal(std::uint64_t seed, std::int64_t moves, int per_thousand, Clock min_wait,
               Clock max_wait) {
  demand(min_wait >= 1 && max_wait >= min_wait, "random motion: waits");
  return make([=, random = SplitMix64(seed), k = std::int64_t{0}]() mutable -> std::optional<Move> {
    if (k++ == moves) return std::nullopt;
    const Clock wait = min_wait + random.below(max_wait - min_wait + 1);
    const int legal = random.below(2) == 0 ? 1 : -1;
    return Move{wait, random.below(1000) < per_thousand ? 2 : legal};
  });
}

}  // namespace synthetic
}  // namespace feltgate::traces
