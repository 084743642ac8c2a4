// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// A law that runs once a tick, as a clocked block: it computes at start and shows each result in
// the clock in which the RTL's register has it. at(k) is the RTL's at[k]. docs/architecture.md
#pragma once

#include <cstdint>

namespace feltgate::axis {

/// Shows each result of a law in the clock in which the RTL shows it. Law::State is the state after
/// a tick; Law::show(at, from, to) copies what is new in this clock from the tick's state to the
/// outputs.
template <class Law>
class Clocked {
 public:
  using State = typename Law::State;

  State state{};  ///< after the tick; complete from the clock after start

  /// What the outputs show in this clock.
  const State& shown() const { return at_ == 0 ? state : shown_; }
  State& showing() { return shown_; }
  bool at(int k) const { return (at_ >> k & 1) != 0; }
  /// `latency` clocks after start, for one clock.
  bool valid(int latency) const { return at(latency - 1); }
  /// A clock; `tick` makes the next state in a clock with `start`.
  template <class Tick>
  void clock(bool start, Tick&& tick) {
    if (at_ != 0) Law::show(*this, state, shown_);
    at_ = at_ << 1 | (start ? 1U : 0U);
    if (start) {
      shown_ = state;
      state = tick();
    }
  }
  /// A whole tick at once: all of the state is shown.
  State& tick() {
    at_ = 0;
    return state;
  }

 private:
  State shown_{};  ///< while a tick is under way
  std::uint32_t at_ = 0;
};

}  // namespace feltgate::axis
