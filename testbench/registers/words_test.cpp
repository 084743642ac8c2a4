// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// What the host's registers must do, as docs/registers.md says. That the RTL is the twin:
// NAME_test.cpp.
#include "block_design.hpp"
#include "catch.hpp"
#include "feltgate/axis/params.hpp"
#include "feltgate/axis/registers.hpp"

using namespace feltgate::test;

namespace {

using A = Map::A;
using C = Map::C;

struct Port {
  /// A clock; the last of a tick where `tick`.
  void clock(bool tick, int addr = 0, std::uint32_t data = 0, bool write = false) {
    Pins pins;
    pins.reg_addr = static_cast<std::uint16_t>(addr);
    pins.reg_wdata = data;
    pins.reg_write = write;
    r.clock(formats(), {tick, pins, armed, false});
  }
  /// A write, and the clock in which it takes effect.
  void write(int addr, std::uint32_t data) {
    clock(false, addr, data, true);
    CHECK(r.busy());
  }
  Registers r;
  bool armed = false;
};

}  // namespace

TEST_CASE("registers: one write a tick takes effect at its end; another one is not taken") {
  Port port;
  port.write(A::torque_limit, 1000);
  port.clock(false, A::torque_limit, 2000, true);
  CHECK_FALSE(port.r.write(false, false));
  CHECK(
      (port.r.write(true, false) && port.r.address() == A::torque_limit && port.r.data() == 1000));
  port.clock(true);
  CHECK_FALSE(port.r.busy());
  port.write(C::command, 1U << C::command_kick);
  CHECK((port.r.command(true, C::command_kick) && !port.r.command(true, C::command_clear_faults)));
}

TEST_CASE("registers: a word that does not fit its format becomes the nearest that does") {
  for (const Word& w : design().words) {
    CAPTURE(w.name);
    const std::int64_t most = (std::int64_t{1} << (w.has_sign ? w.bits - 1 : w.bits)) - 1,
                       least = w.has_sign ? -most - 1 : 0;
    for (const std::int64_t value :
         {least, most, least - 1, most + 1, std::int64_t{0}, std::int64_t{-1}}) {
      // A host writes 32 bits: with a sign, but where all are the word's.
      if (value != (w.bits == 32 && !w.has_sign ? std::int64_t{static_cast<std::uint32_t>(value)}
                                                : std::int64_t{static_cast<std::int32_t>(value)})) {
        continue;
      }
      Port port;
      port.write(w.address, static_cast<std::uint32_t>(value));
      const std::int64_t nearest = std::max(least, std::min(most, value));
      CHECK(port.r.data() == static_cast<std::uint32_t>(nearest));
      CHECK(port.r.saturated() == (value != nearest));
    }
  }
}

TEST_CASE(
    "registers: while armed some words are refused, some ramp, and mode, polarities and filter "
    "hold") {
  Port port;
  port.armed = true;
  for (const Word& w : design().words) {
    CAPTURE(w.name);
    port.write(w.address, 1);
    const bool refused = w.address < 64 && (Map::refused_while_armed >> w.address & 1) != 0;
    CHECK(port.r.write(true, true) == !refused);
    port.clock(true);
    CHECK(port.r.refused() == refused);
  }
  port.write(A::torque_constant, 1);
  CHECK_FALSE(port.r.write(true, true));
  port.clock(true);
  port.write(C::control, 0x7fff);
  port.clock(true);
  CHECK(port.r.control.word == 0x3f);  // host, arm, scene
  port.write(Map::S::wall * 32 + 2, 1);
  CHECK((port.r.restart(true, Map::S::wall) && !port.r.restart(true, Map::S::damper)));
}

TEST_CASE("registers: a disarm and a stop pass a write that waits") {
  Port port;
  port.armed = true;
  port.write(C::control, 3U << C::control_host);
  port.clock(false, C::control, 1U << C::control_host, true);
  CHECK(port.r.disarm());
  port.clock(false, C::command, 1U << C::command_stop, true);
  CHECK(port.r.stop());
  port.clock(true);
  CHECK((port.r.control.host() && !port.r.control.arm() && !port.r.stop() && !port.r.disarm()));
}

TEST_CASE(
    "params: a word that has changed by itself is told when it is fetched, until it is written") {
  ParamsMemory memory(design(), formats());
  Params params;
  const auto errors = [&](int ticks, bool write) {
    int found = 0;
    for (int k = 0; k < ticks * 50; ++k) {
      params.clock(memory, formats(), k % 50, 0, write && k == 49, A::torque_limit, 5, 0);
      found += params.word_error();
    }
    return found;
  };
  CHECK(errors(6, false) == 0);
  for (int bit = 0; bit < 36; ++bit) {
    memory.ram[A::torque_limit] ^= std::uint64_t{1} << bit;
    CHECK(errors(6, false) > 2);
    CHECK(errors(1, true) <= 1);
    CHECK((errors(6, false) == 0 && memory.p.torque_limit == 5));
  }
  for (const std::uint64_t all : {std::uint64_t{0}, (std::uint64_t{1} << 36) - 1}) {
    memory.ram.fill(all);  // a memory that reads all 0 or all 1
    CHECK(errors(6, false) > 100);
  }
}
