// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The Verilated core with access to its state. A test can flip a flip-flop or a word of a memory
// (all logic that depends on it is evaluated again), and copy and compare the whole state.
// Documentation: docs/testing.md
#pragma once

#include <Vfaults.h>
#include <Vfaults___024root.h>

#include <cstdint>
#include <cstring>
#include <memory>

#include <flops.hpp>

#include "campaigns/faults/outcome.hpp"
#include "feltgate/feltgate_core.hpp"
#include "feltgate/generated/lever.hpp"
#include "sim/backends/rtl_ports.hpp"

void Vfaults___024root___eval_settle(Vfaults___024root* vlSelf);

namespace feltgate::faults {

using D = Lever;

class RtlState {
 public:
  explicit RtlState(std::uint64_t seed = 1) : rtl_(make(seed)) {
    rtl_->rst_ni = 1;  // so that the first reset is an edge
    low();
    drive(CoreIn{});
    reset(true);
    for (int k = 0; k < 4; ++k) clock();
    low();
    reset(false);
  }
  ~RtlState() { rtl_->final(); }
  RtlState(const RtlState&) = delete;
  RtlState& operator=(const RtlState&) = delete;

  /// Copies the state of another core. Both must be in one program, so that the bytes mean the
  /// same.
  void copy(const RtlState& o) {
    std::memcpy(begin(), o.begin(), size());
    in_ = o.in_;
  }
  bool same_state(const RtlState& o) const { return std::memcmp(begin(), o.begin(), size()) == 0; }

  // Call flips between two clocks.
  void flip(int flop) {
    const Flop& f = kFlops[flop];
    byte_of(f) ^= mask_of(f);
    settle();
  }
  /// Sets the flip-flop to this level, as if it had kept it over the last edge.
  void hold(int flop, bool level) {
    const Flop& f = kFlops[flop];
    if (((byte_of(f) & mask_of(f)) != 0) != level) flip(flop);
  }
  void flip_parameter(int address, int bit) {
    rtl_->rootp
        ->feltgate_core__DOT__u_wave__DOT__u_registers__DOT__parameter_ram[static_cast<std::size_t>(
            address)] ^= QData{1} << bit;
    settle();
  }
  void flip_line(int address, int bit) {
    auto& word =
        rtl_->rootp->feltgate_core__DOT__u_estimators__DOT__g_n_method__DOT__u_velocity_n__DOT__line
            [static_cast<std::size_t>(address)];
    word = static_cast<SData>(word ^ (1u << bit));
    settle();
  }

  void drive(const CoreIn& in) {
    in_ = in;
    drive_inputs<D>(*rtl_, in);
  }
  /// One clock with the inputs that were driven.
  void clock() {
    rtl_->stop_i = in_.stop;
    low();
    rtl_->stop_i = false;
    rtl_->clk_i = 1;
    rtl_->eval();
  }
  void reset(bool held) { rtl_->rst_ni = held ? 0 : 1; }
  unsigned gates() const {
    return static_cast<unsigned>(rtl_->gate_a_hi_o | rtl_->gate_a_lo_o << 1 |
                                 rtl_->gate_b_hi_o << 2 | rtl_->gate_b_lo_o << 3);
  }
  CoreOut out() const { return read_outputs<D>(*rtl_); }

 private:
  unsigned char& byte_of(const Flop& f) {
    return static_cast<unsigned char*>(flop_place(*rtl_->rootp, f.place))[f.place_bit / 8];
  }
  static unsigned char mask_of(const Flop& f) {
    return static_cast<unsigned char>(1u << (f.place_bit % 8));
  }
  /// What Verilator computes before the first clock: all combinational logic, from the registers.
  void settle() { Vfaults___024root___eval_settle(rtl_->rootp); }

  // The whole state of the model lies between its first member and the pointer to its symbols.
  unsigned char* begin() { return reinterpret_cast<unsigned char*>(&rtl_->rootp->clk_i); }
  const unsigned char* begin() const {
    return reinterpret_cast<const unsigned char*>(&rtl_->rootp->clk_i);
  }
  std::size_t size() const {
    return static_cast<std::size_t>(reinterpret_cast<const unsigned char*>(&rtl_->rootp->vlSymsp) -
                                    begin());
  }

  // All models share one context: a Verilated scope ends in the context of its thread.
  static std::unique_ptr<Vfaults> make(std::uint64_t seed) {
    static VerilatedContext context;
    context.randReset(2);
    context.randSeed(static_cast<int>(seed % 0x7ffffffeU) + 1);
    return std::make_unique<Vfaults>(&context);
  }
  void low() {
    rtl_->clk_i = 0;
    rtl_->eval();
  }

  std::unique_ptr<Vfaults> rtl_;
  CoreIn in_;
};

/// Counts gates over clocks.
class GateCount {
 public:
  void add(unsigned gates) {
    times_.a_hi += static_cast<int>(gates & 1u);
    times_.a_lo += static_cast<int>((gates >> 1) & 1u);
    times_.b_hi += static_cast<int>((gates >> 2) & 1u);
    times_.b_lo += static_cast<int>((gates >> 3) & 1u);
    const bool both = (gates & 3u) == 3u || (gates & 12u) == 12u;
    run_ = both ? run_ + 1 : 0;
    if (run_ > times_.both) times_.both = run_;
  }
  /// Returns the counts of the clocks since the last call; a run of both gates continues over the
  /// call.
  GateTimes take() {
    const GateTimes t = times_;
    times_ = {};
    return t;
  }

 private:
  GateTimes times_;
  int run_ = 0;
};

}  // namespace feltgate::faults
