// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The Verilated core of one design behind the twin's types. Documentation: docs/architecture.md
#pragma once

#include <verilated.h>
#include <verilated_fst_c.h>

#include <memory>
#include <string>

#include "feltgate/feltgate_core.hpp"

namespace feltgate {

/// The low `width` bits of `word` as a signed number.
constexpr std::int64_t sign_extend(std::uint64_t word, int width) {
  const std::uint64_t sign = std::uint64_t{1} << (width - 1);
  const std::uint64_t low = word & ((sign << 1) - 1);
  return static_cast<std::int64_t>(low ^ sign) - static_cast<std::int64_t>(sign);
}

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
    drive(in);
    rtl_->rst_ni = 1;
    rtl_->clk_i = 0;
    rtl_->eval();
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

  CoreOut out() const {
    CoreOut o;
    o.velocity = sign_extend(rtl_->velocity_o, D::f.velocity.width());
    o.tick_count = rtl_->tick_count_o;
    o.reg_rdata = rtl_->reg_rdata_o;
    o.position = static_cast<std::int32_t>(rtl_->position_o);
    o.tau_hat = narrow_word(rtl_->tau_hat_o, D::f.torque.width());
    o.tau_ref = narrow_word(rtl_->tau_ref_o, D::f.torque.width());
    o.current_ref = narrow_word(rtl_->current_ref_o, D::f.current.width());
    o.voltage = narrow_word(rtl_->voltage_o, D::f.voltage.width());
    o.duty = static_cast<std::int16_t>(narrow_word(rtl_->duty_o, D::f.duty.width()));
    o.duty_active = static_cast<std::int16_t>(narrow_word(rtl_->duty_active_o, D::f.duty.width()));
    o.gates = static_cast<std::uint8_t>(rtl_->gate_a_hi_o | rtl_->gate_a_lo_o << 1 |
                                        rtl_->gate_b_hi_o << 2 | rtl_->gate_b_lo_o << 3);
    o.scene = rtl_->scene_o;
    o.limits = rtl_->limits_o;
    o.faults = rtl_->faults_o;
    o.first_fault = rtl_->first_fault_o;
    o.armed = rtl_->armed_o != 0;
    o.gates_enable = rtl_->gates_enable_o != 0;
    o.snapshot_valid = rtl_->snapshot_valid_o != 0;
    o.reg_busy = rtl_->reg_busy_o != 0;
    return o;
  }

  /// Writes the clocks [from, to] after the next power_up() to an FST file; to < 0: to the end.
  void trace(const std::string& path, Clock from, Clock to) {
    trace_path_ = path;
    trace_from_ = from;
    trace_to_ = to;
  }

 private:
  static std::int32_t narrow_word(std::uint32_t word, int width) {
    return static_cast<std::int32_t>(sign_extend(word, width));
  }

  void drive(const CoreIn& in) {
    rtl_->enc_a_i = in.encoder.a;
    rtl_->enc_b_i = in.encoder.b;
    rtl_->enc_z_i = in.encoder.z;
    rtl_->arm_i = in.arm;
    rtl_->stop_i = in.stop;
    rtl_->set_zero_i = in.set_zero;
    rtl_->scene_i = in.scene;
    rtl_->reg_addr_i = in.reg_addr;
    rtl_->reg_wdata_i = in.reg_wdata;
    rtl_->reg_write_i = in.reg_write;
  }

  void edge() {
    const bool dumping =
        !trace_path_.empty() && now_ >= trace_from_ && (trace_to_ < 0 || now_ <= trace_to_);
    if (dumping && !fst_) open_trace();
    rtl_->clk_i = 0;
    rtl_->eval();
    if (dumping) fst_->dump(static_cast<std::uint64_t>(20 * now_));
    rtl_->clk_i = 1;
    rtl_->eval();
    if (dumping) fst_->dump(static_cast<std::uint64_t>(20 * now_ + 10));
    ++now_;
  }
  void open_trace() {
    fst_ = std::make_unique<VerilatedFstC>();
    rtl_->trace(fst_.get(), 99);
    fst_->set_time_unit("1ns");
    fst_->set_time_resolution("1ns");
    fst_->open(trace_path_.c_str());
  }
  void close_trace() {
    if (fst_) fst_->close();
    fst_.reset();
  }

  std::unique_ptr<VerilatedContext> context_;
  std::unique_ptr<Rtl> rtl_;
  std::unique_ptr<VerilatedFstC> fst_;
  std::string trace_path_;
  Clock trace_from_ = 0, trace_to_ = -1, now_ = 0;
};

}  // namespace feltgate
