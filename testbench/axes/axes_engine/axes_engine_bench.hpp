// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The part between an engine and its axes, with axes that a test controls: RTL and twin.
// Documentation: docs/architecture.md
#pragma once

#include <Vaxes_engine.h>

#include <vector>

#include "catch.hpp"
#include "feltgate/axes_engine.hpp"
#include "feltgate/generated/lever_law.hpp"
#include "lock_step.hpp"
#include "machine_programs.hpp"
#include "ports.hpp"

namespace feltgate::test {

using H = EngineMap::H;
constexpr int kAxes = 2;

/// The signals of an axis.
struct Axis {
  bool law = false, arm_request = false, armed = false, zeroed = false;
  std::int32_t position = 0, velocity = 0, tau_hat = 0;
};

struct AxisOf {
  CoreOut core;
  Axis says;
  bool is_sample = false, is_measured = false, is_last = false;
  const CoreOut& out() const { return core; }
  bool arm_request(const CoreIn&) const { return says.arm_request; }
  bool zeroed() const { return says.zeroed; }
  bool samples() const { return is_sample; }
  bool measured() const { return is_measured; }
  bool last() const { return is_last; }
};

/// The twin as a separate block.
class Twin {
 public:
  struct In {
    std::array<Axis, kAxes> axis;
    bool sample = false, measured = false, last = false;
    std::uint32_t tick_count = 0;
    AxesIn<kAxes> port;
  };
  struct Out {
    std::array<std::int32_t, kAxes> torque{};
    bool late = false, restart = false, unchecked = false, unfit = false;
    AxesOut<kAxes> port;
  };

  auto& engine() { return twin_.engine(); }
  bool restarted() const { return twin_.restarted(); }
  bool busy() const { return twin_.busy(); }
  void reset() {
    twin_.reset();
    last_ = In{};
  }
  Out peek(const In& in) const {
    Out out;
    std::array<CoreIn, kAxes> each;
    twin_.give(in.port, axes(in), each);
    const Program<kAxes> program = twin_.program(in.port, 0);
    out.torque = program.torque;
    out.late = program.late;
    out.restart = each[0].law_restart;
    out.unchecked = each[0].axis_silent;
    out.unfit = each[0].axis_blocked;
    twin_.show(in.port, out.port);
    return out;
  }
  Out out() const { return peek(last_); }
  void clock(const In& in) {
    last_ = in;
    twin_.clock(in.port, axes(in), {});
  }

 private:
  static std::array<AxisOf, kAxes> axes(const In& in) {
    std::array<AxisOf, kAxes> all;
    for (std::size_t n = 0; n < kAxes; ++n) {
      AxisOf& a = all[n];
      a.says = in.axis[n];
      a.is_sample = in.sample;
      a.is_measured = in.measured;
      a.is_last = in.last;
      a.core.scene = in.axis[n].law ? Map::S::law : 0;
      a.core.armed = in.axis[n].armed;
      a.core.tick_count = in.tick_count;
      a.core.position = in.axis[n].position;
      a.core.velocity = in.axis[n].velocity;
      a.core.tau_hat = in.axis[n].tau_hat;
    }
    return all;
  }

  mutable AxesEngine<kAxes> twin_{design_of<LeverLaw>()};  // program() counts what was taken
  In last_;
};

struct Adapter {
  static void drive(Vaxes_engine& rtl, const Twin::In& in) {
    const auto bits = [&in](bool Axis::*what) {
      return static_cast<std::uint8_t>(in.axis[0].*what | in.axis[1].*what << 1);
    };
    const auto words = [&in](std::int32_t Axis::*what) {
      return std::uint64_t{static_cast<std::uint32_t>(in.axis[1].*what)} << 32 |
             static_cast<std::uint32_t>(in.axis[0].*what);
    };
    rtl.law_i = bits(&Axis::law);
    rtl.arm_request_i = bits(&Axis::arm_request);
    rtl.armed_i = bits(&Axis::armed);
    rtl.zeroed_i = bits(&Axis::zeroed);
    rtl.sample_i = in.sample;
    rtl.measured_i = in.measured;
    rtl.last_i = in.last;
    rtl.tick_count_i = in.tick_count;
    rtl.position_i = words(&Axis::position);
    rtl.velocity_i = words(&Axis::velocity);
    rtl.tau_hat_i = words(&Axis::tau_hat);
    FELTGATE_DRIVE(rtl, in.port, reg_addr, reg_wdata, reg_write, reg_read);
  }
  template <class Check>
  static void compare(Check& check, const Vaxes_engine& rtl, const Twin::Out& out) {
    constexpr int width = LeverLaw::f.torque.width();
    const auto torque = [&rtl](int n) {
      const std::uint64_t raw = rtl.torque_o >> (width * n) << (64 - width);
      return static_cast<std::int64_t>(raw) >> (64 - width);
    };
    check("torque of axis 0", torque(0), std::int64_t{out.torque[0]});
    check("torque of axis 1", torque(1), std::int64_t{out.torque[1]});
    FELTGATE_COMPARE(check, rtl, out, late, restart, unchecked, unfit);
    check("reg_busy", rtl.reg_busy_o, out.port.reg_busy);
    if (out.port.rdata_known) check("reg_rdata", rtl.reg_rdata_o, out.port.reg_rdata);
    check("event_valid", rtl.event_valid_o, out.port.event_valid);
    if (!out.port.event_valid) return;
    check("event_number", rtl.event_number_o, out.port.event_number);
    check("event_value", static_cast<std::int32_t>(rtl.event_value_o), out.port.event_value);
  }
};
using Bench = LockStep<Vaxes_engine, Twin, Adapter>;

/// A state that begins at 900 and loses one in a run: axis 0 has it with parameter 0, axis 1 its
/// position with mailbox word 30. An event tells of velocity and tau_hat of axis 1.
inline EngineMemory counting_law() {
  using Op = EngineOp;
  EngineMemory m;
  m.set_data(kConstant + 1, 900);
  m.set_data(kConstant + 2, 1);
  m.line_base = 509;
  program(m, 0,
          {to(0, Op::sel, kConstant + 1, 0), to(0, Op::sub, 0, kConstant + 2),
           word(Op::add, 0, 0, kParameter, EngineTarget::output, 0),
           word(Op::sub, 0, kVelocity + 3, kVelocity + 4, EngineTarget::event, 5),
           out(1, Op::add, kPosition + 3, kParameter + 30)});
  for (const int n : {0, 30}) {
    m.set_data(EngineMap::D::lower + n, -1000);
    m.set_data(EngineMap::D::upper + n, 1000);
  }
  return m;
}

/// The twin with ticks of 50 clocks and a host. Its inputs are recorded for the RTL.
class Device {
 public:
  static constexpr int kTick = 50;
  Twin::In in;

  Device() { twin_.reset(); }
  Twin::Out out() const { return twin_.peek(in); }
  Twin& twin() { return twin_; }
  int clock_of_tick() const { return since_; }
  Axis& axis(int n) { return in.axis[static_cast<std::size_t>(n)]; }
  void clock() {
    since_ = (since_ + 1) % kTick;
    in.sample = since_ == 2;
    in.measured = since_ == 23;
    in.last = since_ == kTick - 1;
    if (in.measured) ++in.tick_count;
    twin_.clock(in);
    inputs_.push_back(in);
    for (Axis& a : in.axis) a.zeroed = false;
    in.port.reg_write = in.port.reg_read = false;
  }
  /// A clock between two ticks, which then are further apart.
  void pause() {
    in.sample = in.measured = in.last = false;
    twin_.clock(in);
    inputs_.push_back(in);
  }
  void clocks(int n) {
    for (int k = 0; k < n; ++k) clock();
  }
  void ticks(int n) { clocks(n * kTick); }
  void write(int address, std::uint32_t word) {
    in.port.reg_addr = static_cast<std::uint16_t>(axes_engine + address);
    while (out().port.reg_busy) clock();
    in.port.reg_wdata = word;
    in.port.reg_write = true;
    clock();
    while (out().port.reg_busy) clock();
  }
  std::uint32_t read(int address) {
    in.port.reg_addr = static_cast<std::uint16_t>(axes_engine + address);
    while (out().port.reg_busy) clock();
    clocks(40);
    const std::uint32_t word = out().port.reg_rdata;
    in.port.reg_read = true;
    clock();
    return word;
  }
  void load(const EngineMemory& m, std::uint32_t crc, std::uint32_t max_age = 20) {
    for (int n = 0; n < 8; ++n) {
      write(H::high, static_cast<std::uint32_t>(m.program_at(n) >> 32));
      write(H::program + n, static_cast<std::uint32_t>(m.program_at(n)));
    }
    for (int n = EngineMap::D::lower; n < EngineMap::data_words; ++n) {
      if (m.data_at(n) != 0) write(H::data + n, static_cast<std::uint32_t>(m.data_at(n)));
    }
    write(H::line_base, static_cast<std::uint32_t>(m.line_base));
    write(H::mailbox_first, 30);
    write(H::mailbox_age, 2000);
    write(H::crc, crc);
    write(H::max_age, max_age);
    commit(0, 0);
    write(H::run, 1);
  }
  void commit(std::int32_t parameter, std::int32_t mailbox) {
    write(H::data + kParameter, static_cast<std::uint32_t>(parameter));
    write(H::data + kParameter + 30, static_cast<std::uint32_t>(mailbox));
    write(H::commit, 1);
    while ((read(H::status) & 1U) != 0) clock();
  }
  void set(bool Axis::*what, bool on) {
    for (Axis& a : in.axis) a.*what = on;
  }
  /// Ticks until the check is over, at most `limit`.
  int until_checked(int limit) {
    int n = 0;
    while (out().unchecked && n < limit) ticks(1), ++n;
    return n;
  }
  void arm() {
    set(&Axis::arm_request, true);
    until_checked(3000);
    set(&Axis::armed, true);
  }
  /// Runs the recorded inputs, RTL against twin.
  void play() {
    Twin again = Bench("axes_engine", 1).run_list(inputs_);
    CHECK(again.engine().memory().data == twin_.engine().memory().data);
  }

 private:
  Twin twin_;
  std::vector<Twin::In> inputs_;
  int since_ = 0;
};

}  // namespace feltgate::test
