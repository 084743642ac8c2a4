// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// scenes: RTL against twin on every clock, clock() against tick(), selection, limit and ramp, and
// the distance from the laws in 113-bit arithmetic. Documentation: docs/blocks/scenes.md
#include "catch.hpp"
#include "scenes_bench.hpp"

using namespace feltgate;
using namespace feltgate::test;

namespace {

constexpr bool kAll = Built::scene_mask == Design::scene_mask;

/// Scenes, arming, words and motion at random.
struct Next {
  Random random;
  Wave wave{};
  Wave operator()(Memory& memory, std::int64_t) {
    if (random.one_in(25)) wave.scene = static_cast<int>(random.below(10));
    if (random.one_in(50)) wave.scene = static_cast<int>(random.below(16));
    if (random.one_in(20)) wave.armed = !random.one_in(4);
    if (random.one_in(40)) write(memory);
    if (random.one_in(3)) {
      wave.position = any_position(random, memory, wave.scene);
    } else {
      wave.position = std::clamp(wave.position + static_cast<std::int32_t>(random.between(-40, 40)),
                                 -131072, 131071);
    }
    wave.velocity = static_cast<std::int32_t>(random.bits()) >> random.below(16);
    wave.length = random.one_in(50) ? 50 : static_cast<int>(random.between(30, 33));
    return wave;
  }
  void write(Memory& memory) {
    memory.write(A::torque_limit, random.one_in(8) ? any_word(random) : random.below(80000));
    memory.write(A::ramp_step, random.one_in(8)
                                   ? any_word(random)
                                   : random.below(std::uint64_t{1} << random.below(25)));
    memory.write(A::setpoint_torque, random.between(-60000, 60000));
    memory.write(A::membrane_torque, random.below(60000));
    memory.write(A::tension_rest, random.between(-300000, 300000));
    memory.write(A::attract_core, random.below(400));
    memory.write(static_cast<int>(random.below(512)), any_word(random));
  }
};

/// Waves that a test lists by number.
template <class F>
struct Listed {
  F f;
  Wave operator()(Memory& memory, std::int64_t number) { return f(memory, number); }
};

/// What the RTL showed after each wave.
struct Seen {
  std::int64_t tau = 0;
  bool ramp = false, limit = false;
};

struct Keep {
  std::vector<Seen>* seen;
  TickBeside beside;
  void forget() { beside.forget(); }
  const char* operator()(const Probe& p, const Vscenes& rtl, const Twin& twin) {
    seen->push_back({sign_extend<kTorque.width()>(rtl.tau_ref_o), rtl.limit_ramp_o != 0,
                     rtl.limit_torque_o != 0});
    return beside(p, rtl, twin);
  }
};

template <class F>
std::vector<Seen> play(F f, int waves) {
  std::vector<Seen> seen;
  Tally tally;
  const auto probe = std::make_shared<Probe>();
  Bench bench("scenes", 7);
  bench.run(Waves<Block, Listed<F>>(2, {f}, probe), 30 * waves + 32, {},
            AfterWave<Keep>(probe, {&seen, {&tally}}));
  return seen;
}

Wave wave(int scene, std::int32_t position = 0, bool armed = true) {
  Wave w;
  w.scene = scene;
  w.position = position;
  w.armed = armed;
  w.length = 30;
  return w;
}

}  // namespace

TEST_CASE("scenes: everything at random") {
  Tally tally;
  const auto probe = std::make_shared<Probe>();
  Bench bench("scenes", 1);
  bench.run(Waves<Block, Next>(2, Next{Random(3)}, probe), scaled_clocks(4000000), {10000},
            AfterWave<TickBeside>(probe, {&tally}));
  INFO("waves " << tally.waves << ", disarmed " << tally.disarmed << ", limited " << tally.limited
                << ", ramping " << tally.ramping << ", free " << tally.free << ", ends "
                << tally.ends);
  REQUIRE(tally.waves > 100000);
  REQUIRE(tally.disarmed > tally.waves / 10);
  REQUIRE(tally.ramping > tally.waves / 10);
  REQUIRE(tally.free > tally.waves / (kAll ? 10 : 5));
  REQUIRE(tally.ends > 300);
  REQUIRE(tally.limited > 500);
  for (int scene = 0; scene < 16; ++scene) {
    CAPTURE(scene, tally.acting[static_cast<std::size_t>(scene)]);
    const bool acts = scene != S::free && scene_built<Built>(scene);
    if (acts) REQUIRE(tally.acting[static_cast<std::size_t>(scene)] > 300);
  }
}

TEST_CASE("scenes: arming inside a scene ramps at the set rate, then nothing is slowed") {
  constexpr std::int64_t step = 1000;  // of 2^-24 Nm
  const auto seen = play(
      [](Memory& memory, std::int64_t k) {
        memory.write(A::ramp_step, step);
        memory.write(A::tension_rest, 0);
        return wave(S::spring_tension, k < 2000 ? -50 : (k % 2 != 0 ? -300 : 300), k >= 10);
      },
      2020);
  REQUIRE(seen.size() >= 2019);
  Memory memory;
  const std::int64_t k = memory.word(A::tension_stiffness) & 0x1ffff;
  const int drop = Design::P::tension_stiffness.fraction - kTorque.fraction;
  const std::int64_t target = (50 * k + (std::int64_t{1} << (drop - 1))) >> drop;
  for (std::int64_t n = 0; n < 10; ++n) REQUIRE(seen[static_cast<std::size_t>(n)].tau == 0);
  std::int64_t ramp = 0;
  std::size_t n = 10;
  for (; target * 256 - ramp > step; ++n) {
    ramp += step;
    REQUIRE(seen[n].tau == ramp / 256);
    REQUIRE(seen[n].ramp);
  }
  REQUIRE(seen[n].ramp);  // the tick that finds the target within a step
  REQUIRE(seen[n].tau == ramp / 256);
  for (++n; n < 2000; ++n) {
    REQUIRE_FALSE(seen[n].ramp);
    REQUIRE(seen[n].tau == target);
  }
  for (; n < 2018; ++n) {
    REQUIRE((seen[n].tau > 0) == (n % 2 != 0));  // 600 counts per tick, and nothing is slowed
    REQUIRE(seen[n].tau != target);
  }
}

TEST_CASE("scenes: a change of scene ramps from where the torque is") {
  constexpr std::int64_t step = 256 * 100;
  const auto seen = play(
      [](Memory& memory, std::int64_t k) {
        memory.write(A::ramp_step, step);
        memory.write(A::torque_limit, 30000);
        return wave(k < 400 || k >= 600 ? S::spring_tension : S::free, -2000);
      },
      800);
  REQUIRE(seen[399].tau == 30000);
  REQUIRE(seen[399].limit);
  REQUIRE_FALSE(seen[399].ramp);
  for (std::size_t n = 400; n < 600; ++n) {
    REQUIRE(seen[n].tau == 30000 - 100 * static_cast<std::int64_t>(n - 399));
    REQUIRE(seen[n].ramp);
  }
  // Changed back on the way: up again from there.
  REQUIRE(seen[600].tau == seen[599].tau + 100);
  REQUIRE(seen[601].tau == seen[599].tau + 200);
}

TEST_CASE("scenes: disarming takes the torque away at once") {
  const auto seen = play(
      [](Memory& memory, std::int64_t k) {
        memory.write(A::ramp_step, 256 * 5000);
        return wave(S::spring_tension, -2000, k < 50);
      },
      60);
  REQUIRE(seen[49].tau == 32768);
  for (std::size_t n = 50; n < seen.size(); ++n) REQUIRE(seen[n].tau == 0);
}

TEST_CASE("scenes: both limits are the same size; a negative limit or step counts as 0") {
  for (const int sign : {1, -1}) {
    const auto seen = play(
        [sign](Memory& memory, std::int64_t k) {
          memory.write(A::ramp_step, k < 100 ? 256 * 30000 : -1);
          memory.write(A::torque_limit, k < 50 ? 12345 : -5);
          return wave(k < 70 || k > 90 ? S::spring_tension : S::free, -2000 * sign);
        },
        200);
    REQUIRE(seen[40].tau == 12345 * sign);
    REQUIRE(seen[40].limit);
    REQUIRE(seen[60].tau == 0);
    REQUIRE(seen[199].tau == 0);
  }
}

#ifndef FELTGATE_SCENE_MASK
#include "reference_cases.hpp"
#endif
