// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Two twins of the core with one stimulus, one from event to event and one clock by clock: the same
// outputs, registers read back and gate times. Documentation: docs/architecture.md
#pragma once

#include <cstdint>
#include <initializer_list>
#include <set>

#include "catch.hpp"
#include "feltgate/feltgate_core.hpp"
#include "feltgate/generated/causes.hpp"
#include "feltgate/generated/link.hpp"
#include "mismatch.hpp"
#include "random.hpp"
#include "sim/backends/fnv1a.hpp"
#include "twins.hpp"

namespace feltgate::test {

/// Inputs that hold for some clocks.
struct Stretch {
  CoreIn in;
  std::int64_t clocks = 0;
};

inline bool same(const CoreIn& a, const CoreIn& b) {
  return a.encoder == b.encoder && a.encoder_data == b.encoder_data && a.hall == b.hall &&
         a.current_data == b.current_data && a.driver_fault == b.driver_fault && a.arm == b.arm &&
         a.stop == b.stop && a.set_zero == b.set_zero && a.scene == b.scene &&
         a.reg_addr == b.reg_addr && a.reg_wdata == b.reg_wdata && a.reg_write == b.reg_write &&
         a.law_torque == b.law_torque && a.law_late == b.law_late &&
         a.law_restart == b.law_restart && a.axis_fault == b.axis_fault &&
         a.axis_silent == b.axis_silent && a.axis_blocked == b.axis_blocked &&
         a.axis_testing == b.axis_testing && a.axis_waits == b.axis_waits;
}

/// Over what a tick shows.
struct Hash : Fnv1a {
  using Fnv1a::add;
  /// The words of a tick but the status, which is stored some clocks later.
  template <class Core>
  void add_words(const Core& core) {
    std::uint64_t words = 0;
    for (const int slot : LinkMap::slots) {
      if (slot == Map::R::status) continue;
      words = (words << 7 | words >> 57) ^ core.word(slot);
    }
    add(static_cast<std::int64_t>(words));
  }
  void add(const CoreOut& o) {
    for (const std::int64_t v :
         {std::int64_t{o.tick_count}, std::int64_t{o.position}, o.velocity, std::int64_t{o.tau_hat},
          std::int64_t{o.tau_ref}, std::int64_t{o.current_ref}, std::int64_t{o.voltage},
          std::int64_t{o.duty}, std::int64_t{o.duty_active}, std::int64_t{o.limits},
          std::int64_t{o.faults}, std::int64_t{o.first_fault}, std::int64_t{o.scene},
          std::int64_t{o.armed}}) {
      add(v);
    }
  }
};

/// The I2t sum, by what budgets it trips in a copy, which goes on clock by clock: no output shows
/// it.
template <class D>
std::uint32_t heat_of(FeltgateCore core) {
  const auto write = [&core](int address, std::uint32_t word) {
    CoreIn in;
    while (core.out().reg_busy) core.clock(in);
    in.reg_addr = static_cast<std::uint16_t>(address);
    in.reg_wdata = word;
    in.reg_write = true;
    core.clock(in);
    in.reg_write = false;
    for (int k = 0; k < 2 * D::clocks_per_tick; ++k) core.clock(in);
  };
  write(D::C::control, static_cast<std::uint32_t>(D::control_reset) | 1u << D::C::control_host);
  write(D::A::nominal_current_squared, 0);  // it does not cool from here on
  std::uint32_t heat = 0;
  for (std::uint32_t bit = 1u << 31; bit != 0; bit >>= 1) {
    FeltgateCore tried = core;
    write(D::A::i2t_budget, 0xffffffffu);
    write(D::C::command, 1u << D::C::command_clear_faults);
    write(D::A::i2t_budget, heat | bit);
    const bool hot = (core.out().faults >> static_cast<int>(Fault::i2t) & 1u) != 0;
    if (hot) heat |= bit;
    core = tried;
  }
  return heat;
}

/// What a run has come across.
struct Met {
  std::set<int> faults;  ///< first causes
  std::int64_t ticks = 0, whole = 0, settled = 0;
  int resets = 0, flips = 0;
};

/// Stretches end with the inputs, or after `longest` clocks at most; one of two ends with its tick.
template <class D, bool ReadBack = true, class Stimulus>
void compare_by_event(Stimulus stimulus, std::uint64_t seed, std::int64_t clocks,
                      std::uint32_t longest, Met* met = nullptr) {
  Random cut(seed);
  test::CoreOf<D, ReadBack> by_clock, by_event;
  Hash clock_hash, event_hash;
  const bool words = ReadBack && seed % 2 == 1;
  std::int64_t done = 0, stretches = 0;
  CoreIn in = stimulus(0);
  const auto seldom = 400'000 / (longest < 50 ? longest : 50);
  while (done < clocks) {
    if (met != nullptr && cut.one_in(seldom)) {
      by_clock.reset(), by_event.reset();
      clock_hash = event_hash = {};
      ++met->resets;
    }
    if (met != nullptr && by_clock.clock_of_tick() == 0 && cut.one_in(seldom / 20)) {
      // Words that the stimulus writes again.
      const int words[] = {D::A::overspeed, D::A::i2t_budget, D::A::watchdog_ticks};
      const int word = words[cut.below(3)], bit = static_cast<int>(cut.below(36));
      by_clock.flip(word, bit), by_event.flip(word, bit);
      ++met->flips;
    }
    // As long as the inputs hold; a strobe lasts one clock.
    Stretch s{in, 0};
    auto limit = static_cast<std::int64_t>(1 + cut.below(longest));
    if (met != nullptr && cut.coin()) limit = D::clocks_per_tick - by_clock.clock_of_tick();
    do {
      ++s.clocks;
      in = stimulus(done + s.clocks);
    } while (same(in, s.in) && !s.in.reg_write && !s.in.set_zero && s.clocks < limit);
    const bool strobe = s.in.reg_write || s.in.set_zero;
    const CoreOut before = by_clock.out();
    for (std::int64_t k = 0; k < s.clocks; ++k) {
      by_clock.clock(s.in);
      const CoreOut& now = by_clock.out();
      if (now.snapshot_valid) {
        clock_hash.add(now), clock_hash.add(1);
        if (words) clock_hash.add_words(by_clock);
      }
    }
    if (met != nullptr && before.first_fault != 0) met->faults.insert(before.first_fault);
    const auto note = [&] {
      event_hash.add(by_event.out());
      event_hash.add(by_event.out().snapshot_valid);
      if (words) event_hash.add_words(by_event);
    };
    bool settled = true;
    if (strobe || (met != nullptr && cut.one_in(16))) {
      for (std::int64_t k = 0; k < s.clocks; ++k) {
        by_event.clock(s.in);
        if (by_event.out().snapshot_valid) note();
      }
    } else if (cut.coin()) {
      by_event.run(s.in, s.clocks, note);
    } else {
      by_event.advance(s.in, s.clocks, note);
      settled = false;
    }
    done += s.clocks;
    ++stretches;
    const CoreOut &a = by_clock.out(), &b = by_event.out();
    if (by_clock.clock_of_tick() != by_event.clock_of_tick() || a.gates != b.gates ||
        a.duty_active != b.duty_active || a.gates_enable != b.gates_enable || a.armed != b.armed) {
      INFO("seed " << seed << ", after clock " << done << ", stretch of " << s.clocks);
      FAIL("what is told amid a tick differs");
    }
    if ((settled && !(a == b)) || clock_hash.value() != event_hash.value() ||
        by_clock.gate_clocks() != by_event.gate_clocks()) {
      INFO("seed " << seed << ", after clock " << done << ", stretch of " << s.clocks);
      CHECK(clock_hash.value() == event_hash.value());
      CHECK(by_clock.gate_clocks() == by_event.gate_clocks());
      CHECK(by_clock.out().tick_count == by_event.out().tick_count);
      CHECK(by_clock.out().velocity == by_event.out().velocity);
      CHECK(by_clock.out().limits == by_event.out().limits);
      CHECK(by_clock.out().reg_rdata == by_event.out().reg_rdata);
      CHECK(by_clock.out().faults == by_event.out().faults);
      CHECK(by_clock.out().gates == by_event.out().gates);
      FAIL("the twin by events differs from the twin by clocks");
    }
  }
  CHECK(stretches > 100);
  if (met != nullptr) {
    met->ticks += done / D::clocks_per_tick;
    met->whole += by_event.whole_ticks();
    met->settled += by_event.settled_ticks();
  }
  INFO("seed " << seed);
  CHECK(heat_of<D>(by_clock) == heat_of<D>(by_event));
}

}  // namespace feltgate::test
