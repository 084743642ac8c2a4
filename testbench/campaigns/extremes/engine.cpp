// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Extremes of laws: ends of a table, ages, a full FIFO, the longest program, all threads at once.
// Documentation: docs/extremes.md
#include <algorithm>
#include <cmath>
#include <vector>

#include "campaigns/extremes/engine_pair.hpp"
#include "engine/machine/machine_programs.hpp"

namespace feltgate::extremes {

namespace {

using namespace test;
using H = EngineMap::H;
using Op = EngineOp;
constexpr int clocks_per_tick = EnginePair::clocks_per_tick;  // of 1 us

/// Returns the clocks to the next fresh result in RTL and twin, at most `limit`.
Both until_fresh(EnginePair* pair, std::int64_t limit) {
  Both found{-1, -1};
  for (std::int64_t k = 1; k <= limit && (found.rtl < 0 || found.twin < 0); ++k) {
    pair->clock();
    if (found.rtl < 0 && pair->rtl_fresh()) found.rtl = static_cast<double>(k);
    if (found.twin < 0 && pair->fresh()) found.twin = static_cast<double>(k);
  }
  return found;
}

Outcome law_table_ends(const Settings&) {
  Outcome o;
  constexpr std::int32_t value = 1 << 19, slope = 1 << 15;  // one more than the largest
  EngineMemory m;
  m.set_table(0, engine_table_word(-value, -slope));
  m.set_table(511, engine_table_word(value - 1, slope - 1));
  program(m, 0, {out(0, Op::lrp, kPosition, 0)});
  EnginePair pair(m);
  pair.write(H::run, 1);
  const auto at = [&](const std::string& what, std::int32_t place, double expected) {
    pair.in.position[0] = place;
    pair.clock(4 * clocks_per_tick);
    add(&o, what, "LSB", exactly(expected), pair.torque());
  };
  // A segment has 4096 places; at its last place the slope counts for 4095/4096 of the segment.
  const double most = 4095.0 / 4096;
  at("first place: its value", 0, -value);
  at("last place of the first segment", 4095, std::round(-value - slope * most));
  at("last place of the table", 512 * 4096 - 1, std::round(value - 1 + (slope - 1) * most));
  at("the fourth place of the last segment: 23.9993 rounded", 511 * 4096 + 3,
     value - 1 + std::round((slope - 1) * 3.0 / 4096));
  at("one place further: the first word again", 512 * 4096, -value);
  at("one place before the first: the last word", -1, std::round(value - 1 + (slope - 1) * most));
  at("the largest word", INT32_MAX, std::round(value - 1 + (slope - 1) * most));
  at("the smallest word", INT32_MIN, -value);
  pair.report(&o);
  o.note =
      "A table of all 512 words with the largest values and slopes. The compiler proves that a "
      "law's place never leaves its table; the memory itself wraps around.";
  return o;
}

Outcome law_age(const Settings&) {
  Outcome o;
  for (const int max_age : {0, 1, 4095, 65535}) {
    EngineMemory m;
    program(m, 0, {out(0, Op::add, kPosition, kConstant)});
    EnginePair pair(m);
    pair.write(H::max_age, static_cast<std::uint32_t>(max_age));
    pair.write(H::run, 1);
    until_fresh(&pair, 1000);
    const Both before = pair.late();
    // The program becomes endless: no more results, except from a run that has begun.
    pair.write(H::program, static_cast<std::uint32_t>(engine_encode(word(Op::brf, 1, 0, 0))));
    Both ticks{-1, -1};
    int count = 0;  // ticks since the last result
    for (std::int64_t k = 0;
         k < clocks_per_tick * (max_age + 10) && (ticks.rtl < 0 || ticks.twin < 0); ++k) {
      pair.clock();
      count = pair.fresh() ? 0 : count + (pair.in.tick ? 1 : 0);
      if (ticks.rtl < 0 && pair.late().rtl > 0) ticks.rtl = count;
      if (ticks.twin < 0 && pair.late().twin > 0) ticks.twin = count;
    }
    const std::string of = ", max_age " + number(max_age);
    // With a largest age of 0 the next tick is always too late.
    add(&o, "late with a result in every tick" + of, "", exactly(max_age == 0 ? 1 : 0), before);
    if (max_age > 0) {
      add(&o, "ticks from the last result to late" + of, "", exactly(max_age + 1), ticks);
    }
    pair.report(&o);
  }
  for (const int max_age : {4094, 4095}) {
    EngineMemory m;
    program(m, 0, {out(0, Op::add, kPosition, kConstant)});
    EnginePair pair(m);
    pair.write(H::max_age, static_cast<std::uint32_t>(max_age));
    pair.write(H::divider0, 4095);
    pair.write(H::run, 1);
    until_fresh(&pair, 5000 * clocks_per_tick);
    until_fresh(&pair, 5000 * clocks_per_tick);
    add(&o, "late with a result every 4095 ticks, max_age " + number(max_age), "",
        exactly(max_age == 4094 ? 1 : 0), pair.late());
    pair.report(&o);
  }
  o.note = "An engine alone. If it is late, the core sets the torque to 0 and raises a fault.";
  return o;
}

Outcome law_events_full(const Settings&) {
  Outcome o;
  for (const int ticks : {8, 9, 300}) {
    EngineMemory m;
    program(m, 0,
            {word(Op::add, 0, EngineMap::input_tick, 63, EngineTarget::event, 1),
             word(Op::add, 0, EngineMap::input_tick, 63, EngineTarget::event, 2, true)});
    EnginePair pair(m);
    pair.write(H::run, 1);
    int told = 0;
    while (told < 2 * ticks) {
      pair.clock();
      told += pair.event() ? 1 : 0;
    }
    pair.write(H::run, 0);
    const std::string of = " of " + number(told);
    add(&o, "events that wait" + of, "", exactly(std::min(told, 16)), pair.read(H::event_count));
    add(&o, "events counted as lost" + of, "", exactly(std::min(std::max(0, told - 16), 255)),
        pair.read(H::events_lost));
    const Both first = pair.read(H::event_tick);
    for (int k = 0; k < 6; ++k) pair.read(H::event_tick);
    const Both eighth = pair.read(H::event_tick);
    add(&o, "ticks from the oldest to the eighth" + of, "", exactly(3),
        {eighth.rtl - first.rtl, eighth.twin - first.twin});
    pair.report(&o);
  }
  o.note = "Two events in every tick, which nobody reads. The newest are lost, and counted.";
  return o;
}

Outcome law_program_512(const Settings&) {
  Outcome o;
  EngineMemory m;
  m.set_data(kConstant + 1, 3);
  const EngineInstruction first = word(Op::add, 0, kConstant + 1, kConstant);
  const EngineInstruction more = word(Op::add, 2, kConstant + 1, kConstant);  // acc + 3
  for (int n = 0; n < 511; ++n) m.set_program(n, engine_encode(n == 0 ? first : more));
  m.set_program(511, engine_encode(out(0, Op::add, kConstant + 1, 0, 2)));
  EnginePair pair(m);
  const int ticks =
      (engine_period(EngineMap::program_words, 1) + clocks_per_tick - 1) / clocks_per_tick;
  pair.write(H::divider0, static_cast<std::uint32_t>(ticks));
  pair.write(H::max_age, static_cast<std::uint32_t>(ticks));
  pair.write(H::run, 1);
  until_fresh(&pair, 10'000);
  Both clocks;  // three measurements, because a run begins in one of six clocks
  for (int k = 0; k < 3; ++k) {
    const Both next = until_fresh(&pair, 10'000);
    clocks.rtl += next.rtl / 3, clocks.twin += next.twin / 3;
  }
  add(&o, "result of 512 additions of 3", "LSB", exactly(512 * 3), pair.torque());
  add(&o, "clocks from result to result", "", exactly(1.0 * clocks_per_tick * ticks), clocks);
  add(&o, "rate of the law", "kHz", near(1000.0 / ticks, 0.01),
      {1000.0 * clocks_per_tick / clocks.rtl, 1000.0 * clocks_per_tick / clocks.twin});
  pair.clock(200'000);
  const auto overrun = [&] {
    const Both status = pair.read(H::status);
    const auto bit = [](double word) {
      return static_cast<double>(static_cast<unsigned>(word) >> EngineMap::S::status_overrun & 1U);
    };
    return Both{bit(status.rtl), bit(status.twin)};
  };
  add(&o, "starts missed at that rate", "", exactly(0), overrun());
  add(&o, "late with as many ticks of age", "", exactly(0), pair.late());
  pair.write(H::run, 0);
  pair.clock(10'000);
  pair.write(H::divider0, static_cast<std::uint32_t>(ticks - 1));
  pair.write(H::run, 1);
  pair.clock(400'000);  // each run ends 34 clocks later, until a start comes while one waits
  add(&o, "starts missed with a tick less", "", exactly(1), overrun());
  pair.report(&o);
  o.note = "One program over the words of all four threads, 6 clocks an instruction.";
  return o;
}

Outcome law_threads_at_once(const Settings&) {
  Outcome o;
  EngineMemory m;
  for (int n = 0; n < EngineMap::threads; ++n) {
    const int own = EngineMap::D::exchange + n * EngineMap::exchange_words;
    m.set_data(kConstant + 1 + n, 1 << (4 * n));
    // Each thread makes its event and writes its words in the same turn of the round; all threads
    // read all words. Each addresses its private word like the last thread, but reaches its own.
    constexpr int shared = 3 * EngineMap::private_words + 5;
    const int last = EngineMap::D::exchange;
    program(m, n,
            {word(Op::add, 0, kConstant + 1 + n, kConstant, EngineTarget::event, n + 1),
             to(shared, Op::add, kConstant + 1 + n, kConstant), to(own, Op::add, shared, kConstant),
             word(Op::add, 0, last, last + 16), word(Op::add, 2, last + 32, 0),
             word(Op::add, 2, last + 48, 0, n == 0 ? EngineTarget::output : EngineTarget::none, 0,
                  true)});
  }
  EnginePair pair(m);
  pair.write(H::run, 15);
  int told = 0;
  const std::uint32_t from = pair.in.tick_count;
  while (told < 4) {
    pair.clock();
    told += pair.event() ? 1 : 0;
  }
  pair.write(H::run, 0);
  const Both waiting = pair.read(H::event_count);
  add(&o, "events of the first tick", "", exactly(4), waiting);
  Both sum, spread;
  std::vector<Both> ticks;
  for (int n = 0; n < 4; ++n) {
    const Both value = pair.read(H::event_value);
    sum.rtl += value.rtl, sum.twin += value.twin;
    ticks.push_back(pair.read(H::event_tick));
    spread.rtl = std::max(spread.rtl, std::abs(ticks[0].rtl - ticks.back().rtl));
    spread.twin = std::max(spread.twin, std::abs(ticks[0].twin - ticks.back().twin));
  }
  add(&o, "their values together, one digit each [hex 1111]", "", exactly(0x1111), sum);
  add(&o, "ticks between them", "", exactly(0), spread);
  add(&o, "their tick, from the start", "", between(1, 2),
      {ticks[0].rtl - from, ticks[0].twin - from});
  pair.write(H::run, 15);
  pair.clock(5 * clocks_per_tick);
  add(&o, "sum of the words that all threads write at once", "LSB", exactly(0x1111), pair.torque());
  pair.report(&o);
  o.note =
      "Four threads that start with the same tick; they fill four of the six clocks of a round.";
  return o;
}

}  // namespace

std::vector<Case> engine_cases() {
  const char* group = "Laws";
  return {
      {group, "law_table_ends", "A table read at its ends and beyond them.", law_table_ends},
      {group, "law_age", "A law's last result, as old as its age allows and a tick older.",
       law_age},
      {group, "law_events_full", "More events than places: 16 wait, the others are counted.",
       law_events_full},
      {group, "law_program_512", "The longest program: its rate, and a tick too few.",
       law_program_512},
      {group, "law_threads_at_once", "Four threads, each with its event, in the same tick.",
       law_threads_at_once},
  };
}

}  // namespace feltgate::extremes
