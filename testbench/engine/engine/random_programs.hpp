// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Random contents of the engine's memories. Documentation: docs/blocks/engine.md
#pragma once

#include <cstdint>

#include "feltgate/engine_memory.hpp"
#include "feltgate/engine_ops.hpp"
#include "random.hpp"

namespace feltgate::test {

/// Returns a number at the ends of a width that matters, or a random number of any size.
inline std::int32_t corner(Random& random) {
  static const std::int64_t corners[] = {0,      1,       2,       0x7ff,   0x800,   0xfff,  0x1000,
                                         0xffff, 0x10000, 0x1ffff, 0x20000, 0x3ffff, 0x40000};
  switch (random.below(4)) {
    case 0: {
      const auto n = static_cast<std::int32_t>(corners[random.below(13)]);
      return random.one_in(2) ? n : -n;
    }
    case 1:
      return random.one_in(2) ? INT32_MAX - static_cast<int>(random.below(3))
                              : INT32_MIN + static_cast<int>(random.below(3));
    default:
      return static_cast<std::int32_t>(static_cast<std::uint32_t>(random.below(0xffffffffU))) >>
             random.below(32);
  }
}

/// Returns a data address that programs use often: private, inputs, exchange, parameters,
/// constants.
inline int random_address(Random& random) {
  switch (random.below(6)) {
    case 0:
      return static_cast<int>(random.below(512));
    case 1:
      return EngineMap::input_first + static_cast<int>(random.below(16));
    case 2:
      return EngineMap::D::exchange + static_cast<int>(random.below(64));
    case 3:
      return EngineMap::D::parameter + static_cast<int>(random.below(32));
    default:
      return static_cast<int>(random.below(12));  // few words, so that they are read again
  }
}

/// Returns any instruction, with frequent ends and outputs. One in 40 is 36 random bits.
inline std::uint64_t random_instruction(Random& random) {
  if (random.one_in(40)) {
    return static_cast<std::uint64_t>(random.below(0xffffffffU)) << 4 | random.below(16);
  }
  EngineInstruction i;
  i.op = static_cast<EngineOp>(random.below(16));
  i.mode = static_cast<int>(random.below(4));
  i.last = random.one_in(14);
  i.dst = random.one_in(3) ? static_cast<int>(random.below(4)) : 1;
  if (i.dst == 3 && !random.one_in(3)) i.dst = 2;
  i.d = i.dst == 2 ? static_cast<int>(random.below(4)) : random_address(random);
  i.a = random_address(random);
  i.b = random_address(random);
  return engine_encode(i);
}

/// Random content for all memories. Parameters are within their ranges.
inline EngineMemory random_memory(Random& random) {
  EngineMemory m;
  using D = EngineMap::D;
  for (int n = 0; n < 512; ++n) {
    m.set_program(n, random_instruction(random));
    m.set_table(n, static_cast<std::uint64_t>(random.below(0xffffffffU)) << 4 | random.below(16));
    const bool input = n < 256 && n % 64 >= EngineMap::input_first;
    m.set_data(n, input ? 0 : corner(random));
  }
  // Most programs end, with outputs for all axes, unless they branch elsewhere.
  for (int thread = 0; thread < EngineMap::threads; ++thread) {
    if (random.one_in(6)) continue;
    int at = thread * EngineMap::thread_words + 1 + static_cast<int>(random.below(12));
    for (int n = 0; n < 3; ++n) {
      EngineInstruction i = engine_decode(random_instruction(random));
      i.dst = static_cast<int>(EngineTarget::output);
      i.d = n;
      i.last = n == 2;
      if (i.op == EngineOp::brf) i.op = EngineOp::mac;
      m.set_program(at++, engine_encode(i));
    }
  }
  for (int n = 0; n < EngineMap::parameter_words; ++n) {
    const std::int32_t u = corner(random), v = corner(random);
    m.set_data(D::lower + n, u < v ? u : v);
    m.set_data(D::upper + n, u < v ? v : u);
    m.set_data(D::parameter + n, u);
    m.set_data(D::parameter_bank + n, v);
  }
  m.line_base =
      random.one_in(3) ? EngineMap::table_words : 300 + static_cast<int>(random.below(212));
  return m;
}

/// Programs without branches in all threads, with every instruction and mode on corner values; each
/// result is an event.
inline EngineMemory random_arithmetic(Random& random) {
  EngineMemory m = random_memory(random);
  for (int thread = 0; thread < EngineMap::threads; ++thread) {
    for (int n = 0; n < EngineMap::thread_words; ++n) {
      EngineInstruction i;
      i.op = static_cast<EngineOp>(random.below(16));
      i.mode = static_cast<int>(random.below(4));
      i.last = n == EngineMap::thread_words - 1;
      i.dst = i.last ? 2 : 3;
      i.d = i.last ? 0 : static_cast<int>(random.below(512));
      const auto constant = [&random] {
        return EngineMap::D::lower + static_cast<int>(random.below(128));
      };
      i.a = constant();
      i.b = random.one_in(8) ? i.a : constant();
      if (i.op == EngineOp::brf) i.b = thread * EngineMap::thread_words + n + 1;
      m.set_program(thread * EngineMap::thread_words + n, engine_encode(i));
    }
  }
  return m;
}

}  // namespace feltgate::test
