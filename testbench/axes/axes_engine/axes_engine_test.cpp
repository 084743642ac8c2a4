// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// axes_engine: the effect of arming, entries, commits and a silent program on an engine's torque.
// RTL against twin on every clock. Documentation: docs/architecture.md
#include "axes_engine_bench.hpp"
#include "catch.hpp"
#include "random.hpp"

using namespace feltgate;
using namespace feltgate::test;

namespace {

const EngineMemory kLaw = counting_law();
const std::uint32_t kCrc = image_crc(kLaw);

/// From the change on: the torque may jump until the second run that ended after it was sampled.
void expect_restart(Device& device, const char* what) {
  INFO(what);
  device.clocks(3);
  CHECK(device.out().restart);
  int ticks = 0;
  while (device.out().restart && ticks < 20) device.ticks(1), ++ticks;
  CHECK(ticks >= 2);
  CHECK(ticks <= 4);
}

}  // namespace

TEST_CASE("axes_engine: states begin anew with the first axis in the scene, and with arming") {
  Device device;
  device.load(kLaw, kCrc);
  device.ticks(30);
  CHECK(device.out().torque[0] < 900 - 25);
  const auto begins = [&](const char* what) {
    device.ticks(5);
    INFO(what << ", torque " << device.out().torque[0]);
    CHECK(device.out().torque[0] > 900 - 8);
    device.ticks(20);
  };
  device.axis(1).law = true;
  begins("entry");
  device.axis(0).law = true;
  device.ticks(5);
  CHECK(device.out().torque[0] < 900 - 25);  // it is in force already
  device.arm();
  begins("arming");
  device.set(&Axis::law, false);
  device.ticks(5);
  CHECK(device.out().torque[0] < 900 - 25);
  device.axis(0).law = true;
  begins("entry while armed");
  device.set(&Axis::armed, false);
  device.ticks(5);
  CHECK(device.out().torque[0] < 900 - 25);
  device.play();
}

TEST_CASE("axes_engine: arming waits for a check of its own, and for a good one in the scene") {
  for (const std::uint32_t wrong : {0U, 1U}) {
    Device device;
    device.load(kLaw, kCrc ^ wrong);
    CHECK(device.out().unchecked);
    device.ticks(20);
    CHECK(device.out().unchecked);
    CHECK_FALSE(device.out().unfit);
    CHECK(device.out().late);  // no good check yet
    device.axis(0).arm_request = true;
    device.ticks(20);
    CHECK(device.out().unchecked);  // one of two
    device.axis(1).arm_request = true;
    const int whole = device.until_checked(3000);
    CHECK(whole > 500);
    CHECK(whole < 1500);
    CHECK(device.out().late == (wrong != 0));
    CHECK_FALSE(device.out().unfit);
    device.axis(1).law = true;
    device.clock();
    CHECK(device.out().unfit == (wrong != 0));
    // A check that another request began does not count.
    device.axis(0).arm_request = false;
    device.ticks(2);
    CHECK(device.out().unchecked);
    device.axis(0).arm_request = true;
    device.ticks(whole / 2);
    device.axis(0).arm_request = false;
    device.ticks(3);
    device.axis(0).arm_request = true;
    const int again = device.until_checked(3000);
    INFO("ticks " << whole << ", " << again);
    CHECK(again > whole);
    device.play();
  }
}

TEST_CASE("axes_engine: what jumps ramps until it was sampled") {
  Device device;
  device.load(kLaw, kCrc);
  device.axis(0).law = true;
  device.arm();
  expect_restart(device, "arming");
  device.axis(1).zeroed = true;
  device.clock();
  expect_restart(device, "zero of the second axis");
  device.set(&Axis::law, false);
  device.ticks(5);
  CHECK_FALSE(device.out().restart);
  device.axis(1).law = true;
  device.clock();
  expect_restart(device, "entry");
  device.axis(0).law = true;
  device.clocks(3);
  CHECK_FALSE(device.out().restart);
  // A parameter: seen in any clock of the wait for it.
  const auto commit_ramps = [&device](std::int32_t parameter, std::int32_t mailbox) {
    device.write(H::data + kParameter, static_cast<std::uint32_t>(parameter));
    device.write(H::data + kParameter + 30, static_cast<std::uint32_t>(mailbox));
    device.write(H::commit, 1);
    bool any = false;
    for (int k = 0; k < 45 * Device::kTick; ++k) {
      device.clock();
      any = any || device.out().restart;
    }
    CHECK_FALSE(device.out().restart);
    return any;
  };
  CHECK(commit_ramps(5, 0));
  CHECK_FALSE(commit_ramps(5, 7));
  CHECK_FALSE(commit_ramps(5, -7));
  CHECK(commit_ramps(0, -7));
  CHECK(device.out().torque[1] == -7);
  device.play();
}

TEST_CASE(
    "axes_engine: a tick restarts where the one before it ended with a torque that may jump") {
  Device device;
  device.load(kLaw, kCrc);
  device.set(&Axis::law, true);
  device.arm();
  Random random(1);
  bool at_end = false, expected = false;
  int ticks = 0, restarts = 0, changes = 0;
  for (int k = 0; k < 20'000; ++k) {
    if (random.one_in(150)) device.axis(1).zeroed = true;
    device.clock();
    if (device.in.measured) {
      ++ticks;
      changes += expected != at_end;
      expected = at_end;
      restarts += expected;
    }
    if (ticks > 1) REQUIRE(device.twin().restarted() == expected);
    // What is shown now is of the clock to come, the last one of the tick.
    if (device.clock_of_tick() == Device::kTick - 2) at_end = device.out().restart;
  }
  CHECK(restarts > 100);
  CHECK(changes > 20);
  device.axis(1).zeroed = true;
  device.ticks(2);
  REQUIRE(device.twin().restarted());
  device.play();
  device.set(&Axis::law, false);
  device.set(&Axis::armed, false);
  device.twin().reset();
  CHECK_FALSE(device.twin().restarted());
  while (!device.in.measured) device.clock();
  CHECK_FALSE(device.twin().restarted());
}

TEST_CASE("axes_engine: it takes no word between a commit and the end of the runs before it") {
  Device device;
  device.load(kLaw, kCrc);
  CHECK_FALSE(device.twin().busy());
  device.in.port.reg_addr = axes_engine + H::commit;
  device.in.port.reg_wdata = 1;
  device.in.port.reg_write = true;
  device.clock();
  int busy = 0, port_busy = 0;
  while (device.twin().busy() && busy < 10'000) {
    port_busy += device.out().port.reg_busy;
    device.clock();
    ++busy;
  }
  CHECK(port_busy > 1000);  // 32 words, eight beats each, one in six clocks
  CHECK(busy > port_busy);
  CHECK(busy < 2000 + 2 * Device::kTick);
  // Without a commit: the words of lines are cleared.
  device.in.port.reg_addr = axes_engine + H::run;
  device.in.port.reg_write = true;
  device.clock();
  device.clock();
  CHECK(device.twin().busy());
  REQUIRE(device.out().port.reg_busy);
  device.play();
  device.twin().reset();
  CHECK_FALSE(device.out().port.reg_busy);
  CHECK_FALSE(device.twin().busy());
}

TEST_CASE("axes_engine: whether a word is known is said of the engine's only") {
  Twin twin;
  Twin::In in;
  CHECK(twin.out().port.rdata_known);
  for (int k = 0; k < 100; ++k) {
    const bool engine = k % 2 != 0;
    in.port.reg_addr = engine ? axes_engine : 0x300;
    twin.clock(in);
    CHECK(twin.out().port.rdata_known == (!engine || k > 40));
  }
}

TEST_CASE("axes_engine: a program that gives nothing is late, until it is entered anew") {
  Device device;
  device.load(kLaw, kCrc, 5);
  device.arm();
  device.ticks(20);
  CHECK_FALSE(device.out().late);
  device.set(&Axis::armed, false);
  device.set(&Axis::arm_request, false);
  device.ticks(2);
  device.write(H::divider0, 400);
  device.arm();
  device.ticks(10);
  CHECK(device.out().late);
  device.axis(1).law = true;
  device.clocks(3);
  CHECK_FALSE(device.out().late);
  device.ticks(10);
  CHECK(device.out().late);
  device.play();
}

TEST_CASE("axes_engine: a program is locked from the request to arm on") {
  Device device;
  device.load(kLaw, kCrc ^ 1U);
  const auto low = static_cast<std::uint32_t>(kLaw.program_at(3));
  const auto writes = [&device](std::uint32_t word) {
    device.write(H::program + 3, word);
    device.ticks(1);
    return device.read(H::program + 3) == word;
  };
  device.write(H::high, static_cast<std::uint32_t>(kLaw.program_at(3) >> 32));
  CHECK(writes(low ^ 1));
  CHECK(writes(low));
  device.set(&Axis::arm_request, true);
  device.until_checked(3000);
  CHECK_FALSE(writes(low ^ 1));
  device.axis(0).arm_request = false;
  CHECK(writes(low ^ 1));
  device.axis(1).armed = true;  // alone
  CHECK_FALSE(writes(low));
  device.axis(1).armed = false;
  device.axis(0).arm_request = true;
  device.ticks(2);
  device.axis(0).arm_request = false;  // the check is under way
  device.in.port.reg_addr = static_cast<std::uint16_t>(axes_engine + H::line_base);
  device.in.port.reg_wdata = 7;
  device.in.port.reg_write = true;
  device.clocks(3);
  device.axis(1).armed = true;
  CHECK_FALSE(writes(low));
  device.play();
}

TEST_CASE("axes_engine: the port has the engine's words at their place, and events that wait") {
  Device device;
  device.load(kLaw, kCrc);
  CHECK(device.read(H::program + 1) == static_cast<std::uint32_t>(kLaw.program_at(1)));
  device.axis(1).velocity = -123456;
  device.axis(1).tau_hat = 77;
  device.axis(0).velocity = 999;
  device.axis(1).position = -50;
  device.ticks(30);
  CHECK(device.out().torque[1] == -50);
  CHECK(device.read(H::event_count) == 16);
  for (int n = 0; n < 15; ++n) {
    CHECK(device.read(H::event_number) == 5);
    (void)device.read(H::event_tick);
  }
  CHECK(static_cast<std::int32_t>(device.read(H::event_value)) == -123456 - 77);
  // Another's address reads 0, is not busy, and takes no event away.
  device.write(H::run, 0);
  const std::uint32_t count = device.read(H::event_count);
  for (unsigned page = 0; page < 0x10000; page += 0x1000) {
    if (page == static_cast<unsigned>(axes_engine)) continue;
    device.in.port.reg_addr =
        static_cast<std::uint16_t>(page | static_cast<unsigned>(H::event_tick));
    device.clocks(40);
    CHECK(device.out().port.reg_rdata == 0);
    device.in.port.reg_read = true;
    device.in.port.reg_write = true;
    device.clock();
    CHECK_FALSE(device.out().port.reg_busy);
    device.in.port.reg_addr = static_cast<std::uint16_t>(page | static_cast<unsigned>(H::run));
    device.in.port.reg_wdata = 1;
    device.in.port.reg_write = true;
    device.ticks(4);
    CHECK(device.out().torque[1] == 0);
  }
  CHECK(device.read(H::event_count) == count);
  device.play();
}

TEST_CASE("axes_engine: axes and hosts at random, RTL against twin") {
  Device device;
  device.load(kLaw, kCrc);
  Random random(7);
  int restarts = 0, lates = 0, unfits = 0, checks = 0;
  for (int tick = 0; tick < 7'000; ++tick) {
    for (Axis& a : device.in.axis) {
      if (random.one_in(150)) a.law = !a.law;
      if (random.one_in(a.arm_request ? 4000 : 100)) a.arm_request = !a.arm_request;
      if (!a.arm_request || device.out().unchecked) a.armed = false;
      if (a.arm_request && !device.out().unchecked && random.one_in(30)) a.armed = true;
      a.zeroed = random.one_in(300);
      a.position = static_cast<std::int32_t>(random.between(-3000, 3000));
      a.velocity = static_cast<std::int32_t>(random.between(-100'000, 100'000));
      a.tau_hat = static_cast<std::int32_t>(random.between(-9000, 9000));
    }
    if (random.one_in(200)) {
      device.in.port.reg_addr = static_cast<std::uint16_t>(
          axes_engine + (random.one_in(2) ? H::commit : kParameter + (random.one_in(2) ? 30 : 0)));
      device.in.port.reg_wdata = static_cast<std::uint32_t>(random.between(-1001, 1001));
      device.in.port.reg_write = true;
    } else if (random.one_in(3000)) {
      device.in.port.reg_addr = static_cast<std::uint16_t>(axes_engine + H::divider0);
      device.in.port.reg_wdata = random.one_in(2) ? 1 : 60;
      device.in.port.reg_write = true;
    } else if (!(device.axis(0).arm_request && device.axis(1).arm_request) && random.one_in(20)) {
      device.in.port.reg_addr = static_cast<std::uint16_t>(axes_engine + H::crc);  // not locked
      device.in.port.reg_wdata = kCrc ^ std::uint32_t{random.one_in(2)};
      device.in.port.reg_write = true;
    } else if (random.one_in(20)) {
      device.in.port.reg_addr = static_cast<std::uint16_t>(axes_engine + H::event_tick);
      device.in.port.reg_read = true;
    }
    const int part = static_cast<int>(random.below(Device::kTick));
    device.clocks(part);
    for (Axis& a : device.in.axis) a.zeroed = random.one_in(300);
    device.clocks(Device::kTick - part);
    restarts += device.out().restart;
    lates += device.out().late;
    unfits += device.out().unfit;
    checks += !device.out().unchecked;
  }
  INFO("restart " << restarts << ", late " << lates << ", unfit " << unfits << ", checked "
                  << checks);
  CHECK(restarts > 58);
  CHECK(lates > 58);
  CHECK(unfits > 58);
  CHECK(checks > 291);
  device.play();
}

// axes_engine: each bit to and from the engine is connected to its own place.

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
