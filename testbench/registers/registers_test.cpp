// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
#include "feltgate/axis/registers.hpp"

#include "ports/registers.hpp"

using namespace feltgate::test;

namespace {

struct Twin : BlockTwin<ports::registers> {
  /// Addresses of words, and of control and commands; data of each format.
  void legal(In& in, Random& random) {
    if (random.one_in(4))
      in.reg_addr = static_cast<std::uint16_t>(Map::C::control + random.below(2));
    if (random.one_in(4))
      in.reg_addr = static_cast<std::uint16_t>(random.pick(design().words).address);
    if (random.one_in(3)) in.reg_wdata >>= random.below(32);
  }
  void clock(const In& in) {
    Pins pins;
    pins.reg_addr = in.reg_addr;
    pins.reg_wdata = in.reg_wdata;
    pins.reg_write = in.reg_write;
    pins.set_zero = in.set_zero;
    block.clock(formats(), {in.tick, pins, in.armed, in.polarity_holds});
  }
  Out out(const In& in) const {
    using C = Map::C;
    const Control& c = block.control;
    const auto command = [&](int bit) { return block.command(in.tick, bit); };
    return {block.busy(),
            {c.filter(), c.pwm_mode(), c.encoder_polarity(), c.motor_polarity(), c.mode(),
             c.scene(), c.arm(), c.host()},
            block.error(),
            block.write(in.tick, in.armed),
            block.address(),
            block.data(),
            block.set_zero(in.tick),
            command(C::command_clear_faults),
            command(C::command_kick),
            command(C::command_freeze),
            command(C::command_thaw),
            block.disarm(),
            block.stop(),
            block.restart(in.tick, in.scene),
            block.refused(),
            block.saturated()};
  }
  Twin() { block.control.word = static_cast<std::uint32_t>(design()["CONTROL_RESET"]); }

  Registers block;
};

}  // namespace

TEST_CASE("registers: RTL and twin, every clock") {
  lock_step(Twin(), {800'000, 8, 5000, "control_error"});
}
