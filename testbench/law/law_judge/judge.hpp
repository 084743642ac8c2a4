// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Compares a law's words, run by the interpreter, with the law in long double.
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
      0;  ///< runs in which only a turned comparison within its declared strip explains the words
  std::string first_turned;                  ///< the first of these runs
  std::int64_t aimed = 0, aimed_turned = 0;  ///< the same for runs aimed at a comparison
  int unread_states = 0;  ///< states that no step reads; their words are not judged
  double worst = 0;  ///< largest error of a torque divided by its bound, without the turned runs
  int acting = 0;    ///< free runs in which a torque moved
  int left = 0;      ///< of these, those in which many runs were far from the law
};

/// Compares the words of `compiled` with `law`: torques, events, states and lines of every run.
/// Ends at the first failure.
Verdict judge(const Law& law, const Printer& printer, const feltgate::law::Compiled& compiled,
              std::uint64_t seed, int runs);

}  // namespace feltgate::judge
