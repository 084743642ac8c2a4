// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// RTL and twin on the same inputs, every output compared on every clock.
// Documentation: docs/architecture.md
#pragma once

#include <algorithm>
#include <array>
#include <chrono>
#include <string>
#include <vector>

#include "clocked_engine.hpp"
#include "rtl_core.hpp"
#include "sampled_watch.hpp"

namespace feltgate {

/// Every output of the core, in the order in which a difference is looked for.
#define FELTGATE_EACH_OUTPUT(apply)                                                              \
  apply(tick_count) apply(position) apply(velocity) apply(tau_hat) apply(tau_ref)                \
      apply(current_ref) apply(voltage) apply(duty) apply(duty_active) apply(gates) apply(scene) \
          apply(limits) apply(faults) apply(first_fault) apply(armed) apply(gates_enable)        \
              apply(snapshot_valid) apply(reg_busy) apply(reg_rdata)

/// Does not compile when an output came or went: then the list above lacks it too.
inline void count_outputs(const CoreOut& out) {
  [[maybe_unused]] const auto& [a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, s] = out;
#define FELTGATE_ONE(name) +1
  static_assert(FELTGATE_EACH_OUTPUT(FELTGATE_ONE) == 19, "an output is not in the list above");
#undef FELTGATE_ONE
}

/// Name of the first output in which two cores differ, with both values.
inline std::string difference(const CoreOut& rtl, const CoreOut& twin) {
#define FELTGATE_TELL(name)                                                                   \
  if (rtl.name != twin.name) {                                                                \
    return #name ": rtl " + std::to_string(rtl.name) + ", twin " + std::to_string(twin.name); \
  }
  FELTGATE_EACH_OUTPUT(FELTGATE_TELL)
#undef FELTGATE_TELL
  return {};
}

/// The outputs of `Clocks` clocks, each in an array of its own: word for word, as the twin has just
/// written them. Copied in wider pieces, each copy would wait for the words to reach the cache.
template <std::size_t Clocks>
class OutputLog {
 public:
  void put(std::size_t clock, const CoreOut& out) {
#define FELTGATE_PUT(name) name##_[clock] = out.name;
    FELTGATE_EACH_OUTPUT(FELTGATE_PUT)
#undef FELTGATE_PUT
  }
  bool holds(std::size_t clock, const CoreOut& out) const {
    std::int64_t difference = 0;
#define FELTGATE_COMPARE(name) difference |= std::int64_t{name##_[clock]} ^ std::int64_t{out.name};
    FELTGATE_EACH_OUTPUT(FELTGATE_COMPARE)
#undef FELTGATE_COMPARE
    return difference == 0;
  }
  CoreOut at(std::size_t clock) const {
    CoreOut out;
#define FELTGATE_GET(name) out.name = name##_[clock];
    FELTGATE_EACH_OUTPUT(FELTGATE_GET)
#undef FELTGATE_GET
    return out;
  }

 private:
#define FELTGATE_KEEP(name) std::array<decltype(CoreOut::name), Clocks> name##_;
  FELTGATE_EACH_OUTPUT(FELTGATE_KEEP)
#undef FELTGATE_KEEP
};
#undef FELTGATE_EACH_OUTPUT

/// The twin leads, from event to event; the RTL follows in stretches of its own, long enough that
/// the code of each half stays in the processor's cache, and is compared with what the twin has
/// shown.
template <class Rtl, class D>
class LockStepEngine : public ClockedEngine {
 public:
  LockStepEngine() : ClockedEngine(design_info<D>()) {}
  const char* name() const override { return "lockstep"; }
  void trace(const std::string& path, Clock from, Clock to) override {
    follower_.rtl.trace(path, from, to);
    traced_ = true;
  }
  std::int64_t mismatches() const override { return followed().mismatches; }
  std::string first_mismatch() const override { return followed().first; }
  Clock first_mismatch_clock() const override { return followed().first_clock; }
  double busy_s(const std::string& half) const override {
    return half == "rtl" ? followed().busy_s : twin_watch_.seconds();
  }

  void advance(Clock clocks, const EncoderEvent* first, const EncoderEvent* last) override {
    snapshots_.clear();
    if (first != last) events_.push(first, last);
    gates_before_ = twin_.gate_clocks();
    CoreIn in = inputs();
    for (const Clock end = now_ + clocks; now_ < end; in.reg_write = false) {
      in.encoder = events_.at(now_);
      Clock until = std::min({end, events_.next(end), now_ + follower_.room()});
      if (!writes_.empty()) {
        const int ahead = host_write_clock - twin_.clock_of_tick();
        if (ahead == 0) issue_write(&in);
        until = std::min(until, now_ + (ahead == 0  ? 1
                                        : ahead > 0 ? ahead
                                                    : ahead + D::clocks_per_tick));
      }
      twin_watch_.time([&] { lead(in, until - now_); });
      now_ = until;
      if (follower_.room() == 0) follower_.follow();
    }
    if (traced_) followed();  // a file that cannot be written is told at once
  }
  GateClocks gates() const override {
    const auto after = twin_.gate_clocks();
    return {after[0] - gates_before_[0], after[1] - gates_before_[1], after[2] - gates_before_[2],
            after[3] - gates_before_[3]};
  }
  int duty() const override { return twin_.out().duty_active; }
  bool gates_enabled() const override { return twin_.out().gates_enable; }

 private:
  /// The RTL, with what it has yet to run and to show.
  struct Follower {
    struct Inputs {
      CoreIn in;
      std::size_t clocks;
    };
    static constexpr std::size_t longest = 1000;

    Clock room() const { return static_cast<Clock>(longest - shown); }
    void clear() {
      shown = 0;
      held.clear();
    }
    void follow() {
      const auto begin = std::chrono::steady_clock::now();
      compare();
      busy_s += std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
      clear();
    }
    /// Flat: the outputs are compared where they are, not copied first.
    [[gnu::flatten]] void compare() {
      std::size_t n = 0;
      for (const Inputs& inputs : held) {
        rtl.drive(inputs.in);
        for (const std::size_t end = n + inputs.clocks; n < end; ++n) {
          rtl.edge();
          if (!twin.holds(n, rtl.out())) miss(n);
        }
      }
      clock += static_cast<Clock>(n);
    }
    [[gnu::noinline, gnu::cold]] void miss(std::size_t n) {
      if (mismatches++ > 0) return;
      first_clock = clock + static_cast<Clock>(n);
      first = "clock " + std::to_string(first_clock) + ", " + difference(rtl.out(), twin.at(n));
    }

    RtlCore<Rtl, D> rtl;
    std::vector<Inputs> held;
    OutputLog<longest> twin;  ///< what it has shown
    std::size_t shown = 0;    ///< of it, clocks
    Clock clock = 0;          ///< to which it is the first
    std::int64_t mismatches = 0;
    Clock first_clock = 0;
    std::string first;
    double busy_s = 0;
  };

  [[gnu::flatten]] void lead(const CoreIn& in, Clock clocks) {
    follower_.held.push_back({in, static_cast<std::size_t>(clocks)});
    for (Clock k = 0; k < clocks; ++k) {
      twin_.clock(in);
      const CoreOut& out = twin_.out();
      follower_.twin.put(follower_.shown++, out);
      if (out.snapshot_valid) keep(out, twin_.sampled_travel(), twin_.writes());
    }
  }
  /// Once it has caught up.
  const Follower& followed() const {
    if (follower_.shown > 0) follower_.follow();
    return follower_;
  }
  void reset_core(std::uint64_t seed, EncoderPins pins) override {
    follower_.clear();
    follower_.rtl.power_up(seed, pins);
    follower_.clock = follower_.mismatches = 0;
    follower_.first.clear();
    twin_ = FeltgateCore<D>();
    gates_before_ = {};
  }

  FeltgateCore<D> twin_;
  mutable Follower follower_;
  bool traced_ = false;
  SampledWatch twin_watch_;
  std::array<std::int64_t, 4> gates_before_{};
};

}  // namespace feltgate
