// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// dob: RTL against twin on every clock; stall, motion and arming against closed forms, and the
// distance from quad precision. Documentation: docs/blocks/dob.md
#include <Vdob.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "../../wave/mult/mult_twin.hpp"
#include "../lowpass/exact.hpp"
#include "../lowpass/lowpass_twin.hpp"
#include "catch.hpp"
#include "feltgate/dob.hpp"
#include "feltgate/generated/map.hpp"
#include "feltgate/largest.hpp"
#include "lock_step.hpp"
#include "ports.hpp"

// Twin of rtl/core/estimators/dob.sv, clock by clock, by the law of the chain.

namespace feltgate {

/// Clocked twin.
template <class D>
class Dob {
 public:
  using Law = DobLaw<D, Fixed>;
  using Current = fixed_of<D::f.current.key()>;
  using Velocity = fixed_of<D::f.velocity.key()>;
  using TorqueConstant = fixed_of<D::P::torque_constant.key()>;
  using InertiaGain = fixed_of<D::P::inertia_gain.key()>;

  struct In {
    bool armed = false;
    std::uint64_t wave = 0;
    std::int64_t product = 0;  ///< Ktn*I in T::drive_torque, g*Jn*w in T::observer_input
  };
  struct Out {
    std::int64_t operand = 0;
    std::int64_t tau_hat = 0;
    bool saturated = false;
  };

  void reset() {
    filter_.reset();
    tau_hat_ = typename Law::Torque{};
    out_ = {};
  }

  void clock(const In& in) {
    const auto at = [&in](int t) { return ((in.wave >> t) & 1u) != 0; };
    using T = Map::T;
    filter_.clock({at(T::observer_difference), at(T::observer_state), !in.armed,
                   static_cast<std::int64_t>(input_.raw()), in.product});
    if (at(T::tau_hat)) observe();
    if (at(T::observer_input)) {
      inertia_ = Law::inertia(decltype(Velocity{} * InertiaGain{})::from_raw(in.product));
      input_ = Law::input(drive_, inertia_);
    }
    if (at(T::drive_torque)) {
      drive_ = in.armed ? Law::drive(decltype(Current{} * TorqueConstant{})::from_raw(in.product))
                        : typename Law::Drive{};
    }
    out_.operand = filter_.out().operand;
  }

  const Out& out() const { return out_; }
  typename Law::Torque tau_hat() const { return tau_hat_; }

 private:
  void observe() {
    out_.saturated = false;
    tau_hat_ = Law::tau_hat(filter_.state(), inertia_, &out_.saturated);
    out_.tau_hat = tau_hat_.raw();
  }

  Lowpass<D::f.observer.key(), D::f.observer_difference.key(), D::P::observer_a1.key(), D::rounding>
      filter_;
  typename Law::Drive drive_{};
  typename Law::Inertia inertia_{};
  typename Law::State input_{};
  typename Law::Torque tau_hat_{};
  Out out_;
};

}  // namespace feltgate

namespace feltgate::test {

using Observer = Dob<Design>;
using Chain = ObserverStep<Design, Fixed>;
using Current = Observer::Current;
using Velocity = Observer::Velocity;

/// What one wave works on: two signals and three words.
struct Wave {
  std::int64_t current = 0, velocity = 0;
  std::int64_t torque_constant = parameter(Design::A::torque_constant).raw;
  std::int64_t inertia_gain = parameter(Design::A::inertia_gain).raw;
  std::int64_t a1 = parameter(Design::A::observer_a1).raw;
  bool armed = false;
};
using Twin = Watched<Observer, Wave>;

/// The wave as the chain takes it.
inline void tick(Chain& chain, const Wave& w) {
  struct Coefficients {
    const Wave& wave;
    auto torque_constant() const {
      return Observer::TorqueConstant::from_raw(wave.torque_constant);
    }
    auto inertia_gain() const { return Observer::InertiaGain::from_raw(wave.inertia_gain); }
    auto observer_a1() const { return fixed_of<Design::P::observer_a1.key()>::from_raw(wave.a1); }
  };
  chain.tick(Coefficients{w}, w.armed, Current::from_raw(w.current),
             Velocity::from_raw(w.velocity));
}

struct Adapter {
  static void drive(Vdob& rtl, const Twin::In& in) {
    rtl.armed_i = in.port.armed;
    FELTGATE_STROBES(rtl, in.port.wave, at, T, drive_torque, observer_input, observer_difference,
                     observer_state, observed, observed_rounded, tau_hat);
    rtl.product_i = port_bits<53, std::uint64_t>(in.port.product);
  }
  template <class Check>
  static void compare(Check& check, const Vdob& rtl, const Twin::Out& out) {
    if (out.clocked) {
      check("operand", sign_extend<Design::f.observer_difference.width()>(rtl.operand_o),
            out.port.operand);
    }
    check("tau_hat", sign_extend<Design::f.torque.width()>(rtl.tau_hat_o), out.port.tau_hat);
    check("saturated", rtl.saturated_o, out.port.saturated);
  }
};

using Bench = LockStep<Vdob, Twin, Adapter>;

/// In this clock the step T is taken.
inline bool at(const Twin::In& in, int t) { return ((in.port.wave >> t) & 1u) != 0; }

/// The clocks of the observer in waves of next(wave number).
template <class Next>
struct Waves {
  Waves(std::uint64_t seed, Next n, std::uint32_t more_clocks)
      : next(n), mult(seed), gaps(seed + 1), spread(more_clocks) {}

  Twin::In operator()(std::int64_t, const Twin::Out& out) {
    if (out.resets != resets) {
      resets = out.resets;
      clock = kStart;
      wave = 0;
    }
    if (clock == kStart) {
      in.aside = next(wave++);
      in.port.armed = in.aside.armed;
      period = kShortest + static_cast<int>(gaps.below(spread));
    }
    in.port.wave = clock < Map::wave_length ? std::uint64_t{1} << clock : 0;
    in.port.product = mult.product();
    if (clock == Map::W::torque_constant) {
      mult.operands(in.aside.current, in.aside.torque_constant);
    } else if (clock == Map::W::inertia_gain) {
      mult.operands(in.aside.velocity, in.aside.inertia_gain);
    } else if (clock == Map::W::observer_a1) {
      mult.operands(out.port.operand, in.aside.a1);
    } else if (clock == Map::T::observed - Map::multiplier_latency ||
               clock == Map::T::observed_rounded - Map::multiplier_latency) {
      mult.operands(0, 1);  // nothing is on the operand bus
    } else {
      mult.others();
    }
    clock = clock + 1 == kStart + period ? kStart : clock + 1;
    return in;
  }

  static constexpr int kStart = 0;
  static constexpr int kShortest = Map::T::tau_hat + 2 - kStart;
  Next next;
  SharedMult mult;
  Random gaps;
  std::uint32_t spread;
  Twin::In in;
  std::int64_t resets = 0, wave = 0;
  int clock = kStart, period = kShortest;
};

/// Currents and velocities of every size, held or jumping; coefficients of the design or any;
/// arming and disarming between waves.
struct RandomWaves {
  Random random{13};
  Wave wave;
  int left = 0;

  template <class Number>
  std::int64_t any() {
    const auto word = static_cast<std::int64_t>(random.bits()) >> (64 - Number::width);
    if (random.one_in(8)) return random.coin() ? Number::max_raw() : Number::min_raw();
    return word >> random.below(Number::width);
  }
  Wave operator()(std::int64_t) {
    if (random.one_in(50)) wave.armed = !wave.armed;
    if (left-- > 0) {
      if (random.coin()) return wave;
      wave.velocity += random.between(-20000, 20000);  // a motion without jumps
      wave.velocity = std::min(std::max(wave.velocity, Velocity::min_raw()), Velocity::max_raw());
      return wave;
    }
    left = static_cast<int>(random.below(60));
    wave.current = any<Current>();
    wave.velocity = any<Velocity>();
    const Wave design;
    const bool others = random.one_in(4);
    wave.torque_constant = others ? random.between(0, 131071) : design.torque_constant;
    wave.inertia_gain = others ? random.between(0, 131071) : design.inertia_gain;
    wave.a1 = others ? random.between(0, 131071) : design.a1;
    return wave;
  }
};

/// The chain's tau_hat is due in the clock after its step; disarmed it is 0.
struct ChainBeside {
  Chain shadow{};

  const char* operator()(const Twin::In& in, const Vdob& rtl, const Twin&, bool in_reset) {
    if (in_reset) {
      shadow = {};
      return nullptr;
    }
    if (!at(in, Map::T::tau_hat)) return nullptr;
    tick(shadow, in.aside);
    const std::int64_t tau_hat = sign_extend<Design::f.torque.width()>(rtl.tau_hat_o);
    if (tau_hat != shadow.tau_hat.raw()) return "tau_hat of the chain is that of clock()";
    if ((rtl.saturated_o != 0) != shadow.limit) return "saturated of the chain";
    if (!in.port.armed && tau_hat != 0) return "tau_hat is 0 while disarmed";
    return nullptr;
  }
};

}  // namespace feltgate::test

using namespace feltgate;
using namespace feltgate::test;

namespace {

constexpr double kPole = 500.0;
constexpr std::int64_t kAmpere = std::int64_t{1} << Design::f.current.fraction;
constexpr std::int64_t kRadS = std::int64_t{1} << Design::f.velocity.fraction;

double nm(std::int64_t tau_hat) { return std::ldexp(static_cast<double>(tau_hat), -16); }

/// tau_hat of the RTL after every wave of next().
template <class Next>
std::vector<std::int64_t> observe(Next next, std::int64_t waves) {
  std::vector<std::int64_t> tau_hat;
  const auto keep = [&](const Twin::In& in, const Vdob& rtl, const Twin&, bool in_reset) {
    if (!in_reset && at(in, Map::T::tau_hat)) tau_hat.push_back(sign_extend<21>(rtl.tau_hat_o));
    return static_cast<const char*>(nullptr);
  };
  Bench bench("dob", 3);
  bench.run(Waves<Next>(3, next, 1), Waves<Next>::kShortest * waves + 10, {}, keep);
  return tau_hat;
}

quad quantised(const ParameterInfo& p) { return static_cast<quad>(p.raw) * lsb(p.format.fraction); }

/// Largest distance of tau_hat from the exact law on the same current and velocity. Three sources:
/// a1 (coefficient over the largest difference, half an LSB of the state, the bits the difference
/// gives up), Ktn*I, and g*Jn*w, which enters through the low-pass and leaves directly; then the
/// rounding to torque.
quad error_bound(quad largest_difference, quad current, quad velocity) {
  const ParameterInfo& a1 = parameter(Design::A::observer_a1);
  const quad last = lsb(Design::f.observer.fraction);
  const quad filter = (coefficient_error(a1) * largest_difference + last / 2) / quantised(a1) +
                      lsb(Design::f.observer_difference.fraction);
  const quad drive = coefficient_error(parameter(Design::A::torque_constant)) * current + last;
  const quad inertia = coefficient_error(parameter(Design::A::inertia_gain)) * velocity + last;
  return filter + drive + 2 * inertia + lsb(Design::f.torque.fraction) / 2;
}

}  // namespace

TEST_CASE("dob: before the first tick nothing has saturated") {
  const ObserverStep<Design, Fixed> step;
  CHECK_FALSE(step.limit);
  CHECK(step.tau_hat.raw() == 0);
}

TEST_CASE("dob: random currents, velocities, coefficients, arming and resets") {
  Bench bench("dob", 1);
  bench.run(Waves<RandomWaves>(2, {}, 30), scaled_clocks(1500000), {5000}, ChainBeside{});
  bench.run(Waves<RandomWaves>(3, {}, 1), scaled_clocks(1000000), {100000}, ChainBeside{});
}

TEST_CASE("dob: at stall tau_hat is the 500 rad/s low-pass of Ktn*I, within one LSB") {
  for (const double torque : {0.5, 0.1, -0.3}) {
    const double ktn = parameter(Design::A::torque_constant).si;
    Wave wave;
    wave.armed = true;
    wave.current = std::llround(torque / ktn * static_cast<double>(kAmpere));
    const auto tau_hat = observe([wave](std::int64_t) { return wave; }, 30000);
    REQUIRE(tau_hat.size() > 29990);
    const double final = ktn * static_cast<double>(wave.current) / static_cast<double>(kAmpere);
    double worst = 0;
    for (std::size_t k = 0; k < tau_hat.size(); ++k) {
      const double exact_tau = -final * std::expm1(-kPole * 1e-6 * static_cast<double>(k + 1));
      worst = feltgate::larger(worst, std::fabs(nm(tau_hat[k]) - exact_tau));
    }
    INFO("torque " << torque << " Nm, worst " << worst << " Nm");
    REQUIRE(worst <= std::ldexp(1.0, -16));
    REQUIRE(std::fabs(nm(tau_hat.back()) - final) <= std::ldexp(1.0, -16));
  }
}

TEST_CASE("dob: a free lever that accelerates by its nominal inertia shows no load") {
  // Jn*alpha = Ktn*I, hence tau_hat stays 0 but for the one tick by which w lags.
  const double ktn = parameter(Design::A::torque_constant).si;
  const double jn = parameter(Design::A::inertia_gain).si / kPole;
  const double amperes = kIsPaper ? 2.0 : 0.5;
  const double rad_s2 = ktn * amperes / jn;
  const auto next = [=](std::int64_t wave) {
    Wave w;
    w.armed = true;
    w.current = static_cast<std::int64_t>(amperes * static_cast<double>(kAmpere));
    const double time = 1e-6 * static_cast<double>(wave + 1);
    w.velocity = std::llround(rad_s2 * time * static_cast<double>(kRadS));
    return w;
  };
  const auto tau_hat = observe(next, 20000);
  const double torque = ktn * amperes;
  for (const std::int64_t t : tau_hat) {
    if (std::fabs(nm(t)) > torque * kPole * 1e-6 + std::ldexp(2.0, -16)) FAIL("load " << nm(t));
  }
}

TEST_CASE("dob: a load that blocks a moving lever shows with its sign") {
  // Positive motor torque, speed falling at Jn*alpha = -0.05 Nm: the load is the sum of both.
  const double ktn = parameter(Design::A::torque_constant).si;
  const double jn = parameter(Design::A::inertia_gain).si / kPole;
  const double amperes = 0.1 / ktn;
  const auto next = [=](std::int64_t wave) {
    Wave w;
    w.armed = true;
    w.current = std::llround(amperes * static_cast<double>(kAmpere));
    const double speed = 10 - 0.05 / jn * 1e-6 * static_cast<double>(wave + 1);
    w.velocity = std::llround(speed * static_cast<double>(kRadS));
    return w;
  };
  const auto tau_hat = observe(next, 40000);
  REQUIRE(std::fabs(nm(tau_hat.back()) - 0.15) < 0.0001);
}

TEST_CASE("dob: arming in motion makes no jump, disarming ends the estimate at once") {
  constexpr std::int64_t arm = 1000, disarm = 12000;
  const auto next = [](std::int64_t wave) {
    Wave w;
    w.armed = wave >= arm && wave < disarm;
    w.current = 2 * kAmpere;
    w.velocity = 30 * kRadS + wave * 200;
    return w;
  };
  const auto tau_hat = observe(next, 14000);
  const double gjn = parameter(Design::A::inertia_gain).si;
  const double ktn_i = parameter(Design::A::torque_constant).si * 2;
  // What one tick can add: Ktn*I through the low-pass, and one tick's inertia torque.
  const double step = ktn_i * kPole * 1e-6 + gjn * std::ldexp(200.0, -21) + std::ldexp(1.0, -16);
  for (std::size_t k = 1; k < tau_hat.size(); ++k) {
    const bool off = k < arm || k >= disarm;
    if (off && tau_hat[k] != 0) FAIL("tau_hat while disarmed, tick " << k);
    if (k != disarm && std::fabs(nm(tau_hat[k] - tau_hat[k - 1])) > step) FAIL("jump at " << k);
  }
  REQUIRE(nm(tau_hat[disarm - 1]) > ktn_i / 4);
}

TEST_CASE("dob: distance from quad precision") {
  using Law = DobLaw<Design, Real<quad>>;
  Chain twin;
  Random random(31);
  quad state = 0, worst = 0, largest_difference = 0;
  const auto si = [](int address) { return static_cast<quad>(parameter(address).si); };
  Wave wave;
  wave.armed = true;
  constexpr std::int64_t max_velocity = 20 * kRadS, max_current = 15 * kAmpere;
  std::int64_t target = 0;
  for (std::int64_t k = 0; k < scaled_clocks(200000); ++k) {
    if (random.one_in(300)) wave.current = random.between(-max_current, max_current);
    if (random.one_in(2000)) target = random.between(-max_velocity, max_velocity);
    wave.velocity += (target - wave.velocity) / 512;
    tick(twin, wave);
    if (twin.limit) FAIL("saturated at wave " << k);
    const quad drive =
        Law::drive(si(Design::A::torque_constant) * exact(Current::from_raw(wave.current)));
    const quad inertia =
        Law::inertia(si(Design::A::inertia_gain) * exact(Velocity::from_raw(wave.velocity)));
    const quad difference = Law::Filter::operand(Law::input(drive, inertia), state);
    if (magnitude(difference) > largest_difference) largest_difference = magnitude(difference);
    state = Law::Filter::next(state, si(Design::A::observer_a1) * difference);
    bool unused = false;
    const quad error = magnitude(exact(twin.tau_hat) - Law::tau_hat(state, inertia, &unused));
    worst = feltgate::larger(worst, error);
  }
  const quad bound = error_bound(largest_difference, 15, 20);
  INFO("worst " << static_cast<double>(worst) << " Nm, bound " << static_cast<double>(bound)
                << " Nm, largest difference " << static_cast<double>(largest_difference));
  REQUIRE(worst <= bound);
  REQUIRE(worst > bound / 10);
  REQUIRE(bound < 8 * lsb(16));
}
