// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Bits of the core's state that flip for one clock, in closed loop, beside a sound core on the same
// lever. Documentation: docs/verification.md
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "faults/outcome.hpp"

namespace feltgate::faults {

/// One bit of state: of a flip-flop, of a parameter's word, or of the line of travels.
struct StateBit {
  enum class Kind { flop, parameter, line };
  Kind kind = Kind::flop;
  std::string name;  ///< register, or word
  int at = 0;        ///< bit of flip_i, or address
  int bit = 0;
  std::string group;   ///< of the report
  bool safety = true;  ///< counts for the share of silent faults
};
std::vector<StateBit> state_bits();

struct StateFault {
  std::size_t act = 0;
  std::int64_t tick = 0;          ///< since the act's beginning
  int clock = 0;                  ///< of the tick, the edge after which the bit is the other
  std::vector<std::size_t> bits;  ///< indices of state_bits(); two of a double flip
  bool stuck = false;             ///< the first stays 1: a broken product, not a flip
  int reset_clocks = 0;           ///< instead: so long a reset, as a brown-out makes it
};

struct StateCampaign {
  std::string root;
  std::uint64_t seed = 1;
  int flips_per_bit = 4;
  int doubles = 0;
  int resets = 0;
  std::string only;        ///< registers whose name has this in it; empty: all
  std::size_t acts = 100;  ///< so many of them at most
};

struct StateResult {
  StateFault fault;
  Outcome outcome;
};

std::vector<StateFault> plan(const StateCampaign& campaign);
/// Runs the faults; told of each as it ends, in the order of acts and ticks.
/// Returns ticks in which the sound core and the twin differed: 0.
std::int64_t run(const StateCampaign& campaign, std::vector<StateFault> faults,
                 const std::function<void(const StateResult&)>& each);

}  // namespace feltgate::faults
