// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
#include "feltgate/axis/host.hpp"

#include "block_signals.hpp"
#include "ports/host.hpp"

using namespace feltgate::test;

namespace {

struct Twin : BlockTwin<ports::host> {
  /// Ticks of 50 clocks; addresses of words, of control and commands and of the snapshot.
  void legal(In& in, Random& random) {
    in.tick.clock = at;
    in.tick.last = at == 49;
    at = at < 49 ? at + 1 : 0;
    if (random.one_in(4))
      in.reg_addr = static_cast<std::uint16_t>(Map::C::control + random.below(2));
    if (random.one_in(4))
      in.reg_addr = static_cast<std::uint16_t>(Map::C::snapshot + random.below(64));
    if (random.one_in(4))
      in.reg_addr = static_cast<std::uint16_t>(random.pick(design().words).address);
    in.reg_write = in.reg_write && random.one_in(4);
  }
  Values values(const In& in) const {
    Values v = values_of(in.values);
    block.words(v, safe_of(in.safety), position_of(in.position), bridge_of(in.bridge), in.testing);
    return v;
  }
  static Pins pins(const In& in) {
    Pins pins;
    pins.scene = static_cast<std::uint8_t>(in.panel.scene);
    pins.set_zero = in.panel.set_zero;
    pins.reg_addr = in.reg_addr;
    pins.reg_wdata = in.reg_wdata;
    pins.reg_write = in.reg_write;
    return pins;
  }
  void clock(const In& in) {
    block.clock(memory, bank, formats(), tick_of(in.tick), pins(in), safe_of(in.safety),
                position_of(in.position), values(in));
  }
  Out out(const In& in) const {
    const Control& c = block.registers.control;
    const bool last = in.tick.last;
    const Commands m = block.commands(last);
    const Values v = values(in);
    const SnapshotWord& w = block.snapshot.word;
    Out o;
    o.reg_busy = block.registers.busy();
    o.reg_rdata = block.rdata;
    o.p = memory.p;
    o.control = {
        c.filter(), c.pwm_mode(), c.encoder_polarity(), c.motor_polarity(), c.mode(), c.scene(),
        c.arm(),    c.host()};
    o.commands = {m.host,      m.host_arm,     in.panel.arm, m.disarm, in.panel.stop,
                  m.host_stop, m.clear_faults, m.kick,       m.mode};
    o.scene = block.scene;
    o.set_zero = block.registers.set_zero(last);
    o.restart = block.registers.restart(last, block.scene);
    o.trip = block.params.word_error() || block.registers.error();
    o.snapshot = {v.tick,   v.position, v.status,  v.faults,  v.encoder, v.index,   v.scene,
                  v.limits, v.velocity, v.tau_hat, v.tau_ref, v.current, v.voltage, v.duty};
    o.word = {w.valid, w.place, w.data};
    return o;
  }
  void reset(const In& in) {
    block.reset(memory, bank, pins(in), static_cast<std::uint32_t>(design()["CONTROL_RESET"]));
    at = 0;
  }

  ParamsMemory memory{design(), formats()};
  Snapshot::Memory bank{};
  Host block;
  int at = 0;
};

}  // namespace

TEST_CASE("host: RTL and twin, every clock") { lock_step(Twin(), {800'000, 8, 5000, "trip"}); }
