// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Axes with an engine and a host that loads laws over the port. Documentation:
// docs/blocks/feltgate_axes.md
#pragma once

#include "../../engine/machine/machine_programs.hpp"
#include "axes_life.hpp"

namespace feltgate::test {

using H = EngineMap::H;

/// Axes whose host loads a law.
class LawLife : public Life {
 public:
  void idle() {
    int n = 0;
    while (twin().out().reg_busy) {
      REQUIRE(++n < 20'000);
      clocks(1);
    }
  }
  void engine(int address, std::uint32_t word) {
    in.reg_addr = static_cast<std::uint16_t>(axes_engine + address);
    in.reg_wdata = word;
    clocks(1);
    idle();
    in.reg_write = true;
    clocks(1);
    in.reg_write = false;
    clocks(1);
    idle();
  }
  std::uint32_t engine_word(int address) {
    in.reg_addr = static_cast<std::uint16_t>(axes_engine + address);
    clocks(40);
    in.reg_read = true;
    clocks(1);
    in.reg_read = false;
    return twin().out().reg_rdata;
  }
  void parameters(std::int32_t minus, std::int32_t plus) {
    engine(kParameter, static_cast<std::uint32_t>(minus));
    engine(kParameter + 1, static_cast<std::uint32_t>(plus));
    engine(H::commit, 1);
    clocks(600);
  }
  void load(const EngineMemory& m, std::uint32_t crc, std::uint32_t max_age = 10) {
    for (int n = 0; n < 3; ++n) {
      engine(H::high, static_cast<std::uint32_t>(m.program_at(n) >> 32));
      engine(H::program + n, static_cast<std::uint32_t>(m.program_at(n)));
    }
    for (int n = 0; n < 2; ++n) {
      engine(EngineMap::D::lower + n,
             static_cast<std::uint32_t>(m.data_at(EngineMap::D::lower + n)));
      engine(EngineMap::D::upper + n,
             static_cast<std::uint32_t>(m.data_at(EngineMap::D::upper + n)));
    }
    engine(H::crc, crc);
    engine(H::max_age, max_age);
    parameters(-100, 100);
    engine(H::run, 1);
  }
  void ask(int scene) {
    for (int n = 0; n < kAxes; ++n) control(n, scene, false);
    write_all(A::self_test_pulse, 0);
    write_all(A::ramp_step, 0x7ffffff);
    write_all(C::command, 1u << C::command_clear_faults);
    ticks(2);
    for (int n = 0; n < kAxes; ++n) control(n, scene, true);
  }
  bool armed() const { return out(0).armed && out(1).armed; }
  /// Returns the number of ticks until both are armed, at most `limit`.
  int until_armed(int limit) {
    int n = 0;
    while (!armed() && n < limit) ticks(1), ++n;
    return n;
  }
  void arm_law() {
    ask(Design::S::law);
    REQUIRE(until_armed(5000) < 5000);
    ticks(8);
  }
  void step(int n, bool up) {
    turn(n, up);
    ticks(1);
  }
};

}  // namespace feltgate::test
