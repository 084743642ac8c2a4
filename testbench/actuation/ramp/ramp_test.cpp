// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// ramp: RTL against twin on every clock, directed tests of its course, and its error against quad
// precision. Documentation: docs/blocks/torque_control.md
#include <Vramp.h>

#include <algorithm>
#include <cstdint>
#include <vector>

#include "../../estimators/lowpass/exact.hpp"
#include "../limiter/limiter_twin.hpp"
#include "catch.hpp"
#include "feltgate/generated/causes.hpp"
#include "feltgate/generated/map.hpp"
#include "feltgate/largest.hpp"
#include "feltgate/ramp.hpp"
#include "feltgate/words.hpp"
#include "lock_step.hpp"
#include "ports.hpp"

// Twin of rtl/core/actuation/ramp.sv, clock by clock, by the law of the chain.

namespace feltgate {

/// Clocked twin.
template <class D>
class Ramp {
 public:
  using Law = RampLaw<D, Fixed>;

  struct In {
    bool armed = false;
    int scene = 0;
    bool restart = false;  ///< in the last clock of a tick
    std::uint64_t wave = 0;
    std::uint32_t param = 0;
    std::int64_t limited = 0;
    bool over_limit = false;
    Relief relief;
  };
  struct Out {
    std::int64_t tau_ref = 0;
    bool limit_torque = false;
    bool limit_ramp = false;
    bool limit_hold = false;
  };

  void reset() { *this = Ramp{}; }

  void clock(const In& in) {
    const auto at = [&in](int t) { return ((in.wave >> t) & 1u) != 0; };
    using T = Map::T;
    if (at(T::ramp_begin)) {
      law_.begin(in.armed, in.scene, in.relief);
      out_.limit_hold = law_.limit_hold();
    }
    if (at(T::ramp_excess)) {
      // As many bits as a torque has.
      const auto target = static_cast<std::uint32_t>(in.limited & 0xffffffff);
      law_.aim(Fixed::from_raw<D::f.torque.key()>(decode_word(D::f.torque, target)), in.over_limit);
      step_ = Fixed::from_raw<D::P::ramp_step.key()>(decode_word(D::P::ramp_step, in.param));
      out_.limit_torque = law_.limit_torque();
    }
    if (at(T::tau_ref)) {
      law_.move(step_);
      out_.tau_ref = law_.tau_ref().raw();
      out_.limit_ramp = law_.limit_ramp();
    }
    if (in.restart) law_.restart();
  }

  const Out& out() const { return out_; }

 private:
  Law law_;
  fixed_of<D::P::ramp_step.key()> step_{};
  Out out_;
};

}  // namespace feltgate

// The ramp of a design after the core's limiter: adapter, waves, and the chain compared with
// clock().

namespace feltgate::test {

using Law = RampLaw<Design, Fixed>;
using Torque = Law::Torque;
using Rendered = fixed_of<Design::f.scene_torque.key()>;
using Step = fixed_of<Design::P::ramp_step.key()>;
constexpr int kFine = Design::f.ramp.fraction - Design::f.torque.fraction;

/// The inputs of one wave.
struct Wave {
  bool armed = true;
  int scene = 0;
  bool restart = false;                              ///< the torque may jump in this wave
  std::int64_t rendered = 0;                         ///< torque of the scene
  std::int64_t limit = Torque::max_raw(), step = 0;  ///< words
  int pulse = 0;  ///< sign of the self-test's, while the ramp takes the motor for disarmed
  Relief relief;
};
using Twin = Watched<Ramp<Design>, Wave>;

struct Adapter {
  static void drive(Vramp& rtl, const Twin::In& in) {
    rtl.armed_i = in.port.armed;
    rtl.restart_i = in.port.restart;
    rtl.scene_i = static_cast<std::uint8_t>(in.port.scene);
    FELTGATE_STROBES(rtl, in.port.wave, at, T, ramp_begin, ramp_excess, ramp_change, tau_ref);
    rtl.param_i = in.port.param;
    rtl.limited_i = port_bits<Design::f.torque.width()>(in.port.limited);
    rtl.over_limit_i = in.port.over_limit;
    rtl.frozen_i = in.port.relief.frozen;
    rtl.derated_i = in.port.relief.derated;
  }
  template <class Check>
  static void compare(Check& check, const Vramp& rtl, const Twin::Out& out) {
    check("tau_ref", sign_extend<Torque::width>(rtl.tau_ref_o), out.port.tau_ref);
    check("limit_torque", rtl.limit_torque_o, out.port.limit_torque);
    check("limit_ramp", rtl.limit_ramp_o, out.port.limit_ramp);
    check("limit_hold", rtl.limit_hold_o, out.port.limit_hold);
  }
};

using Bench = LockStep<Vramp, Twin, Adapter>;

/// In this clock the step T is taken.
inline bool at(const Twin::In& in, int t) { return ((in.port.wave >> t) & 1u) != 0; }

/// The clocks of the ramp in waves of next(wave number).
template <class Next>
struct Waves {
  Waves(std::uint64_t seed, Next n, std::uint32_t more_clocks)
      : next(n), limiter(seed), garbage(seed + 1), spread(more_clocks) {
    following = next(wave++);
  }

  Twin::In operator()(std::int64_t, const Twin::Out& out) {
    if (out.resets != resets) {
      resets = out.resets;
      clock = 0;
      wave = 0;
      following = next(wave++);
    }
    if (clock == 0) {
      in.aside = following;
      in.port.armed = in.aside.armed;
      in.port.scene = in.aside.scene;
      in.port.relief = in.aside.relief;
      period = kShortest + static_cast<int>(garbage.below(spread));
      following = next(wave++);
    }
    in.port.restart = clock + 1 == period && following.restart;
    const bool limits = clock == Map::W::torque_limit;
    std::int64_t word = static_cast<std::int64_t>(garbage.bits() & 0xffffffff);
    if (limits) word = in.aside.limit;
    if (clock == Map::W::ramp_step) word = in.aside.step;
    in.port.wave = clock < Map::wave_length ? std::uint64_t{1} << clock : 0;
    in.port.param = static_cast<std::uint32_t>(word & 0xffffffff);
    in.port.limited = limiter.limited();
    in.port.over_limit = limiter.beyond();
    // Disarmed, the scenes give 0; the self-test gives what is beyond every limit.
    const std::int64_t over_limit = in.aside.pulse > 0   ? Rendered::max_raw()
                                    : in.aside.pulse < 0 ? Rendered::min_raw()
                                                         : 0;
    const std::int64_t x = limits ? (in.aside.armed ? in.aside.rendered : over_limit) : 0;
    const bool comes = clock == Map::W::torque_limit - 1;
    limiter.clock(limits, {comes, 0, x, in.port.param, comes});
    clock = clock + 1 == period ? 0 : clock + 1;
    return in;
  }

  static constexpr int kShortest = Map::T::tau_ref + 2;
  Next next;
  SharedLimiter<Design> limiter;
  Random garbage;
  std::uint32_t spread;
  Twin::In in;
  Wave following{};  ///< the wave to come: what it restarts is told at the end of this one
  std::int64_t resets = 0, wave = 0;
  int clock = 0, period = kShortest;
};

/// Checks that the chain gives the same result, and the properties of limit and ramp.
struct ChainBeside {
  Law chain{};
  std::int64_t before = 0;

  const char* operator()(const Twin::In& in, const Vramp& rtl, const Twin&, bool in_reset) {
    if (in_reset) {
      *this = ChainBeside{};
      return nullptr;
    }
    if (!at(in, Map::T::tau_ref)) return nullptr;
    const Wave& w = in.aside;
    const std::int64_t limit = decode_word(Design::f.limiter, static_cast<std::uint32_t>(w.limit));
    const std::int64_t step = decode_word(Step::format, static_cast<std::uint32_t>(w.step));
    if (w.restart) chain.restart();
    chain.begin(w.armed, w.scene, w.relief);
    const bool pulsed = !w.armed && w.pulse != 0;
    if (pulsed) {
      chain.pulse(w.pulse, Fixed::from_raw<Law::kLimitKey>(limit));
    } else {
      chain.limit(Rendered::from_raw(w.rendered), Fixed::from_raw<Law::kLimitKey>(limit));
    }
    chain.move(Fixed::from_raw<Step::format.key()>(step));
    const std::int64_t tau = sign_extend<Torque::width>(rtl.tau_ref_o);
    const bool ramped = rtl.limit_ramp_o != 0;
    const std::int64_t moved = tau > before ? tau - before : before - tau;
    const bool grown = before < 0 ? tau < before || tau > 0 : tau < 0 || tau > before;
    before = tau;
    if (chain.tau_ref().raw() != tau) return "tau_ref of the chain is that of clock()";
    if (chain.limit_torque() != (rtl.limit_torque_o != 0)) return "limit_torque of the chain";
    if (chain.limit_ramp() != ramped) return "limit_ramp of the chain";
    if (chain.limit_hold() != (rtl.limit_hold_o != 0)) return "limit_hold of the chain";
    if (w.relief.frozen && grown && !pulsed) return "a frozen torque grows";
    if (!w.armed && !pulsed && tau != 0) return "a torque while disarmed";
    const std::int64_t most = std::max<std::int64_t>(limit, 0);
    if (!ramped && (tau > most || tau < -most)) return "beyond the limit";
    const std::int64_t fine = std::int64_t{1} << kFine;
    if (ramped &&
        moved > ((w.relief.frozen ? 0 : std::max<std::int64_t>(step, 1)) + fine - 1) / fine) {
      return "faster than the ramp";
    }
    return nullptr;
  }
};

}  // namespace feltgate::test

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
  bool ramp = false;
};

template <class Next>
std::vector<Seen> play(Next next, int waves) {
  std::vector<Seen> seen;
  ChainBeside beside;
  const auto keep = [&seen, beside](const Twin::In& in, const Vramp& rtl, const Twin& twin,
                                    bool in_reset) mutable {
    if (!in_reset && at(in, Map::T::tau_ref)) {
      seen.push_back({sign_extend<Torque::width>(rtl.tau_ref_o), rtl.limit_ramp_o != 0});
    }
    return beside(in, rtl, twin, in_reset);
  };
  Bench bench("ramp", 7);
  bench.run(Waves<Next>(2, next, 1), Waves<Next>::kShortest * waves + 10, {}, keep);
  REQUIRE(seen.size() >= static_cast<std::size_t>(waves));
  return seen;
}

Wave wave(std::int64_t rendered, std::int64_t step, bool armed = true) {
  Wave w;
  w.armed = armed;
  w.rendered = rendered;
  w.step = step;
  return w;
}

constexpr std::int64_t kWhole = std::int64_t{1} << kFine;  // a step of one LSB of tau_ref

}  // namespace

TEST_CASE("ramp: random torques, limits, steps, arming, scenes and resets") {
  Bench bench("ramp", 1);
  bench.run(Waves<RandomWaves>(2, {Random(3)}, 25), scaled_clocks(1500000), {20000}, ChainBeside{});
  bench.run(Waves<RandomWaves>(4, {Random(5)}, 1), scaled_clocks(500000), {400}, ChainBeside{});
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

TEST_CASE("ramp: another limit, another scene and a restart ramp from where the torque is") {
  // At wave 400 to 5000, back at 500 on the way there, and at 900 to 5000 to stay.
  for (const int by : {0, 1, 2}) {
    const auto seen = play(
        [by](std::int64_t k) {
          const bool changed = (k >= 400 && k < 500) || k >= 900;
          Wave w = wave(changed && by != 0 ? 5000 : 30000, 100 * kWhole);
          w.relief.derated = changed && by == 0;
          w.limit = w.relief.derated ? 5000 : 40000;
          w.scene = changed && by == 1 ? 5 : 0;
          w.restart = by == 2 && (k == 400 || k == 500 || k == 900);
          return w;
        },
        1200);
    for (std::int64_t n = 390; n < 1140; ++n) {
      const std::int64_t tau = n < 400   ? 30000
                               : n < 500 ? 30000 - 100 * (n - 399)
                               : n < 599 ? 20000 + 100 * (n - 499)
                               : n < 600 ? 29900  // the tick within a step ends the ramp
                               : n < 900 ? 30000
                                         : 30000 - 100 * (n - 899);
      INFO("change " << by << ", wave " << n);
      REQUIRE(seen[static_cast<std::size_t>(n)].tau == tau);
    }
    REQUIRE_FALSE(seen[399].ramp);
    REQUIRE(seen[400].ramp);
    REQUIRE(seen[1199].tau == 5000);
    REQUIRE_FALSE(seen[1199].ramp);
  }
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
