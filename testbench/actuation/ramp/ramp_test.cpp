// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// ramp: RTL against twin on every clock, directed tests of its course, and its error against quad
// precision. Documentation: docs/blocks/torque_control.md
#include "ramp_bench.hpp"

#include <algorithm>
#include <vector>

#include "catch.hpp"
#include "feltgate/generated/causes.hpp"
#include "feltgate/largest.hpp"

using namespace feltgate;
using namespace feltgate::test;

namespace {

/// Torques that rest, drift and jump; limits and steps of every size; arming and scenes at random.
struct RandomWaves {
  Random random;
  Wave wave{};

  template <class Number>
  std::int64_t any() {
    if (random.one_in(20)) return random.coin() ? Number::max_raw() : Number::min_raw();
    const auto word = static_cast<std::int64_t>(random.bits()) >> (64 - Number::width);
    return word >> random.below(Number::width);
  }
  std::int64_t any_word(std::int64_t usual) {
    return random.one_in(8) ? static_cast<std::int64_t>(random.bits() >> 32) : usual;
  }
  Wave operator()(std::int64_t) {
    if (random.one_in(25)) wave.scene = static_cast<int>(random.below(16));
    wave.restart = random.one_in(30);
    if (random.one_in(30)) wave.armed = !random.one_in(4);
    if (random.one_in(10)) wave.pulse = static_cast<int>(random.between(-1, 1));
    if (random.one_in(20)) wave.relief.derated = random.coin();
    if (random.one_in(15)) wave.relief.frozen = random.one_in(3);
    if (random.one_in(20)) {
      wave.limit = any_word(random.below(80000));
      wave.step = any_word(random.below(std::uint64_t{1} << random.below(29)));
    }
    if (random.one_in(12)) wave.rendered = any<Rendered>();
    if (random.one_in(6)) wave.rendered = random.between(-60000, 60000);
    wave.rendered += random.between(-3, 3);
    wave.rendered = std::clamp(wave.rendered, Rendered::min_raw(), Rendered::max_raw());
    return wave;
  }
};

/// The outputs of the RTL after each wave.
struct Seen {
  std::int64_t tau = 0;
  bool ramp = false, limit = false;
};

template <class Next>
std::vector<Seen> play(Next next, int waves) {
  std::vector<Seen> seen;
  Tally tally;
  ChainBeside beside{&tally};
  const auto keep = [&seen, beside](const Twin::In& in, const Vramp& rtl, const Twin& twin,
                                    bool in_reset) mutable {
    if (!in_reset && at(in, Map::T::tau_ref)) {
      seen.push_back({sign_extend<Torque::width>(rtl.tau_ref_o), rtl.limit_ramp_o != 0,
                      rtl.limit_torque_o != 0});
    }
    return beside(in, rtl, twin, in_reset);
  };
  Bench bench("ramp", 7);
  bench.run(Waves<Next>(2, next, 1), Waves<Next>::kShortest * waves + 10, {}, keep);
  REQUIRE(seen.size() >= static_cast<std::size_t>(waves));
  return seen;
}

Wave wave(std::int64_t rendered, std::int64_t step, bool armed = true, int scene = 0) {
  Wave w;
  w.armed = armed;
  w.scene = scene;
  w.rendered = rendered;
  w.step = step;
  return w;
}

constexpr std::int64_t kWhole = std::int64_t{1} << kFine;  // a step of one LSB of tau_ref

}  // namespace

TEST_CASE("ramp: random torques, limits, steps, arming, scenes and resets") {
  Tally t;
  Bench bench("ramp", 1);
  bench.run(Waves<RandomWaves>(2, {Random(3)}, 25), scaled_clocks(1500000), {20000},
            ChainBeside{&t});
  bench.run(Waves<RandomWaves>(4, {Random(5)}, 1), scaled_clocks(500000), {400}, ChainBeside{&t});
  INFO("waves " << t.waves << ", disarmed " << t.disarmed << ", free " << t.free << ", limited "
                << t.limited[0] << " " << t.limited[1] << ", ramping " << t.ramping[0] << " "
                << t.ramping[1] << ", ended " << t.ended[0] << " " << t.ended[1] << ", held "
                << t.held << ", scene changes " << t.scene_changes << ", restarts " << t.restarts
                << ", negative step " << t.negative_step << ", negative limit "
                << t.negative_limit);
  REQUIRE(t.waves > 40000);
  REQUIRE(t.disarmed * 10 > t.waves);
  REQUIRE(t.free * 10 > t.waves);
  for (const int direction : {0, 1}) {
    REQUIRE(t.limited[direction] * 50 > t.waves);
    REQUIRE(t.ramping[direction] * 50 > t.waves);
    REQUIRE(t.ended[direction] > 100);
  }
  REQUIRE(t.held * 100 > t.waves);
  REQUIRE(t.scene_changes > 300);
  REQUIRE(t.restarts > 300);
  REQUIRE(t.negative_step > 300);
  REQUIRE(t.negative_limit > 300);
  REQUIRE(t.derated_changes > 200);
  REQUIRE(t.pulsed > 300);
  REQUIRE(t.pulsed_frozen > 100);
  for (const int sign : {0, 1}) {
    REQUIRE(t.frozen[sign] > 1000);
    REQUIRE(t.fallen[sign] > 50);
  }
}

TEST_CASE(
    "ramp: arming ramps at the set rate, the tick within a step ends it, then nothing is slowed") {
  for (const std::int64_t sign : {1, -1}) {
    constexpr std::int64_t target = 30000, step = 3 * kWhole + 7;
    const auto seen = play(
        [sign](std::int64_t k) {
          const std::int64_t jump = k % 2 != 0 ? -1000 : 1000;
          return wave(sign * (k < 11000 ? target : jump), step, k >= 10);
        },
        11020);
    for (std::size_t n = 0; n < 10; ++n) REQUIRE(seen[n].tau == 0);
    std::int64_t ramp = 0;
    std::size_t n = 10;
    for (; target * kWhole - ramp > step; ++n) {
      ramp += step;
      const std::int64_t floor = sign > 0 ? ramp / kWhole : -((ramp + kWhole - 1) / kWhole);
      if (seen[n].tau != floor || !seen[n].ramp)
        FAIL("tau_ref " << seen[n].tau << " in tick " << n);
    }
    REQUIRE(seen[n].ramp);
    REQUIRE(seen[n].tau == seen[n - 1].tau);
    for (++n; n < 11000; ++n) {
      if (seen[n].tau != sign * target || seen[n].ramp) FAIL("not at the target in tick " << n);
    }
    for (; n < 11020; ++n) REQUIRE(seen[n].tau == sign * (n % 2 != 0 ? -1000 : 1000));
  }
}

TEST_CASE(
    "ramp: frozen, the reference keeps the smaller of two torques, and follows again at once") {
  for (const std::int64_t sign : {1, -1}) {
    for (const std::int64_t small : {0, 9000}) {
      const auto seen = play(
          [=](std::int64_t k) {
            Wave w = wave(sign * (k % 2 != 0 ? small : 30000), Law::Ramp::max_raw());
            w.relief.frozen = k >= 20 && k < 40;
            return w;
          },
          50);
      for (std::size_t n = 10; n < 50; ++n) {
        const bool frozen = n >= 20 && n < 40;
        REQUIRE(seen[n].tau == sign * (n % 2 != 0 || frozen ? small : 30000));
        REQUIRE((seen[n].ramp || (frozen && n % 2 != 0)) == frozen);
      }
    }
  }
}

TEST_CASE("ramp: frozen, the reference does not change its sign, from either side") {
  for (const std::int64_t sign : {1, -1}) {
    const auto seen = play(
        [=](std::int64_t k) {
          // The target goes from T to -T, to 0 and to -T.
          Wave w = wave(sign * (k < 20 ? 9000 : k == 30 ? 0 : -9000), Law::Ramp::max_raw());
          w.relief.frozen = k >= 20 && k < 40;
          return w;
        },
        50);
    for (std::size_t n = 10; n < 50; ++n) {
      REQUIRE(seen[n].tau == sign * (n < 30 ? 9000 : n < 40 ? 0 : -9000));
      REQUIRE(seen[n].ramp == (n >= 20 && n < 40 && n != 30));
    }
  }
}

TEST_CASE("ramp: another limit ramps, both ways") {
  constexpr std::int64_t step = 100 * kWhole;
  const auto seen = play(
      [](std::int64_t k) {
        Wave w = wave(30000, k < 400 ? Law::Ramp::max_raw() : step);
        w.relief.derated = k >= 400 && k < 800;
        w.limit = w.relief.derated ? 10000 : 40000;
        return w;
      },
      1100);
  REQUIRE(seen[399].tau == 30000);
  for (std::size_t n = 400; n < 599; ++n) {
    REQUIRE(seen[n].tau == 30000 - 100 * static_cast<std::int64_t>(n - 399));
  }
  for (std::size_t n = 600; n < 800; ++n) REQUIRE(seen[n].tau == 10000);
  for (std::size_t n = 800; n < 999; ++n) {
    REQUIRE(seen[n].tau == 10000 + 100 * static_cast<std::int64_t>(n - 799));
  }
  REQUIRE(seen[1099].tau == 30000);
}

TEST_CASE("ramp: a change of scene ramps from where the torque is, also on the way") {
  constexpr std::int64_t step = 100 * kWhole;
  const auto seen = play(
      [](std::int64_t k) {
        const bool spring = k < 400 || k >= 600;
        return wave(spring ? 30000 : 0, step, true, spring ? 5 : 0);
      },
      800);
  REQUIRE(seen[399].tau == 30000);
  REQUIRE_FALSE(seen[399].ramp);
  for (std::size_t n = 400; n < 600; ++n) {
    REQUIRE(seen[n].tau == 30000 - 100 * static_cast<std::int64_t>(n - 399));
    REQUIRE(seen[n].ramp);
  }
  REQUIRE(seen[600].tau == seen[599].tau + 100);
  REQUIRE(seen[601].tau == seen[599].tau + 200);
}

TEST_CASE("ramp: a restart ramps from where the torque is, in the wave that follows it") {
  const auto seen = play(
      [](std::int64_t k) {
        Wave w = wave(k < 400 ? 30000 : k < 450 ? -30000 : 10000, 100 * kWhole);
        w.restart = k == 400 || k == 430;
        return w;
      },
      900);
  REQUIRE(seen[399].tau == 30000);
  for (std::size_t n = 400; n < 450; ++n) {
    REQUIRE(seen[n].tau == 30000 - 100 * static_cast<std::int64_t>(n - 399));
    REQUIRE(seen[n].ramp);
  }
  REQUIRE(seen[450].tau == 24900);
  REQUIRE(seen[700].tau == 10000);
  REQUIRE_FALSE(seen[700].ramp);
}

TEST_CASE("ramp: disarming takes the torque away at once") {
  const auto seen = play([](std::int64_t k) { return wave(20000, 5000 * kWhole, k < 50); }, 60);
  REQUIRE(seen[49].tau == 20000);
  for (std::size_t n = 50; n < seen.size(); ++n) REQUIRE(seen[n].tau == 0);
}

TEST_CASE("ramp: a step of 0 or less is one LSB of the fine reference") {
  for (const std::int64_t step : {0, -9}) {
    const auto seen =
        play([=](std::int64_t k) { return wave(20000, k < 5 ? 300 * kWhole : step); }, 1100);
    for (std::size_t n = 5; n < seen.size(); ++n) {
      REQUIRE(seen[n].tau == 1500 + static_cast<std::int64_t>(n - 4) / kWhole);
      REQUIRE(seen[n].ramp);
    }
  }
}

TEST_CASE("ramp: a pulse reaches the largest limit that there is, and no other") {
  for (const std::int64_t limit : {Torque::max_raw(), Torque::max_raw() - 1, std::int64_t{7}}) {
    for (const int sign : {1, 0, -1}) {
      Law law;
      law.begin(true, 0);
      law.pulse(sign, Fixed::from_raw<Law::kLimitKey>(limit));
      for (int k = 0; k < 3; ++k) law.move(Fixed::from_raw<Step::format.key()>(Step::max_raw()));
      while (law.limit_ramp()) law.move(Fixed::from_raw<Step::format.key()>(Step::max_raw()));
      law.move(Fixed::from_raw<Step::format.key()>(0));
      REQUIRE(law.tau_ref().raw() == sign * limit);
    }
  }
}

TEST_CASE("ramp: relief as the limits say") {
  for (unsigned bits = 0; bits < 1u << 12; ++bits) {
    const Relief relief = relief_of(bits);
    REQUIRE(relief.frozen == ((bits & limit::chatter) != 0));
    REQUIRE(relief.derated == ((bits & limit::hold) != 0));
  }
}

TEST_CASE("ramp: within one LSB of quad precision, which is the floor") {
  Law fixed;
  RampLaw<Design, Real<quad>> real;
  RandomWaves random{Random(51)};
  quad worst = 0, least = 0;
  std::int64_t ramping = 0;
  for (std::int64_t k = 0; k < scaled_clocks(200000); ++k) {
    Wave w = random(k);
    const auto limit = Fixed::from_raw<Law::kLimitKey>(random.random.below(80000));
    const auto step = Fixed::from_raw<Step::format.key()>(w.step & 0xffffff);
    const auto rendered = Rendered::from_raw(w.rendered);
    if (w.restart) fixed.restart(), real.restart();
    fixed.begin(w.armed, w.scene);
    real.begin(w.armed, w.scene);
    fixed.limit(rendered, limit);
    real.limit(exact(rendered), exact(limit));
    fixed.move(step);
    real.move(exact(step));
    const quad error = (real.tau_ref() - exact(fixed.tau_ref())) / lsb(Torque::format.fraction);
    worst = feltgate::larger(worst, error);
    least = std::min(least, error);
    ramping += fixed.limit_ramp();
    if (fixed.limit_torque() != real.limit_torque() || fixed.limit_ramp() != real.limit_ramp()) {
      FAIL("another limit in tick " << k);
    }
  }
  INFO("worst " << static_cast<double>(worst) << " LSB");
  REQUIRE(least == 0);
  REQUIRE(worst < 1);
  REQUIRE(worst > 0.9);
  REQUIRE(ramping > 20000);
}
