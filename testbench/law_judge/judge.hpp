// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// A law's words, run by the interpreter, beside the law in long double.
#pragma once

#include <cstdint>
#include <string>

#include "law/compile.hpp"
#include "law_tree.hpp"

namespace feltgate::judge {

struct Verdict {
  std::string failure;  ///< empty: none
  std::int64_t runs = 0;
  std::int64_t turned =
      0;  ///< where only a comparison within its declared strip explains the words
  std::string first_turned;                  ///< the first of those
  std::int64_t aimed = 0, aimed_turned = 0;  ///< the same of runs that were aimed at a comparison
  int unread_states = 0;  ///< states that no step reads; their words are not judged
  double worst = 0;  ///< largest distance of a torque from its law, by the bound, without those
};

/// The words of `compiled` against `law`: torques, events, states and lines of every run. Ends at
/// the first failure.
Verdict judge(const Law& law, const Printer& printer, const feltgate::law::Compiled& compiled,
              std::uint64_t seed, int runs);

}  // namespace feltgate::judge
