// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Programs at random that a device could have: they end. Documentation: docs/engine-isa.md
#pragma once

#include <algorithm>
#include <cstdint>

#include "feltgate/engine_memory.hpp"
#include "feltgate/engine_ops.hpp"
#include "random.hpp"

namespace feltgate::test {

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
