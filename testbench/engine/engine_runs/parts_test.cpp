// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The parts of EngineRuns alone: ticks, writes, instructions, outputs.
// Documentation: docs/blocks/engine.md
#include "../machine/machine_programs.hpp"
#include "catch.hpp"
#include "feltgate/engine_runs_parts.hpp"

using namespace feltgate;
using namespace feltgate::test;
using namespace feltgate::law;

namespace {

using Axes = std::array<std::int32_t, 1>;
using Ticks = RunTicks<Axes>;

constexpr RunTiming timing{50, 22, 14, 23};

/// Ticks at clocks 25, 75 and so on, whose words are 1, 10, 100; 2, 20, 200 and so on.
Ticks ticks(int count, std::uint32_t number = 7, int clock_of_tick = 0) {
  Ticks t(timing);
  t.begin(number, clock_of_tick);
  for (int n = 1; n <= count; ++n) {
    t.add({50 * n - 25 - clock_of_tick, {n}, {10 * n}, {100 * n}});
  }
  return t;
}

}  // namespace

TEST_CASE("run ticks: counted from where they began") {
  for (const int of_tick : {0, 1, 25, 49}) {
    const Ticks t = ticks(0, 7, of_tick);
    CHECK(t.count_at(0) == 7);
    CHECK(t.count_at(49 - of_tick) == 7);
    CHECK(t.count_at(50 - of_tick) == 8);
    CHECK(t.count_at(149 - of_tick) == 9);
    CHECK(t.count_at(150 - of_tick) == 10);
  }
}

TEST_CASE("run ticks: what the axes show, before a tick and after it") {
  Ticks t = ticks(3);
  const auto at = [&t](std::int64_t n) { return t.at_or_after(n, 0); };
  CHECK(t.size() == 3);
  CHECK(at(0) == 0);
  CHECK(at(25) == 0);
  CHECK(at(26) == 1);
  CHECK(at(125) == 2);
  CHECK(at(126) == 3);
  CHECK(t.at_or_after(20, 2) == 2);
  CHECK(t.is_tick(25, 0));
  CHECK(t.is_tick(75, 1));
  CHECK_FALSE(t.is_tick(26, 1));
  CHECK_FALSE(t.is_tick(175, 3));
  // Before the first tick nothing is known, but what comes early of it.
  CHECK(t.position(2, 0)[0] == 0);
  CHECK(t.position(3, 0)[0] == 1);
  CHECK(t.velocity(10, 0)[0] == 0);
  CHECK(t.velocity(11, 0)[0] == 10);
  CHECK(t.tau_hat(24, 0)[0] == 0);
  CHECK(t.tau_hat(25, 0)[0] == 100);
  CHECK(t.position(52, at(52))[0] == 1);
  CHECK(t.position(53, at(53))[0] == 2);
  CHECK(t.velocity(60, at(60))[0] == 10);
  CHECK(t.velocity(61, at(61))[0] == 20);
  CHECK(t.tau_hat(74, at(74))[0] == 100);
  CHECK(t.tau_hat(75, at(75))[0] == 200);
  // Behind the last one the next comes, which is shown.
  t.show({-1}, {-10});
  CHECK(t.position(152, at(152))[0] == 3);
  CHECK(t.position(153, at(153))[0] == -1);
  CHECK(t.velocity(160, at(160))[0] == 30);
  CHECK(t.velocity(161, at(161))[0] == -10);
  CHECK(t.tau_hat(174, at(174))[0] == 300);
  CHECK(t.position(3, 0)[0] == 1);
}

TEST_CASE("run ticks: one that has been, and the next that comes") {
  Ticks t = ticks(1);
  t.show({-1}, {-10});
  CHECK(t.position(52, 1)[0] == 1);
  CHECK(t.position(53, 1)[0] == -1);
  CHECK(t.velocity(60, 1)[0] == 10);
  CHECK(t.velocity(61, 1)[0] == -10);
}

TEST_CASE("run ticks: nothing is shown of a tick to come where there is none before") {
  Ticks t = ticks(0);
  t.show({-1}, {-10});
  CHECK(t.position(0, 0)[0] == 0);
  CHECK(t.velocity(30, 0)[0] == 0);
  CHECK(t.tau_hat(30, 0)[0] == 0);
  CHECK_FALSE(t.beyond(100, 0));
}

TEST_CASE("run ticks: later than a snapshot knows") {
  const Ticks t = ticks(2);
  CHECK_FALSE(t.beyond(98, 2));
  CHECK(t.beyond(99, 2));
  CHECK_FALSE(t.beyond(60, 1));
  CHECK(t.known_for() == 23);
}

TEST_CASE("run ticks: the thread that is counted") {
  const Ticks t = ticks(2);
  CHECK(t.counted(25) == -1);
  for (int n = 0; n < 4; ++n) CHECK(t.counted(26 + n) == n);
  CHECK(t.counted(30) == -1);
  CHECK(t.counted(79) == 3);
  CHECK(t.counted(24) == -1);
}

TEST_CASE("run ticks: what is forgotten is a tick older than asked") {
  Ticks t = ticks(4);
  t.forget(75);
  CHECK(t.size() == 4);
  t.forget(76);
  CHECK(t.size() == 3);
  CHECK(t.is_tick(75, 0));
  t.begin(1, 0);
  CHECK(t.size() == 0);
}

TEST_CASE("run ticks: runs so long that they are never known too late") {
  // Start two clocks behind what is known, six clocks an instruction, outputs four behind the end:
  // the least length that gives nothing before the tick after.
  for (int known = 5; known < 40; ++known) {
    const Ticks t({50, 22, 14, known});
    const auto ends = [known](int length) { return known + 1 + 2 + 6 * length + 4; };
    INFO("known for " << known);
    CHECK(ends(t.long_run()) >= 50);
    CHECK(ends(t.long_run() - 1) < 50);
  }
}

TEST_CASE("run writes: those since the last but one mark are taken back, the last first") {
  EngineMemory m;
  RunWrites w;
  w.data(m, 5, 1);
  w.mark();
  w.data(m, 5, 2);
  w.table(m, 0, 20);
  w.table(m, 511, 21);
  w.data(m, 511, 9);
  w.data(m, 0, 8);
  w.mark();
  w.data(m, 5, 3);
  w.data(m, 5, -4);
  w.table(m, 0, 0xffffffff);
  CHECK(m.data_at(5) == -4);
  CHECK(m.table_at(0) == 0xffffffff);
  w.take_back(m);
  CHECK(m.data_at(5) == 1);
  CHECK(m.data_at(511) == 0);
  CHECK(m.data_at(0) == 0);
  CHECK(m.table_at(0) == 0);
  CHECK(m.table_at(511) == 0);
  m.set_data(5, 77);
  w.take_back(m);
  CHECK(m.data_at(5) == 77);
}

TEST_CASE("run writes: wide words of a table, negative ones of data") {
  EngineMemory m;
  RunWrites w;
  m.set_table(3, 0xfedcba987);
  m.set_table(0, 0x123456789);
  m.set_data(3, -5);
  w.table(m, 3, 1);
  w.table(m, 0, 0);
  w.data(m, 3, 6);
  w.take_back(m);
  CHECK(m.table_at(3) == 0xfedcba987);
  CHECK(m.table_at(0) == 0x123456789);
  CHECK(m.data_at(3) == -5);
}

TEST_CASE("run program: instructions with their addresses, decoded once") {
  EngineMemory m;
  program(m, 1,
          {to(3, EngineOp::add, 2, kParameter), to(kConstant, EngineOp::add, 2, 1),
           word(EngineOp::add, 0, 1, 2, EngineTarget::event, 3), out(0, EngineOp::add, 1, 2)});
  RunProgram p;
  p.begin(1, 1);
  CHECK(p.at(m, 128).x == engine_read_address(2, 1, 1));
  CHECK(p.at(m, 128).y == engine_read_address(kParameter, 1, 1));
  CHECK(p.at(m, 128).to == engine_write_address(3, 1));
  CHECK(p.at(m, 129).to == -1);  // no thread writes there
  CHECK(p.at(m, 130).to == -1);
  CHECK(p.at(m, 131).i.last);
  m.set_program(131, 0);
  CHECK(p.at(m, 131).i.last);
  p.begin(0, 0);
  CHECK_FALSE(p.at(m, 131).i.last);
  CHECK(p.at(m, 128).x == engine_read_address(2, 0, 0));
  CHECK(p.at(m, 128).y == engine_read_address(kParameter, 0, 0));
}

TEST_CASE("run program: how many instructions every run has at least") {
  const auto shortest = [](std::initializer_list<EngineInstruction> list, int most,
                           int thread = 0) {
    EngineMemory m;
    program(m, thread, list);
    RunProgram p;
    p.begin(thread, 0);
    return p.shortest(m, most);
  };
  const auto add = to(1, EngineOp::add, 1, 1), end = out(0, EngineOp::add, 1, 1);
  const auto branch = word(EngineOp::brf, 0, 0, 0);
  const auto event = word(EngineOp::add, 0, 1, 1, EngineTarget::event, 1);
  CHECK(shortest({end}, 9) == 1);
  CHECK(shortest({add, add, end}, 9) == 3);
  CHECK(shortest({add, branch, add, end}, 9) == 2);
  CHECK(shortest({add, event, end}, 9) == 1);
  CHECK(shortest({event, end}, 9) == 0);
  CHECK(shortest({add, add, add, end}, 2) == 2);
  CHECK(shortest({add, add, end}, 3) == 3);
  CHECK(shortest({end}, 0) == 0);
  CHECK(shortest({add, end}, 9, 3) == 2);
  // What lies before a thread's first word is not its own.
  EngineMemory before;
  program(before, 0, {end});
  before.set_program(127, engine_encode(end));
  program(before, 1, {add, add, end});
  RunProgram second;
  second.begin(1, 0);
  CHECK(second.shortest(before, 9) == 3);
  // The words go round.
  EngineMemory m;
  for (int n = 0; n < 128; ++n) m.set_program(384 + n, engine_encode(add));
  program(m, 0, {add, end});
  RunProgram p;
  p.begin(3, 0);
  CHECK(p.shortest(m, 200) == 130);
}

TEST_CASE("run state: as new") {
  const RunState<2> s;
  CHECK(s.clock == 0);
  CHECK(s.torque == std::array<std::int32_t, 2>{});
  CHECK(s.renewed == 0);
  CHECK(s.age == 0);
  CHECK(s.first == 0);
  CHECK(s.count == 0);
  CHECK_FALSE(s.due);
  CHECK_FALSE(s.overrun);
  CHECK_FALSE(s.mail_late);
  CHECK(s.mail_age == 0);
  const RunOutputs<2> outputs;
  CHECK(outputs.clock == 0);
  CHECK(outputs.mask == 0);
  const RunProgram::Step step;
  CHECK(step.x == 0);
  CHECK(step.y == 0);
  CHECK(step.to == -1);
}

TEST_CASE("run outputs: all axes renewed by one run or by several") {
  RunOutputs<3> all{9, 7, {1, 2, 3}}, first{9, 1, {4, 5, 6}}, rest{9, 6, {7, 8, 9}}, none{9, 0, {}};
  CHECK(all.renews(0));
  CHECK_FALSE(first.renews(0));
  CHECK(first.renews(6));
  CHECK_FALSE(none.renews(7));
  RunState<3> s;
  s.age = 5;
  first.appear(&s, false);
  CHECK(s.torque == std::array<std::int32_t, 3>{4, 0, 0});
  CHECK(s.renewed == 1);
  CHECK(s.age == 5);
  rest.appear(&s, false);
  CHECK(s.torque == std::array<std::int32_t, 3>{4, 8, 9});
  CHECK(s.renewed == 0);
  CHECK(s.age == 0);
  all.appear(&s, true);
  CHECK(s.torque == std::array<std::int32_t, 3>{0, 0, 0});
  first.appear(&s, true);
  CHECK(s.renewed == 1);
}
