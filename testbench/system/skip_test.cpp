// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The twin from event to event against the twin clock by clock: the same outputs, registers read
// back and gate times, on long random runs. Documentation: docs/blocks/feltgate_core.md
#include <vector>

#include "../feltgate_core/core_stimulus.hpp"
#include "catch.hpp"
#include "feltgate/feltgate_core.hpp"
#include "feltgate/generated/lever.hpp"
#include "feltgate/generated/paper.hpp"
#include "mismatch.hpp"

namespace {

using namespace feltgate;

/// Inputs that hold for some clocks.
struct Stretch {
  CoreIn in;
  std::int64_t clocks = 0;
};

bool same(const CoreIn& a, const CoreIn& b) {
  return a.encoder == b.encoder && a.arm == b.arm && a.stop == b.stop && a.set_zero == b.set_zero &&
         a.scene == b.scene && a.reg_addr == b.reg_addr && a.reg_wdata == b.reg_wdata &&
         a.reg_write == b.reg_write;
}

/// FNV-1a over what a tick shows.
struct Hash {
  std::uint64_t value = 0xcbf29ce484222325u;
  void add(std::int64_t v) {
    for (int k = 0; k < 8; ++k) {
      value = (value ^ (static_cast<std::uint64_t>(v) >> (8 * k) & 0xffu)) * 0x100000001b3u;
    }
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

/// Stretches end with the inputs, or after `longest` clocks at most.
template <class D>
void compare(std::uint64_t seed, std::int64_t clocks, std::uint32_t longest = 40'000) {
  test::CoreStimulus<D> stimulus(seed);
  test::Random cut(seed);
  FeltgateCore<D> by_clock, by_event;
  Hash clock_hash, event_hash;
  std::int64_t done = 0, stretches = 0;
  CoreIn in = stimulus(0);
  while (done < clocks) {
    // As long as the inputs hold; a strobe lasts one clock.
    Stretch s{in, 0};
    const auto limit = static_cast<std::int64_t>(1 + cut.below(longest));
    do {
      ++s.clocks;
      in = stimulus(done + s.clocks);
    } while (same(in, s.in) && !s.in.reg_write && !s.in.set_zero && s.clocks < limit);
    for (std::int64_t k = 0; k < s.clocks; ++k) {
      by_clock.clock(s.in);
      if (by_clock.out().snapshot_valid) clock_hash.add(by_clock.out());
    }
    if (s.in.reg_write || s.in.set_zero) {
      by_event.clock(s.in);
      if (by_event.out().snapshot_valid) event_hash.add(by_event.out());
    } else {
      by_event.run(s.in, s.clocks, [&] { event_hash.add(by_event.out()); });
    }
    done += s.clocks;
    ++stretches;
    if (!(by_clock.out() == by_event.out()) || clock_hash.value != event_hash.value ||
        by_clock.gate_clocks() != by_event.gate_clocks()) {
      INFO("seed " << seed << ", after clock " << done << ", stretch of " << s.clocks);
      CHECK(clock_hash.value == event_hash.value);
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
}

}  // namespace

TEST_CASE("skipping from event to event changes nothing") {
  for (const std::uint64_t seed : {21u, 22u, 23u}) {
    compare<Lever>(seed, test::scaled_clocks(8'000'000));
    compare<Paper>(seed + 100, test::scaled_clocks(8'000'000));
  }
}

TEST_CASE("nor does stopping anywhere in a tick") {
  for (const std::uint32_t longest : {7u, 40u, 120u}) {
    compare<Lever>(longest, test::scaled_clocks(3'000'000), longest);
    compare<Paper>(longest + 1, test::scaled_clocks(3'000'000), longest);
  }
}
