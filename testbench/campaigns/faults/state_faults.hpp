// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Bits of the core's state flip for one clock. The core runs in closed loop beside a sound core on
// the same lever. Documentation: docs/testing.md
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "campaigns/faults/outcome.hpp"

namespace feltgate::faults {

/// One bit of state: of a flip-flop, of a parameter's word, or of the line of travels.
struct StateBit {
  enum class Kind { flop, parameter, line };
  Kind kind = Kind::flop;
  std::string name;  ///< register, or word
  int at = 0;        ///< bit number in flip_i, or address
  int bit = 0;
  std::string group;   ///< group in the report
  bool safety = true;  ///< the bit counts for the share of silent faults
};
std::vector<StateBit> state_bits();

struct StateFault {
  std::size_t act = 0;
  std::int64_t tick = 0;          ///< ticks since the beginning of the act
  int clock = 0;                  ///< clock of the tick; the bit is flipped after its edge
  std::vector<std::size_t> bits;  ///< indices into state_bits(); two for a double flip
  bool stuck = false;             ///< the first bit stays 1: a broken product, not a flip
  int reset_clocks = 0;           ///< not 0: a reset of so many clocks (brown-out), no flip
};

struct StateCampaign {
  std::string root;
  std::uint64_t seed = 1;
  int flips_per_bit = 4;
  int doubles = 0;
  int resets = 0;
  std::string only;        ///< only registers whose name contains this text; empty: all
  std::size_t acts = 100;  ///< largest number of acts
};

struct StateResult {
  StateFault fault;
  Outcome outcome;
};

std::vector<StateFault> plan(const StateCampaign& campaign);
/// Runs the faults and calls back after each one, in the order of acts and ticks. Returns the
/// number of ticks in which the sound core and the twin differed; it must be 0.
std::int64_t run(const StateCampaign& campaign, std::vector<StateFault> faults,
                 const std::function<void(const StateResult&)>& each);

}  // namespace feltgate::faults
