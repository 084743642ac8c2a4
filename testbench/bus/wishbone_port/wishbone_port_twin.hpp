// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Twin of rtl/bus/wishbone_port.sv, clock by clock: a list of answers that are due.
// Documentation: docs/other-tools.md
#pragma once

#include <cstdint>
#include <deque>

#include "port_map.hpp"

namespace feltgate::test {

template <bool Pipelined>
class WishbonePort {
 public:
  struct In {
    bool cyc = false, stb = false, we = false;
    std::uint16_t adr = 0;
    std::uint8_t sel = 15;
    std::uint32_t dat = 0;
    std::uint32_t reg_rdata = 0;
    bool reg_busy = false;
  };
  struct Out {
    std::uint32_t dat = 0;
    bool ack = false, err = false, stall = false;
    std::uint16_t reg_addr = 0;
    std::uint32_t reg_wdata = 0;
    bool reg_write = false;
  };

  void reset() { due_.clear(); }

  Out peek(const In& in) const {
    Out out;
    out.dat = in.reg_rdata;
    out.reg_addr = in.adr;
    out.reg_wdata = in.dat;
    out.reg_write = asks(in) && writes(in);
    out.stall = Pipelined && writes(in) && in.reg_busy;
    if (answered(in) && !due_.empty() && due_.front().clocks == 0) {
      (due_.front().good ? out.ack : out.err) = true;
    }
    return out;
  }

  void clock(const In& in) {
    const bool taken = asks(in) && !(writes(in) && in.reg_busy);
    if (!due_.empty() && due_.front().clocks == 0) due_.pop_front();
    for (Answer& a : due_) --a.clocks;
    if (taken) due_.push_back({2, in.we ? writes(in) : port_reads(in.adr)});
    if (!answered(in)) due_.clear();
    out_ = peek(in);
  }

  const Out& out() const { return out_; }

 private:
  struct Answer {
    int clocks;
    bool good;
  };

  static bool writes(const In& in) { return in.we && in.sel == 15 && port_writes(in.adr); }
  static bool answered(const In& in) { return in.cyc && (Pipelined || in.stb); }
  bool asks(const In& in) const { return in.cyc && in.stb && (Pipelined || due_.empty()); }

  std::deque<Answer> due_;
  Out out_;
};

}  // namespace feltgate::test
