// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// How tight the bounds are: motions chosen tick by tick so that every rounding falls the worse way;
// and designs one guard bit short, which break their target. Documentation: docs/error-bounds.md
#include <algorithm>
#include <cmath>

#include "catch.hpp"
#include "feltgate/generated/lever.hpp"
#include "feltgate/quad.hpp"
#include "feltgate/velocity_n.hpp"
#include "files/toml/toml_reader.hpp"
#include "studies/bounds/error_bounds.hpp"

namespace feltgate::bounds {

namespace {

using Law = VelocityLaw<Lever, Fixed>;
constexpr auto a1 = fixed_of<Lever::P::velocity_a1.key()>::from_raw(67092);

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
    bool saturated = false;
    const auto raw = Law::raw(static_cast<std::int16_t>(best), &saturated);
    state_ = Law::Filter::next(state_, Law::Filter::operand(raw, state_) * a1);
    const Quad input = raw.to_double();
    exact_ += (input - exact_) * static_cast<Quad>(a1.to_double());
    return best;
  }
  /// The state less that of the same low-pass in real arithmetic, rad/s.
  double error_rad_s() const {
    return static_cast<double>(static_cast<Quad>(state_.to_double()) - exact_);
  }

  static constexpr int reach = 60;

 private:
  /// What rounding adds, in steps of the state.
  double rounding(int c) const {
    bool saturated = false;
    const auto raw = Law::raw(static_cast<std::int16_t>(c), &saturated);
    const auto step = Law::Filter::operand(raw, state_) * a1;
    const auto next = Law::Filter::next(state_, step);
    return (next - state_ - step).to_double() * std::ldexp(1.0, Lever::f.velocity.fraction);
  }

  fixed_of<Lever::f.velocity.key()> state_{};
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

/// Where the low-pass of lever's velocity comes to rest from above, its state with F fraction bits,
/// less its input, rad/s.
template <int F>
double rest_error() {
  using Filter = LowpassLaw<Fixed, Format{1, 10, F}.key(), Format{1, 11, F}.key(), Round::half_up>;
  using State = typename Filter::State;
  const State input = State::from_raw(4 * (1 << F));
  State state = State::from_raw(40 * (1 << F));
  for (int k = 0; k < 100'000; ++k) state = Filter::next(state, Filter::operand(input, state) * a1);
  const State before = state;
  state = Filter::next(state, Filter::operand(input, state) * a1);
  REQUIRE(state.raw() == before.raw());
  return (state - input).to_double();
}

}  // namespace

TEST_CASE("the velocity's bound is nearly reached when every rounding falls one way") {
  const ChainNumbers numbers = chain_numbers(elaborate(lever_file(), registers()));
  REQUIRE(numbers.at("velocity_a1").raw == a1.raw());
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
  CHECK(rest_error<21>() <= target);
  d.velocity.fraction = 20;
  CHECK_THROWS_AS(elaborate(d, registers()), config::ConfigError);
  d.allow_coarse = true;
  CHECK(bound() > target);
  CHECK(rest_error<20>() > target);
  CHECK(rest_error<20>() <= bound());
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
