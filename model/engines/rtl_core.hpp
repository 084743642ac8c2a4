// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The Verilated core of one design behind the twin's types. Documentation: docs/architecture.md
#pragma once

#include <verilated.h>
#include <verilated_fst_c.h>

#include <algorithm>
#include <memory>
#include <stdexcept>
#include <string>

#include "feltgate/feltgate_core.hpp"
#include "rtl_ports.hpp"

namespace feltgate {

/// Rtl is Verilator's class of feltgate_core for design D.
template <class Rtl, class D>
class RtlCore {
 public:
  RtlCore() { power_up(1, {}); }
  ~RtlCore() { close_trace(); }
  RtlCore(const RtlCore&) = delete;
  RtlCore& operator=(const RtlCore&) = delete;

  /// A new chip: registers filled with random bits of `seed`, four clocks of reset.
  void power_up(std::uint64_t seed, EncoderPins pins) {
    close_trace();
    rtl_.reset();  // before its context
    context_ = std::make_unique<VerilatedContext>();
    context_->randReset(2);
    context_->randSeed(static_cast<int>(seed % 0x7ffffffeU) + 1);
    context_->traceEverOn(true);
    rtl_ = std::make_unique<Rtl>(context_.get());
    CoreIn in;
    in.encoder = pins;
    drive_inputs(*rtl_, in);
    rtl_->rst_ni = 1;
    rtl_->clk_i = 0;
    rtl_->eval();
    now_ = before_trace;
    reset(4);
    now_ = 0;
  }

  /// `clocks` clocks with the reset held.
  void reset(int clocks) {
    rtl_->rst_ni = 0;
    for (int k = 0; k < clocks; ++k) edge();
    rtl_->clk_i = 0;
    rtl_->eval();
    rtl_->rst_ni = 1;
  }

  void clock(const CoreIn& in) {
    drive(in);
    edge();
  }
  /// The inputs of the coming clocks.
  void drive(const CoreIn& in) { drive_inputs(*rtl_, in); }
  /// One clock with the inputs that were driven.
  void edge() {
    const bool dumping = !trace_path_.empty() && now_ >= std::max<Clock>(trace_from_, 0) &&
                         (trace_to_ < 0 || now_ <= trace_to_);
    if (dumping && !fst_) open_trace();
    rtl_->clk_i = 0;
    rtl_->eval();
    if (dumping) fst_->dump(picoseconds(2 * now_));
    rtl_->clk_i = 1;
    rtl_->eval();
    if (dumping) fst_->dump(picoseconds(2 * now_ + 1));
    ++now_;
  }

  CoreOut out() const { return read_outputs<D>(*rtl_); }

  /// Writes the clocks [from, to] after the next power_up() to an FST file; to < 0: to the end.
  /// Clock n begins at n periods of the design's clock and rises in their middle.
  void trace(const std::string& path, Clock from, Clock to) {
    trace_path_ = path;
    trace_from_ = from;
    trace_to_ = to;
  }

 private:
  /// Of so many half clocks, to the nearest: a period need not be a whole number of them.
  static std::uint64_t picoseconds(std::int64_t half_clocks) {
    constexpr std::int64_t half_clocks_per_s = 2 * D::clock_hz;
    const int128_t ps = int128_t{half_clocks} * 1'000'000'000'000 + half_clocks_per_s / 2;
    return static_cast<std::uint64_t>(ps / half_clocks_per_s);
  }
  void open_trace() {
    fst_ = std::make_unique<VerilatedFstC>();
    rtl_->trace(fst_.get(), 99);
    fst_->set_time_unit("1ps");
    fst_->set_time_resolution("1ps");
    fst_->open(trace_path_.c_str());
    if (!fst_->isOpen()) {
      throw std::runtime_error(trace_path_ + ": cannot be written; check the folder and the disk");
    }
  }
  void close_trace() {
    if (fst_) fst_->close();
    fst_.reset();
  }

  std::unique_ptr<VerilatedContext> context_;
  std::unique_ptr<Rtl> rtl_;
  std::unique_ptr<VerilatedFstC> fst_;
  std::string trace_path_;
  static constexpr Clock before_trace = -1000;  ///< the reset comes before clock 0, unseen
  Clock trace_from_ = 0, trace_to_ = -1, now_ = 0;
};

}  // namespace feltgate
