// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Programs of the engine written by hand, for tests. Documentation: docs/blocks/engine.md
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <initializer_list>
#include <vector>

#include "feltgate/crc32.hpp"
#include "feltgate/engine.hpp"
#include "feltgate/engine_memory.hpp"
#include "feltgate/engine_ops.hpp"
#include "random.hpp"

namespace feltgate::test {

/// Fields of an instruction in the order in which they are easily read.
inline EngineInstruction word(EngineOp op, int mode, int a, int b,
                              EngineTarget target = EngineTarget::none, int d = 0,
                              bool last = false) {
  return {op, mode, last, static_cast<int>(target), d, a, b};
}
/// The result goes to data word d.
inline EngineInstruction to(int d, EngineOp op, int a, int b, int mode = 0) {
  return word(op, mode, a, b, EngineTarget::data, d);
}
/// The last instruction of a run.
inline EngineInstruction out(int n, EngineOp op, int a, int b, int mode = 0) {
  return word(op, mode, a, b, EngineTarget::output, n, true);
}

/// Puts a program where a thread begins.
inline void program(EngineMemory& m, int thread, std::initializer_list<EngineInstruction> list) {
  int n = thread * EngineMap::thread_words;
  for (const EngineInstruction& i : list) m.set_program(n++, engine_encode(i));
}

// Words of these programs.
constexpr int kPosition = EngineMap::input_first;
constexpr int kVelocity = kPosition + 1;
constexpr int kParameter = EngineMap::D::parameter;
constexpr int kConstant = EngineMap::D::constant;  // 0

/// amplitude * sin(clicks * position): five instructions. With 4096 counts a turn, 2^20 * clicks *
/// position wraps at a turn, as a word; its upper 18 bits are the place in 64 lines of sine.
/// Parameter 0: 2^9 * clicks; parameter 1: amplitude, [1,1,16].
inline void detent(EngineMemory& m, int thread) {
  using Op = EngineOp;
  constexpr int lines = 64;
  for (int n = 0; n < lines; ++n) {
    const auto at = [](int k) { return std::lround(131072 * std::sin(2 * M_PI * k / lines)); };
    const int k = n - lines / 2;
    m.set_table(n, engine_table_word(static_cast<std::int32_t>(at(k)),
                                     static_cast<std::int32_t>(at(k + 1) - at(k))));
  }
  m.set_data(kConstant + 1, 1 << 11);
  m.set_data(kConstant + 2, 1 << 13);
  program(m, thread,
          {to(0, Op::mlw, kPosition, kParameter), to(0, Op::mlw, 0, kConstant + 1),
           to(0, Op::mul, 0, kConstant + 2, 3), to(0, Op::lrp, 0, lines / 2),
           out(0, Op::mul, 0, kParameter + 1, 2)});
}

/// A wall with damping at parameter 0, which pushes down: six instructions. Stiffness (shift 12)
/// and negative damping (shift 27) are parameters 1 and 2.
inline void wall(EngineMemory& m, int thread) {
  using Op = EngineOp;
  program(m, thread,
          {to(0, Op::sub, kParameter, kPosition), to(1, Op::mul, 0, kParameter + 1, 1),
           to(1, Op::mac, kVelocity, kParameter + 2, 3), to(1, Op::min, 1, kConstant),
           word(Op::cmp, 0, kParameter, kPosition), out(0, Op::sel, 1, kConstant)});
}

/// Crossing `upper` pulls to it from above until the position falls below `lower`: a membrane with
/// the words minus, plus as torques. Parameters 0 to 3: lower, upper, minus, plus. State 0.
inline void membrane(EngineMemory& m, int thread) {
  using Op = EngineOp;
  program(m, thread,
          {to(0, Op::sel, kParameter + 3, 0), word(Op::cmp, 0, kPosition, kParameter),
           to(0, Op::sel, kParameter + 2, 0), word(Op::cmp, 0, kParameter + 1, kPosition),
           to(0, Op::sel, kParameter + 3, 0), word(Op::cmp, 1, kPosition, kParameter),
           out(0, Op::sel, kConstant, 0)});
}

/// CRC-32 of an image as a loader computes it.
inline std::uint32_t image_crc(const EngineMemory& m) {
  std::vector<std::uint8_t> bytes;
  const auto put = [&bytes](std::uint64_t word, int count) {
    for (int n = 0; n < count; ++n) bytes.push_back(static_cast<std::uint8_t>(word >> (8 * n)));
  };
  for (int n = 0; n < 512; ++n) put(m.program_at(n), 5);
  for (int n = 384; n < 512; ++n) put(static_cast<std::uint32_t>(m.data_at(n)), 4);
  for (int n = 0; n < m.line_base; ++n) put(m.table_at(n), 5);
  return crc32(bytes.data(), bytes.size());
}

/// A charge at parameter 0: its force stands over the amount of the distance, and takes the sign of
/// that: six instructions. Parameter 1: far, parameter 2: places per count (shift 12).
inline void charge(EngineMemory& m, int thread) {
  using Op = EngineOp;
  for (int n = 0; n < 128; ++n) {
    const auto at = [](int k) {
      const double r = 0.05 * k;
      return std::lround(100000 * r / std::pow(r * r + 0.2, 1.5) / 10);
    };
    m.set_table(64 + n, engine_table_word(static_cast<std::int32_t>(at(n)),
                                          static_cast<std::int32_t>(at(n + 1) - at(n))));
  }
  program(m, thread,
          {to(0, Op::sub, kPosition, kParameter), to(1, Op::abs, 0, 0),
           to(1, Op::min, 1, kParameter + 1), to(1, Op::mul, 1, kParameter + 2, 1),
           to(1, Op::lrp, 1, 64), out(0, Op::abs, 0, 1)});
}

// How often a program runs in the engine's twin, clock by clock.

/// Runs of thread 0 and whether a start was missed, in so many ticks.
struct Seen {
  int fresh = 0;
  bool overrun = false;
};

template <int Axes>
Seen run(const EngineMemory& memory, int divider, int clocks_per_tick, int phase, int ticks) {
  using H = EngineMap::H;
  law::Engine<Axes> engine(0xffff);
  engine.reset();
  engine.memory() = memory;
  typename law::Engine<Axes>::In in;
  const auto write = [&](int address, int word) {
    in.addr = static_cast<unsigned>(address);
    in.wdata = static_cast<std::uint32_t>(word);
    in.write = true;
    engine.clock(in);
    in.write = false;
    for (int k = 0; k < 40; ++k) engine.clock(in);
  };
  write(H::divider0, divider);
  write(H::run, 1);
  for (int k = 0; k < phase; ++k) engine.clock(in);
  in.addr = static_cast<unsigned>(H::status);
  Seen seen;
  for (int k = 0; k < ticks * clocks_per_tick; ++k) {
    in.tick = k % clocks_per_tick == 0;
    engine.clock(in);
    seen.fresh += engine.out().fresh ? 1 : 0;
  }
  seen.overrun = (engine.out().rdata >> EngineMap::S::status_overrun & 1U) != 0;
  return seen;
}

// Programs at random that a device could have: they end.

/// All four threads have `length` random words or less; branches go forward but for some, and
/// mostly a run renews all outputs.
inline EngineMemory random_program(Random& random, int length) {
  EngineMemory m;
  m.line_base = random.coin() ? 512 : 400;
  for (auto& word : m.table) word = random.bits() >> 28;
  for (int n = 448; n < 512; ++n) m.set_data(n, static_cast<std::int32_t>(random.bits() >> 40));
  for (int t = 0; t < 4; ++t) {
    for (int n = 0; n < length; ++n) {
      EngineInstruction i = engine_decode(random.bits() >> 28);
      const int at = t * EngineMap::thread_words + n;
      i.last = n + 1 == length || random.one_in(40);
      if (i.op == EngineOp::brf) {
        i.b = std::min(at + 1 + static_cast<int>(random.below(4)), at - n + length - 1);
        if (random.one_in(300)) i.b = at;
      }
      if (random.one_in(3)) i.a = 48 + static_cast<int>(random.below(10));
      if (i.dst == 2) i.d = static_cast<int>(random.below(3));
      if (i.dst == 1 && random.coin()) i.d = static_cast<int>(random.below(40));
      if (n + 3 >= length) i.dst = 2;
      if (n + 3 >= length) i.d = length - 1 - n;
      m.set_program(at, engine_encode(i));
    }
  }
  return m;
}

}  // namespace feltgate::test
