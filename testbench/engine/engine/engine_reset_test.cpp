// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// engine: the state that a reset restores, also in a configured twin, and the state that is known
// after it. Documentation: docs/blocks/engine.md
#include <cstdint>

#include "catch.hpp"
#include "engine_device.hpp"

using namespace feltgate;
using namespace feltgate::test;
using S = EngineMap::S;

namespace {

constexpr int kMailbox = 30;

/// torque = mailbox word; thread 0 runs at every tick from power-up on.
EngineMemory fed_law() {
  EngineMemory m;
  program(m, 0, {out(0, EngineOp::add, kParameter + kMailbox, kConstant)});
  m.set_data(EngineMap::D::lower + kMailbox, -1000);
  m.set_data(EngineMap::D::upper + kMailbox, 1000);
  m.set_data(kParameter + kMailbox, 70);
  m.set_data(kParameter + EngineMap::parameter_words + kMailbox, 70);
  return m;
}

}  // namespace

TEST_CASE("engine: a reset ends the clearing of lines, RTL against twin") {
  const auto stimulus = [](std::int64_t clock) {
    Twin::In in;
    in.write = clock % 97 == 0;
    in.addr = H::line_base;
    in.enter = clock % 97 == 50;
    return in;
  };
  bool cleared = false;
  int ended = 0;
  const auto watch = [&](const Twin::In&, const Vengine&, const Twin& twin,
                         bool in_reset) -> const char* {
    const bool clears = twin.out().busy;
    ended += cleared && in_reset;
    cleared = clears;
    return nullptr;
  };
  Bench("engine", 1).run(stimulus, 60'000, {300}, watch);
  CHECK(ended > 20);
}

TEST_CASE("engine: a configured twin runs from power-up on, and again from each reset on") {
  constexpr int age = 5, step = EngineMap::mailbox_step;
  EngineReset words;
  words.run = 1;
  words.divider0 = 1;
  words.mailbox_first = kMailbox;
  words.mailbox_age = age;
  words.crc = image_crc(fed_law());
  words.max_age = 9;
  Device device;
  device.twin.configure(fed_law(), words);
  for (int life = 0; life < 3; ++life) {
    device.in = {};
    REQUIRE(device.until_fresh(3 * kTick) > 0);
    device.in.crc_start = true;
    for (int k = 0; k < 100'000 && !device.out().crc_done; ++k) device.clock();
    REQUIRE(device.out().crc_done);
    CHECK(device.out().crc_good);
    CHECK(device.status(S::status_mailbox_late));
    CHECK(device.out().torque[0] == 0);
    while (device.in.tick_count % step != 0) device.clock();
    device.write(H::commit, 1);
    for (int ticks = 0; ticks < step * age - 20;) {
      device.clock();
      ticks += device.in.tick;
    }
    CHECK_FALSE(device.status(S::status_mailbox_late));
    CHECK(device.out().torque[0] == 70);
    device.clock(3 * step * kTick);
    CHECK(device.status(S::status_mailbox_late));
    CHECK_FALSE(device.out().late);
    device.twin.reset();
  }
}

TEST_CASE(
    "engine: the age of a result is the configuration's, or the design's where it says none") {
  for (const unsigned configured : {0U, 3U}) {
    EngineMemory silent;
    program(silent, 0, {word(EngineOp::nop, 0, 0, 0, EngineTarget::none, 0, true)});
    EngineReset words;
    words.run = 1;
    words.max_age = configured;
    Device device;
    device.twin = Twin(7);
    device.twin.configure(silent, words);
    int ticks = 0;
    while (!device.out().late && ticks < 100) {
      device.clock();
      ticks += device.in.tick;
    }
    CHECK(ticks == (configured == 0 ? 8 : 4));
  }
}

TEST_CASE("engine: words of memories are known some rounds after a reset, registers at once") {
  Device device;
  device.in.addr = H::data + 5;
  for (int k = 0; k < 40; ++k) {
    REQUIRE_FALSE(device.out().rdata_known);
    device.clock();
  }
  CHECK(device.out().rdata_known);
  device.twin.reset();
  CHECK_FALSE(device.out().rdata_known);
  device.in.addr = H::status;
  CHECK(device.out().rdata_known);
}

TEST_CASE("engine: a thread is running from its start to its end, and no other is") {
  Device device(image(wall, {100, 20000, -60000}));
  device.write(H::divider0, 4);
  device.write(H::run, 1);
  int running = 0, begins = 0;
  bool before = false;
  constexpr int clocks = 400 * kTick;
  for (int k = 0; k < clocks; ++k) {
    device.clock();
    const bool now = device.twin.running(0);
    running += now;
    begins += now && !before;
    before = now;
    for (const int other : {1, 2, 3}) REQUIRE_FALSE(device.twin.running(other));
  }
  CHECK(begins == 100);
  CHECK(running < clocks / 2);
}
