// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// engine: no torque remains when the host stops writing; which changes are announced as jumps.
// Documentation: docs/blocks/engine.md
#include <cstdint>

#include "catch.hpp"
#include "engine_device.hpp"
#include "machine_programs.hpp"

using namespace feltgate;
using namespace feltgate::test;
using S = EngineMap::S;

namespace {

constexpr int kMailbox = 30;  // first parameter word of the mailbox

/// torque = parameter 0 + mailbox word 30, each from -1000 to 1000.
EngineMemory fed_law() {
  EngineMemory m;
  program(m, 0, {out(0, EngineOp::add, kParameter, kParameter + kMailbox)});
  for (const int n : {0, 1, 29, 30, 31}) {
    m.set_data(EngineMap::D::lower + n, -1000);
    m.set_data(EngineMap::D::upper + n, 1000);
  }
  return m;
}

struct Fed : LoadedDevice {
  explicit Fed(unsigned age) : LoadedDevice(fed_law()) {
    write(H::max_age, 1000);
    write(H::mailbox_first, kMailbox);
    write(H::mailbox_age, age);
    write(H::run, 1);
  }
  void set(int n, std::int32_t value) {
    write(H::data + kParameter + n, static_cast<std::uint32_t>(value));
  }
  /// Commits. Returns how often a jump of the torque was announced until the earlier runs have
  /// ended.
  int commit() {
    const int before = jumps;
    write(H::commit, 1);
    while (status(S::status_committing)) clock();
    return jumps - before;
  }
  /// Returns the ticks until the mailbox is late, or -1 if it is not late within `limit`.
  int until_late(int limit) {
    in.addr = H::status;
    for (int ticks = 0; ticks <= limit;) {
      clock();
      ticks += in.tick;
      if ((out().rdata >> S::status_mailbox_late & 1U) != 0) return ticks;
    }
    return -1;
  }
};

}  // namespace

TEST_CASE("engine: a commit of mailbox words jumps nothing, one of a parameter does") {
  Fed device(1000);
  // The mailbox was never fed before: the first commit lets the torque rise.
  CHECK(device.commit() == 1);
  CHECK(device.commit() == 0);  // both banks are equal
  for (const int n : {30, 31}) {
    for (const std::int32_t value : {1, -1, 1000, -1000, 0}) {
      device.set(n, value);
      CHECK(device.commit() == 0);
    }
    device.set(n, 0);
    CHECK(device.commit() == 0);
  }
  for (const int n : {0, 1, 29}) {
    for (const std::int32_t value : {1, 2, 1, -1, 1000, -1000}) {
      device.set(n, value);
      CHECK(device.commit() == 1);
      // A word that the host does not write again has its value of the commit before the last: the
      // torque jumps back.
      if (value == 1000) CHECK(device.commit() == 1);
      if (value == 1000) CHECK(device.commit() == 1);
      device.set(n, value);
      CHECK(device.commit() == 0);
    }
  }
  device.write(H::mailbox_first, 31);
  device.set(30, 7);
  CHECK(device.commit() == 1);
  // Without a mailbox all words are parameters.
  device.write(H::mailbox_first, 32);
  device.set(31, 5);
  CHECK(device.commit() == 1);
  device.write(H::mailbox_first, 0);
  device.set(0, 5);
  CHECK(device.commit() == 0);
  device.play();
}

TEST_CASE("engine: without a commit in its time the torques are 0, until the next") {
  for (const int age : {1, 2, 5}) {
    Fed device(static_cast<unsigned>(age));
    device.set(0, 300);
    device.set(kMailbox, 20);
    device.clock(20 * kTick);
    CHECK(device.out().torque[0] == 0);  // the mailbox was not fed
    for (int k = 0; k < 3; ++k) {
      device.set(0, 300);
      device.set(kMailbox, 20 + k);
      REQUIRE(device.commit() == 1);
      REQUIRE(device.until_fresh() > 0);
      REQUIRE(device.until_fresh() > 0);
      CHECK(device.out().torque[0] == 320 + k);
      // A refused commit does not feed the mailbox.
      device.clock(10 * kTick);
      device.set(1, 1001);
      CHECK(device.commit() == 0);
      CHECK(device.status(S::status_refused));
      device.set(1, 0);
      const int before = device.jumps;
      const int ticks = device.until_late(64 * 10);
      INFO("age " << age << ", ticks " << ticks);
      CHECK(ticks + 100 > 64 * age);
      CHECK(ticks <= 64 * (age + 1));
      device.clock(1);
      CHECK(device.jumps == before + 1);
      CHECK(device.out().torque[0] == 0);
      device.clock(20 * kTick);
      CHECK(device.out().torque[0] == 0);
      CHECK_FALSE(device.out().late);  // the program still runs
    }
    device.play();
  }
}

TEST_CASE(
    "engine: an age lowered below the one that has passed is over with the next tick or step") {
  for (const std::uint32_t lowered : {0U, 1U, 8U, 9U}) {
    Fed device(1000);
    device.set(0, 300);
    REQUIRE(device.commit() == 1);
    REQUIRE(device.until_fresh() > 0);
    device.clock(10 * 64 * kTick);
    CHECK(device.out().torque[0] == 300);
    device.write(H::mailbox_age, lowered);
    const int ticks = device.until_late(200);
    INFO("lowered to " << lowered << ", ticks " << ticks);
    CHECK(ticks >= 0);
    CHECK(ticks <= 64);
    device.clock(2);
    CHECK(device.out().torque[0] == 0);
    device.play();
  }
  // Age of the outputs: the run never ends.
  EngineMemory m;
  program(m, 0, {word(EngineOp::brf, 1, 0, 0)});
  for (const std::uint32_t lowered : {0U, 1U, 98U, 99U}) {
    LoadedDevice device(m);
    device.write(H::max_age, 1000);
    device.write(H::run, 1);
    device.clock(100 * kTick);
    CHECK_FALSE(device.out().late);
    device.write(H::max_age, lowered);
    device.clock(kTick);
    INFO("lowered to " << lowered);
    CHECK(device.out().late);
    device.play();
  }
}

TEST_CASE("engine: a mailbox that is fed in time is never late, one that there is not neither") {
  Fed device(2);
  for (int k = 0; k < 30; ++k) {
    device.set(kMailbox, k);
    device.commit();
    device.clock(100 * kTick);
    CHECK_FALSE(device.status(S::status_mailbox_late));
    CHECK(device.out().torque[0] == k);
  }
  device.write(H::mailbox_first, 32);
  const int before = device.jumps;
  CHECK(device.until_late(1000) == -1);
  CHECK(device.jumps == before);
}

TEST_CASE("engine: a bank comes into force with a tick, whenever its check ends") {
  for (int phase = 0; phase < kTick; ++phase) {
    Fed device(1000);
    device.set(0, 1 + phase);
    device.clock(phase);
    bool bank = device.status(S::status_bank);
    device.in.addr = H::commit;
    device.in.wdata = 1;
    device.in.write = true;
    device.clock();
    device.in.addr = H::status;
    int changes = 0;
    for (int k = 0; k < 60 * kTick; ++k) {
      device.clock();
      const bool now = (device.out().rdata >> S::status_bank & 1U) != 0;
      if (now != bank) CHECK(device.in.tick);
      changes += now != bank;
      bank = now;
    }
    CHECK(changes == 1);
    if (phase % 10 == 0) device.play();
  }
}

// The largest values of both age counters, RTL against twin: a tick every 4 clocks, each ends a
// step.
TEST_CASE("engine: ages of 65535, RTL against twin") {
  struct Ends {
    Host host;
    Twin::In in;
    Ends() {
      host.write(H::max_age, 65535);
      host.write(H::mailbox_age, 65535);
      host.write(H::mailbox_first, 31);
      host.write(H::run, 2);  // this thread's program has no output and no end
      host.write(H::commit, 1);
    }
    Twin::In operator()(std::int64_t clock, const Twin::Out& out) {
      if (clock < 8) return in;
      in.tick = clock % 4 == 0;
      if (in.tick) in.tick_count += 64;
      if (host.queue.empty()) in.addr = H::status;
      host.drive(in, out);
      return in;
    }
  };
  std::int64_t ticks = 0, late_at = 0, mailbox_late_at = 0;
  Bench bench("engine", 1);
  bench.run(Ends{}, 4 * 70'000, {},
            [&](const Twin::In& in, const Vengine&, const Twin& twin, bool) -> const char* {
              const Twin::Out out = twin.out();
              ticks += in.tick;
              if (out.late && late_at == 0) late_at = ticks;
              const bool late = (out.rdata >> S::status_mailbox_late & 1U) != 0;
              if (in.addr == H::status && !late) mailbox_late_at = ticks + 1;
              return nullptr;
            });
  INFO("late " << late_at << ", mailbox " << mailbox_late_at);
  CHECK(late_at >= 65536);
  CHECK(late_at < 65536 + 100);
  CHECK(mailbox_late_at >= 65536);
  CHECK(mailbox_late_at < 65536 + 600);
}

// engine: no word of the host is lost without a flag, and no word arrives after the commit that it
// was written for.

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

/// torque = mailbox word; thread 0 runs at every tick from power-up on.
EngineMemory kept_law() {
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
  words.crc = image_crc(kept_law());
  words.max_age = 9;
  Device device;
  device.twin.configure(kept_law(), words);
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
