// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Twin of rtl/safety/stop_latch.sv: the pin clears the gates and sets the latch, with or without a
// clock. The latch powers up set and has no reset. docs/blocks/safety.md
#pragma once

namespace feltgate::axis {

class StopLatch {
 public:
  void reset() { stop_ = before_ = true; }
  bool gates_clear(bool stop) const { return stop || latch_; }
  bool stopped() const { return stop_; }
  bool trip(bool open) const { return stop_ && open; }
  /// The pin sets the latch without a clock.
  void see(bool stop) { latch_ = latch_ || stop; }
  void clock(bool stop, bool open, bool fault) {
    see(stop);
    const bool releases = !stop && stop_ && !open && !fault;
    stop_ = before_;
    before_ = latch_;
    if (releases) latch_ = false;
  }
  /// Clocks with these inputs change nothing.
  bool rests(bool stop, bool open, bool fault) const {
    const bool latch = latch_ || stop;
    return latch == latch_ && before_ == latch && stop_ == latch &&
           !(!stop && stop_ && !open && !fault);
  }

 private:
  bool latch_ = true, before_ = true, stop_ = true;
};

}  // namespace feltgate::axis
