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
#include "feltgate/velocity_n.hpp"
#include "random.hpp"
#include "sim/loop/figures.hpp"
#include "sim/reference/real_chain.hpp"
#include "studies/bounds/coverage.hpp"

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
    counts = std::max(counts, std::abs(travel_difference(in.travel, window.front())));
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

}  // namespace feltgate::bounds
