// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The schedule steps at which an output or register of the core changes, sorted by clock of the
// tick. The core's twin executes a tick in this order. Documentation: docs/architecture.md
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "feltgate/generated/link.hpp"
#include "feltgate/generated/map.hpp"

namespace feltgate::core_steps {

using Step = Map::Step;

/// The clock of the tick for wave clock t.
constexpr int clock_of(int t) { return t + Map::first_wave_clock; }

/// Whether a step changes something that the core shows; the others are inside a law or a block.
constexpr bool shows(Step step) {
  switch (step) {
    case Step::read_tick:
    case Step::read_position:
    case Step::read_status:
    case Step::read_faults:
    case Step::read_velocity:
    case Step::read_index:
    case Step::read_encoder:
    case Step::read_tau_hat:
    case Step::read_tau_ref:
    case Step::read_current_ref:
    case Step::read_voltage:
    case Step::read_duty:
    case Step::sample:
    case Step::levels:
    case Step::channel:
    case Step::ramp_begin:
    case Step::velocity_raw:
    case Step::operand_inverse_resistance:
    case Step::operand_emf_over_resistance:
    case Step::velocity:
    case Step::speed:
    case Step::heat:
    case Step::polarity:
    case Step::tau_hat:
    case Step::law_torque:
    case Step::ramp_excess:
    case Step::tau_ref:
    case Step::current_limited:
    case Step::hold:
    case Step::current:
    case Step::voltage:
    case Step::duty:
    case Step::self_test:
    case Step::watchdog:
    case Step::snapshot:
      return true;
    default:
      return false;
  }
}

/// Number of steps for which shows() holds.
constexpr std::size_t count() {
  std::size_t n = 0;
  for (const Map::StepAt& s : Map::steps) n += shows(s.step) ? 1 : 0;
  return n;
}

/// The steps in the order of execution, with their clocks.
struct Table {
  std::array<Step, count()> steps{};
  /// clock of each step in the tick, ascending
  std::array<int, count()> clocks{};
  std::array<std::uint8_t, Map::wave_length + 1> first{};  ///< by clock: first step not before it
};

constexpr Table make_table() {
  Table table{};
  std::size_t n = 0;
  for (int clock = 0; clock < Map::wave_length; ++clock) {
    table.first[static_cast<std::size_t>(clock)] = static_cast<std::uint8_t>(n);
    for (const Map::StepAt& s : Map::steps) {
      // The outputs belong to one tick in the clock of this step, so it acts after the clock
      // before.
      const int at = clock_of(s.clock) - (s.step == Step::snapshot ? 1 : 0);
      if (!shows(s.step) || at != clock) continue;
      table.steps[n] = s.step;
      table.clocks[n++] = at;
    }
  }
  table.first[Map::wave_length] = static_cast<std::uint8_t>(n);
  return table;
}
inline constexpr Table table = make_table();
/// Whether a word is stored in the snapshot in this clock of a tick.
constexpr bool stores_word(int clock) {
  for (const int slot : LinkMap::slots) {
    if (clock == clock_of(slot)) return true;
  }
  return false;
}

static_assert(table.first[Map::wave_length] == count(), "a step lies beyond the shortest tick");

/// Calls action(step) for the steps of one clock of a tick, in order.
template <class Action>
void for_each_step_of(int clock, Action&& action) {
  if (clock >= Map::wave_length) return;
  const auto at = static_cast<std::size_t>(clock);
  for (std::size_t k = table.first[at]; k < table.first[at + 1]; ++k) action(table.steps[k]);
}

template <class Action, std::size_t... K>
[[gnu::always_inline]] inline void for_these_steps(int from, int to, Action&& action,
                                                   std::index_sequence<K...>) {
  const auto within = [from, to](int clock) { return from <= clock && clock < to; };
  ((within(table.clocks[K]) ? action(table.steps[K]) : void()), ...);
}
/// Calls action(step) for the steps in the clocks [from, to) of a tick, in order. The loop is
/// unrolled, so that each step is a constant in an inlined action, and a whole tick needs no
/// comparisons.
template <class Action>
[[gnu::always_inline]] inline void for_each_step(int from, int to, Action&& action) {
  for_these_steps(from, to, action, std::make_index_sequence<count()>());
}

}  // namespace feltgate::core_steps
