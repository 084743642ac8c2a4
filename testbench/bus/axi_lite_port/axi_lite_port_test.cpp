// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// axi_lite_port: RTL against twin on every clock, and a manager in front of it with the twin of
// registers behind. Documentation: docs/other-tools.md
#include <Vaxi_lite_port.h>

#include <algorithm>
#include <cstdint>
#include <deque>
#include <vector>

#include "catch.hpp"
#include "lock_step.hpp"
#include "port_core.hpp"
#include "port_map.hpp"
#include "ports.hpp"

// Twin of rtl/bus/axi_lite_port.sv, clock by clock: what each channel holds.

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

using namespace feltgate;
using namespace feltgate::test;

namespace {

using Twin = AxiLitePort;
constexpr std::uint32_t kHost = 1U << Lever::C::control_host, kArm = 1U << Lever::C::control_arm;

struct Adapter {
  static void drive(Vaxi_lite_port& rtl, const Twin::In& in) {
    FELTGATE_DRIVE(rtl, in, awvalid, awaddr, wvalid, wdata, wstrb, bready, arvalid, araddr, rready,
                   reg_rdata, reg_busy);
  }
  template <class Check>
  static void compare(Check& check, const Vaxi_lite_port& rtl, const Twin::Out& out) {
    FELTGATE_COMPARE(check, rtl, out, awready, wready, arready, bvalid, bresp, rvalid, rresp, rdata,
                     reg_addr, reg_wdata, reg_write);
  }
};
using Bench = LockStep<Vaxi_lite_port, Twin, Adapter>;

struct Write {
  std::uint16_t addr = 0;
  std::uint32_t data = 0;
  std::uint8_t strb = 15;
};
struct Read {
  int resp = 0;
  std::uint32_t data = 0;
};

/// A manager: what is in its lists goes out, each channel for itself, with the delays asked for.
class Manager {
 public:
  explicit Manager(std::uint64_t seed = 0) : random_(seed) {}

  void clock() {
    Twin::In in;
    if (!aw_shown_) aw_shown_ = !aw.empty() && go();
    if (!w_shown_) w_shown_ = !w.empty() && go();
    if (!ar_shown_) ar_shown_ = !ar.empty() && go();
    in.awvalid = aw_shown_;
    in.wvalid = w_shown_;
    in.arvalid = ar_shown_;
    if (in.awvalid) in.awaddr = aw.front();
    if (in.wvalid) in.wdata = w.front().data;
    in.wstrb = in.wvalid ? w.front().strb : 0;
    if (in.arvalid) in.araddr = ar.front();
    in.bready = go();
    in.rready = go();
    in.reg_rdata = core.rdata();
    in.reg_busy = core.busy();
    list_.push_back(in);
    const Twin::Out out = port_.peek(in);
    if (in.awvalid && out.awready) aw.pop_front(), aw_shown_ = false;
    if (in.wvalid && out.wready) w.pop_front(), w_shown_ = false;
    if (in.arvalid && out.arready) ar.pop_front(), ar_shown_ = false;
    if (in.bready && out.bvalid) b.push_back(out.bresp);
    if (in.rready && out.rvalid) r.push_back({out.rresp, out.rdata});
    core.clock(out);
    port_.clock(in);
    ++clocks;
  }
  void write(int addr, std::uint32_t data, int strb = 15) {
    aw.push_back(static_cast<std::uint16_t>(addr));
    w.push_back({0, data, static_cast<std::uint8_t>(strb)});
  }
  int wait_b() {
    const std::size_t n = b.size() + 1;
    for (int k = 0; b.size() < n; ++k) REQUIRE((clock(), k < 300));
    return b.back();
  }
  Read read(int addr) {
    const std::size_t n = r.size() + 1;
    ar.push_back(static_cast<std::uint16_t>(addr));
    for (int k = 0; r.size() < n; ++k) REQUIRE((clock(), k < 300));
    return r.back();
  }
  void until(int clock_of_tick) {
    do {
      clock();
    } while (core.clock_of_tick() != clock_of_tick);
  }
  void play() {
    Bench bench("axi_lite_port", 1);
    bench.run_list(list_);
  }

  PortCore core;
  std::deque<std::uint16_t> aw, ar;
  std::deque<Write> w;
  std::vector<int> b;
  std::vector<Read> r;
  std::uint32_t delay = 0;  ///< mean clocks of each channel before it goes on
  int clocks = 0;

 private:
  bool go() { return delay == 0 || random_.one_in(delay); }

  Random random_;
  Twin port_;
  std::vector<Twin::In> list_;
  bool aw_shown_ = false, w_shown_ = false, ar_shown_ = false;
};

}  // namespace

TEST_CASE("axi_lite_port: every word is read") {
  for (const std::uint32_t delay : {0U, 4U}) {
    Manager m(7);
    m.delay = delay;
    for (int addr = 0; addr < 0x4000; addr += addr < 0x1000 ? 4 : 0x124) {
      const int before = m.clocks;
      const Read read = m.read(addr);
      REQUIRE(read.resp == (port_reads(addr / 4) ? 0 : 2));
      if (read.resp != 0) REQUIRE(read.data == 0);
      if (delay == 0) REQUIRE(m.clocks - before == (read.resp == 0 ? 6 : 3));
      if (addr < 0x800) REQUIRE(read.data == m.core.parameter(addr / 4));
      if (addr < 0x1000) REQUIRE(m.read(addr + 1 + addr % 3).resp == 2);
    }
    REQUIRE(m.core.taken() == 0);
    m.play();
  }
}

TEST_CASE("axi_lite_port: writes land once each, in their order, whichever channel comes first") {
  for (const std::uint32_t delay : {0U, 3U, 90U}) {
    Manager m(11);
    m.delay = delay;
    Random random(5);
    std::vector<std::uint32_t> wanted(512);
    for (int k = 0; k < 512; ++k) wanted[static_cast<std::size_t>(k)] = m.core.parameter(k);
    constexpr int kWrites = 60;
    int good = 0;
    for (int k = 0; k < kWrites; ++k) {
      const int word = static_cast<int>(random.below(512));
      const int strb = random.one_in(4) ? static_cast<int>(random.below(15)) : 15;
      const int at = random.one_in(6) ? 1 : 0;
      const auto data = static_cast<std::uint32_t>(random.bits());
      m.write(4 * word + at, data, strb);
      if (strb == 15 && at == 0) {
        wanted[static_cast<std::size_t>(word)] = word_kept(word, data);
        ++good;
      }
      if (random.coin()) m.ar.push_back(static_cast<std::uint16_t>(4 * random.below(512)));
    }
    const std::size_t reads = m.ar.size();
    for (int k = 0; m.b.size() < kWrites || m.r.size() < reads; ++k)
      REQUIRE((m.clock(), k < 60000));
    REQUIRE(m.core.taken() == good);
    REQUIRE(std::count(m.b.begin(), m.b.end(), 0) == good);
    m.until(0);
    m.until(0);
    REQUIRE(m.b.size() == kWrites);
    REQUIRE(m.r.size() == reads);
    for (int k = 0; k < 512; ++k) {
      REQUIRE(m.core.parameter(k) == wanted[static_cast<std::size_t>(k)]);
    }
    m.play();
  }
}

TEST_CASE("axi_lite_port: addresses of nobody and read-only words are errors, no write") {
  Manager m;
  for (const int word : {0x202, 0x2ff, 0x300, 0x33f, 0x340, 0x600, 0xfff}) {
    m.write(4 * word, ~0U);
    REQUIRE(m.wait_b() == 2);
  }
  REQUIRE(m.core.taken() == 0);
  m.play();
}

TEST_CASE("axi_lite_port: a disarm waits for no read longer than a clock") {
  for (int offset = 0; offset < 12; ++offset) {
    Manager m;
    m.until(0);
    m.write(4 * Lever::C::control, kHost | kArm);
    m.until(0);
    REQUIRE((m.core.control() & kArm) != 0);
    m.write(4 * Lever::A::ramp_step, 5);
    REQUIRE(m.wait_b() == 0);
    REQUIRE(m.core.busy());
    for (int k = 0; k < 8; ++k) m.ar.push_back(static_cast<std::uint16_t>(4 * k));
    for (int k = 0; k < offset; ++k) m.clock();
    m.write(4 * Lever::C::control, kHost);
    // One clock for the channels, one on the port, at most one behind a read.
    for (int k = 0; k < 3; ++k) m.clock();
    REQUIRE(m.core.disarm());
    REQUIRE(m.wait_b() == 0);
    m.until(0);
    REQUIRE((m.core.control() & kArm) == 0);
    m.play();
  }
}

TEST_CASE("axi_lite_port: any signals at any time, with resets") {
  struct Any {
    Random random;
    std::uint16_t address() {
      const std::uint32_t where[] = {4 * random.below(0x200), 0x800U + 4 * random.below(4),
                                     0xc00U + 4 * random.below(0x80), random.below(0x4000)};
      return static_cast<std::uint16_t>(where[random.below(4)]);
    }
    Twin::In operator()(std::int64_t) {
      Twin::In in;
      in.awvalid = random.one_in(4);
      in.wvalid = random.one_in(4);
      in.arvalid = random.one_in(3);
      in.awaddr = address();
      in.araddr = address();
      in.wdata = static_cast<std::uint32_t>(random.bits());
      in.wstrb = random.below(3) != 0 ? 15 : static_cast<std::uint8_t>(random.below(16));
      in.bready = random.coin();
      in.rready = random.coin();
      in.reg_rdata = static_cast<std::uint32_t>(random.bits());
      in.reg_busy = random.coin();
      return in;
    }
  };
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    Bench bench("axi_lite_port", seed);
    bench.run(Any{Random(seed)}, scaled_clocks(100000), {seed % 2 == 0 ? 500U : 0U});
  }
}
