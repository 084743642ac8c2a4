// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The Verilated core of a design with the twin's types. Documentation: docs/architecture.md
#pragma once

#include <algorithm>
#include <optional>
#include <string>

#include "feltgate/feltgate_core.hpp"
#include "feltgate/fixed.hpp"
#include "rtl_model.hpp"
#include "rtl_ports.hpp"

namespace feltgate {

/// Rtl is Verilator's class of feltgate_core for this design.
template <class Rtl>
class RtlCore {
 public:
  explicit RtlCore(const axis::Design& d) : bits_(d), clock_hz_(d.wide("CLOCK_HZ")) {
    power_up(1, {});
  }

  /// A new chip: registers filled with random bits from `seed`, then four clocks of reset.
  void power_up(std::uint64_t seed, EncoderPins pins) {
    rtl_.emplace(seed);
    CoreIn in;
    in.encoder = pins;
    drive(in);
    rtl_->reset(4);
    now_ = 0;
  }

  /// Runs `clocks` clocks with reset active.
  void reset(int clocks) {
    (*rtl_)->rst_ni = 0;
    for (int k = 0; k < clocks; ++k) edge();
    rtl_->low();
    (*rtl_)->rst_ni = 1;
  }

  void clock(const CoreIn& in) {
    drive(in);
    edge();
  }
  /// Sets the inputs of the next clocks.
  void drive(const CoreIn& in) {
    drive_inputs(**rtl_, bits_, in);
    stop_ = in.stop;
  }
  /// One clock with the inputs that drive() has set.
  void edge() {
    const bool dumping = !trace_path_.empty() && now_ >= std::max<Clock>(trace_from_, 0) &&
                         (trace_to_ < 0 || now_ <= trace_to_);
    if (dumping && !rtl_->tracing()) rtl_->trace(trace_path_, "1ps");
    (*rtl_)->stop_i = stop_;
    rtl_->low();
    if (dumping) rtl_->dump(picoseconds(2 * now_));
    (*rtl_)->stop_i = false;
    rtl_->high();
    if (dumping) rtl_->dump(picoseconds(2 * now_ + 1));
    ++now_;
  }

  CoreOut out() const { return read_outputs(**rtl_, bits_); }
  /// The law's event in this clock, of a core with an engine.
  std::optional<LawEvent> law_event() const { return read_law_event(**rtl_); }

  /// Writes the clocks [from, to] after the next power_up() to an FST file; to < 0: to the end.
  /// Clock n begins at n periods of the design's clock, with its rising edge in the middle.
  void trace(const std::string& path, Clock from, Clock to) {
    trace_path_ = path;
    trace_from_ = from;
    trace_to_ = to;
  }

 private:
  /// Time of so many half clocks, rounded to nearest; a period need not be a whole number of ps.
  std::uint64_t picoseconds(std::int64_t half_clocks) const {
    const std::int64_t half_clocks_per_s = 2 * clock_hz_;
    const int128_t ps = int128_t{half_clocks} * 1'000'000'000'000 + half_clocks_per_s / 2;
    return static_cast<std::uint64_t>(ps / half_clocks_per_s);
  }

  PortBits bits_;
  std::int64_t clock_hz_;
  std::optional<RtlModel<Rtl>> rtl_;
  bool stop_ = false;
  std::string trace_path_;
  Clock trace_from_ = 0, trace_to_ = -1, now_ = 0;
};

}  // namespace feltgate
