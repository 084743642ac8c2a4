// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// A host acts at any clock while the engine's twin runs run by run: writes, commits, resets and
// reads. Documentation: docs/blocks/engine.md
#include "../machine/machine_programs.hpp"
#include "catch.hpp"
#include "feltgate/engine_watch.hpp"
#include "pair.hpp"

using namespace feltgate;
using namespace feltgate::test;

namespace {

/// The torque is a word of the program, of the data and of the table.
EngineMemory sums() {
  EngineMemory m;
  program(m, 0,
          {to(1, EngineOp::tab, kConstant, 20), to(1, EngineOp::add, 1, kConstant + 1),
           to(1, EngineOp::add, 1, kParameter), out(0, EngineOp::add, 1, kPosition)});
  m.set_data(EngineMap::D::upper, 1 << 20);
  return m;
}

void meddle(Pair<1>& p, Random& random) {
  p.hasty = random.coin();
  const auto some = static_cast<int>(random.below(512));
  switch (random.below(12)) {
    case 0:
      p.write(EngineMap::D::parameter, random.below(2000));
      p.write(H::commit, 1);
      break;
    case 1:
      p.write(kConstant + 1, random.below(2000));
      break;
    case 2:
      p.write(H::table + 20, random.below(2000));
      break;
    case 3:
      p.write(H::program + 100 + static_cast<int>(random.below(20)), random.below(2000));
      break;
    case 4:
      p.write(H::run, random.one_in(3) ? 0 : 1);
      break;
    case 5:
      p.write(H::divider0, random.below(4));
      break;
    case 6:
      p.read(random.coin() ? some : H::program + some);
      break;
    case 7:
      p.in.armed = !p.in.armed;
      p.in.locked = p.in.armed && random.coin();
      break;
    case 8:
      p.in.enter = true;
      p.write(EngineMap::D::exchange + 3, random.below(2000));
      p.in.enter = false;
      break;
    case 9:
      p.in.crc_start = true;
      p.read(H::status);
      p.in.crc_start = false;
      break;
    case 10:
      if (random.one_in(6)) p.reset();
      break;
    default:
      p.write(H::mailbox_first, random.below(40));
      p.write(H::mailbox_age, random.below(3));
      break;
  }
  p.hasty = false;
}

}  // namespace

TEST_CASE("engine by runs: a host meddles") {
  Random random(1);
  std::int64_t done = 0, whole = 0;
  for (std::uint64_t seed = 0; seed < 25; ++seed) {
    Pair<1> p(seed);
    EngineMemory m = sums();
    m.line_base = 490;
    p.load(m);
    p.write(H::line_base, 490);
    p.write(H::divider0, 1);
    p.write(H::run, 1);
    for (int n = 0; n < 150; ++n) {
      p.run(1 + random.below(random.coin() ? 60 : 900));
      if (random.one_in(3)) meddle(p, random);
      if (random.one_in(10)) p.look();
      if (random.one_in(3)) p.in.addr = random.below(0xa20);
    }
    done += p.done;
    whole += p.whole;
  }
  INFO("clocks " << done << ", run by run " << whole);
  CHECK(whole > done / 20);
}

TEST_CASE("engine by runs: a word of a host, whichever memory it is for, in any clock of a tick") {
  for (const unsigned run : {0U, 1U}) {
    for (int clock = 0; clock < 50; ++clock) {
      Pair<1> p(3);
      p.load(sums());
      p.write(H::line_base, 512);
      p.write(H::divider0, 1);
      p.write(H::run, run);
      p.ticks(3);
      p.hasty = true;
      INFO("clock " << clock << ", run " << run);
      std::uint32_t word = 100;
      for (const int address : {H::program + 100, H::table + 20, kConstant + 1, 256 + 7}) {
        p.until(clock);
        p.write(address, ++word);
        p.ticks(5);
        p.look();
      }
      CHECK(p.by_event.clocked().memory().program_at(100) == 101);
      CHECK(p.by_event.clocked().memory().table_at(20) == 102);
      CHECK(p.by_event.clocked().memory().data_at(kConstant + 1) == 103);
      CHECK(p.by_event.clocked().memory().data_at(256 + 7) == 104);
    }
  }
}

TEST_CASE("engine by runs: a host changes what runs in any clock of a tick") {
  for (const int length : {1, 4, 6}) {
    for (int clock = 0; clock < 50; ++clock) {
      EngineMemory m;
      for (int t = 0; t < 4; ++t) {
        for (int n = 0; n < length; ++n) {
          auto i = to(1, EngineOp::add, 1, kPosition);
          if (n + 1 == length) i = out(0, EngineOp::add, 1, EngineMap::input_tick);
          m.set_program(t * EngineMap::thread_words + n, engine_encode(i));
        }
      }
      Pair<1> p(3);
      p.load(m);
      p.write(H::line_base, 512);
      for (int t = 0; t < 4; ++t) p.write(H::divider0 + t, static_cast<std::uint32_t>(1 + t % 2));
      p.hasty = true;
      INFO("clock " << clock << ", length " << length);
      for (const unsigned run : {1U, 0U, 2U, 0U, 8U, 1U, 3U, 4U, 8U}) {
        p.until(clock);
        p.write(H::run, run);
        p.run(1 + clock % 3);
        p.ticks(5);
        p.look();
        p.ticks(2);
        p.look();
      }
    }
  }
}

TEST_CASE("engine by runs: a word of a host that runs add to, in any clock of a tick") {
  for (int clock = 0; clock < 50; ++clock) {
    EngineMemory m;
    program(m, 0, {to(5, EngineOp::add, 5, kConstant + 1), out(0, EngineOp::add, 5, kPosition)});
    m.set_data(kConstant + 1, 1);
    Pair<1> p(3);
    p.load(m);
    p.write(H::line_base, 512);
    p.write(H::divider0, 1);
    p.write(H::run, 1);
    p.ticks(3);
    p.hasty = true;
    INFO("clock " << clock);
    for (const int ticks : {1, 2, 3, 4}) {
      p.until(clock);
      p.write(5, 1000);
      p.ticks(ticks);
      p.run(30);
      p.look();
      p.ticks(2);
      CHECK(p.now().torque[0] < 1010 + 3000);
    }
  }
}

TEST_CASE("engine by runs: an instruction that a host writes, in any clock of a tick") {
  EngineMemory m;
  program(m, 0,
          {word(EngineOp::nop, 0, 0, 0), word(EngineOp::nop, 0, 0, 0),
           out(0, EngineOp::add, kConstant + 1, kConstant)});
  m.set_data(kConstant + 1, 1);
  m.set_data(kConstant + 2, 2);
  Pair<1> p(3);
  p.load(m);
  p.write(H::line_base, 512);
  p.write(H::divider0, 1);
  p.write(H::run, 1);
  for (int clock = 0; clock < 50; ++clock) {
    for (int n = 1; n < 3; ++n) {
      const auto word = engine_encode(out(0, EngineOp::add, kConstant + n, kConstant));
      p.write(H::high, static_cast<std::uint32_t>(word >> 32));
      p.ticks(3);
      p.until(clock);
      p.hasty = true;
      p.write(H::program + 2, static_cast<std::uint32_t>(word));
      p.hasty = false;
      p.ticks(5);
      INFO("clock " << clock);
      CHECK(p.now().torque[0] == n);
      p.look();
    }
  }
}

TEST_CASE("engine by runs: a mailbox that a host lets be watched, in any clock of a tick") {
  for (const int thread : {0, 1}) {
    for (const int torque : {0, 5}) {
      EngineMemory m;
      program(m, thread, {out(0, EngineOp::add, kConstant + 1, kConstant)});
      m.set_data(kConstant + 1, torque);
      Pair<1> p(3);
      p.load(m);
      p.write(H::line_base, 512);
      p.write(H::divider0 + thread, 1);
      p.write(H::run, 1U << thread);
      for (int at = 0; at < 150; ++at) {  // starts go round with three ticks
        const int clock = at % 50;
        INFO("clock " << clock << ", thread " << thread << ", torque " << torque);
        p.write(H::mailbox_first, 32);
        p.ticks(3 + at / 50);
        CHECK(p.now().torque[0] == torque);
        p.until(clock);
        p.hasty = true;
        p.write(H::mailbox_first, 0);
        p.hasty = false;
        for (int k = 0; k < 60; ++k) p.run(1);
        p.ticks(3);
        CHECK(p.now().torque[0] == 0);
        p.look();
      }
    }
  }
}

TEST_CASE("engine by runs: a check of the program, its end told") {
  for (const unsigned run : {0U, 1U}) {
    Pair<1> p(3);
    p.load(sums());
    p.write(H::line_base, 512);
    p.write(H::crc, image_crc(p.by_clock.clocked().memory()));
    p.write(H::divider0, 1);
    p.write(H::run, run);
    for (int k = 0; k < 3; ++k) {
      p.ticks(3);
      p.in.crc_start = true;
      p.read(H::status);
      p.in.crc_start = false;
      int done = 0;
      for (int n = 0; n < 100'000 && done == 0; ++n) {
        p.run(1);
        done += p.now().crc_done;
      }
      CHECK(done == 1);
      p.run(1);
      p.ticks(3);
      p.look();
    }
  }
}

TEST_CASE("engine by runs: what is read, after an address that changes in any clock") {
  for (const int changes : {1, 12, 20, 39, 40, 41, 200}) {
    Pair<1> p(3);
    p.load(sums());
    p.write(H::divider0, 1);
    p.write(H::run, 1);
    p.ticks(10);
    for (int n = 0; n < 6; ++n) {
      p.in.addr = static_cast<unsigned>(n % 2 == 0 ? kConstant + 1 : H::program + 3);
      p.run(changes);
      p.look();
    }
    for (int n = 0; n < 10; ++n) {  // a clock after runs have begun to be taken as a whole
      p.in.addr = static_cast<unsigned>(n % 2 == 0 ? H::status : H::events_lost);
      while (!p.by_event.on()) p.run(1);
      p.look();
    }
  }
}

TEST_CASE("engine by runs: after a reset it is as new") {
  Pair<1> p(3), fresh(3);
  p.load(sums());
  p.write(H::divider0, 1);
  p.write(H::run, 1);
  p.ticks(10);
  CHECK(p.by_event.on());
  CHECK(p.by_event.watch().ended.has_value());
  p.reset();
  CHECK_FALSE(p.by_event.on());
  CHECK_FALSE(p.by_event.watch().ended.has_value());
  CHECK(p.by_event.watch().begun.empty());
  p.look();
}

// EngineWatch by itself: which run is behind the torque.

using feltgate::EngineWatch;

namespace {

struct Clock {
  bool ticks = false;
  std::uint32_t tick_count = 0;
  bool runs = false, fresh = false, takes = false, late = false, stops = false;
};
void clock(EngineWatch& w, const Clock& c) {
  w.clock(c.ticks, c.tick_count, c.runs, c.fresh, c.takes, c.late, c.stops);
}

}  // namespace

TEST_CASE("engine watch: nothing has run") {
  EngineWatch w;
  CHECK_FALSE(w.begins);
  CHECK_FALSE(w.running);
  CHECK_FALSE(w.stale);
  CHECK(w.changes == 0);
  CHECK(w.changes_at_begin == 0);
  CHECK_FALSE(w.ended.has_value());
  CHECK_FALSE(w.in_force.has_value());
  clock(w, {true, 5, false, true});
  CHECK_FALSE(w.ended.has_value());
}

TEST_CASE("engine watch: a run begins, ends, and its torque is taken a tick later") {
  EngineWatch w;
  clock(w, {false, 5, true});
  CHECK(w.begins);
  CHECK(w.running);
  REQUIRE(w.begun.size() == 1);
  clock(w, {false, 6, true});
  CHECK(w.begun.size() == 1);
  clock(w, {false, 6, false});
  CHECK_FALSE(w.running);
  CHECK(w.begins);
  clock(w, {false, 6, false, true});
  CHECK(w.ended == 5U);
  CHECK(w.begun.empty());
  clock(w, {true, 6});
  CHECK_FALSE(w.in_force.has_value());
  CHECK_FALSE(w.begins);
  w.take();
  CHECK(w.in_force == 5U);
}

TEST_CASE("engine watch: two runs that overlap end in their order") {
  EngineWatch w;
  clock(w, {false, 5, true});
  clock(w, {false, 5, false});
  clock(w, {false, 6, true});
  CHECK(w.begun.size() == 2);
  clock(w, {false, 6, true, true});
  CHECK(w.ended == 5U);
  clock(w, {false, 7, false, true});
  CHECK(w.ended == 6U);
}

TEST_CASE("engine watch: parameters that come into force, and with which a run began") {
  EngineWatch w;
  clock(w, {true, 5, false, false, true});
  CHECK(w.changes == 1);
  CHECK(w.changes_at_begin == 0);
  clock(w, {false, 5, true});
  CHECK(w.changes_at_begin == 1);
  clock(w, {true, 6, true, false, true});
  CHECK(w.changes == 2);
  CHECK(w.changes_at_begin == 1);
  // In the clock of a start the new ones are counted first.
  clock(w, {false, 6, false});
  clock(w, {false, 6, true, false, true});
  CHECK(w.changes_at_begin == 3);
}

TEST_CASE("engine watch: a mailbox that is too old leaves no torque") {
  EngineWatch w;
  clock(w, {false, 5, true});
  clock(w, {false, 5, false, true});
  CHECK(w.ended == 5U);
  clock(w, {false, 5, false, false, false, true});
  CHECK_FALSE(w.ended.has_value());
  CHECK_FALSE(w.stale);
  clock(w, {false, 5, false, false, false, true});
  clock(w, {true, 6, false, false, false, true});
  CHECK(w.stale);
  CHECK_FALSE(w.in_force.has_value());
  clock(w, {false, 6});
  CHECK(w.stale);
  clock(w, {true, 7});
  CHECK_FALSE(w.stale);
  // An end in such a clock gives none either.
  clock(w, {false, 7, true});
  clock(w, {false, 7, false, true, false, true});
  CHECK_FALSE(w.ended.has_value());
}

TEST_CASE("engine watch: a run that the clearing of the lines ends is behind no torque") {
  EngineWatch w;
  clock(w, {false, 5, true, true});
  CHECK(w.ended == 5U);
  clock(w, {false, 6, false});
  clock(w, {false, 7, true});
  clock(w, {true, 8, false, false, false, false, true});
  CHECK_FALSE(w.ended.has_value());
  CHECK(w.begun.empty());
  clock(w, {false, 9, true});
  clock(w, {false, 9, false, true});
  CHECK(w.ended == 9U);
}
