// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// engine: starts, commits, checks and monitors act at the right time; words that a host reads.
// Documentation: docs/blocks/engine.md
#include "catch.hpp"
#include "engine_device.hpp"
#include "random_programs.hpp"

using namespace feltgate;
using namespace feltgate::test;

TEST_CASE("engine: six instructions at every tick of 50 clocks, none is late") {
  Device device(image(charge, {50, 3000, 700}));
  device.write(H::run, 1);
  device.write(H::max_age, 0);
  REQUIRE(device.until_fresh() > 0);
  device.in.enter = true;
  device.clock();
  int fresh = 0;
  for (int k = 0; k < 3000; ++k) {
    device.clock();
    fresh += device.out().fresh;
  }
  CHECK(fresh == 60);
  CHECK_FALSE(device.status(EngineMap::S::status_overrun));
}

TEST_CASE("engine: dividers") {
  Device device(image(wall, {100, 20000, -60000}));
  for (const int divider : {0, 1, 2, 3, 7}) {
    device.write(H::run, 0);
    device.clock(120);
    device.write(H::divider0, static_cast<std::uint32_t>(divider));
    device.write(H::run, 1);
    REQUIRE(device.until_fresh() > 0);
    int clocks = 0;
    for (int k = 0; k < 30; ++k) clocks += device.until_fresh();
    const double ticks = clocks / 30.0 / kTick;
    CHECK(ticks > std::max(divider, 1) - 0.02);
    CHECK(ticks < std::max(divider, 1) + 0.02);
  }
}

TEST_CASE("engine: an image loaded over the port is read back, and its CRC holds") {
  Random random(5);
  EngineMemory m = random_memory(random);
  m.line_base = 400;
  Device device;
  Host host;
  host.load(m);
  for (const Access& a : host.queue) device.write(static_cast<int>(a.addr), a.word);
  device.write(H::crc, image_crc(m));
  for (int n = 0; n < 512; n += 17) {
    REQUIRE(device.read(H::program + n) == (m.program_at(n) & 0xffffffffU));
    REQUIRE(device.read(H::program_high + n) == m.program_at(n) >> 32);
    REQUIRE(device.read(H::table + n) == (m.table_at(n) & 0xffffffffU));
    REQUIRE(device.read(H::table_high + n) == m.table_at(n) >> 32);
  }
  for (int n = 384; n < 512; ++n) {
    REQUIRE(device.read(H::data + n) == static_cast<std::uint32_t>(m.data_at(n)));
  }
  const auto crc = [&device] {
    device.in.crc_start = true;
    device.clock();
    int clocks = 0;
    while (!device.out().crc_done) device.clock(), ++clocks;
    REQUIRE(clocks < 5 * 50'000);
    return device.out().crc_good;
  };
  CHECK(crc());
  device.write(H::table + 400, 0x1234);  // a word of a line
  CHECK(crc());
  for (const int addr :
       {H::program + 511, H::program, H::data + 384, H::data + 511, H::table + 399}) {
    device.write(addr, device.read(addr) ^ 0x40);
    CHECK_FALSE(crc());
    device.write(addr, device.read(addr) ^ 0x40);
  }
  device.write(H::high, 0);  // a write of the low bits also writes the upper four
  const std::uint64_t high = m.program_at(7) >> 32;
  device.write(H::program + 7, device.read(H::program + 7));
  CHECK(crc() == (high == 0));
}

TEST_CASE("engine: locked, nothing of the image can be written, parameters can") {
  Device device(image(wall, {100, 20000, -60000}));
  for (const bool locked : {true, false}) {
    device.in.locked = locked;
    for (const int addr :
         {H::program + 3, H::table + 3, H::data + 400, H::data + 450, H::data + 3}) {
      const std::uint32_t before = device.read(addr);
      device.write(addr, before + 1);
      CHECK(device.read(addr) == before + (locked ? 0 : 1));
    }
    device.write(H::data + 48, 5);  // an input: the write has no effect
    CHECK(device.read(H::data + 48) != 5);
  }
  device.in.locked = true;
  device.write(H::data + 322, 77);
  CHECK(device.read(H::data + 354) == 77);
  CHECK(device.read(H::data + 322) == 0xffffffffU - 60000 + 1);
  device.write(H::run, 1);
  CHECK(device.until_fresh() < 0);
}

TEST_CASE("engine: a commit brings all words together, or none") {
  EngineMemory m = image(wall, {100, 20000, -60000});
  const auto range = [&m](int word, int lower, int upper) {
    m.set_data(EngineMap::D::lower + word, lower);
    m.set_data(EngineMap::D::upper + word, upper);
  };
  range(0, -1000, 1000);
  range(1, 0, INT32_MAX);
  range(2, INT32_MIN, 0);
  Device device(m);
  const auto commit = [&device](std::initializer_list<std::int32_t> words) {
    int n = 0;
    for (const std::int32_t w : words) {
      device.write(H::data + kParameter + n++, static_cast<std::uint32_t>(w));
    }
    const bool bank = device.status(EngineMap::S::status_bank);
    device.write(H::commit, 1);
    while (device.status(EngineMap::S::status_committing)) device.clock();
    const bool changed = device.status(EngineMap::S::status_bank) != bank;
    CHECK(device.status(EngineMap::S::status_refused) == !changed);
    return changed ? -1 : static_cast<int>(device.read(H::refused_word));
  };
  device.write(H::run, 1);
  CHECK(commit({-1000, INT32_MAX, INT32_MIN}) == -1);
  CHECK(commit({1000, 0, 0}) == -1);
  CHECK(commit({1001, 0, 0}) == 0);
  CHECK(commit({-1001, 0, 0}) == 0);
  CHECK(commit({INT32_MIN, 0, 0}) == 0);
  CHECK(commit({INT32_MAX, 0, 0}) == 0);
  CHECK(commit({0, -1, 0}) == 1);
  CHECK(commit({0, INT32_MIN, 1}) == 1);
  CHECK(commit({0, 0, 1}) == 2);
  CHECK(commit({0, 0, 0}) == -1);
  device.write(H::data + kParameter + 31, 1);
  CHECK(commit({0, 0, 0}) == 31);
  device.write(H::data + kParameter + 31, 0xffffffffU);
  CHECK(commit({0, 0, 0}) == 31);
  device.write(H::data + kParameter + 31, 0);
  CHECK(commit({0, 0, 0}) == -1);
}

TEST_CASE("engine: the age is of the last result; no program, and any, keeps it from counting") {
  Device device(image(wall, {100, 20000, -60000}));
  device.write(H::max_age, 10);
  device.clock(2000);
  CHECK_FALSE(device.out().late);  // no program is enabled
  device.write(H::run, 1);
  device.clock(5000);
  CHECK_FALSE(device.out().late);
  const auto late_after = [&device] {
    int ticks = 0;
    while (!device.out().late && ticks < 100) {
      device.clock();
      ticks += device.in.tick;
    }
    return ticks;
  };
  // Programs: a loop, a run without an output, an output without an end.
  for (const EngineInstruction& i :
       {word(EngineOp::brf, 1, 0, 0), word(EngineOp::add, 0, 0, 0, EngineTarget::none, 0, true),
        word(EngineOp::brf, 1, 0, 0, EngineTarget::output, 0)}) {
    program(device.twin.memory(), 0, {i});
    device.write(H::run, 1);
    const int ticks = late_after();
    CHECK(ticks >= 10);
    CHECK(ticks <= 12);
    program(device.twin.memory(), 0, {out(0, EngineOp::add, 0, 0)});
    device.clock(3000);
    CHECK(device.out().late);  // stays late until the law is entered again
    device.in.enter = true;
    device.clock(2);
    CHECK_FALSE(device.out().late);
  }
}

TEST_CASE("engine: a thread that is switched off ends amid its run") {
  EngineMemory m;
  std::vector<EngineInstruction> list(100, word(EngineOp::add, 0, 63, 63, EngineTarget::event, 3));
  for (std::size_t n = 0; n < list.size(); ++n) {
    m.set_program(static_cast<int>(n), engine_encode(list[n]));
  }
  LoadedDevice device(m);
  device.write(H::divider0, 4000);
  device.write(H::run, 1);
  int events = 0;
  const auto count = [&](int clocks) {
    for (int k = 0; k < clocks; ++k) device.clock(), events += device.out().event_valid;
  };
  count(3 * kTick);
  CHECK(events > 5);
  CHECK(events < 50);
  device.in.addr = H::run;
  device.in.wdata = 0;
  device.in.write = true;
  count(12);  // lets the pipeline run empty
  events = 0;
  count(20 * kTick);
  CHECK(events == 0);
  CHECK(device.read(H::status) >> 8 == 0);
  device.play();
}

TEST_CASE("engine: the first run after arming, entering and a write of run has a flag") {
  EngineMemory m;
  m.set_data(kConstant + 1, 1);
  program(m, 0, {out(0, EngineOp::sel, kConstant + 1, kConstant)});
  Device device(m);
  const auto first = [&device] {
    // A run may be under way.
    int flags = 0;
    for (int k = 0; k < 5; ++k) {
      REQUIRE(device.until_fresh() > 0);
      flags += device.out().torque[0];
    }
    return flags;
  };
  device.write(H::run, 1);
  CHECK(first() == 1);
  CHECK(first() == 0);
  device.in.armed = true;
  CHECK(first() == 1);
  CHECK(first() == 0);
  device.in.armed = false;
  CHECK(first() == 0);
  device.in.enter = true;
  CHECK(first() == 1);
}

TEST_CASE("engine: lines are zeros when states begin anew, and nothing else of the table") {
  EngineMemory m;
  // Writes 7 into the last word of the lines in every run and outputs the earlier content of the
  // first word.
  m.set_data(kConstant + 1, 7);
  m.set_data(kConstant + 2, 511 << 12);
  m.line_base = 400;
  m.set_data(kConstant + 3, m.line_base << 12);
  program(m, 0,
          {to(0, EngineOp::tab, kConstant + 3, 0), to(1, EngineOp::add, kConstant + 1, kConstant),
           word(EngineOp::tst, 0, kConstant + 2, 0), out(0, EngineOp::add, 0, kConstant)});
  for (int n = 0; n < 512; ++n) m.set_table(n, static_cast<std::uint64_t>(n) + (7ULL << 33));
  LoadedDevice device(m);
  const auto expect = [&](const char* what, bool zeros) {
    INFO(what);
    const EngineMemory& now = device.twin.memory();
    for (int n = 0; n < 511; ++n) {
      INFO("word " << n);
      CHECK(now.table_at(n) == (zeros && n >= m.line_base ? 0 : m.table_at(n)));
    }
    CHECK(now.table_at(511) == (zeros ? 7 : m.table_at(511)));
  };
  device.clock(20);
  expect("after load", false);
  const auto fill = [&] {
    for (int n = m.line_base; n < 512; ++n) {
      device.write(H::high, static_cast<std::uint32_t>(m.table_at(n) >> 32));
      device.write(H::table + n, static_cast<std::uint32_t>(m.table_at(n)));
    }
  };
  device.write(H::max_age, 2);
  device.write(H::run, 1);
  // One word per clock, except in the system's turn (one of six); 5 ms are 250,000 clocks.
  const std::int64_t begun = device.clocks;
  REQUIRE(device.until_fresh() > 0);
  CHECK(device.clocks - begun < 1000);
  device.clock(3 * kTick);
  expect("run", true);
  const auto entered = [&](const char* what) {
    INFO(what);
    const std::int64_t from = device.clocks;
    bool late = false, zero = false, busy = false;
    device.clock();
    while (device.out().busy) {
      busy = true;
      device.clock();
      zero = zero || device.out().torque[0] == 0;
      late = late || device.out().late || device.out().fresh;
    }
    CHECK(busy);
    CHECK(zero);
    CHECK_FALSE(late);
    CHECK(device.clocks - from < 200);
    CHECK(device.clocks - from > 112);
    REQUIRE(device.until_fresh() > 0);
    CHECK(device.out().torque[0] == 0);  // the value that the first run read
    device.clock(3 * kTick);
    expect(what, true);
  };
  fill();
  device.in.enter = true;
  entered("entry");
  fill();
  device.in.armed = true;
  entered("arming");
  // In the middle of a run, at any point of it.
  for (int k = 0; k < 2 * kTick; k += 3) {
    device.clock(k);
    device.in.enter = true;
    entered("entry again");
  }
  // A second start during the clearing begins from the start.
  fill();
  device.in.enter = true;
  device.clock(60);
  device.in.enter = true;
  entered("twice");
  // Lines of one word and of no word.
  for (const int base : {511, 512}) {
    fill();
    device.write(H::line_base, static_cast<std::uint32_t>(base));
    device.in.enter = true;
    device.clock();
    device.clock(300);
    const EngineMemory& now = device.twin.memory();
    for (int n = 0; n < 511; ++n) CHECK(now.table_at(n) == m.table_at(n));
    CHECK(now.table_at(511) == (base == 511 ? 7 : m.table_at(511)));
  }
  // The whole table: one word per clock, except one clock in six.
  device.write(H::line_base, 0);
  device.in.enter = true;
  device.clock();
  int clocks = 1;
  while (device.out().busy) device.clock(), ++clocks;
  INFO("clocks " << clocks);
  CHECK(clocks >= 614);
  CHECK(clocks <= 622);
  device.play();
}

TEST_CASE("engine: events wait, oldest first; those without a place are counted") {
  EngineMemory m;
  program(m, 0,
          {word(EngineOp::add, 0, EngineMap::input_tick, 63, EngineTarget::event, 7),
           word(EngineOp::add, 0, 63, 63, EngineTarget::event, 500, true)});
  Device device(m);
  device.write(H::run, 1);
  device.clock(11 * kTick + kTick / 2);
  const int total = 2 * static_cast<int>(device.in.tick_count);
  device.write(H::run, 0);
  CHECK(device.read(H::event_count) == 16);
  const auto lost = static_cast<int>(device.read(H::events_lost));
  CHECK(lost >= 2);
  CHECK(lost <= total - 16);
  std::uint32_t before = 0;
  for (int n = 0; n < 16; ++n) {
    CHECK(device.read(H::event_number) == (n % 2 == 0 ? 7 : 500));
    const std::uint32_t value = device.read(H::event_value);
    const std::uint32_t tick = device.read(H::event_tick);
    if (n % 2 == 0) CHECK(value == tick);
    if (n % 2 != 0) CHECK(tick == before);
    before = tick;
  }
  CHECK(device.read(H::event_count) == 0);
  CHECK(static_cast<int>(device.read(H::events_lost)) == lost);
}

TEST_CASE("engine: torques are limited to their format, and 0 when the threads are switched") {
  EngineMemory m;
  program(m, 0, {out(0, EngineOp::add, kPosition, kConstant)});
  Device device(m);
  device.write(H::run, 1);
  for (const std::int32_t p :
       {0, 5, -5, (1 << 20) - 1, 1 << 20, INT32_MAX, -(1 << 20), -(1 << 20) - 1, INT32_MIN}) {
    device.in.position[0] = p;
    device.clock(4 * kTick);
    CHECK(device.out().torque[0] == std::clamp(p, -(1 << 20), (1 << 20) - 1));
  }
  device.write(H::run, 0);
  CHECK(device.out().torque[0] == 0);
  device.clock(1000);
  CHECK(device.out().torque[0] == 0);
}
