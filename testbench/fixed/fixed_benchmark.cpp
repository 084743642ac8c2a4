// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Time of one control tick in `fixed` over the same tick in hand-written shifts. The two run
// alternately and the median of the ratios is printed: a busy machine slows both. A benchmark, not
// a test; it fails only when the two disagree. Documentation: docs/fixed-point.md
#include <algorithm>
#include <array>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <vector>

#include "feltgate/fixed.hpp"
#include "tick_chain.hpp"

namespace {

using namespace feltgate;
using namespace feltgate::test;

/// The tick of tick_chain.hpp as one would write it without the type: int64, shifts, masks.
class ShiftTick {
 public:
  explicit ShiftTick(std::int32_t count) { delay_.fill(count); }

  TickStates tick(const TickStimulus& in) {
    const auto difference = static_cast<std::int32_t>(
        static_cast<std::uint32_t>(in.count) - static_cast<std::uint32_t>(delay_[position_]));
    delay_[position_] = in.count;
    position_ = position_ + 1 == delay_.size() ? 0 : position_ + 1;
    const std::int64_t doubled = std::int64_t{difference} * 2;
    const std::int64_t raw = clamp(doubled, 1024);
    saturations_.raw_velocity += raw != doubled ? 1 : 0;

    state_ = clamp(state_ + half_up(tick::a1 * (raw * (std::int64_t{1} << 33) - state_), 28),
                   std::int64_t{1} << 43);
    const std::int64_t velocity = clamp(half_up(state_, 12), std::int64_t{1} << 31);

    const std::int64_t inertia = tick::inertia * velocity;  // F = 39
    const std::int64_t drive = tick::ktn * current_ * 8;    // F = 39
    const std::int64_t input = clamp(half_up(drive + inertia, 9), std::int64_t{1} << 39);
    observer_ =
        clamp(observer_ + half_up(tick::a1 * (input - observer_), 28), std::int64_t{1} << 39);
    const std::int64_t observed = half_up(observer_ * 512 - inertia, 23);
    const std::int64_t tau_hat = clamp(observed, 1 << 20);
    saturations_.tau_hat += tau_hat != observed ? 1 : 0;

    const std::int64_t ref = in.torque_ref;
    const std::int64_t wanted =
        clamp(half_up(tick::by_ref * ref + tick::by_hat * tau_hat * 2, 14), 1 << 21);
    current_ = std::min(std::max(wanted, -tick::limit), tick::limit);
    saturations_.current += current_ != wanted ? 1 : 0;

    const std::int64_t kv =
        ref < tick::border && ref > -tick::border ? tick::kv_low : tick::kv_high;
    const std::int64_t voltage = clamp(convergent(kv * current_, 16), 1 << 19);
    const std::int64_t duty = clamp(toward_zero(tick::duty * voltage, 26), 1 << 12);
    return {raw, state_, velocity, observer_, tau_hat, current_, voltage, duty};
  }

  const TickSaturations& saturations() const { return saturations_; }

 private:
  static std::int64_t clamp(std::int64_t x, std::int64_t end) {
    return x < -end ? -end : (x > end - 1 ? end - 1 : x);
  }
  static std::int64_t half_up(std::int64_t x, int k) {
    return (x + (std::int64_t{1} << (k - 1))) >> k;
  }
  static std::int64_t convergent(std::int64_t x, int k) {
    const std::int64_t odd = (x >> k) & 1;
    return (x + (std::int64_t{1} << (k - 1)) - 1 + odd) >> k;
  }
  static std::int64_t toward_zero(std::int64_t x, int k) {
    return (x + (x < 0 ? (std::int64_t{1} << k) - 1 : 0)) >> k;
  }

  std::array<std::int32_t, tick::window> delay_{};
  std::size_t position_ = 0;
  std::int64_t state_ = 0;
  std::int64_t observer_ = 0;
  std::int64_t current_ = 0;
  TickSaturations saturations_;
};

/// A low-pass beyond 64 bits: 48-bit state, 22-bit coefficient, 71-bit product.
class FixedWide {
 public:
  explicit FixedWide(std::int32_t /*count*/) {}
  TickStates tick(const TickStimulus& in) {
    const auto x = fixed<1, 15, 16>::from_raw(in.count);
    const auto product = fixed<0, -10, 32>::from_raw(2147484) * (x - state_);
    state_ = narrow<State, Round::half_up, Overflow::saturate>(state_ + product);
    return {state_.raw()};
  }

 private:
  using State = fixed<1, 15, 32>;
  State state_;
};

class ShiftWide {
 public:
  explicit ShiftWide(std::int32_t /*count*/) {}
  TickStates tick(const TickStimulus& in) {
    const std::int64_t x = std::int64_t{in.count} * 65536;
    const int128_t sum = static_cast<int128_t>(state_) * (int128_t{1} << 32) +
                         static_cast<int128_t>(x - state_) * 2147484;
    const int128_t rounded = (sum + (int128_t{1} << 31)) >> 32;
    const int128_t end = int128_t{1} << 47;
    state_ =
        static_cast<std::int64_t>(rounded < -end ? -end : (rounded > end - 1 ? end - 1 : rounded));
    return {state_};
  }

 private:
  std::int64_t state_ = 0;
};

struct Timing {
  double nanoseconds;
  std::uint64_t sum;
};

/// One tick behind a call: the compiler draws the same boundary around both chains.
template <class Chain>
[[gnu::noinline, gnu::flatten]] TickStates step(Chain& chain, const TickStimulus& in) {
  return chain.tick(in);
}

template <class Chain>
Timing run(const std::vector<TickStimulus>& stimulus) {
  Chain chain(TickPattern::first_count);
  std::uint64_t sum = 0;
  const auto start = std::chrono::steady_clock::now();
  for (const TickStimulus& in : stimulus) {
    for (const std::int64_t s : step(chain, in)) sum = sum * 3 + static_cast<std::uint64_t>(s);
  }
  const std::chrono::duration<double, std::nano> elapsed = std::chrono::steady_clock::now() - start;
  return {elapsed.count() / static_cast<double>(stimulus.size()), sum};
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

/// Prints one row; false when the two chains disagree.
template <class Ours, class Hand>
bool row(const char* name, const std::vector<TickStimulus>& stimulus, int repetitions) {
  std::vector<double> ours;
  std::vector<double> hand;
  std::vector<double> ratios;
  bool equal = true;
  for (int k = 0; k < repetitions; ++k) {
    const Timing a = run<Ours>(stimulus);
    const Timing b = run<Hand>(stimulus);
    equal = equal && a.sum == b.sum;
    ours.push_back(a.nanoseconds);
    hand.push_back(b.nanoseconds);
    ratios.push_back(a.nanoseconds / b.nanoseconds);
  }
  std::printf("%-24s %8.2f %8.2f %8.3f  %s\n", name, median(ours), median(hand), median(ratios),
              equal ? "equal" : "DIFFERENT");
  return equal;
}

}  // namespace

int main() {
  TickPattern pattern;
  std::vector<TickStimulus> stimulus(100000);
  for (TickStimulus& in : stimulus) in = pattern.next();
  std::printf("%-24s %8s %8s %8s\n", "ns per tick", "fixed", "shifts", "ratio");
  const bool tick = row<FixedTick<>, ShiftTick>("control tick", stimulus, 101);
  const bool wide = row<FixedWide, ShiftWide>("128-bit low-pass", stimulus, 101);
  return tick && wide ? 0 : 1;
}
