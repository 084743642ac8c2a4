// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Drives a Verilated block and its twin with one stimulus and compares every output on every clock.
// Adapter, written per block:
//   static void drive(Rtl&, const Twin::In&);
//   template <class Check> static void compare(Check& check, const Rtl&, const Twin::Out&);
//   static void at_edge(Rtl&);  // optional: changes inputs that end before the clock edge
// Documentation: docs/testing.md
#pragma once

#include <type_traits>
#include <utility>
#include <vector>

#include "mismatch.hpp"
#include "random.hpp"
#include "sim/backends/rtl_model.hpp"

namespace feltgate::test {

namespace detail {

/// Whether a reset of the twin depends on the inputs.
template <class Twin, class In, class = void>
struct TakesInReset : std::false_type {};
template <class Twin, class In>
struct TakesInReset<Twin, In,
                    std::void_t<decltype(std::declval<Twin&>().reset(std::declval<const In&>()))>>
    : std::true_type {};

template <class Twin, class = void>
struct HasPeek : std::false_type {};
template <class Twin>
struct HasPeek<Twin, std::void_t<decltype(std::declval<const Twin&>().peek(
                         std::declval<const typename Twin::In&>()))>> : std::true_type {};

template <class Adapter, class Rtl, class = void>
struct HasAtEdge : std::false_type {};
template <class Adapter, class Rtl>
struct HasAtEdge<Adapter, Rtl, std::void_t<decltype(Adapter::at_edge(std::declval<Rtl&>()))>>
    : std::true_type {};

struct NoObserver {
  template <class... Any>
  const char* operator()(const Any&...) const {
    return nullptr;
  }
};

}  // namespace detail

/// How often a run resets the block. The seed sets the times and lengths (1 to 8 clocks).
struct ResetPlan {
  std::uint32_t mean_distance = 0;  ///< clocks between two resets on average; 0: only at the start
};

template <class Rtl, class Twin, class Adapter>
class LockStep {
 public:
  using In = typename Twin::In;

  /// `seed` also fills the registers of the RTL with random bits before the first reset.
  /// `prototype` is copied for every run: a twin with its parameters set.
  LockStep(const char* block, std::uint64_t seed, Twin prototype = Twin())
      : block_(block), seed_(seed), prototype_(std::move(prototype)) {}

  /// Runs from power-up. Stimulus: copyable, all its state inside, called once per clock as
  /// stimulus(clock) or stimulus(clock, twin_out_of_the_clock_before), returns In; it is also
  /// called while reset is held. Observer (optional): called after each clock as observer(in, rtl,
  /// twin, in_reset), returns nullptr or the text of the property that is broken. Ends the test
  /// case at the first difference and leaves a waveform of clocks -200 to +20 around.
  template <class Stimulus, class Observer = detail::NoObserver>
  void run(const Stimulus& stimulus, std::int64_t clocks, ResetPlan resets = {},
           const Observer& observer = {}) {
    Session session(*this, resets);
    {
      Stimulus live = stimulus;
      Observer watch = observer;
      while (session.cycle < clocks && !session.check.failed()) session.clock(live, watch);
    }
    total_clocks_ += session.cycle;
    if (!session.check.failed()) return;
    const Mismatch found = session.check.first();
    if (!waveform_wanted()) fail_with(block_, seed_, found, "");
    const std::string file = mismatch_file(block_);
    {
      Session again(*this, resets);
      Stimulus live = stimulus;
      Observer watch = observer;
      again.trace_from(file, found.cycle);
      while (again.cycle <= found.cycle + 20) again.clock(live, watch);
    }
    fail_with(block_, seed_, found, file);
  }

  /// Runs a list of inputs from power-up; the first input is held during the reset at the start.
  /// Returns the twin after the last input.
  Twin run_list(const std::vector<In>& inputs) {
    Twin last = prototype_;
    const auto stimulus = [&inputs](std::int64_t clock) {
      const std::int64_t k = clock - kFirstReset;
      const auto size = static_cast<std::int64_t>(inputs.size());
      return inputs[static_cast<std::size_t>(k < 0 ? 0 : (k < size ? k : size - 1))];
    };
    const auto keep = [&last](const In&, const Rtl&, const Twin& twin, bool) -> const char* {
      last = twin;
      return nullptr;
    };
    run(stimulus, static_cast<std::int64_t>(inputs.size()) + kFirstReset, {}, keep);
    return last;
  }

  /// Clocks compared so far, over all runs.
  std::int64_t total_clocks() const { return total_clocks_; }

  /// Clocks of reset at the start of every run.
  static constexpr std::int64_t kFirstReset = 3;

 private:
  static constexpr bool kPeek = detail::HasPeek<Twin>::value;

  struct Session {
    Session(const LockStep& bench, ResetPlan plan)
        : rtl(bench.seed_),
          twin(bench.prototype_),
          resets(bench.seed_ ^ 0x7265736574U),
          reset_plan(plan) {
      twin.reset();
    }

    template <class Stimulus, class Observer>
    void clock(Stimulus& stimulus, Observer& observer) {
      if (reset_left > 0) {
        --reset_left;
      } else if (reset_plan.mean_distance != 0 && resets.one_in(reset_plan.mean_distance)) {
        reset_left = 1 + resets.below(8);
      }
      const bool in_reset = reset_left > 0;
      In in;
      if constexpr (std::is_invocable<Stimulus&, std::int64_t, const typename Twin::Out&>::value) {
        in = stimulus(cycle, twin.out());
      } else {
        in = stimulus(cycle);
      }
      Adapter::drive(*rtl, in);
      rtl->rst_ni = in_reset ? 0 : 1;
      rtl.low();
      if (in_reset) {
        if constexpr (detail::TakesInReset<Twin, In>::value) {
          twin.reset(in);
        } else {
          twin.reset();
        }
      }
      if constexpr (kPeek) {
        Adapter::compare(check, *rtl, twin.peek(in));
      } else if (in_reset) {
        Adapter::compare(check, *rtl, twin.out());
      }
      if (__builtin_expect(check.failed(), 0)) note("before the edge");
      dump(20 * cycle);
      if constexpr (detail::HasAtEdge<Adapter, Rtl>::value) Adapter::at_edge(*rtl);
      rtl.high();
      if (!in_reset) twin.clock(in);
      if constexpr (kPeek) {
        Adapter::compare(check, *rtl, twin.peek(in));
      } else {
        Adapter::compare(check, *rtl, twin.out());
      }
      if (__builtin_expect(check.failed(), 0)) note("after the edge");
      const char* broken = observer(in, *rtl, twin, in_reset);
      if (__builtin_expect(broken != nullptr, 0) && !check.failed()) {
        check.first().signal = broken;
        check.first().is_property = true;
        note("after the edge");
      }
      dump(20 * cycle + 10);
      ++cycle;
    }

    void note(const char* instant) {
      if (noted) return;
      noted = true;
      check.first().cycle = cycle;
      check.first().instant = instant;
    }
    void trace_from(const std::string& path, std::int64_t found) {
      rtl.trace(path, "1ns");
      dump_from = 20 * (found - 200);
    }
    void dump(std::int64_t time) {
      if (rtl.tracing() && time >= dump_from) rtl.dump(static_cast<std::uint64_t>(time));
    }

    RtlModel<Rtl> rtl;
    Twin twin;
    Random resets;
    ResetPlan reset_plan;
    Check check;
    std::int64_t cycle = 0;
    std::int64_t dump_from = 0;
    std::int64_t reset_left = kFirstReset + 1;
    bool noted = false;
  };

  const char* block_;
  std::uint64_t seed_;
  Twin prototype_;
  std::int64_t total_clocks_ = 0;
};

}  // namespace feltgate::test
