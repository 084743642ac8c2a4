// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// RTL and twin of the core with the same inputs; every output is compared in every clock.
// Documentation: docs/architecture.md
#pragma once

#include <array>
#include <chrono>
#include <optional>
#include <string>
#include <vector>

#include "feltgate/feltgate_core.hpp"
#include "law_core.hpp"
#include "rtl_core.hpp"

namespace feltgate {

/// Every output of the core, in the order in which they are compared.
#define FELTGATE_EACH_OUTPUT(apply)                                                              \
  apply(tick_count) apply(position) apply(velocity) apply(tau_hat) apply(tau_ref)                \
      apply(current_ref) apply(voltage) apply(duty) apply(duty_active) apply(gates) apply(scene) \
          apply(limits) apply(faults) apply(first_fault) apply(armed) apply(gates_enable)        \
              apply(snapshot_valid) apply(reg_busy) apply(reg_rdata) apply(word_valid)           \
                  apply(word_slot) apply(word_data) apply(current) apply(current_clock)          \
                      apply(heartbeat) apply(serial)

/// Does not compile if CoreOut gained or lost an output that the list above lacks or has.
inline void count_outputs(const CoreOut& out) {
  [[maybe_unused]] const auto& [a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, s, t, u, v, w,
                                x, y, z] = out;
#define FELTGATE_ONE(name) +1
  static_assert(FELTGATE_EACH_OUTPUT(FELTGATE_ONE) == 26, "an output is not in the list above");
#undef FELTGATE_ONE
}

/// Name and both values of the first output in which two cores differ; empty if none.
inline std::string difference(const CoreOut& rtl, const CoreOut& twin) {
#define FELTGATE_TELL(name)                                                                   \
  if (rtl.name != twin.name) {                                                                \
    return #name ": rtl " + std::to_string(rtl.name) + ", twin " + std::to_string(twin.name); \
  }
  FELTGATE_EACH_OUTPUT(FELTGATE_TELL)
#undef FELTGATE_TELL
  return {};
}

/// The outputs of `Clocks` clocks, one array per output. They are copied word by word, as the twin
/// has just written them: wider copies would wait until the words have reached the cache.
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
#define FELTGATE_DIFFER(name) difference |= std::int64_t{name##_[clock]} ^ std::int64_t{out.name};
    FELTGATE_EACH_OUTPUT(FELTGATE_DIFFER)
#undef FELTGATE_DIFFER
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

/// The twin leads. The RTL follows in stretches, long enough that the code of each half stays in
/// the processor's cache, and is compared with the twin's outputs.
template <class Rtl>
class LockStepCore {
 public:
  using Twin = std::conditional_t<is_axes<Rtl>, LawCore, FeltgateCore>;

  explicit LockStepCore(const axis::Design& d) : new_(d), twin_(new_), rtl_(d) {}

  void power_up(std::uint64_t seed, EncoderPins pins) {
    clear();
    rtl_.power_up(seed, pins);
    clock_ = mismatches_ = 0;
    first_.clear();
    twin_ = new_;
  }
  /// Writes a waveform of the RTL; see RtlCore::trace().
  void trace(const std::string& path, Clock from, Clock to) { rtl_.trace(path, from, to); }

  const Twin& twin() const { return twin_; }
  /// The law's events, from the twin.
  std::vector<LawEvent> law_events() { return law_events_of(twin_); }

  /// Number of clocks by which the twin may lead further before the RTL follows.
  Clock room() const { return static_cast<Clock>(longest - shown_); }
  /// Advances the twin by `clocks` clocks, at most room(); calls on_snapshot() after each with a
  /// snapshot.
  template <class OnSnapshot>
  void lead(const CoreIn& in, Clock clocks, OnSnapshot&& on_snapshot) {
    held_.push_back({in, static_cast<std::size_t>(clocks)});
    for (Clock k = 0; k < clocks; ++k) {
      twin_.clock(in);
      if constexpr (is_axes<Rtl>) {
        if (const auto e = twin_.law_event()) shown_events_.push_back({shown_, *e});
      }
      const CoreOut& out = twin_.out();
      shown_outputs_.put(shown_++, out);
      if (snapshot_due(twin_)) on_snapshot();
    }
  }
  void follow() {
    const auto begin = std::chrono::steady_clock::now();
    compare();
    busy_s_ += std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    clear();
  }

  // For the clocks that the RTL has followed:
  std::int64_t mismatches() const { return mismatches_; }
  Clock first_mismatch_clock() const { return first_clock_; }
  const std::string& first_mismatch() const { return first_; }
  double rtl_busy_s() const { return busy_s_; }

 private:
  struct Inputs {
    CoreIn in;
    std::size_t clocks;
  };
  static constexpr std::size_t longest = 1000;

  void clear() {
    shown_ = 0;
    shown_events_.clear();
    held_.clear();
  }
  /// Flattened: the outputs are compared in place, not copied first.
  [[gnu::flatten]] void compare() {
    std::size_t n = 0, event = 0;
    for (const Inputs& inputs : held_) {
      rtl_.drive(inputs.in);
      for (const std::size_t end = n + inputs.clocks; n < end; ++n) {
        rtl_.edge();
        if (!shown_outputs_.holds(n, rtl_.out())) miss(n);
        if constexpr (is_axes<Rtl>) compare_event(n, &event);
      }
    }
    clock_ += static_cast<Clock>(n);
  }
  [[gnu::noinline, gnu::cold]] void miss(std::size_t n) {
    miss(n, difference(rtl_.out(), shown_outputs_.at(n)));
  }
  void miss(std::size_t n, const std::string& what) {
    if (mismatches_++ > 0) return;
    first_clock_ = clock_ + static_cast<Clock>(n);
    first_ = "clock " + std::to_string(first_clock_) + ", " + what;
  }
  /// Compares the law's events of one clock; `next` is the index of the twin's next event.
  void compare_event(std::size_t n, std::size_t* next) {
    const std::optional<LawEvent> rtl = rtl_.law_event();
    const bool shown = *next < shown_events_.size() && shown_events_[*next].clock == n;
    const LawEvent twin = shown ? shown_events_[(*next)++].event : LawEvent{};
    if (rtl.has_value() == shown &&
        (!shown || (rtl->number == twin.number && rtl->value == twin.value))) {
      return;
    }
    const auto told = [](bool is, const LawEvent& e) {
      return is ? std::to_string(e.number) + " of " + std::to_string(e.value) : "none";
    };
    miss(n, "event: rtl " + told(rtl.has_value(), rtl.value_or(LawEvent{})) + ", twin " +
                told(shown, twin));
  }

  Twin new_, twin_;  ///< as after power-up, and now
  RtlCore<Rtl> rtl_;
  std::vector<Inputs> held_;
  OutputLog<longest> shown_outputs_;
  struct ShownEvent {
    std::size_t clock;  ///< index among the clocks shown
    LawEvent event;
  };
  std::vector<ShownEvent> shown_events_;
  std::size_t shown_ = 0;  ///< number of clocks that the twin has shown
  Clock clock_ = 0;        ///< clock of the first of them
  std::int64_t mismatches_ = 0;
  Clock first_clock_ = 0;
  std::string first_;
  double busy_s_ = 0;
};

}  // namespace feltgate
