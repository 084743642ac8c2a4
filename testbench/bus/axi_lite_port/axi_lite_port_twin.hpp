// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Twin of rtl/bus/axi_lite_port.sv, clock by clock: what each channel holds.
// Documentation: docs/other-tools.md
#pragma once

#include <cstdint>

#include "port_map.hpp"

namespace feltgate::test {

class AxiLitePort {
 public:
  struct In {
    bool awvalid = false;
    std::uint16_t awaddr = 0;
    bool wvalid = false;
    std::uint32_t wdata = 0;
    std::uint8_t wstrb = 15;
    bool bready = false;
    bool arvalid = false;
    std::uint16_t araddr = 0;
    bool rready = false;
    std::uint32_t reg_rdata = 0;
    bool reg_busy = false;
  };
  struct Out {
    bool awready = true, wready = true, bvalid = false, arready = true, rvalid = false;
    int bresp = 2, rresp = 2;
    std::uint32_t rdata = 0;
    std::uint16_t reg_addr = 0;
    std::uint32_t reg_wdata = 0;
    bool reg_write = false;
  };

  void reset() { *this = AxiLitePort{}; }

  Out peek(const In& in) const {
    Out out;
    out.awready = !aw_;
    out.wready = !w_;
    out.arready = !ar_;
    out.bvalid = b_;
    out.rvalid = r_;
    out.bresp = b_good_ ? 0 : 2;
    out.rresp = r_good_ ? 0 : 2;
    out.rdata = rdata_;
    out.reg_write = offers() && !fetches(in);
    out.reg_addr = static_cast<std::uint16_t>((out.reg_write ? awaddr_ : araddr_) / 4);
    out.reg_wdata = wdata_;
    return out;
  }

  void clock(const In& in) {
    const AxiLitePort was = *this;
    const bool fetch = was.fetches(in);
    const bool taken = was.offers() && !fetch && !in.reg_busy;
    const bool refused = was.whole() && !was.offers();
    const bool no_word = was.asks() && !was.readable();

    if (was.b_ && in.bready) b_ = false;
    if (taken || refused) {
      b_ = true;
      b_good_ = taken;
      aw_ = w_ = false;
    }
    if (!was.aw_) {
      aw_ = in.awvalid;
      awaddr_ = in.awaddr;
    }
    if (!was.w_) {
      w_ = in.wvalid;
      wdata_ = in.wdata;
      wstrb_ = in.wstrb;
    }

    if (was.r_ && in.rready) r_ = false;
    if (was.fetched_ == 3) {
      r_ = r_good_ = true;
      rdata_ = in.reg_rdata;
    }
    if (no_word) {
      r_ = true;
      r_good_ = false;
      rdata_ = 0;
    }
    fetched_ = fetch ? 1 : was.fetched_ % 3 == 0 ? 0 : was.fetched_ + 1;
    if (fetch || no_word) ar_ = false;
    if (!was.ar_) {
      ar_ = in.arvalid;
      araddr_ = in.araddr;
    }
    out_ = peek(in);
  }

  const Out& out() const { return out_; }

 private:
  bool whole() const { return aw_ && w_ && !b_; }
  bool offers() const {
    return whole() && wstrb_ == 15 && awaddr_ % 4 == 0 && port_writes(awaddr_ / 4);
  }
  bool readable() const { return araddr_ % 4 == 0 && port_reads(araddr_ / 4); }
  bool asks() const { return ar_ && !r_ && fetched_ == 0; }
  bool fetches(const In& in) const { return asks() && readable() && (in.reg_busy || !offers()); }

  bool aw_ = false, w_ = false, ar_ = false, b_ = false, r_ = false;
  bool b_good_ = false, r_good_ = false;
  std::uint16_t awaddr_ = 0, araddr_ = 0;
  std::uint8_t wstrb_ = 0;
  std::uint32_t wdata_ = 0, rdata_ = 0;
  int fetched_ = 0;  ///< clocks since an address was on the port, 0 none
  Out out_;
};

}  // namespace feltgate::test
