// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The default chip's twin beside its RTL: every output in every clock, over random motion, panel,
// host (words out of format too), faults, other axes and resets; and run() beside clock(). By hand:
//   verilator --cc --build --prefix Vtop --top-module lever_wrap cfg.sv map.sv <rtl> lever_wrap.sv
//   g++ -std=c++17 -Imodel/include ... axis_test.cpp obj_dir/Vtop__ALL.a verilated.cpp
//   AXIS_TICKS=20000 AXIS_SEED=1 ./axis_test
// Another design: -DFELTGATE_DESIGN=Paper -DFELTGATE_DESIGN_HEADER='"feltgate/generated/paper.hpp"'

#define CATCH_CONFIG_MAIN
#include <catch2/catch.hpp>
#include <cstdio>
#include <cstdlib>
#include <random>
#include <string>
#include <tuple>

#include "Vtop.h"
#include "feltgate/feltgate_core.hpp"

#ifndef FELTGATE_DESIGN
#define FELTGATE_DESIGN Lever
#define FELTGATE_DESIGN_HEADER "feltgate/generated/lever.hpp"
#endif
#include FELTGATE_DESIGN_HEADER

namespace {

using feltgate::CoreIn;
using feltgate::Map;
using feltgate::axis::Design;
using Core = feltgate::FeltgateCore<feltgate::FELTGATE_DESIGN>;

const Design& design() { return feltgate::design_of<feltgate::FELTGATE_DESIGN>(); }
long number(const char* name, long otherwise) {
  const char* text = std::getenv(name);
  return text == nullptr ? otherwise : std::atol(text);
}

struct Random {
  std::mt19937_64 bits;
  std::uint32_t below(std::uint32_t n) { return static_cast<std::uint32_t>(bits() % n); }
  bool one_in(std::uint32_t n) { return below(n) == 0; }
  std::uint32_t word(int most) {  // of at most so many bits, with any sign
    return static_cast<std::uint32_t>(static_cast<std::int32_t>(bits()) >>
                                      (32 - 2 - below(static_cast<std::uint32_t>(most - 1))));
  }
};

/// Moves the inputs clock by clock, as hosts, hands and cables do.
class Stimulus {
 public:
  Stimulus(std::uint64_t seed, const Design& d)
      : r_{std::mt19937_64(seed)},
        words_(d.words),
        i2t_start_(static_cast<std::uint32_t>(d["I2T_START"])) {
    faults_ = r_.one_in(2);
    fastest_ = r_.one_in(3) ? 1200 : 250;
    setup();
  }
  CoreIn in;
  bool reset = false;
  long resets = 0, writes = 0;
  void quiet() { quiet_ = true; }  ///< the host writes seldom, few glitches

  /// Inputs of the next clock. `clock`: of the tick. `busy`: of the register port.
  void next(int clock, bool busy) {
    move();
    port(busy);
    if (reset) {
      if (r_.one_in(4)) reset = false;
    } else if (r_.one_in(300000)) {
      reset = true;
      ++resets;
    }
    if (r_.one_in(40000)) in.arm = !in.arm;
    if (r_.one_in(60000)) in.scene = static_cast<std::uint8_t>(r_.below(16));
    if (in.stop ? r_.one_in(10) : r_.one_in(faults_ ? 200000 : 2000000)) {
      in.stop = !in.stop;
    }
    if (in.set_zero ? r_.one_in(3) : r_.one_in(50000)) in.set_zero = !in.set_zero;
    if (clock < 2) {  // the laws' operands hold while the chain runs
      if (r_.one_in(500)) in.law_torque = static_cast<std::int32_t>(r_.word(21));
      if (in.law_late ? r_.one_in(10) : r_.one_in(40000)) in.law_late = !in.law_late;
      if (r_.one_in(1000)) in.law_restart = !in.law_restart;
      if (in.axis_testing ? r_.one_in(40) : r_.one_in(20000)) in.axis_testing = !in.axis_testing;
    }
    if (in.axis_fault ? r_.one_in(20) : r_.one_in(1000000)) in.axis_fault = !in.axis_fault;
    if (in.axis_silent ? r_.one_in(3000) : r_.one_in(100000)) in.axis_silent = !in.axis_silent;
    if (in.axis_blocked ? r_.one_in(900) : r_.one_in(90000)) in.axis_blocked = !in.axis_blocked;
    if (in.axis_waits ? r_.one_in(5000) : r_.one_in(70000)) in.axis_waits = !in.axis_waits;
  }

 private:
  void move() {
    if (r_.one_in(2000)) speed_ += static_cast<int>(r_.below(401)) - 200;
    if (r_.one_in(60000)) speed_ = 0;
    if (r_.one_in(200000)) still_ = !still_;
    speed_ = std::max(-fastest_, std::min(fastest_, speed_));
    if (--wait_ <= 0 && speed_ != 0 && !still_) {
      ab_ = speed_ > 0 ? (ab_ + 1) & 3 : (ab_ + 3) & 3;
      wait_ = std::max(30, 40000 / std::abs(speed_));
      if (chatter_ > 0) {
        --chatter_;
        speed_ = -speed_;
      }
    }
    if (r_.one_in(400000)) chatter_ = static_cast<int>(r_.below(60));
    in.encoder.a = ab_ == 2 || ab_ == 3;
    in.encoder.b = ab_ == 1 || ab_ == 2;
    if (r_.one_in(faults_ ? 10000 : 100000)) in.encoder.a = !in.encoder.a;
    if (faults_ && r_.one_in(50000)) ab_ ^= 2;
    if (in.encoder.z ? r_.one_in(30) : r_.one_in(30000)) in.encoder.z = !in.encoder.z;
  }
  void write(int address, std::uint32_t word) {
    queue_.push_back({static_cast<std::uint16_t>(address), word});
  }
  void port(bool busy) {
    if (!queue_.empty() && in.reg_write && !busy) {
      queue_.erase(queue_.begin());
      in.reg_write = false;
      ++writes;
    }
    if (queue_.empty() && r_.one_in(quiet_ ? 40000 : 1500)) act();
    if (queue_.empty()) {
      in.reg_write = false;
      if (r_.one_in(quiet_ ? 20000 : 20)) {
        const std::uint32_t kind = r_.below(8);
        in.reg_addr = static_cast<std::uint16_t>(kind < 3   ? 0x300 + r_.below(64)
                                                 : kind < 6 ? r_.below(512)
                                                            : 0x1f8 + r_.below(16));
      }
    } else if (!in.reg_write && (r_.one_in(3) || busy)) {
      in.reg_addr = queue_.front().first;
      in.reg_wdata = queue_.front().second;
      in.reg_write = true;
    }
  }
  void setup() {
    using A = Map::A;
    write(A::self_test_pulse, r_.one_in(3) ? r_.below(3) : 0);
    write(A::self_test_quiet, r_.below(4));
    if (!faults_) {
      write(A::overspeed, 0x7fffffff);
      write(A::i2t_budget, 0xffffffff);
      write(A::polarity_ticks, 0xffff);
      write(A::hold_time, 0x3fff);
    } else {
      write(A::hold_time, r_.below(20));
      write(A::self_test_arms, r_.below(4));
      write(A::polarity_speed, r_.below(3000000));
      write(A::polarity_current, r_.below(400000));
      write(A::polarity_ticks, r_.below(300));
      write(A::overspeed, r_.below(0x7fffffff));
      write(A::i2t_budget, i2t_start_ + r_.below(i2t_start_));
      write(A::nominal_current_squared, r_.below(100000));
      write(A::watchdog_ticks, r_.one_in(2) ? r_.below(3000) : 100000);
    }
  }
  void any_word() {  // a word of the design: near its value, any in its format, or any at all
    const feltgate::axis::Word& w = words_[r_.below(static_cast<std::uint32_t>(words_.size()))];
    if (!faults_ && (w.address == Map::A::overspeed || w.address == Map::A::i2t_budget ||
                     w.address == Map::A::polarity_ticks || w.address == Map::A::hold_time)) {
      return;
    }
    const std::uint32_t kind = r_.below(10);
    write(w.address, kind < 4 ? w.reset + r_.word(8)
                     : kind < 8
                         ? feltgate::axis::low_bits(static_cast<std::uint32_t>(r_.bits()), w.bits)
                     : kind < 9 ? r_.word(32)
                                : static_cast<std::uint32_t>(r_.bits()));
  }
  void arm() {
    const std::uint32_t base = 1 | scene_ << 2 | mode_ << 6 | held_;
    write(0x200, base);
    write(0x201, 2);
    write(0x200, base | 2);
  }
  void act() {
    switch (r_.below(16)) {
      case 0:
      case 1:
      case 2:
        scene_ = r_.one_in(6) ? r_.below(16) : r_.one_in(3) ? 7 + r_.below(3) : 2 + r_.below(8);
        mode_ = r_.below(r_.one_in(4) ? 4 : 2);
        held_ = r_.below(2) << 10 | (r_.one_in(8) ? r_.below(4) << 8 : 0) |
                (r_.one_in(3) ? r_.below(16) << 11 : 0);
        write(0x201, 2);
        arm();
        break;
      case 3:
        scene_ = 2 + r_.below(8);
        write(0x200, 3 | scene_ << 2 | mode_ << 6 | held_);
        break;
      case 4:
        write(0x200, 1);
        for (std::uint32_t n = r_.below(20); n > 0; --n) any_word();
        if (!r_.one_in(3)) setup();
        write(0x201, 2);
        arm();
        break;
      case 5:
        write(0x201, r_.below(64) & ~32U);
        arm();
        break;
      case 6:
        if (faults_) write(0x201, 4);
        break;
      case 7:
        write(0x200, static_cast<std::uint32_t>(r_.bits()) & 0x7fff);
        break;
      case 8:
        if (r_.one_in(faults_ ? 4 : 20)) write(0x201, 32);
        break;
      case 9:
        if (r_.one_in(4)) write(static_cast<int>(r_.below(4096)), r_.word(32));
        break;
      case 10:
        write(Map::A::torque_limit, r_.below(400000));
        write(Map::A::ramp_step, r_.one_in(3) ? 0 : r_.word(24) & 0x7fffffff);
        break;
      case 11:
        write(Map::A::voltage_setpoint, r_.word(20));
        write(static_cast<int>(32 * scene_ + 10), r_.below(131071));
        break;
      default:
        any_word();
    }
  }

  Random r_;
  std::vector<feltgate::axis::Word> words_;
  std::uint32_t i2t_start_;
  int fastest_ = 250;
  bool faults_ = false, still_ = false, quiet_ = false;
  int speed_ = 0, wait_ = 100, ab_ = 0, chatter_ = 0;
  std::uint32_t scene_ = 9, mode_ = 0, held_ = 0;
  std::vector<std::pair<std::uint16_t, std::uint32_t>> queue_;
};

/// The outputs of RTL and twin, by name.
using Outputs = std::vector<std::pair<const char*, std::uint64_t>>;
std::uint64_t signed32(std::int64_t x) { return static_cast<std::uint32_t>(x); }
std::uint64_t bits(std::initializer_list<bool> from_top) {
  std::uint64_t x = 0;
  for (const bool b : from_top) x = x << 1 | (b ? 1 : 0);
  return x;
}

void outputs(const Core& twin, const CoreIn& in, Outputs& to) {
  const auto o = twin.axis_out(in);
  const feltgate::CoreOut& pins = twin.out();
  const feltgate::axis::Values& s = o.snapshot;
  const feltgate::axis::Safe& f = o.safety;
  to = {{"reg_busy", o.reg_busy},
        {"reg_rdata", pins.reg_rdata},
        {"gates", pins.gates},
        {"tick.clock", static_cast<std::uint64_t>(o.tick.clock)},
        {"tick.at", bits({o.tick.sample, o.tick.velocity, o.tick.tau_hat, o.tick.scene,
                          o.tick.tau_ref, o.tick.duty, o.tick.last})},
        {"tick.count", o.tick.count},
        {"position", signed32(s.position)},
        {"status", s.status},
        {"faults", s.faults},
        {"encoder", s.encoder},
        {"index", signed32(s.index)},
        {"tick", s.tick},
        {"scene, limits", static_cast<std::uint64_t>(s.scene) << 12 | s.limits},
        {"velocity", signed32(s.velocity)},
        {"tau_hat", signed32(s.tau_hat)},
        {"tau_ref", signed32(s.tau_ref)},
        {"current", signed32(s.current)},
        {"voltage", signed32(s.voltage)},
        {"duty", signed32(s.duty)},
        {"safety", bits({f.armed, f.locks, f.gates_enable, f.gates_clear, f.clear, f.arm_request,
                         f.ready, f.unkicked, f.derated, f.testing})},
        {"test_torque", signed32(f.test_torque)},
        {"latched", static_cast<std::uint64_t>(f.test_result) << 21 | std::uint64_t{f.faults} << 5 |
                        static_cast<std::uint64_t>(f.first_fault)},
        {"estimate", signed32(f.current_estimate)},
        {"word", (o.word.valid ? std::uint64_t{1} << 38 : 0) |
                     static_cast<std::uint64_t>(o.word.place) << 32 | o.word.data},
        {"duty_active", signed32(pins.duty_active)},
        {"zeroed", o.zeroed}};
}
void outputs(const Vtop& rtl, Outputs& to) {
  to = {{"reg_busy", rtl.reg_busy_o},
        {"reg_rdata", rtl.reg_rdata_o},
        {"gates", rtl.gates_o},
        {"tick.clock", rtl.clock_o},
        {"tick.at", rtl.at_o},
        {"tick.count", rtl.count_o},
        {"position", rtl.position_o},
        {"status", rtl.status_o},
        {"faults", rtl.faults_o},
        {"encoder", rtl.encoder_o},
        {"index", rtl.index_o},
        {"tick", rtl.tick_word_o},
        {"scene, limits", rtl.scene_limits_o},
        {"velocity", rtl.velocity_o},
        {"tau_hat", rtl.tau_hat_o},
        {"tau_ref", rtl.tau_ref_o},
        {"current", rtl.current_o},
        {"voltage", rtl.voltage_o},
        {"duty", rtl.duty_o},
        {"safety", rtl.safety_o},
        {"test_torque", rtl.test_torque_o},
        {"latched", rtl.latched_o},
        {"estimate", rtl.estimate_o},
        {"word", rtl.word_o},
        {"duty_active", rtl.duty_active_o},
        {"zeroed", rtl.zeroed_o}};
}

void drive(Vtop& rtl, const CoreIn& in) {
  rtl.enc_a_i = in.encoder.a;
  rtl.enc_b_i = in.encoder.b;
  rtl.enc_z_i = in.encoder.z;
  rtl.arm_i = in.arm;
  rtl.stop_i = in.stop;
  rtl.set_zero_i = in.set_zero;
  rtl.scene_i = static_cast<std::uint8_t>(in.scene);
  rtl.law_torque_i = static_cast<std::uint32_t>(in.law_torque);
  rtl.law_late_i = in.law_late;
  rtl.law_restart_i = in.law_restart;
  rtl.peers_i = static_cast<std::uint8_t>(
      bits({in.axis_fault, in.axis_silent, in.axis_blocked, in.axis_testing, in.axis_waits}));
  rtl.reg_addr_i = static_cast<std::uint16_t>(in.reg_addr);
  rtl.reg_wdata_i = in.reg_wdata;
  rtl.reg_write_i = in.reg_write;
}
void edge(Vtop& rtl) {
  rtl.eval();
  rtl.clk_i = 1;
  rtl.eval();
  rtl.clk_i = 0;
  rtl.eval();
}
std::string difference(const Outputs& rtl, const Outputs& twin) {
  std::string text;
  for (std::size_t n = 0; n < rtl.size(); ++n) {
    if (rtl[n].second == twin[n].second) continue;
    char line[99];
    std::snprintf(line, sizeof line, " %s %llx %llx;", rtl[n].first,
                  static_cast<unsigned long long>(rtl[n].second),
                  static_cast<unsigned long long>(twin[n].second));
    text += line;
  }
  return text;
}

std::string difference(const feltgate::CoreOut& a, const feltgate::CoreOut& b) {
  const auto all = [](const feltgate::CoreOut& o) {
    return Outputs{{"velocity", signed32(o.velocity)},
                   {"tick", o.tick_count},
                   {"position", signed32(o.position)},
                   {"tau_hat", signed32(o.tau_hat)},
                   {"tau_ref", signed32(o.tau_ref)},
                   {"current", signed32(o.current_ref)},
                   {"voltage", signed32(o.voltage)},
                   {"duty", signed32(o.duty)},
                   {"duty_active", signed32(o.duty_active)},
                   {"gates", o.gates},
                   {"scene", o.scene},
                   {"limits", o.limits},
                   {"faults", o.faults},
                   {"first", o.first_fault},
                   {"state", bits({o.armed, o.gates_enable, o.snapshot_valid, o.reg_busy})},
                   {"word", std::uint64_t{o.word_valid} << 38 | std::uint64_t{o.word_slot} << 32 |
                                o.word_data}};
  };
  return difference(all(a), all(b));
}
bool same(const CoreIn& a, const CoreIn& b) {
  const auto all = [](const CoreIn& x) {
    return std::make_tuple(x.encoder.a, x.encoder.b, x.encoder.z, x.arm, x.stop, x.set_zero,
                           x.scene, x.law_torque, x.law_late, x.law_restart, x.axis_fault,
                           x.axis_silent, x.axis_blocked, x.axis_testing, x.axis_waits, x.reg_addr,
                           x.reg_wdata, x.reg_write);
  };
  return all(a) == all(b);
}

}  // namespace

TEST_CASE("every output of the twin equals the RTL's in every clock") {
  const Design& d = design();
  const long ticks = number("AXIS_TICKS", 20000), first = number("AXIS_SEED", 1);
  long armed = 0, scenes[16] = {}, limits[12] = {}, clocks = 0, resets = 0, writes = 0, passed = 0;
  unsigned faults = 0;
  for (long run = 0; run < 10; ++run) {
    Vtop rtl;
    Core twin;
    Stimulus s(static_cast<std::uint64_t>(first + 100 * run), d);
    rtl.rst_ni = 1;  // the reset is an edge
    rtl.eval();
    s.reset = true;
    Outputs of_rtl, of_twin;
    outputs(twin, s.in, of_twin);
    for (long tick = 0; tick < ticks / 10;) {
      rtl.rst_ni = !s.reset;
      drive(rtl, s.in);
      edge(rtl);
      if (s.reset) {
        twin.reset(s.in);
      } else {
        twin.clock(s.in);
      }
      ++clocks;
      outputs(rtl, of_rtl);
      outputs(twin, s.in, of_twin);
      if (of_rtl != of_twin) {
        FAIL("run " << run << " clock " << clocks << " tick " << tick << " clock of the tick "
                    << rtl.clock_o << ":" << difference(of_rtl, of_twin));
      }
      if ((rtl.at_o & 1) != 0) {
        ++tick;
        ++passed;
        const bool on = (rtl.safety_o & 0x200) != 0;
        armed += on;
        if (on) ++scenes[rtl.scene_limits_o >> 12];
        for (int k = 0; k < 12; ++k) limits[k] += rtl.scene_limits_o >> k & 1;
        faults |= rtl.latched_o >> 5 & 0xffff;
      }
      s.next(rtl.clock_o, rtl.reg_busy_o != 0);
    }
    resets += s.resets;
    writes += s.writes;
  }
  std::printf("%ld ticks, %ld clocks, %ld armed, %ld resets, %ld writes, faults %x; scenes", passed,
              clocks, armed, resets, writes, faults);
  for (const long n : scenes) std::printf(" %ld", n);
  std::printf("; limits");
  for (const long n : limits) std::printf(" %ld", n);
  std::printf("\n");
  CHECK(armed > 0);
}

TEST_CASE("run equals clock in every output") {
  const long clocks =
      number("AXIS_RUN_TICKS", number("AXIS_TICKS", 20000)) * design()["CLOCKS_PER_TICK"];
  const long first = number("AXIS_SEED", 1);
  long compared = 0, whole = 0, thrown = 0, snapshots = 0;
  for (long run = 0; run < 10; ++run) {
    Core by_clock, by_run;
    Stimulus s(static_cast<std::uint64_t>(first + 100 * run), design());
    if (run % 3 != 0) s.quiet();
    Outputs of_clock, of_run;
    for (long at = 0; at < clocks / 10;) {
      // A stretch with constant inputs.
      const CoreIn in = s.in;
      std::vector<feltgate::CoreOut> expected;
      long n = 0;
      do {
        by_clock.clock(in);
        if (by_clock.out().snapshot_valid) expected.push_back(by_clock.out());
        s.next(by_clock.clock_of_tick(), by_clock.out().reg_busy);
        ++n;
      } while (same(s.in, in) && n < 30000);
      std::size_t met = 0;
      by_run.run(in, n, [&] {
        REQUIRE(met < expected.size());
        feltgate::CoreOut out = by_run.out();
        out.reg_rdata = expected[met].reg_rdata;  // it is read at the end of a stretch
        if (!(out == expected[met]))
          FAIL("run " << run << " after " << at << " clocks, snapshot " << met
                      << difference(out, expected[met]));
        ++met;
      });
      REQUIRE(met == expected.size());
      snapshots += static_cast<long>(met);
      at += n;
      outputs(by_clock, in, of_clock);
      outputs(by_run, in, of_run);
      ++compared;
      if (of_clock != of_run || by_clock.gate_clocks() != by_run.gate_clocks()) {
        FAIL("run " << run << " after " << at << " clocks, " << n
                    << " in the stretch:" << difference(of_clock, of_run));
      }
    }
    whole += static_cast<long>(by_run.whole_ticks());
    thrown += static_cast<long>(by_run.thrown_ticks());
  }
  std::printf(
      "%ld clocks, compared after %ld stretches and in %ld snapshots, %ld ticks as a whole, "
      "%ld thrown away\n",
      clocks, compared, snapshots, whole, thrown);
}
