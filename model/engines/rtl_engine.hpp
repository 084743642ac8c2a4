// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The Verilated RTL as an engine. Rtl is Verilator's class of feltgate_core for design D.
// Documentation: docs/architecture.md
#pragma once

#include <verilated.h>
#include <verilated_fst_c.h>

#include <memory>

#include "engines/clocked_engine.hpp"

namespace feltgate {

/// The low `width` bits of `word` as a signed number.
constexpr std::int64_t sign_extend(std::uint64_t word, int width) {
  const std::uint64_t sign = std::uint64_t{1} << (width - 1);
  const std::uint64_t low = word & ((sign << 1) - 1);
  return static_cast<std::int64_t>(low ^ sign) - static_cast<std::int64_t>(sign);
}

template <class Rtl, class D>
class RtlEngine : public ClockedEngine<RtlEngine<Rtl, D>> {
 public:
  RtlEngine() : info_(design_info<D>()) {}
  ~RtlEngine() override { close_trace(); }

  const char* name() const override { return "rtl"; }
  const DesignInfo& design() const override { return info_; }
  int duty() const override { return static_cast<int>(sign_extend(rtl_->duty_active_o, D::f.duty.width())); }
  bool gates_enabled() const override { return rtl_->gates_enable_o != 0; }

  void reset_core(std::uint64_t seed, EncoderPins pins) {
    close_trace();
    context_ = std::make_unique<VerilatedContext>();
    context_->randReset(2);
    context_->randSeed(static_cast<int>(seed % 0x7ffffffeu) + 1);
    context_->traceEverOn(true);
    rtl_ = std::make_unique<Rtl>(context_.get());
    drive(CoreIn{pins, false, false, false, 0, 0, 0, false});
    rtl_->rst_ni = 1;
    rtl_->clk_i = 0;
    rtl_->eval();
    rtl_->rst_ni = 0;
    for (int k = 0; k < 4; ++k) {
      rtl_->clk_i = 0;
      rtl_->eval();
      rtl_->clk_i = 1;
      rtl_->eval();
    }
    rtl_->clk_i = 0;
    rtl_->eval();
    rtl_->rst_ni = 1;
    time_ = 0;
    if (!trace_path_.empty()) {
      fst_ = std::make_unique<VerilatedFstC>();
      rtl_->trace(fst_.get(), 99);
      fst_->set_time_unit("1ns");
      fst_->set_time_resolution("1ns");
      fst_->open(trace_path_.c_str());
    }
  }

  void clock_core(const CoreIn& in) {
    drive(in);
    rtl_->clk_i = 0;
    rtl_->eval();
    dump();
    rtl_->clk_i = 1;
    rtl_->eval();
    dump();
  }

  bool snapshot_valid() const { return rtl_->snapshot_valid_o != 0; }
  unsigned gate_bits() const {
    return static_cast<unsigned>(rtl_->gate_a_hi_o) | static_cast<unsigned>(rtl_->gate_a_lo_o) << 1 |
           static_cast<unsigned>(rtl_->gate_b_hi_o) << 2 | static_cast<unsigned>(rtl_->gate_b_lo_o) << 3;
  }
  Snapshot snapshot() const {
    Snapshot s;
    s.tick = rtl_->tick_count_o;
    s.position = static_cast<std::int32_t>(rtl_->position_o);
    s.velocity = sign_extend(rtl_->velocity_o, D::f.velocity.width());
    s.tau_hat = sign_extend(rtl_->tau_hat_o, D::f.torque.width());
    s.tau_ref = sign_extend(rtl_->tau_ref_o, D::f.torque.width());
    s.current_ref = sign_extend(rtl_->current_ref_o, D::f.current.width());
    s.voltage = sign_extend(rtl_->voltage_o, D::f.voltage.width());
    s.duty = sign_extend(rtl_->duty_o, D::f.duty.width());
    s.scene = rtl_->scene_o;
    s.limits = rtl_->limits_o;
    s.faults = rtl_->faults_o;
    s.first_fault = rtl_->first_fault_o;
    s.armed = rtl_->armed_o != 0;
    return s;
  }

  const Rtl& rtl() const { return *rtl_; }
  Rtl& rtl() { return *rtl_; }
  /// Writes every clock of the next run to an FST file; call before reset().
  void trace_to(const std::string& path) { trace_path_ = path; }

 private:
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
  void dump() {
    if (fst_) fst_->dump(static_cast<std::uint64_t>(time_));
    time_ += 10;
  }
  void close_trace() {
    if (fst_) fst_->close();
    fst_.reset();
  }

  DesignInfo info_;
  std::unique_ptr<VerilatedContext> context_;
  std::unique_ptr<Rtl> rtl_;
  std::unique_ptr<VerilatedFstC> fst_;
  std::string trace_path_;
  std::int64_t time_ = 0;
};

}  // namespace feltgate
