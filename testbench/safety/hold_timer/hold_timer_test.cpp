// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// hold_timer: RTL against twin on every clock, and its course by hand.
// Documentation: docs/blocks/supervisor.md
#include <Vhold_timer.h>

#include <algorithm>
#include <vector>

#include "catch.hpp"
#include "feltgate/hold_timer.hpp"
#include "lock_step.hpp"
#include "ports.hpp"

namespace feltgate {

class HoldTimer {
 public:
  struct In {
    bool armed = false;
    std::uint64_t wave = 0;
    std::uint32_t tick_count = 0;
    std::uint32_t param = 0;
    bool moved = false;
    bool over_limit = false;
  };
  struct Out {
    bool derated = false;
  };

  void reset() {
    law_ = {};
    strong_ = false;
    out_ = {};
  }

  void clock(const In& in) {
    const auto at = [&in](int t) { return ((in.wave >> t) & 1u) != 0; };
    if (at(Map::T::hold)) {
      law_.tick(in.armed, in.moved, strong_, in.tick_count, in.param);
      out_.derated = law_.derated();
    }
    if (at(Map::T::hold_strong)) strong_ = in.over_limit;
  }

  const Out& out() const { return out_; }

 private:
  HoldTimerLaw law_;
  bool strong_ = false;
  Out out_;
};

}  // namespace feltgate

using namespace feltgate;
using namespace feltgate::test;

namespace {

using Twin = HoldTimer;

struct Adapter {
  static void drive(Vhold_timer& rtl, const Twin::In& in) {
    FELTGATE_DRIVE(rtl, in, armed, tick_count, param, moved, over_limit);
    FELTGATE_STROBES(rtl, in.wave, at, T, hold_strong, hold);
  }
  template <class Check>
  static void compare(Check& check, const Vhold_timer& rtl, const Twin::Out& out) {
    check("derated", rtl.derated_o, out.derated);
  }
};
using Bench = LockStep<Vhold_timer, Twin, Adapter>;

/// What one tick works on.
struct Tick {
  bool armed = true, moved = false, strong = true;
  std::uint32_t tick = 0, hold_time = 3;
};

/// Ticks of two clocks: that of the comparison, that of the word; each lasts as long as a unit
/// where `units` is set, by the count of ticks.
std::vector<Twin::In> inputs(const std::vector<Tick>& ticks) {
  std::vector<Twin::In> list(8);
  for (const Tick& t : ticks) {
    Twin::In in{t.armed, std::uint64_t{1} << Map::T::hold_strong, t.tick, ~t.hold_time, t.moved,
                t.strong};
    list.push_back(in);
    in.wave = std::uint64_t{1} << Map::T::hold;
    in.param = t.hold_time;
    in.over_limit = !t.strong;
    list.push_back(in);
  }
  return list;
}

/// Runs ticks, each the whole of a unit; whether the torque was eased after each.
std::vector<bool> play(std::vector<Tick> ticks) {
  HoldTimerLaw law;
  std::vector<bool> derated;
  std::uint32_t k = 0;
  for (Tick& t : ticks) {
    t.tick = k++ << Map::hold_unit_bits;
    law.tick(t.armed, t.moved, t.strong, t.tick, t.hold_time);
    derated.push_back(law.derated());
  }
  Bench bench("hold_timer", 1);
  bench.run_list(inputs(ticks));
  return derated;
}

std::vector<Tick> ticks(int n, Tick each = {}) { return std::vector<Tick>(n, each); }

struct Stimulus {
  Random random;
  Twin::In in{};
  Tick now{};
  int clock = 0;

  Twin::In operator()(std::int64_t) {
    if (clock == 0) tick();
    const bool word = clock == 2;
    in.wave = clock == 0 ? std::uint64_t{1} << Map::T::hold_strong
              : word     ? std::uint64_t{1} << Map::T::hold
                         : random.bits() & ~(std::uint64_t{1} << Map::T::hold_strong |
                                         std::uint64_t{1} << Map::T::hold);
    in.param = word ? now.hold_time : static_cast<std::uint32_t>(random.bits());
    in.over_limit = clock == 0 ? now.strong : random.coin();
    clock = clock == 3 ? 0 : clock + 1;
    return in;
  }
  void tick() {
    // Mostly whole units, so that times pass; else beside one by a single bit, or any.
    now.tick += 1u << Map::hold_unit_bits;
    if (random.one_in(12)) now.tick = static_cast<std::uint32_t>(random.bits());
    if (!random.one_in(12)) now.tick &= ~((1u << Map::hold_unit_bits) - 1);
    if (random.one_in(6)) now.tick += 1u << random.below(Map::hold_unit_bits);
    if (random.one_in(60)) now.armed = !random.one_in(5);
    now.moved = random.one_in(rare ? 20000 : 40);
    if (random.one_in(rare ? 4000 : 30)) now.strong = !random.one_in(5);
    if (random.one_in(100)) {
      now.hold_time = static_cast<std::uint32_t>(random.below(40));
      if (random.one_in(3)) now.hold_time += 1u << (Map::hold_bits + random.below(19));
    }
    if (random.one_in(30000)) rare = !rare;
    if (rare) now.armed = true;
    in.armed = now.armed;
    in.moved = now.moved;
    in.tick_count = now.tick;
  }
  bool rare = false;
};

}  // namespace

TEST_CASE("hold_timer: random torques, counts, times, arming and resets") {
  std::int64_t derated = 0, given_back = 0;
  bool before = false;
  Bench bench("hold_timer", 1);
  bench.run(Stimulus{Random(2)}, scaled_clocks(2000000), {50000},
            [&, before](const Twin::In&, const Vhold_timer& rtl, const Twin&,
                        bool in_reset) mutable -> const char* {
              const bool now = rtl.derated_o != 0;
              derated += now && !before;
              given_back += !now && before && !in_reset;
              before = now;
              return nullptr;
            });
  INFO(derated << " times eased, " << given_back << " times given back");
  REQUIRE(derated > 800);
  REQUIRE(given_back > 800);
}

TEST_CASE("hold_timer: after its time a torque is eased, and stays so while it is weak") {
  auto list = ticks(10);
  const auto weak = ticks(100, {true, false, false});
  list.insert(list.end(), weak.begin(), weak.end());
  const auto derated = play(list);
  for (std::size_t k = 0; k < derated.size(); ++k) REQUIRE(derated[k] == (k >= 3));
}

TEST_CASE("hold_timer: a count gives the torque back, and the time begins anew") {
  auto list = ticks(13);
  list[7].moved = true;
  const auto derated = play(list);
  for (std::size_t k = 0; k < derated.size(); ++k) {
    REQUIRE(derated[k] == ((k >= 3 && k < 7) || k >= 11));
  }
}

TEST_CASE("hold_timer: disarming gives the torque back") {
  auto list = ticks(13);
  list[7].armed = false;
  const auto derated = play(list);
  for (std::size_t k = 0; k < derated.size(); ++k) {
    REQUIRE(derated[k] == ((k >= 3 && k < 7) || k >= 11));
  }
}

TEST_CASE("hold_timer: a count, a weak torque or a pause in time begins anew") {
  for (const bool by_count : {true, false}) {
    std::vector<Tick> list;
    for (int k = 0; k < 60; ++k) {
      Tick t;
      if (k % 3 == 2) (by_count ? t.moved : t.strong) = by_count;
      list.push_back(t);
    }
    for (const bool derated : play(list)) REQUIRE_FALSE(derated);
  }
}

TEST_CASE("hold_timer: a time of 2^13 units or more is for ever") {
  constexpr std::uint32_t kFirst = 1u << Map::hold_bits;
  for (const std::uint32_t time : {kFirst, kFirst + 3, 0x40000000u, 0x7fffffffu}) {
    for (const bool derated :
         play(ticks(2 * static_cast<int>(kFirst) + 9, {true, false, true, 0, time}))) {
      if (derated) FAIL("eased with " << time);
    }
  }
  const auto longest =
      play(ticks(static_cast<int>(kFirst) + 9, {true, false, true, 0, kFirst - 1}));
  for (std::size_t k = 0; k < longest.size(); ++k) {
    if (longest[k] != (k >= kFirst - 1)) FAIL("after " << k);
  }
}

TEST_CASE("hold_timer: a negative time is none") {
  for (const std::uint32_t time : {0x80000000u, 0xffffffffu}) {
    for (const bool derated : play(ticks(5, {true, false, true, 0, time}))) REQUIRE(derated);
    for (const bool derated : play(ticks(5, {true, false, false, 0, time}))) REQUIRE_FALSE(derated);
  }
}

TEST_CASE("hold_timer: every unit counts, one less than the time is never enough") {
  auto list = ticks(1 << Map::hold_bits);
  std::uint32_t units = 0;
  for (Tick& t : list) t.hold_time = ++units;
  list.back().hold_time = units - 1;
  const auto derated = play(list);
  for (std::size_t k = 0; k < derated.size(); ++k) {
    if (derated[k] != (k + 1 == derated.size())) FAIL("after " << k);
  }
}
