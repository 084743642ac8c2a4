// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Measured errors against their bounds: slow, small, swept, random and adversarial motions over all
// scenes of both designs, and how nearly the bounds are reached. Documentation:
// docs/error-bounds.md
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <deque>
#include <functional>

#include "catch.hpp"
#include "feltgate/axis/velocity_estimator.hpp"
#include "feltgate/generated/lever.hpp"
#include "feltgate/quad.hpp"
#include "files/toml/toml_reader.hpp"
#include "random.hpp"
#include "sim/loop/figures.hpp"
#include "sim/reference/real_chain.hpp"
#include "studies/bounds/coverage.hpp"
#include "studies/bounds/error_bounds.hpp"

namespace feltgate::bounds {

namespace {

design::Elaborated shipped(const std::string& name) {
  static const design::RegisterMap registers =
      design::read_registers(FELTGATE_ROOT "/rtl/registers.toml");
  return elaborate(design::read_design(FELTGATE_ROOT "/rtl/designs/" + name + ".toml"), registers);
}

/// Counts at tick k.
using Motion = std::function<int(int)>;

int whole(double counts) { return static_cast<int>(std::floor(counts)); }

/// Ticks of a random walk with runs of a constant speed and jumps of it.
Motion random_walk(std::uint64_t seed) {
  auto random = test::Random(seed);
  double speed = 0, place = 0;
  return [=](int) mutable {
    if (random.one_in(3000)) speed = static_cast<double>(random.between(-300, 300)) * 1e-4;
    if (random.one_in(20000)) speed = 0;
    place += speed;
    return whole(place);
  };
}

struct Stimulus {
  const char* name;
  Motion motion;
};

std::vector<Stimulus> stimuli(std::uint64_t seed) {
  return {
      {"slow", [](int k) { return k / 25'000; }},
      {"small square wave", [](int k) { return (k / 7'000) % 2 == 0 ? 0 : 3; }},
      {"one count back and forth", [](int k) { return (k / 400) % 2; }},
      {"chirp",
       [](int k) {
         const double t = k * 1e-6;
         return whole(500 * std::sin(2 * 3.14159265358979 * (1 + 300 * t) * t));
       }},
      {"across every border", [](int k) { return whole(600 * std::sin(k * 1.3e-4)); }},
      {"random", random_walk(seed)},
  };
}

struct Held {
  std::int64_t covered = 0, ticks = 0;
  double velocity_share = 0;  ///< largest measured error as a share of its bound
};

/// The chain of `design` beside the reference, each error below its bound.
void check(const std::string& design, int scene, const Stimulus& stimulus, int ticks, Held* held) {
  const design::Elaborated e = shipped(design);
  const ChainNumbers numbers = chain_numbers(e);
  std::string name = "free";
  for (const design::Scene& s : e.registers.scenes) {
    if (s.number == scene) name = s.name;
  }
  const auto fixed = make_real_chain(design, "fixed"), exact = make_real_chain(design, "quad");
  // The ramp after arming is over at once: what it does is no matter of rounding.
  for (RealChain* chain : {fixed.get(), exact.get()}) {
    chain->set_parameter(e.word("ramp_step").parameter.address, 15.0);
  }
  Coverage coverage(error_bounds(numbers, {1e-9, name, 0}), numbers);
  std::deque<std::int16_t> window(static_cast<std::size_t>(e.design.m1), 0);
  int counts = 0;
  ErrorFigure velocity_rad_s, tau_hat_nm, tau_ref_nm, current_a;
  for (int k = 0; k < ticks; ++k) {
    ChainIn in;
    in.armed = k > 2000 && (k / 10'000) % 3 != 2;
    in.scene = scene;
    in.position = stimulus.motion(k);
    in.travel = static_cast<std::int16_t>(in.position & 0xffff);
    fixed->tick(in);
    exact->tick(in);
    window.push_back(in.travel);
    counts = std::max(counts, std::abs(static_cast<std::int16_t>(in.travel - window.front())));
    window.pop_front();
    const ChainOut &of_core = fixed->out(), &real = exact->out();
    const unsigned limits = fixed->raw()->limits;
    coverage.tick({(limits & limit::velocity) != 0, (limits & limit::tau_hat) != 0,
                   (limits & limit::ramp) != 0 || exact->ramping(),
                   of_core.tau_ref_nm - real.tau_ref_nm});
    if (coverage.velocity()) velocity_rad_s.add(of_core.velocity_rad_s - real.velocity_rad_s);
    if (!coverage.torque()) continue;
    tau_hat_nm.add(of_core.tau_hat_nm - real.tau_hat_nm);
    tau_ref_nm.add(of_core.tau_ref_nm - real.tau_ref_nm);
    current_a.add(of_core.current_a - real.current_a);
  }
  const double largest_rad_s = std::max(counts * numbers.used_gain, 1e-9);
  const ErrorBounds b = error_bounds(numbers, {largest_rad_s, name, 0});
  INFO(design << ", " << name << ", " << stimulus.name << ", up to " << largest_rad_s);
  CHECK(velocity_rad_s.max() <= b.velocity_rad_s.against_reference);
  CHECK(tau_hat_nm.max() <= b.tau_hat_nm.against_reference);
  CHECK(tau_ref_nm.max() <= b.tau_ref_nm.against_reference);
  CHECK(current_a.max() <= b.current_a.against_reference);
  held->velocity_share =
      std::max(held->velocity_share, velocity_rad_s.max() / b.velocity_rad_s.against_reference);
  held->ticks += ticks;
  held->covered += coverage.ticks() - coverage.outside();
}

}  // namespace

TEST_CASE("no error exceeds its bound, in any scene, whatever the lever does") {
  for (const char* design : {"lever", "paper"}) {
    Held held;
    const design::Elaborated e = shipped(design);
    std::uint64_t seed = 1;
    const auto& built = e.design.scenes;
    for (const design::Scene& s : e.registers.scenes) {
      if (std::find(built.begin(), built.end(), s.name) == built.end()) continue;
      for (const Stimulus& stimulus : stimuli(seed++))
        check(design, s.number, stimulus, 50'000, &held);
    }
    INFO(design << ": " << held.covered << " of " << held.ticks << " ticks, velocity "
                << held.velocity_share << " of its bound");
    CHECK(held.covered > held.ticks * 9 / 10);
    CHECK(held.velocity_share > 0.9);
  }
}

// How tight the bounds are: motions chosen tick by tick so that every rounding falls the worse way;
// and designs one guard bit short, which break their target.

namespace {

using axis::Fixed;
constexpr std::int64_t a1 = 67092;
constexpr int a1_f = Lever::P::velocity_a1.fraction;

const design::RegisterMap& registers() {
  static const design::RegisterMap map =
      design::read_registers(FELTGATE_ROOT "/rtl/registers.toml");
  return map;
}

design::Design lever_file() { return design::read_design(FELTGATE_ROOT "/rtl/designs/lever.toml"); }

/// The low-pass of lever's velocity with an adversary at its input.
class Adversary {
 public:
  /// The count within +-reach whose rounding is largest in the wanted direction.
  int choose(bool upward) {
    int best = 0;
    double most = -1;
    for (int c = -reach; c <= reach; ++c) {
      const double error = rounding(c);
      const double wanted = upward ? error : -error;
      if (wanted > most) {
        most = wanted;
        best = c;
      }
    }
    state_ = after(best);
    const Quad input = Fixed::value(law_.speed(static_cast<std::int16_t>(best)), law_.f);
    exact_ += (input - exact_) * static_cast<Quad>(Fixed::value(a1, a1_f));
    return best;
  }
  /// The state less that of the same low-pass in real arithmetic, rad/s.
  double error_rad_s() const {
    return static_cast<double>(static_cast<Quad>(Fixed::value(state_, law_.f)) - exact_);
  }

  static constexpr int reach = 60;

 private:
  std::int64_t after(int c) const {
    axis::Words<std::int64_t> p;
    p.velocity_a1 = a1;
    return law_.tick({state_, false}, p, static_cast<std::int16_t>(c)).velocity;
  }
  /// What rounding adds, in steps of the state.
  double rounding(int c) const {
    const std::int64_t step = (law_.speed(static_cast<std::int16_t>(c)) - state_) * a1;
    return static_cast<double>(after(c) - state_) - Fixed::value(step, a1_f);
  }

  axis::VelocityEstimator<Fixed> law_{axis::Design::of<Lever>()};
  std::int64_t state_ = 0;
  Quad exact_ = 0;
};

/// Largest errors of velocity and tau_hat when the last `turned` ticks round the other way than
/// those before. The observer is linear: the velocity's error passes its high-pass.
struct Attack {
  double velocity_rad_s = 0, tau_hat_nm = 0;
};
Attack attack(const ChainNumbers& numbers, int ticks, int turned) {
  const double alpha = numbers.at("observer_a1").used(), gain = numbers.at("inertia_gain").used();
  Adversary adversary;
  Attack most;
  double state = 0;
  for (int k = 0; k < ticks; ++k) {
    adversary.choose(k < ticks - turned);
    const double velocity = adversary.error_rad_s(), inertia = gain * velocity;
    state += alpha * (inertia - state);
    most.velocity_rad_s = std::max(most.velocity_rad_s, std::abs(velocity));
    most.tau_hat_nm = std::max(most.tau_hat_nm, std::abs(state - inertia));
  }
  return most;
}

/// Where the low-pass of lever's velocity comes to rest from above, its state with so many fraction
/// bits, less its input, rad/s.
double rest_error(int fraction) {
  const axis::Drop rounded(a1_f, axis::Rounding::half_up);
  const std::int64_t input = Fixed::of(4, fraction);
  std::int64_t state = Fixed::of(40, fraction);
  const auto next = [&] { return Fixed::add_rounded(state, (input - state) * a1, rounded); };
  for (int k = 0; k < 100'000; ++k) state = next();
  REQUIRE(next() == state);
  return Fixed::value(state - input, fraction);
}

}  // namespace

TEST_CASE("the velocity's bound is nearly reached when every rounding falls one way") {
  const ChainNumbers numbers = chain_numbers(elaborate(lever_file(), registers()));
  REQUIRE(numbers.at("velocity_a1").raw == a1);
  const SourceBound bound = source_bounds(numbers, {2.0 * Adversary::reach, "free", 0}).front();
  const double share = attack(numbers, 12'000, 0).velocity_rad_s / bound.velocity_rad_s;
  INFO("share " << share);
  CHECK(share <= 1);
  CHECK(share > 0.8);
}

TEST_CASE("tau_hat's part of it when they turn where the impulse response does") {
  const ChainNumbers numbers = chain_numbers(elaborate(lever_file(), registers()));
  const SourceBound bound = source_bounds(numbers, {2.0 * Adversary::reach, "free", 0}).front();
  // The response of two equal poles peaks after 1/a1 ticks.
  const int turned = static_cast<int>(1.0 / numbers.at("velocity_a1").used());
  const double share = attack(numbers, 16'000, turned).tau_hat_nm / bound.tau_hat_nm;
  const double unturned = attack(numbers, 16'000, 0).tau_hat_nm / bound.tau_hat_nm;
  INFO("share " << share << ", without the turn " << unturned);
  CHECK(share <= 1);
  CHECK(share > 0.8);
  CHECK(unturned < 0.6);
}

TEST_CASE("a velocity one guard bit short breaks its target, and is refused") {
  // Promised: half a bit of 2^-10 rad/s.
  const double target = std::ldexp(0.5, -10);
  design::Design d = lever_file();
  const auto bound = [&] {
    return source_bounds(chain_numbers(elaborate(d, registers())), {10, "free", 0})
        .front()
        .velocity_rad_s;
  };
  REQUIRE(d.velocity.fraction == 21);
  CHECK(bound() <= target);
  CHECK(rest_error(21) <= target);
  d.velocity.fraction = 20;
  CHECK_THROWS_AS(elaborate(d, registers()), config::ConfigError);
  d.allow_coarse = true;
  CHECK(bound() > target);
  CHECK(rest_error(20) > target);
  CHECK(rest_error(20) <= bound());
}

TEST_CASE("an observer one guard bit short breaks its target, and is refused") {
  // Promised: what its filter adds stays below half a bit of torque, beside the rounding of
  // tau_hat.
  design::Design d = lever_file();
  const double half = std::ldexp(0.5, -d.torque.fraction);
  const auto filter_adds = [&] {
    const auto sources = source_bounds(chain_numbers(elaborate(d, registers())), {10, "free", 0});
    return sources.at(1).tau_hat_nm - half;
  };
  d.observer_fraction = 27;
  CHECK(filter_adds() <= half);
  d.observer_fraction = 26;
  CHECK_THROWS_AS(elaborate(d, registers()), config::ConfigError);
  d.allow_coarse = true;
  CHECK(filter_adds() > half);
}

}  // namespace feltgate::bounds
