// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Twin of rtl/host/host.sv, the host's side of an axis: register port, parameters, and the snapshot
// that is read back. reg_rdata follows reg_addr by three clocks. docs/blocks/host.md
#pragma once

#include "feltgate/axis/params.hpp"
#include "feltgate/axis/registers.hpp"
#include "feltgate/axis/snapshot.hpp"

namespace feltgate::axis {

struct Host {
  Registers registers;
  Params params;
  Snapshot snapshot;
  int scene = 0;  ///< in force in this tick
  int addr = 0, addr2 = 0;
  std::uint32_t rdata = 0;

  Commands commands(bool last) const {
    Commands c;
    c.host = registers.control.host();
    c.host_arm = registers.control.arm();
    c.disarm = registers.disarm();
    c.host_stop = registers.stop();
    c.clear_faults = registers.command(last, Map::C::command_clear_faults);
    c.kick = registers.command(last, Map::C::command_kick);
    c.mode = registers.control.mode();
    return c;
  }
  /// The chain's values with the words of status and faults.
  [[gnu::always_inline]] void words(Values& v, const Safe& safe, const Position& position,
                                    const Bridge& bridge, bool testing) const {
    using C = Map::C;
    const auto bit = [](unsigned on, int place) { return on << place; };
    v.faults = bit(safe.faults, C::faults_seen) |
               bit(static_cast<unsigned>(safe.first_fault), C::faults_first) |
               bit(bridge.why & 0x1f, C::faults_current) |
               bit(position.why & 0x3f, C::faults_absolute);
    v.status =
        bit(v.limits, C::status_limits) | bit(static_cast<unsigned>(scene), C::status_scene) |
        bit(safe.armed, C::status_armed) |
        bit(static_cast<unsigned>(registers.control.mode()), C::status_mode) |
        bit(static_cast<unsigned>(safe.test_result), C::status_self_test) |
        bit(testing, C::status_testing) | bit(bridge.why >> 5 & 1, C::status_driver_fault) |
        bit(bridge.why >> 6 & 1, C::status_current_missing) |
        bit(position.error, C::status_encoder_error) | bit(registers.refused(), C::status_refused) |
        bit(registers.saturated(), C::status_saturated) | bit(safe.unkicked, C::status_unkicked);
  }

  void clock(ParamsMemory& m, Snapshot::Memory& bank, const WordFormats& formats, const Tick& tick,
             const Pins& pins, const Safe& safe, const Position& position, const Values& values) {
    settle(m, bank);
    rdata = read();
    addr2 = addr;
    addr = pins.reg_addr;
    const Registers::In in = at_port(tick.last, pins, safe, position);
    snapshot.clock(bank, tick.last, tick.tau_ref, tick.duty,
                   registers.command(tick.last, Map::C::command_freeze),
                   registers.command(tick.last, Map::C::command_thaw), values, pins.reg_addr);
    params.clock(m, formats, tick.clock, scene, registers.write(tick.last, in.armed),
                 registers.address(), registers.data(), pins.reg_addr);
    if (tick.last) next_scene(pins);
    registers.clock(formats, in);
  }
  /// A tick in which nothing is written but the snapshot. What the port reads in it waits.
  /// `reads`: the host may read its values.
  [[gnu::always_inline]] void tick(Snapshot::Memory& bank, int clocks, const Pins& pins,
                                   const Values& values, bool reads) {
    if (reads) snapshot.tick(bank, values);
    addr = addr2 = pins.reg_addr;
    waits_ = true;
    params.tick(clocks);
    snapshot.end_tick(true, false, false);
    next_scene(pins);
  }
  /// The word that the host reads.
  std::uint32_t read_data(const ParamsMemory& m, const Snapshot::Memory& bank) {
    settle(m, bank);
    return rdata;
  }
  void reset(const ParamsMemory& m, const Snapshot::Memory& bank, const Pins& pins,
             std::uint32_t control_reset) {
    settle(m, bank);
    registers = {};
    registers.control.word = control_reset;
    params.reset();
    params.read(m, pins.reg_addr);
    snapshot.reset();
    snapshot.read(bank, pins.reg_addr);
    scene = addr = addr2 = 0;
    rdata = 0;
  }
  Registers::In at_port(bool last, const Pins& pins, const Safe& safe,
                        const Position& position) const {
    return {last, pins, safe.armed || safe.locks, position.polarity_holds};
  }

 private:
  void settle(const ParamsMemory& m, const Snapshot::Memory& bank) {
    if (!waits_) return;
    waits_ = false;
    params.settle(m, addr);
    snapshot.settle(bank, addr);
    rdata = read();
  }
  void next_scene(const Pins& pins) {
    scene = registers.control.host() ? registers.control.scene() : pins.scene;
  }
  std::uint32_t read() const {
    if (addr2 >> 9 == 0) return params.read_data();
    if (addr2 >> 6 == Map::C::snapshot >> 6) return snapshot.read_data();
    return addr2 == Map::C::control ? registers.control.word : 0;
  }

  bool waits_ = false;  ///< a tick as a whole has passed, its reads have not
};

}  // namespace feltgate::axis
