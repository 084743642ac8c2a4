// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// engine: limits that random runs seldom reach, RTL against twin. Documentation:
// docs/blocks/engine.md
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "catch.hpp"
#include "engine_device.hpp"
#include "feltgate/engine_parts.hpp"

using namespace feltgate;
using namespace feltgate::test;

TEST_CASE("engine: a long divider counts all its ticks, and begins anew when run is written") {
  LoadedDevice device(image(wall, {100, 20000, -60000}));
  device.write(H::divider0, 300);
  device.write(H::run, 1);
  REQUIRE(device.until_fresh() > 0);
  for (int k = 0; k < 2; ++k) {
    const int clocks = device.until_fresh(301 * kTick);
    CHECK(clocks > 300 * kTick - kTick / 2);
    CHECK(clocks < 300 * kTick + kTick / 2);
  }
  device.clock(100 * kTick);  // 200 ticks are left
  device.write(H::run, 0);
  device.clock(5 * kTick);
  device.write(H::run, 1);
  CHECK(device.until_fresh(3 * kTick) > 0);
  device.play();
}

TEST_CASE(
    "engine: a run counts that begins where the one word of lines is cleared, at every clock") {
  EngineMemory m;
  m.set_data(EngineMap::D::lower, -1000);
  m.set_data(EngineMap::D::upper, 1000);
  m.line_base = EngineMap::table_words - 1;
  std::vector<EngineInstruction> list(110, word(EngineOp::nop, 0, 0, 0));
  list.front() = to(0, EngineOp::add, kParameter, kConstant);
  list.push_back(to(1, EngineOp::sub, 0, kParameter));  // 0: one set of parameters per run
  list.push_back(out(0, EngineOp::add, 1, kConstant));
  int n = 0;
  for (const EngineInstruction& i : list) m.set_program(n++, engine_encode(i));
  LoadedDevice device(m);
  device.write(H::divider0, 20);
  int value = 0;
  for (int phase = 0; phase < kTick; ++phase) {
    device.write(H::run, 0);  // so that the next tick is the first
    device.clock(2 * kTick);
    while (device.since != kTick - 20) device.clock();
    device.write(H::run, 1);
    while (device.since != 0) device.clock();
    device.clock(phase);
    device.in.enter = true;
    device.clock();
    // A write after a commit waits for the end of the run that uses its bank.
    device.write(H::data + kParameter, static_cast<std::uint32_t>(++value));
    device.write(H::commit, 1);
    device.write(H::data + kParameter, static_cast<std::uint32_t>(++value));
    device.clock(40 * kTick);
    CHECK(device.out().torque[0] == 0);
  }
  CHECK(device.results >= kTick);
  device.play();
}

// In a block RAM the fetched word may be any word, so a host should not write a program that runs.
TEST_CASE("engine: a program word written in the clock that fetches it, RTL against twin") {
  using Op = EngineOp;
  EngineMemory m;
  const auto event = [](int number) {
    return engine_encode(word(Op::add, 0, kConstant, kConstant, EngineTarget::event, number, true));
  };
  // One instruction a tick: a thread's word is written in its own turns, while it does not run.
  m.set_program(0, event(0));
  LoadedDevice device(m);
  device.write(H::run, 1);
  REQUIRE(event(0) >> 32 == event(511) >> 32);
  device.write(H::high, static_cast<std::uint32_t>(event(0) >> 32));
  std::array<int, 512> told{};
  for (int k = 0; k < 500; ++k) {
    device.write(H::program, static_cast<std::uint32_t>(event(k + 1)));
    for (int wait = 0; wait < 44 + k % 13; ++wait) {
      device.clock();
      const auto out = device.out();
      if (out.event_valid) ++told[static_cast<std::size_t>(out.event_number)];
    }
  }
  CHECK(std::count_if(told.begin(), told.end(), [](int n) { return n > 0; }) > 300);
  device.play();
}

TEST_CASE("engine: lines that are taken away in the clock of an entry are not cleared") {
  LoadedDevice device(image(wall, {100, 20000, -60000}));
  device.write(H::line_base, 500);
  device.write(H::table + 505, 77);
  device.write(H::run, 1);
  device.in.enter = true;
  device.write(H::line_base, EngineMap::table_words);
  CHECK(device.read(H::table + 505) == 0);  // the write of run cleared it
  device.write(H::run, 0);
  device.write(H::table + 505, 78);
  device.write(H::line_base, 500);
  device.in.enter = true;
  device.write(H::line_base, EngineMap::table_words);
  CHECK(device.read(H::table + 505) == 78);
  device.play();
}

TEST_CASE("engine: only the commit's own address commits") {
  LoadedDevice device(image(wall, {100, 20000, -60000}));
  device.write(H::data + kParameter, 7);
  const bool bank = device.status(EngineMap::S::status_bank);
  for (int bit = 0; bit < 9; ++bit) {
    device.write(H::commit ^ (1 << bit), 1);
    device.clock(5 * kTick);
  }
  CHECK(device.status(EngineMap::S::status_bank) == bank);
  device.play();
}

TEST_CASE("engine: events go around all their places") {
  EngineMemory m;
  program(m, 0, {word(EngineOp::add, 0, EngineMap::input_tick, 63, EngineTarget::event, 7, true)});
  LoadedDevice device(m);
  device.write(H::divider0, 20);
  device.write(H::run, 1);
  std::uint32_t before = 0;
  for (int round = 0; round < 4; ++round) {
    device.clock(10 * 20 * kTick);
    for (int n = 0; n < 10; ++n) {
      const std::uint32_t value = device.read(H::event_value);
      CHECK(value > before);
      CHECK(device.read(H::event_tick) == value);
      before = value;
    }
  }
  CHECK(device.read(H::events_lost) == 0);
  device.play();
}

TEST_CASE("engine: the status tells a CRC that holds") {
  EngineMemory m = image(wall, {100, 20000, -60000});
  LoadedDevice device(m);
  const auto check = [&device] {
    device.in.crc_start = true;
    device.clock();
    while (!device.out().crc_done) device.clock();
    return device.status(EngineMap::S::status_crc_good);
  };
  device.write(H::crc, image_crc(device.twin.memory()));
  CHECK(check());
  device.write(H::crc, 1);
  CHECK_FALSE(check());
  device.play();
}

TEST_CASE("engine: products beyond every window saturate") {
  EngineMemory m;
  const std::array<std::int32_t, 4> data{INT32_MIN, INT32_MAX, 1 << 30, -(1 << 30)};
  const std::array<std::int32_t, 5> factors{-(1 << 17), (1 << 17) - 1, 1 << 16, 1 << 15, 3 << 14};
  int at = EngineMap::D::lower;
  for (const std::int32_t x : data) m.set_data(at++, x);
  for (const std::int32_t x : factors) m.set_data(at++, x);
  int n = 0;
  for (int mode = 0; mode < 4; ++mode) {
    for (int a = 0; a < 4; ++a) {
      for (int b = 0; b < 5; ++b, ++n) {
        m.set_program(
            n, engine_encode(word(EngineOp::mul, mode, EngineMap::D::lower + a,
                                  EngineMap::D::lower + 4 + b, EngineTarget::event, n, n == 79)));
      }
    }
  }
  LoadedDevice device(m);
  device.write(H::run, 1);
  int events = 0, limited = 0;
  for (int k = 0; k < 50 * kTick; ++k) {
    device.clock();
    const Twin::Out out = device.out();
    if (!out.event_valid) continue;
    ++events;
    limited += out.event_value == INT32_MIN || out.event_value == INT32_MAX ? 1 : 0;
  }
  CHECK(events > 160);
  CHECK(limited > events / 4);
  CHECK(limited < events * 3 / 4);
  device.play();
}

TEST_CASE("engine: ages have 16 bits, and a program is late after as many ticks") {
  LoadedDevice device(image(wall, {100, 20000, -60000}));
  // Sets and clears each bit of both ages twice; the last write counts.
  for (const std::uint32_t age : {0xffffu, 0u, 0xffffu, 0x5555u, 0xaaaau, 0u, 1100u}) {
    device.write(H::mailbox_age, age);
    device.write(H::max_age, age);
  }
  device.write(H::divider0, 4000);
  device.write(H::run, 1);
  REQUIRE(device.until_fresh() > 0);
  device.clock(1000 * kTick);
  CHECK_FALSE(device.out().late);
  device.clock(200 * kTick);
  CHECK(device.out().late);
  device.play();
}

// engine: its parts alone, from their first clock and with inputs that no engine gives.

namespace {

using Inputs = EngineInputs<1>;
using Outputs = EngineOutputs<2>;

Outputs::In watched(unsigned max_age) {
  Outputs::In in;
  in.watched = true;
  in.max_age = max_age;
  return in;
}

/// Returns the number of ticks up to the tick that makes the outputs late.
int ticks_to_late(Outputs& outputs, unsigned max_age) {
  Outputs::In in = watched(max_age);
  for (int ticks = 1; ticks < 100; ++ticks) {
    in.tick = true;
    outputs.clock(in);
    if (outputs.late) return ticks;
    in.tick = false;
    for (int k = 0; k < 3; ++k) outputs.clock(in);
    if (outputs.late) return 0;
  }
  return -1;
}

/// Returns the clocks of a check whose beats are `every` clocks apart.
int clocks_of_check(EngineCrc& crc, int line_base, int every) {
  EngineCrc::In in;
  in.line_base = line_base;
  for (int k = 0; k < 1'000'000; ++k) {
    in.start = k == 0;
    in.beat = k % every == every - 1;
    crc.clock(in);
    if (crc.done) return k;
  }
  return -1;
}

}  // namespace

TEST_CASE("engine: as made no thread is due, and its dividers are those of the configuration") {
  Inputs inputs;
  const std::array<unsigned, 4> dividers{3, 1, 0, 2};
  inputs.configure(dividers);
  Inputs::In in;
  in.run = 15;
  for (int k = 0; k < 20; ++k) {
    inputs.clock(in);
    REQUIRE_FALSE(inputs.wanted());
    REQUIRE(inputs.request == 0);
    REQUIRE(inputs.running == 0);
  }
  std::array<int, 4> starts{};
  for (int tick = 0; tick < 24; ++tick) {
    for (int k = 0; k < 60; ++k) {
      in.tick = k == 0;
      in.taken = inputs.wanted();
      in.started = in.ended = false;
      for (int thread = 0; thread < 4; ++thread) {
        if ((inputs.request >> thread & 1U) == 0) continue;
        in.started = in.ended = true;
        in.thread = thread;
        starts[static_cast<std::size_t>(thread)] += 1;
        REQUIRE(tick % static_cast<int>(std::max(dividers[static_cast<std::size_t>(thread)], 1U)) ==
                0);
        break;
      }
      inputs.clock(in);
    }
  }
  CHECK(starts == std::array<int, 4>{8, 24, 24, 12});
}

TEST_CASE("engine: a thread that waits and is stopped is not due again") {
  Inputs inputs;
  inputs.configure({1, 1, 1, 1});
  Inputs::In in;
  in.run = 1;
  int again = 0;
  for (int k = 0; k < 30; ++k) {
    in.tick = k % 10 == 0;
    inputs.clock(in);
    again += inputs.due_again(1);
    REQUIRE_FALSE(inputs.due_again(0));
  }
  CHECK(again == 2);
}

TEST_CASE("engine: the age of outputs begins at 0, as made and while nobody watches") {
  for (const unsigned max_age : {0U, 1U, 5U}) {
    Outputs made, unwatched;
    CHECK(ticks_to_late(made, max_age) == static_cast<int>(max_age) + 1);
    Outputs::In in;
    in.tick = true;
    in.max_age = max_age;
    for (int k = 0; k < 4; ++k) unwatched.clock(in);
    CHECK(ticks_to_late(unwatched, max_age) == static_cast<int>(max_age) + 1);
  }
}

TEST_CASE("engine: as made the first outputs of all axes are fresh") {
  Outputs outputs;
  Outputs::In in = watched(9);
  in.output = true;
  for (in.number = 0; in.number < 2; ++in.number) {
    in.result = 100 + in.number;
    in.last = in.number == 1;
    outputs.clock(in);
    REQUIRE_FALSE(outputs.fresh);
  }
  outputs.clock(watched(9));
  CHECK(outputs.fresh);
  CHECK(outputs.torque == std::array<std::int32_t, 2>{100, 101});
}

TEST_CASE(
    "engine: each word of a check is taken with its third beat, and checks take the same time") {
  constexpr int words = EngineMap::program_words + EngineMap::data_words - EngineMap::D::lower;
  for (const int line_base : {0, 37, 512}) {
    EngineCrc crc;
    // After the last word the check still processes its bits, and compares in the next clock.
    const int clocks = 60 * 3 * (words + line_base) + (line_base == 0 ? 33 : 41);
    CHECK(clocks_of_check(crc, line_base, 60) == clocks);
    CHECK(clocks_of_check(crc, line_base, 60) == clocks);
    const int fast = clocks_of_check(crc, line_base, 1);
    CHECK(clocks_of_check(crc, line_base, 1) == fast);
    CHECK(clocks_of_check(crc, line_base, 1) == fast);
    // The engine's beats are a round apart: 0.96 ms at 50 MHz, as docs/link.md says.
    CHECK(clocks_of_check(crc, line_base, 6) < 48'000);
  }
}

TEST_CASE("engine: events are told without places for them, up to a number") {
  EngineEvents events;
  for (int k = 0; k < 20; ++k) events.clock(true, {k, -k, 0}, false);
  CHECK(events.count == 16);
  CHECK(events.lost == 4);
  REQUIRE(events.told.size() == 20);
  CHECK(events.told.back().number == 19);
  for (int k = 0; k < 70'000; ++k) events.clock(true, {k, 0, 0}, true);
  CHECK(events.told.size() == EngineEvents::most_told);
  for (int k = 0; k < 300; ++k) events.clock(true, {k, 0, 0}, false);
  CHECK(events.lost == 255);
}
