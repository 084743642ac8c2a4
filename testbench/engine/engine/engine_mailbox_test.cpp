// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// engine: no torque remains when the host stops writing; which changes are announced as jumps.
// Documentation: docs/blocks/engine.md
#include "catch.hpp"
#include "engine_device.hpp"

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
