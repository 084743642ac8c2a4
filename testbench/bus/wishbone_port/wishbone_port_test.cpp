// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// wishbone_port: RTL against twin on every clock, and a host in front of it with the twin of
// registers behind. Documentation: docs/other-tools.md
#include <Vwishbone_port.h>

#include <cstdint>
#include <deque>
#include <map>
#include <vector>

#include "catch.hpp"
#include "lock_step.hpp"
#include "port_core.hpp"
#include "port_map.hpp"
#include "ports.hpp"

// Twin of rtl/bus/wishbone_port.sv, clock by clock: a list of answers that are due.

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

using namespace feltgate;
using namespace feltgate::test;

namespace {

using Twin = WishbonePort<PIPELINED != 0>;
constexpr std::uint32_t kHost = 1U << Lever::C::control_host, kArm = 1U << Lever::C::control_arm;

struct Adapter {
  static void drive(Vwishbone_port& rtl, const Twin::In& in) {
    FELTGATE_DRIVE(rtl, in, cyc, stb, we, adr, sel, dat, reg_rdata, reg_busy);
  }
  template <class Check>
  static void compare(Check& check, const Vwishbone_port& rtl, const Twin::Out& out) {
    FELTGATE_COMPARE(check, rtl, out, dat, ack, err, stall, reg_addr, reg_wdata, reg_write);
  }
};
using Bench = LockStep<Vwishbone_port, Twin, Adapter>;

/// A host with a script; keeps the inputs for the lock-step run.
class Host {
 public:
  Twin::Out clock(Twin::In in) {
    in.reg_rdata = core.rdata();
    in.reg_busy = core.busy();
    list_.push_back(in);
    const Twin::Out out = port_.peek(in);
    core.clock(out);
    port_.clock(in);
    return out;
  }
  /// One request to its answer; the clocks that it took before it was taken, and to the answer.
  struct Answer {
    bool good = false;
    std::uint32_t dat = 0;
    int waited = 0, clocks = 0;
  };
  Answer request(bool we, int adr, std::uint32_t dat = 0, int sel = 15) {
    const Twin::In asks{
        true, true, we, static_cast<std::uint16_t>(adr), static_cast<std::uint8_t>(sel), dat};
    Answer a;
    Twin::In in = asks;
    for (;; ++a.clocks) {
      REQUIRE(a.clocks < 200);
      const int before = core.taken();
      const Twin::Out out = clock(in);
      REQUIRE_FALSE((out.ack && out.err));
      if (out.ack || out.err) {
        a.good = out.ack;
        a.dat = out.dat;
        // Between two classic requests stb is low or high; both are tried.
        if (++requests_ % 2 == 0) clock({});
        return a;
      }
      if (PIPELINED != 0 && in.stb && !out.stall) in.stb = false;
      if (we && core.taken() == before && out.reg_write) ++a.waited;
    }
  }
  void idle(int clocks) {
    while (clocks-- > 0) {
      const Twin::Out out = clock({});
      REQUIRE_FALSE(out.ack);
      REQUIRE_FALSE(out.err);
    }
  }
  void until(int clock_of_tick) {
    while (core.clock_of_tick() != clock_of_tick) idle(1);
  }
  void play() {
    Bench bench("wishbone_port", 1);
    bench.run_list(list_);
  }

  PortCore core;

 private:
  Twin port_;
  std::vector<Twin::In> list_;
  int requests_ = 0;
};

}  // namespace

TEST_CASE("wishbone_port: every word is read, three clocks after its request") {
  Host host;
  for (int adr = 0; adr < 0x1000; adr += adr < 0x400 ? 1 : 0x55) {
    const Host::Answer a = host.request(false, adr, 0, adr & 15);
    REQUIRE(a.good == port_reads(adr));
    REQUIRE(a.clocks == 3);
    if (adr < 512) REQUIRE(a.dat == host.core.parameter(adr));
  }
  REQUIRE(host.core.taken() == 0);
  host.play();
}

TEST_CASE("wishbone_port: writes land once each, in their order, and wait for the tick") {
  Host host;
  Random random(3);
  std::map<int, std::uint32_t> wanted;
  int waited = 0, written = 0;
  for (int k = 0; k < 300; ++k) {
    const int adr = static_cast<int>(random.below(512));
    const auto word = static_cast<std::uint32_t>(random.bits());
    const Host::Answer a = host.request(true, adr, word);
    REQUIRE(a.good);
    REQUIRE(a.clocks == a.waited + 3);
    REQUIRE(a.waited <= Lever::clocks_per_tick);
    waited += a.waited > 0;
    REQUIRE(host.core.taken() == ++written);
    wanted[adr] = word_kept(adr, word);
    if (random.one_in(4)) host.idle(static_cast<int>(random.below(70)));
  }
  REQUIRE(waited > 100);
  host.idle(2 * Lever::clocks_per_tick);
  for (const auto& [adr, word] : wanted) REQUIRE(host.request(false, adr).dat == word);
  REQUIRE(host.core.taken() == written);
  host.play();
}

TEST_CASE("wishbone_port: parts of words, addresses of nobody and read-only words are errors") {
  Host host;
  host.until(1);
  for (const int busy : {0, 1}) {
    if (busy != 0) REQUIRE(host.request(true, Lever::A::ramp_step, 1).good);
    const int taken = host.core.taken();
    for (int sel = 0; sel < 15; ++sel) {
      const Host::Answer a = host.request(true, Lever::C::control, ~0U, sel);
      REQUIRE_FALSE(a.good);
      REQUIRE(a.clocks == 3);
      REQUIRE(a.waited == 0);
    }
    for (const int adr : {0x202, 0x2ff, 0x300, 0x33f, 0x340, 0x600, 0xfff}) {
      REQUIRE_FALSE(host.request(true, adr, ~0U).good);
    }
    REQUIRE(host.core.taken() == taken);
  }
  host.play();
}

TEST_CASE("wishbone_port: a disarm is on the port with its request, whatever waits or is read") {
  for (int reads = 0; reads < (PIPELINED != 0 ? 4 : 1); ++reads) {
    Host host;
    host.until(0);
    REQUIRE(host.request(true, Lever::C::control, kHost | kArm).good);
    host.until(0);
    REQUIRE((host.core.control() & kArm) != 0);
    REQUIRE(host.request(true, Lever::A::ramp_step, 5).good);
    REQUIRE(host.core.busy());
    for (int k = 0; k < reads; ++k) host.clock({true, true, false, 7, 15, 0});
    REQUIRE_FALSE(host.core.disarm());
    const Twin::In disarm{true, true, true, Lever::C::control, 15, kHost};
    host.clock(disarm);
    REQUIRE(host.core.disarm());
    while (host.core.busy()) host.clock(disarm);
    REQUIRE((host.core.control() & kArm) == 0);
    host.play();
  }
}

TEST_CASE("wishbone_port: a request in every clock is answered in every clock, in order") {
  if (PIPELINED == 0) return;
  Host host;
  int answers = 0;
  for (int k = 0; k < 512 + 3; ++k) {
    const bool asks = k < 512;
    const Twin::Out out = host.clock(
        {true, asks, false, static_cast<std::uint16_t>(asks ? (k * 37) % 512 : 0), 15, 0});
    REQUIRE(out.ack == (k >= 3));
    if (!out.ack) continue;
    REQUIRE(out.dat == host.core.parameter((answers * 37) % 512));
    ++answers;
  }
  REQUIRE(answers == 512);
  host.play();
}

TEST_CASE("wishbone_port: a cycle that ends early gets no answer, nor does the next one get its") {
  for (int clocks = 1; clocks < 4; ++clocks) {
    for (int gap = 1; gap < 4; ++gap) {
      Host host;
      host.request(false, 3);
      for (int k = 0; k < clocks; ++k) {
        const Twin::Out out = host.clock({true, k == 0 || PIPELINED == 0, false, 0x300, 15, 0});
        REQUIRE_FALSE(out.ack);
      }
      host.idle(gap);
      const Host::Answer a = host.request(false, Lever::A::velocity_a1);
      REQUIRE(a.clocks == 3);
      REQUIRE(a.dat == host.core.parameter(Lever::A::velocity_a1));
      host.play();
    }
  }
}

TEST_CASE("wishbone_port: any signals at any time, with resets") {
  struct Any {
    Random random;
    Twin::In in{};
    Twin::In operator()(std::int64_t) {
      if (random.one_in(12)) in.cyc = random.below(4) != 0;
      if (random.one_in(5)) in.stb = random.below(4) != 0;
      if (random.one_in(3)) {
        in.we = random.coin();
        in.sel = random.below(3) != 0 ? 15 : static_cast<std::uint8_t>(random.below(16));
        const std::uint32_t where[] = {random.below(0x200), 0x200U + random.below(4),
                                       0x300U + random.below(0x80), random.below(0x1000)};
        in.adr = static_cast<std::uint16_t>(where[random.below(4)]);
      }
      in.dat = static_cast<std::uint32_t>(random.bits());
      in.reg_rdata = static_cast<std::uint32_t>(random.bits());
      in.reg_busy = random.one_in(3);
      return in;
    }
  };
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    Bench bench("wishbone_port", seed);
    bench.run(Any{Random(seed)}, scaled_clocks(100000), {seed % 2 == 0 ? 500U : 0U});
  }
}
