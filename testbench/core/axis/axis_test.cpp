// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The default chip's twin beside its RTL: every output in every clock, over random motion, panel,
// host (words out of format too), faults, other axes and resets; and run() beside clock(). By hand:
//   verilator --cc --build --prefix Vtop --top-module lever_wrap cfg.sv map.sv <rtl> lever_wrap.sv
//   g++ -std=c++17 -Imodel/include ... axis_test.cpp obj_dir/Vtop__ALL.a verilated.cpp
//   AXIS_DESIGN=design.txt AXIS_TICKS=20000 AXIS_SEED=1 ./axis_test

#define CATCH_CONFIG_MAIN
#include <catch2/catch.hpp>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <random>
#include <string>
#include <tuple>

#include "Vtop.h"
#include "feltgate/axis/tops.hpp"

namespace {

using feltgate::axis::Axis;
using feltgate::axis::Design;
using feltgate::axis::LeverTop;
using feltgate::Map;

Design design() {
  const char* const path = std::getenv("AXIS_DESIGN");
  std::ifstream file(path == nullptr ? "design.txt" : path);
  return Design::read(file);
}
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
  LeverTop::In in;
  long resets = 0, writes = 0;
  void quiet() { quiet_ = true; }  ///< the host writes seldom, few glitches

  /// Inputs of the next clock. `clock`: of the tick. `busy`: of the register port.
  void next(int clock, bool busy) {
    move();
    port(busy);
    if (in.reset) {
      if (r_.one_in(4)) in.reset = false;
    } else if (r_.one_in(300000)) {
      in.reset = true;
      ++resets;
    }
    if (r_.one_in(40000)) in.panel.arm = !in.panel.arm;
    if (r_.one_in(60000)) in.panel.scene = static_cast<int>(r_.below(16));
    if (in.panel.stop ? r_.one_in(10) : r_.one_in(faults_ ? 200000 : 2000000)) {
      in.panel.stop = !in.panel.stop;
    }
    if (in.panel.set_zero ? r_.one_in(3) : r_.one_in(50000)) in.panel.set_zero = !in.panel.set_zero;
    if (clock < 2) {  // the laws' operands hold while the chain runs
      if (r_.one_in(500)) in.law.torque = static_cast<std::int32_t>(r_.word(21));
      if (in.law.late ? r_.one_in(10) : r_.one_in(40000)) in.law.late = !in.law.late;
      if (r_.one_in(1000)) in.law.restart = !in.law.restart;
      if (in.peers.testing ? r_.one_in(40) : r_.one_in(20000)) in.peers.testing = !in.peers.testing;
    }
    if (in.peers.fault ? r_.one_in(20) : r_.one_in(1000000)) in.peers.fault = !in.peers.fault;
    if (in.peers.silent ? r_.one_in(3000) : r_.one_in(100000)) in.peers.silent = !in.peers.silent;
    if (in.peers.blocked ? r_.one_in(900) : r_.one_in(90000)) in.peers.blocked = !in.peers.blocked;
    if (in.peers.waits ? r_.one_in(5000) : r_.one_in(70000)) in.peers.waits = !in.peers.waits;
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
    in.pins.encoder.a = ab_ == 2 || ab_ == 3;
    in.pins.encoder.b = ab_ == 1 || ab_ == 2;
    if (r_.one_in(faults_ ? 10000 : 100000)) in.pins.encoder.a = !in.pins.encoder.a;
    if (faults_ && r_.one_in(50000)) ab_ ^= 2;
    if (in.pins.encoder.z ? r_.one_in(30) : r_.one_in(30000))
      in.pins.encoder.z = !in.pins.encoder.z;
  }
  void write(int address, std::uint32_t word) { queue_.push_back({address, word, true}); }
  void port(bool busy) {
    if (!queue_.empty() && in.port.write && !busy) {
      queue_.erase(queue_.begin());
      in.port.write = false;
      ++writes;
    }
    if (queue_.empty() && r_.one_in(quiet_ ? 40000 : 1500)) act();
    if (queue_.empty()) {
      in.port.write = false;
      if (r_.one_in(quiet_ ? 20000 : 20)) {
        const std::uint32_t kind = r_.below(8);
        in.port.addr = static_cast<int>(kind < 3   ? 0x300 + r_.below(64)
                                        : kind < 6 ? r_.below(512)
                                                   : 0x1f8 + r_.below(16));
      }
    } else if (!in.port.write && (r_.one_in(3) || busy)) {
      in.port = queue_.front();
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
    write(w.address, kind < 4   ? w.reset + r_.word(8)
                     : kind < 8 ? feltgate::axis::low_bits(static_cast<std::uint32_t>(r_.bits()), w.bits)
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
  std::vector<feltgate::axis::RegisterPort> queue_;
};

/// The outputs of RTL and twin, by name.
using Outputs = std::vector<std::pair<const char*, std::uint64_t>>;
std::uint64_t signed32(std::int64_t x) { return static_cast<std::uint32_t>(x); }
std::uint64_t bits(std::initializer_list<bool> from_top) {
  std::uint64_t x = 0;
  for (const bool b : from_top) x = x << 1 | (b ? 1 : 0);
  return x;
}

void outputs(const LeverTop& twin, const LeverTop::In& in, Outputs& to) {
  const LeverTop::Out o = twin.out(in);
  const feltgate::axis::Values& s = o.snapshot;
  const feltgate::axis::Safe& f = o.safety;
  to = {{"reg_busy", o.reg_busy},
        {"reg_rdata", o.reg_rdata},
        {"gates", o.gates},
        {"tick.clock", static_cast<std::uint64_t>(o.tick.clock)},
        {"tick.at", bits({o.tick.sample, o.tick.velocity, o.tick.tau_hat, o.tick.scene, o.tick.tau_ref,
                          o.tick.duty, o.tick.last})},
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
        {"duty_active", signed32(o.duty_active)},
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

void drive(Vtop& rtl, const LeverTop::In& in) {
  const feltgate::axis::Peers& p = in.peers;
  rtl.rst_ni = !in.reset;
  rtl.enc_a_i = in.pins.encoder.a;
  rtl.enc_b_i = in.pins.encoder.b;
  rtl.enc_z_i = in.pins.encoder.z;
  rtl.arm_i = in.panel.arm;
  rtl.stop_i = in.panel.stop;
  rtl.set_zero_i = in.panel.set_zero;
  rtl.scene_i = static_cast<std::uint8_t>(in.panel.scene);
  rtl.law_torque_i = static_cast<std::uint32_t>(in.law.torque);
  rtl.law_late_i = in.law.late;
  rtl.law_restart_i = in.law.restart;
  rtl.peers_i = static_cast<std::uint8_t>(bits({p.fault, p.silent, p.blocked, p.testing, p.waits}));
  rtl.reg_addr_i = static_cast<std::uint16_t>(in.port.addr);
  rtl.reg_wdata_i = in.port.wdata;
  rtl.reg_write_i = in.port.write;
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

feltgate::EncoderPins events_pins(const std::vector<feltgate::EncoderEvent>& events,
                                  const feltgate::EncoderPins& before) {
  return events.empty() ? before : events.back().pins;
}
bool same_but_pins(const LeverTop::In& a, const LeverTop::In& b) {
  const auto all = [](const LeverTop::In& x) {
    return std::make_tuple(x.reset, x.panel.arm, x.panel.stop, x.panel.set_zero, x.panel.scene,
                           x.law.torque, x.law.late, x.law.restart, x.peers.fault, x.peers.silent,
                           x.peers.blocked, x.peers.testing, x.peers.waits, x.port.addr,
                           x.port.wdata, x.port.write);
  };
  return all(a) == all(b);
}

}  // namespace

TEST_CASE("every output of the twin equals the RTL's in every clock") {
  const Design d = design();
  const long ticks = number("AXIS_TICKS", 20000), first = number("AXIS_SEED", 1);
  long armed = 0, scenes[16] = {}, limits[12] = {}, clocks = 0, resets = 0, writes = 0, passed = 0;
  unsigned faults = 0;
  for (long run = 0; run < 10; ++run) {
    Vtop rtl;
    LeverTop twin(d);
    Stimulus s(static_cast<std::uint64_t>(first + 100 * run), d);
    rtl.rst_ni = 1;  // the reset is an edge
    rtl.eval();
    s.in.reset = true;
    Outputs of_rtl, of_twin;
    outputs(twin, s.in, of_twin);
    for (long tick = 0; tick < ticks / 10;) {
      drive(rtl, s.in);
      edge(rtl);
      twin.clock(s.in);
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
  const Design d = design();
  const long clocks = number("AXIS_RUN_TICKS", number("AXIS_TICKS", 20000)) * d["CLOCKS_PER_TICK"];
  const long first = number("AXIS_SEED", 1);
  long compared = 0, whole = 0, thrown = 0;
  for (long run = 0; run < 10; ++run) {
    LeverTop by_clock(d), by_run(d);
    Stimulus s(static_cast<std::uint64_t>(first + 100 * run), d);
    if (run % 3 != 0) s.quiet();
    std::mt19937_64 lengths(static_cast<std::uint64_t>(first + run));
    s.in.reset = true;
    Outputs of_clock, of_run;
    for (long at = 0; at < clocks / 10;) {
      // A stretch with constant inputs but for the encoder's pins.
      LeverTop::In in = s.in;
      std::vector<feltgate::EncoderEvent> events;
      const long most = 1 + static_cast<long>(lengths() % (lengths() % 4 == 0 ? 30000 : 300));
      const feltgate::EncoderPins before = in.pins.encoder;
      long n = 0;
      bool same = true;
      for (; n < most && same; ++n) {
        in.pins.encoder = s.in.pins.encoder;
        if (n > 0 && in.pins.encoder != events_pins(events, before))
          events.push_back({n, in.pins.encoder});
        by_clock.clock(in);
        s.next(by_clock.axis.clock_of_tick(), by_clock.out(in).reg_busy);
        same = same_but_pins(s.in, in);
      }
      LeverTop::In of_stretch = in;
      of_stretch.pins.encoder = before;
      by_run.run(of_stretch, n, events.data(), events.data() + events.size());
      at += n;
      outputs(by_clock, in, of_clock);
      outputs(by_run, of_stretch, of_run);
      ++compared;
      if (of_clock != of_run) {
        FAIL("run " << run << " after " << at << " clocks, " << n
                    << " in the stretch:" << difference(of_clock, of_run));
      }
    }
    whole += by_run.whole;
    thrown += by_run.thrown;
  }
  std::printf("%ld clocks, compared after %ld stretches, %ld ticks as a whole, %ld thrown away\n",
              clocks, compared, whole, thrown);
}
