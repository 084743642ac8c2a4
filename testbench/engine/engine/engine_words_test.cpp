// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// engine: no word of the host is lost without a flag, and no word arrives after the commit that it
// was written for. Documentation: docs/blocks/engine.md
#include <cstdint>

#include "catch.hpp"
#include "engine_device.hpp"
#include "engine_rate.hpp"

using namespace feltgate;
using namespace feltgate::test;
using S = EngineMap::S;

namespace {

/// Writes a word in one clock and does not wait for the result.
void post(Device* device, int addr, std::uint32_t word) {
  device->in.addr = static_cast<unsigned>(addr);
  device->in.wdata = word;
  device->in.write = true;
  device->clock();
}

/// An image with parameter 0 from -1000 to 1000 and a run that never ends.
EngineMemory endless() {
  EngineMemory m;
  program(m, 0, {word(EngineOp::brf, 1, 0, 0)});
  m.set_data(EngineMap::D::lower, -1000);
  m.set_data(EngineMap::D::upper, 1000);
  return m;
}

}  // namespace

TEST_CASE("engine: words of a set that is being committed are dropped and told") {
  for (const bool commits : {false, true}) {
    LoadedDevice device(endless());
    device.write(H::run, 1);
    device.clock(5 * kTick);
    device.write(H::data + kParameter, 5);
    CHECK_FALSE(device.status(S::status_dropped));
    device.write(H::commit, 1);
    device.clock(100 * kTick);
    // The new set is in force, but the run continues with the set before.
    REQUIRE(device.status(S::status_bank));
    REQUIRE(device.status(S::status_committing));
    CHECK_FALSE(device.status(S::status_dropped));
    // A word outside the set is not dropped; a commit without words is not dropped either.
    device.write(H::data + kConstant + 3, 1);
    device.write(H::commit, 0);
    CHECK_FALSE(device.status(S::status_dropped));
    device.write(commits ? H::commit : H::data + kParameter, commits ? 1 : 8);
    CHECK(device.status(S::status_dropped));
    device.write(H::commit, 3);  // reported again
    CHECK(device.status(S::status_dropped));
    device.write(H::run, 0);
    CHECK_FALSE(device.status(S::status_committing));
    CHECK(device.status(S::status_bank));
    CHECK(device.status(S::status_dropped));
    CHECK(device.read(H::data + kParameter) == 0);  // the word of the idle set
    device.write(H::commit, 2);
    CHECK_FALSE(device.status(S::status_dropped));
    CHECK_FALSE(device.status(S::status_committing));
    device.write(H::data + kParameter, 8);
    device.write(H::commit, 1);
    device.clock(100 * kTick);
    CHECK_FALSE(device.status(S::status_bank));
    CHECK_FALSE(device.status(S::status_dropped));
    CHECK(device.read(H::data + kParameter) == 8);
    device.play();
  }
}

TEST_CASE("engine: a word that the lock refuses is told") {
  LoadedDevice device(endless());
  device.in.locked = true;
  device.write(H::data + kParameter, 5);
  CHECK_FALSE(device.status(S::status_dropped));
  for (const int address : {H::program + 3, H::table + 3, H::data + kConstant}) {
    const std::uint32_t before = device.read(address);
    device.write(address, before + 1);
    CHECK(device.status(S::status_dropped));
    CHECK(device.read(address) == before);
    device.write(H::commit, 2);
    CHECK_FALSE(device.status(S::status_dropped));
  }
  device.play();
}

TEST_CASE("engine: a parameter written in the clock before the commit is of that set") {
  for (const std::int32_t value : {-1001, 1001, 400}) {
    for (int phase = 0; phase < 6; ++phase) {
      LoadedDevice device(endless());
      device.clock(phase);
      device.write(H::data + kParameter, static_cast<std::uint32_t>(value));
      device.write(H::commit, 1);
      while (device.status(S::status_committing)) device.clock();
      INFO("value " << value << ", phase " << phase);
      CHECK(device.status(S::status_refused) == (value != 400));
      CHECK(device.status(S::status_bank) == (value == 400));
      device.play();
    }
  }
}

TEST_CASE("engine: a word that waits when a CRC is asked for is in it") {
  EngineMemory m;
  // Three endless threads leave few turns, and the inputs of the fourth thread use them.
  for (int t = 0; t < 3; ++t) {
    const int first = EngineMap::thread_words * t;
    program(m, t, {word(EngineOp::brf, 0, 0, first), word(EngineOp::brf, 1, 0, first)});
  }
  program(m, 3, {out(0, EngineOp::add, 63, 63)});
  m.line_base = EngineMap::table_words;
  EngineMemory changed = m;
  changed.set_program(0, m.program_at(0) ^ 4);
  int waited = 0;
  for (int phase = 0; phase < kTick; ++phase) {
    LoadedDevice device(m);
    device.write(H::high, static_cast<std::uint32_t>(changed.program_at(0) >> 32));
    device.write(H::crc, image_crc(changed));
    device.write(H::run, 15);
    device.clock(5 * kTick + phase);
    device.in.crc_start = true;
    const std::int64_t begun = device.clocks;
    post(&device, H::program, static_cast<std::uint32_t>(changed.program_at(0)));
    while (device.twin.memory().program_at(0) != changed.program_at(0)) device.clock();
    waited = std::max(waited, static_cast<int>(device.clocks - begun));
    while (!device.out().crc_done) device.clock();
    INFO("phase " << phase);
    CHECK(device.out().crc_good);
    if (phase % 10 == 5) device.play();
  }
  CHECK(waited > 20);
}

// engine: the state that a reset restores, also in a configured twin, and the state that is known
// after it.

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

// engine: clocks from start to start of a run.

namespace {

template <int Axes>
EngineMemory adds(int instructions) {
  EngineMemory m;
  for (int n = 0; n < instructions; ++n) {
    EngineInstruction i;
    i.op = EngineOp::add;
    i.last = n == instructions - 1;
    i.d = n % Axes;
    i.dst = n < instructions - Axes ? 0 : static_cast<int>(EngineTarget::output);
    m.set_program(n, engine_encode(i));
  }
  return m;
}

template <int Axes>
void exact() {
  constexpr int ticks = 300;
  for (const int n : {4, 5, 6, 7, 8, 9, 20}) {
    const int period = engine_period(n, Axes);
    INFO(Axes << " axes, " << n << " instructions, " << period << " clocks");
    for (int phase = 0; phase < EngineMap::round_clocks; ++phase) {
      const EngineMemory m = adds<Axes>(n);
      for (const int clocks : {period, period + 1, period + 4}) {
        const Seen enough = run<Axes>(m, 1, clocks, phase, ticks);
        REQUIRE_FALSE(enough.overrun);
        REQUIRE(enough.fresh >= ticks - 2);
      }
      const Seen less = run<Axes>(m, 1, period - 1, phase, ticks);
      REQUIRE(less.overrun);
      REQUIRE(less.fresh < ticks - 2);
    }
  }
}

}  // namespace

TEST_CASE("engine: clocks from start to start: as many as the twin needs, and not one less") {
  exact<1>();
  exact<2>();
  exact<3>();
}
