// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The engine's twin run by run against its clocks: programs of every length and rhythm.
// Documentation: docs/blocks/engine.md
#include "../machine/machine_programs.hpp"
#include "pair.hpp"

using namespace feltgate;
using namespace feltgate::test;

namespace {

/// `length` instructions of thread 0 that count the tick's number, the last with the torque.
EngineMemory counting(int length, int thread = 0, bool tells = false) {
  EngineMemory m;
  const int first = thread * EngineMap::thread_words;
  const auto tick = EngineMap::input_tick;
  for (int n = 0; n < length - 1; ++n) {
    m.set_program(first + n, engine_encode(to(n % 40, EngineOp::add, (n + 39) % 40, tick)));
  }
  if (tells) {
    m.set_program(first,
                  engine_encode(word(EngineOp::add, 0, kPosition, tick, EngineTarget::event, 17)));
  }
  m.set_program(first + length - 1, engine_encode(out(0, EngineOp::add, kPosition, tick)));
  return m;
}

template <int N>
void start(Pair<N>& p, const EngineMemory& m, unsigned run, int divider) {
  p.load(m);
  p.write(H::line_base, static_cast<std::uint32_t>(m.line_base));
  for (int t = 0; t < 4; ++t) p.write(H::divider0 + t, static_cast<std::uint32_t>(divider));
  p.write(H::run, run);
  p.in.addr = 0;
}

int period(int length, int axes = 1) { return engine_period(length, axes); }

template <int N>
void lives(std::uint64_t seed, int programs) {
  Random random(seed);
  std::int64_t done = 0, whole = 0;
  for (int k = 0; k < programs; ++k) {
    const int length = 1 + static_cast<int>(random.below(random.coin() ? 8 : 40));
    const int rounds = length * 6 / 50 + 1;
    const int divider = random.one_in(4) ? static_cast<int>(random.below(5))
                                         : rounds + static_cast<int>(random.below(3));
    const unsigned max_age = random.coin() ? 4000 : 1 + random.below(5);
    Pair<N> p(seed * 100 + static_cast<std::uint64_t>(k), max_age);
    INFO("program " << k << ", length " << length << ", divider " << divider);
    start(p, random_program(random, length), 1U << random.below(4), divider);
    for (int n = 0; n < 120; ++n) {
      p.run(1 + random.below(random.coin() ? 60 : 600));
      if (random.one_in(8)) p.ticks(1 + static_cast<int>(random.below(5)));
      if (random.one_in(8)) p.look();
      if (random.one_in(8)) p.in.addr = random.below(0xa20);
      if (random.one_in(8)) p.in.armed = random.coin();
    }
    done += p.done;
    whole += p.whole;
  }
  INFO("clocks " << done << ", run by run " << whole);
  CHECK(whole > done / 3);
}

}  // namespace

TEST_CASE("engine by runs: random programs of one axis, two and three") {
  lives<1>(1, 60);
  lives<2>(2, 15);
  lives<3>(3, 15);
}

TEST_CASE("engine by runs: every length, as often as it fits and less often") {
  for (const bool tells : {false, true}) {
    for (int length = 1; length < 30; ++length) {
      for (const int thread : {0, length % 4}) {
        Pair<1> p(static_cast<std::uint64_t>(length));
        const int divider = (period(length) + 49) / 50 + length % 2;
        start(p, counting(length, thread, tells), 1U << thread, divider);
        INFO("length " << length << ", thread " << thread << ", divider " << divider);
        p.ticks(20);
        const std::int64_t done = p.done, whole = p.whole;
        p.ticks(40);
        for (int n = 0; n < 60; ++n) p.run(1 + n * 7 % 53);
        CHECK(p.whole - whole == p.done - done);
        for (int n = 0; n < 60; ++n) {
          p.run(1 + n * 11 % 57);
          if (n % 7 == 0) p.look();
        }
      }
    }
  }
}

TEST_CASE("engine by runs: runs that are too long for their divider, overruns told") {
  for (int length = 4; length < 40; length += 3) {
    Pair<1> p(static_cast<std::uint64_t>(length));
    start(p, counting(length), 1, 1);
    INFO("length " << length);
    p.ticks(30);
    p.in.addr = H::status;
    const std::int64_t done = p.done, whole = p.whole;
    for (int n = 0; n < 40; ++n) p.run(1 + n * 13 % 71);
    CHECK(p.whole - whole == p.done - done);
    for (int n = 0; n < 40; ++n) {
      p.run(1 + n * 13 % 71);
      if (n % 5 == 0) p.look();
    }
    // An overrun is kept until the host writes what runs.
    CHECK((p.now().rdata >> EngineMap::S::status_overrun & 1U) == (period(length) > 50));
    p.write(H::run, 1);
    p.ticks(20);
    p.look();
  }
}

TEST_CASE("engine by runs: no thread runs") {
  Pair<1> p(5);
  start(p, counting(3), 0, 1);
  p.ticks(20);
  const std::int64_t done = p.done, whole = p.whole;
  for (int n = 0; n < 90; ++n) p.run(1 + n * 13 % 71);
  CHECK(p.whole - whole == p.done - done);
  p.look();
  p.write(H::run, 2);
  p.ticks(10);
  p.look();
}

TEST_CASE("engine by runs: a torque becomes too old in the same clock") {
  for (const int divider : {2, 5, 11}) {
    for (int max_age = 1; max_age < 13; ++max_age) {
      Pair<1> p(7, static_cast<unsigned>(max_age));
      start(p, counting(4), 1, divider);
      INFO("divider " << divider << ", max_age " << max_age);
      int late = 0;
      for (int n = 0; n < 120; ++n) {
        p.run(1 + n * 17 % 83);
        late += p.out().late;
        if (n % 9 == 0) p.look();
      }
      if (divider > max_age + 1) CHECK(late > 0);
    }
  }
}

TEST_CASE("engine by runs: outputs that come no more after runs that followed close") {
  for (int length = 6; length < 16; ++length) {
    EngineMemory m = counting(length);
    program(m, 0,
            {word(EngineOp::cmp, 0, EngineMap::input_tick, kConstant + 1),
             word(EngineOp::brf, 0, 0, length - 1)});
    m.set_program(length - 2,
                  engine_encode(word(EngineOp::nop, 0, 0, 0, EngineTarget::none, 0, true)));
    m.set_data(kConstant + 1, 100);
    for (const unsigned max_age : {0U, 1U, 9U, 31U}) {
      Pair<1> p(7, max_age);
      start(p, m, 1, 1);
      INFO("length " << length << ", max_age " << max_age);
      p.ticks(100 + static_cast<int>(max_age) / 2);
      p.look();
      for (int n = 0; n < 90; ++n) p.run(1 + n * 17 % 83);
      CHECK(p.out().late);
      p.look();
    }
  }
}

TEST_CASE("engine by runs: long and short runs by turns, told in the tick that they are of") {
  Random random(1);
  for (const int thread : {0, 1, 2, 3}) {
    for (int length = 4; length < 18; ++length) {
      EngineMemory m = counting(length, thread);
      const int first = thread * EngineMap::thread_words;
      program(m, thread,
              {word(EngineOp::cmp, 0, kPosition, kConstant),
               word(EngineOp::brf, 0, 0, first + length - 1)});
      for (const int divider : {1, 2}) {
        Pair<1> p(static_cast<std::uint64_t>(length));
        start(p, m, 1U << thread, divider);
        INFO("length " << length << ", thread " << thread << ", divider " << divider);
        for (int n = 0; n < 300; ++n) {
          p.run(1 + random.below(n % 2 == 0 ? 50 : 120));
          if (random.one_in(3)) p.look();
        }
        for (int n = 0; n < 200; ++n) {
          p.run(1 + random.below(60));
          p.look();
        }
        p.ticks(100);
        p.look();
      }
    }
  }
}

TEST_CASE("engine by runs: a mailbox becomes too old, and is fed") {
  for (int age = 0; age < 4; ++age) {
    for (const bool runs : {false, true}) {
      Pair<1> p(9);
      start(p, counting(5), runs, 1);
      p.write(H::mailbox_first, 3);
      p.write(H::mailbox_age, static_cast<std::uint32_t>(age));
      for (int k = 0; k < 3; ++k) {
        p.commit();
        p.in.addr = 0;
        CHECK((p.now().torque[0] != 0) == false);
        bool fed = false;
        for (int n = 0; n < (age + 2) * EngineMap::mailbox_step; ++n) {
          p.ticks(1);
          fed |= p.now().torque[0] != 0;
        }
        CHECK(fed == runs);
        CHECK(p.now().torque[0] == 0);
        CHECK(p.by_event.watch().stale);
        p.look();
      }
    }
  }
}

TEST_CASE("engine by runs: an age is lowered below the one that has passed") {
  for (const bool runs : {false, true}) {
    Pair<1> p(9);
    start(p, counting(5), runs, 1);
    p.write(H::mailbox_first, 3);
    p.write(H::mailbox_age, 1000);
    p.commit();
    p.ticks(20 * EngineMap::mailbox_step);
    CHECK((p.now().torque[0] != 0) == runs);
    p.write(H::mailbox_age, 2);
    p.ticks(EngineMap::mailbox_step + 1);
    CHECK(p.by_event.watch().stale);
    CHECK(p.now().torque[0] == 0);
    p.look();
  }
  // Runs of twelve ticks, each twenty: lowered between the tick that one is due with and its start.
  for (int delay = 0; delay < 20; ++delay) {
    Pair<1> p(7, 1000);
    start(p, counting(100), 1, 20);
    p.ticks(100);
    const auto runs = [&p] { return p.by_clock.clocked().running(0); };
    while (runs()) p.run(1);
    while (!runs()) p.run(1);
    p.run(delay);
    CHECK_FALSE(p.now().late);
    p.write(H::max_age, 4);
    p.ticks(3);
    INFO("delay " << delay);
    CHECK(p.now().late);
    p.look();
  }
}

TEST_CASE("engine by runs: begun anew at every start, at any clock of a tick") {
  for (const int thread : {0, 1, 3}) {
    for (int length = 1; length < 20; ++length) {
      Pair<1> p(static_cast<std::uint64_t>(length));
      start(p, counting(length, thread), 1U << thread, 1 + length % 3 / 2);
      INFO("length " << length << ", thread " << thread);
      for (int n = 0; n < 150; ++n) {
        p.run(1 + n * 23 % 97);
        p.look();
      }
    }
  }
}

TEST_CASE(
    "engine by runs: a mailbox counts while nobody watches it, and beside runs of every length") {
  Random random(1);
  for (const int length : {3, 7, 9, 12, 17}) {
    const int thread = length % 2 == 0 ? 1 : 0;
    for (const int ticks : {10, 60, 64, 70, 100, 127, 130, 200, 260, 390}) {
      for (const bool watched : {false, true}) {
        Pair<1> p(9);
        EngineMemory m = counting(length, thread);
        if (length == 7) {  // a torque of 0
          m.set_program(thread * EngineMap::thread_words + length - 1,
                        engine_encode(out(0, EngineOp::add, kConstant, kConstant)));
        }
        start(p, m, 1U << thread, 1);
        p.write(H::mailbox_first, watched ? 0 : 32);
        p.write(H::mailbox_age, 1);
        p.commit();
        p.in.addr = 0;
        INFO("length " << length << ", ticks " << ticks << ", watched " << watched);
        for (int n = 0; n < ticks; ++n) {
          p.ticks(1);
          if (p.count() % EngineMap::mailbox_step > 1) continue;
          p.run(120 + random.below(150));
          p.look();
        }
        p.write(H::mailbox_first, 0);
        p.look();
        p.ticks(70);
        p.look();
      }
    }
  }
}

TEST_CASE("engine by runs: as new, nothing is passed") {
  const Pair<1> p(3);
  CHECK_FALSE(p.by_event.on());
}

TEST_CASE("engine by runs: a run without an end is left to the clocks, and comes back") {
  for (const int mode : {0, 1}) {  // the first run, or the second
    EngineMemory m = counting(3);
    m.set_program(1, engine_encode(word(EngineOp::brf, mode, 0, 1)));
    Pair<1> p(11);
    start(p, m, 1, 1);
    p.ticks(200);
    CHECK(p.whole < p.done / 10);
    p.look();
    p.write(EngineMap::H::program + 1, 0);
    p.ticks(300);
    CHECK(p.by_event.on());
    p.look();
  }
}

TEST_CASE("engine by runs: one without an end after others, begun at any clock of a tick") {
  for (int length = 7; length < 11; ++length) {
    for (int last = 60; last < 85; ++last) {
      EngineMemory m = counting(length);
      program(m, 0,
              {word(EngineOp::cmp, 0, EngineMap::input_tick, kConstant + 1),
               word(EngineOp::brf, 1, 0, 1)});
      m.set_data(kConstant + 1, last);
      Pair<1> p(11);
      start(p, m, 1, 1);
      INFO("length " << length << ", last tick " << last);
      while (p.count() < 90) {
        p.run(50);
        p.look();
      }
    }
  }
}

TEST_CASE("engine by runs: axes renewed by turns") {
  EngineMemory m;
  program(m, 0,
          {to(1, EngineOp::sub, kConstant + 1, 1), word(EngineOp::cmp, 0, kConstant, 1),
           word(EngineOp::brf, 0, 0, 4), out(0, EngineOp::add, kPosition, EngineMap::input_tick),
           out(1, EngineOp::add, kPosition, EngineMap::input_tick)});
  m.set_data(kConstant + 1, 1);
  for (const unsigned max_age : {2U, 3U, 4000U}) {
    Pair<2> p(17, max_age);
    start(p, m, 1, 1);
    for (int n = 0; n < 150; ++n) {
      p.run(1 + n * 23 % 97);
      if (n % 2 == 0) p.look();
    }
    CHECK(p.whole > p.done / 4);
    CHECK(p.out().torque[1] != 0);
  }
}

TEST_CASE("engine by runs: the line of a table, written by runs and taken back") {
  EngineMemory m;
  m.line_base = 400;
  program(m, 0,
          {to(1, EngineOp::add, 1, kConstant + 1),
           to(2, EngineOp::mul, EngineMap::input_tick, kConstant + 2),
           word(EngineOp::tst, 0, 2, 400), to(3, EngineOp::tab, 2, 400),
           word(EngineOp::tst, 0, 2, 300), out(0, EngineOp::add, 3, kPosition)});
  m.set_data(kConstant + 1, 77);
  m.set_data(kConstant + 2, 5 << 12);
  Pair<1> p(13);
  start(p, m, 1, 1);
  for (int n = 0; n < 200; ++n) {
    p.run(1 + n * 19 % 91);
    if (n % 3 == 0) p.look();
  }
  CHECK(p.whole > p.done / 4);
}
