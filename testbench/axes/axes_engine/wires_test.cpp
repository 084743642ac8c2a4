// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// axes_engine: each bit to and from the engine is connected to its own place; the port's addresses;
// a lock that lasts as long as a check. Documentation: docs/architecture.md
#include "axes_engine_bench.hpp"
#include "catch.hpp"

using namespace feltgate;
using namespace feltgate::test;

namespace {

constexpr int kTickCount = kPosition + 9;

/// Four inputs as events whose numbers are bits in turn.
EngineMemory telling(std::array<int, 4> inputs) {
  const auto tells = [](int number, int input) {
    return word(EngineOp::add, 0, input, kConstant, EngineTarget::event, number);
  };
  EngineMemory m;
  m.line_base = 509;
  program(m, 0,
          {tells(0x155, inputs[0]), tells(0x0aa, inputs[1]), tells(0x1c3, inputs[2]),
           tells(0x03c, inputs[3]), out(0, EngineOp::add, kConstant, kConstant)});
  return m;
}

}  // namespace

TEST_CASE("axes_engine: all bits of all inputs come to a program, and those of its events out") {
  for (const auto& inputs : {std::array{kPosition, kVelocity, kPosition + 2, kPosition + 3},
                             std::array{kVelocity + 3, kPosition + 5, kTickCount, kPosition}}) {
    const EngineMemory m = telling(inputs);
    Device device;
    device.load(m, image_crc(m));
    Random random(11);
    const auto any = [&random] { return static_cast<std::int32_t>(random.bits()); };
    int events = 0;
    for (int tick = 0; tick < 200; ++tick) {
      for (Axis& a : device.in.axis) {
        a.position = any();
        a.velocity = any();
        a.tau_hat = any();
      }
      device.in.tick_count = static_cast<std::uint32_t>(any());
      for (int k = 0; k < Device::kTick; ++k) {
        device.clock();
        events += device.out().port.event_valid;
      }
    }
    CHECK(events > 700);
    device.play();
  }
}

TEST_CASE(
    "axes_engine: an address of another page reads 0 and does nothing, whichever bit it has") {
  const EngineMemory m = counting_law();
  Device device;
  device.load(m, image_crc(m));
  device.axis(1).position = -50;
  device.write(H::run, 0);
  device.ticks(10);
  const std::int32_t rests = device.out().torque[0];
  for (unsigned page = 0; page < 16; ++page) {
    if (page << 12 == static_cast<unsigned>(axes_engine)) continue;
    device.in.port.reg_addr =
        static_cast<std::uint16_t>(page << 12 | static_cast<unsigned>(H::run));
    device.in.port.reg_wdata = 1;
    device.in.port.reg_write = true;
    device.clocks(40);
    CHECK(device.out().port.reg_rdata == 0);
    device.ticks(3);
    CHECK(device.out().torque[0] == rests);
  }
  device.write(H::run, 1);
  device.ticks(5);
  CHECK(device.out().torque[0] != rests);
  device.play();
}

TEST_CASE("axes_engine: a program is locked while a check is under way that nobody waits for") {
  const EngineMemory m = counting_law();
  Device device;
  device.load(m, image_crc(m));
  const auto low = static_cast<std::uint32_t>(m.program_at(3));
  device.write(H::high, static_cast<std::uint32_t>(m.program_at(3) >> 32));
  device.set(&Axis::arm_request, true);
  device.ticks(2);
  device.set(&Axis::arm_request, false);
  device.ticks(1);
  device.write(H::program + 3, low ^ 1);
  CHECK(device.read(H::program + 3) == low);
  device.ticks(2000);
  device.write(H::program + 3, low ^ 1);
  CHECK(device.read(H::program + 3) == (low ^ 1));
  device.play();
}

TEST_CASE("axes_engine: whose check it is does not change with the clock in which it ends") {
  for (const int shift : {0, 1}) {
    const EngineMemory m = counting_law();
    Device device;
    device.load(m, image_crc(m));
    device.set(&Axis::arm_request, true);
    device.ticks(2);
    device.axis(0).arm_request = false;
    device.ticks(3);
    for (int k = 0; k < shift; ++k) device.pause();
    device.ticks(2);
    device.axis(0).arm_request = true;
    CHECK(device.until_checked(3000) > 500);
    device.play();
  }
}
