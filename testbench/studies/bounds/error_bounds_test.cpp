// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The bounds of a design: closed forms where there are some, how they move with a design, what is
// promised to hold without saturation. Documentation: docs/error-bounds.md
#include <cmath>

#include "catch.hpp"
#include "feltgate/quad.hpp"
#include "studies/bounds/error_bounds.hpp"
#include "studies/bounds/interval.hpp"
#include "studies/bounds/sections.hpp"

namespace feltgate::bounds {

namespace {

using design::Design;
using design::Elaborated;

const design::RegisterMap& registers() {
  static const design::RegisterMap map =
      design::read_registers(FELTGATE_ROOT "/rtl/registers.toml");
  return map;
}

Design file(const std::string& name) {
  return design::read_design(FELTGATE_ROOT "/rtl/designs/" + name + ".toml");
}

Elaborated shipped(const std::string& name) { return elaborate(file(name), registers()); }

bool finite(const ErrorBound& b) {
  return std::isfinite(b.against_quantised) && std::isfinite(b.against_reference) &&
         std::isfinite(b.against_exact);
}

}  // namespace

TEST_CASE("the velocity's bound is half a bit over a1 with the core's own coefficients") {
  for (const char* name : {"lever", "paper"}) {
    const Elaborated e = shipped(name);
    const ErrorBounds b = error_bounds(e);
    const double closed =
        std::ldexp(0.5, -e.formats.velocity.fraction) / e.word("velocity_a1").quantised();
    CHECK(b.velocity_rad_s.against_quantised >= closed);
    CHECK(b.velocity_rad_s.against_quantised <= closed * (1 + 1e-12));
  }
}

TEST_CASE("every signal of the shipped designs has a bound, each reference adds to it") {
  for (const char* name : {"lever", "paper"}) {
    const ErrorBounds b = error_bounds(shipped(name));
    for (const ErrorBound* s : {&b.velocity_rad_s, &b.tau_hat_nm, &b.tau_ref_nm, &b.current_a,
                                &b.torque_nm, &b.unlimited_tau_hat_nm, &b.unlimited_current_a}) {
      CHECK(finite(*s));
      CHECK(s->against_quantised > 0);
      CHECK(s->against_reference > s->against_quantised);
      CHECK(s->against_exact > s->against_reference);
    }
    CHECK(b.unlimited_tau_hat_nm.against_quantised <= b.tau_hat_nm.against_quantised * (1 + 1e-9));
    CHECK(bound_fields(b).size() == 5);
  }
}

TEST_CASE("the sources add up to the bound") {
  constexpr double SourceBound::*signals[] = {&SourceBound::velocity_rad_s,
                                              &SourceBound::tau_hat_nm, &SourceBound::tau_ref_nm,
                                              &SourceBound::current_a};
  for (const char* name : {"lever", "paper"}) {
    const ChainNumbers numbers = chain_numbers(shipped(name));
    for (const std::string& scene : numbers.scenes) {
      const InputRegion region{10, scene, 0};
      const ErrorBounds b = error_bounds(numbers, region);
      const auto sources = source_bounds(numbers, region);
      REQUIRE(sources.size() == 6);
      const ErrorBound bounds[] = {b.velocity_rad_s, b.tau_hat_nm, b.tau_ref_nm, b.current_a};
      for (std::size_t n = 0; n < 4; ++n) {
        double rounding = 0;
        for (std::size_t k = 0; k < 4; ++k) rounding += sources[k].*signals[n];
        const double all = rounding + sources[4].*signals[n];
        CAPTURE(name, scene, n);
        CHECK(rounding <= bounds[n].against_quantised * 1.0001 + 1e-200);
        CHECK(all >= bounds[n].against_reference * (1 - 1e-9));
        CHECK(all <= bounds[n].against_reference * 1.1 + 1e-200);
      }
    }
  }
}

TEST_CASE("a source has the bound of its own rounding, and none where it does not round") {
  const Elaborated e = shipped("lever");
  const auto s = source_bounds(chain_numbers(e), {8, "spring_compression", 0});
  const auto bit = [](const Format& f) { return std::ldexp(1.0, -f.fraction); };
  CHECK(s[0].name == "velocity_n");
  CHECK(s[0].velocity_rad_s ==
        Approx(bit(e.formats.velocity) / 2 / e.word("velocity_a1").quantised()));
  CHECK(s[0].tau_hat_nm > 0);
  CHECK(s[0].tau_ref_nm + s[0].current_a == 0);
  CHECK(s[1].name == "dob");
  CHECK(s[1].tau_hat_nm > bit(e.formats.torque) / 2 +
                              bit(e.formats.observer) / 2 / e.word("observer_a1").quantised());
  CHECK(s[1].velocity_rad_s + s[1].tau_ref_nm + s[1].current_a == 0);
  CHECK(s[2].name == "scenes");
  CHECK(s[2].tau_ref_nm == Approx(bit(e.formats.torque) / 2));
  CHECK(s[2].current_a == Approx(s[2].tau_ref_nm * e.word("torque_gain").quantised()));
  CHECK(s[2].velocity_rad_s == 0);
  CHECK(s[3].name == "torque_control");
  CHECK(s[3].current_a == Approx(bit(e.formats.current)));
  CHECK(s[3].velocity_rad_s + s[3].tau_ref_nm == 0);
  CHECK(s[4].name == "coefficients");
  CHECK(s[5].name == "gain");
  CHECK(
      s[5].velocity_rad_s ==
      Approx(8 * std::abs(e.design.velocity_gain_rad_s() / e.rad_s_per_count() - 1)).epsilon(0.1));
  CHECK(s[5].tau_ref_nm + s[5].current_a == 0);
  const std::string table = source_table(s);
  for (const SourceBound& row : s) {
    if (row.name != "gain") CHECK(table.find("\n" + row.name + " ") != std::string::npos);
  }
}

TEST_CASE("a smaller region has a smaller bound, except what rounding alone does") {
  const Elaborated e = shipped("lever");
  InputRegion region;
  region.velocity_rad_s = 10;
  const ErrorBounds slow = error_bounds(e, region), any = error_bounds(e);
  CHECK(slow.velocity_rad_s.against_quantised == any.velocity_rad_s.against_quantised);
  CHECK(slow.velocity_rad_s.against_reference < any.velocity_rad_s.against_reference);
  CHECK(slow.tau_hat_nm.against_reference < any.tau_hat_nm.against_reference);
  region.scene = "free";
  CHECK(error_bounds(e, region).tau_ref_nm.against_exact == 0);
  region.scene = "nowhere";
  CHECK_THROWS_AS(error_bounds(e, region), std::invalid_argument);
}

TEST_CASE("nothing saturates in the region that is stated") {
  const ErrorBounds lever = error_bounds(shipped("lever")), paper = error_bounds(shipped("paper"));
  // 2 rad/s per count in [1,10,21]; 4 rad/s per count.
  CHECK(lever.free.counts_per_window == 511);
  CHECK(lever.free.velocity_rad_s == 1022);
  CHECK(paper.free.counts_per_window == 255);
  CHECK(lever.free.tau_hat_rad_s > 300);
  // tau_ref alone takes 16.56 of 16.6 A in lever; in paper the observer may ask for more.
  CHECK(lever.free.current_rad_s == lever.free.velocity_rad_s);
  CHECK(paper.free.current_rad_s == 0);
}

TEST_CASE("the more tau_hat is fed back, the larger its bound, up to none at all") {
  constexpr double endless = std::numeric_limits<double>::infinity();
  Design d = file("paper");
  double before = 0;
  for (const double kp : {2042.0, 1600.0, 800.0}) {
    d.kp_1_kg_m2 = kp;
    const ErrorBounds b = error_bounds(elaborate(d, registers()));
    CHECK(b.tau_hat_nm.against_quantised > before);
    before = b.tau_hat_nm.against_quantised;
  }
  // Fed back whole it is an integrator but for the quantised constants: a bound without use.
  d.kp_1_kg_m2 = 0;
  CHECK(error_bounds(elaborate(d, registers())).tau_hat_nm.against_quantised > 1);
  // Above 1 with either sign the argument through the limit fails; the closed section still holds.
  d.kp_1_kg_m2 = 5000;
  const ErrorBounds n = error_bounds(elaborate(d, registers()));
  CHECK(n.tau_hat_nm.against_quantised == endless);
  CHECK(n.unlimited_tau_hat_nm.against_quantised < 1e-3);
  CHECK(std::isfinite(n.velocity_rad_s.against_reference));
}

// Peak gains of the sections against plain sums in 113 bits.

namespace {

Quad magnitude_of(Quad x) { return x < 0 ? -x : x; }

TEST_CASE("an interval contains the exact result of every operation") {
  const double values[] = {0.1, 1.0 / 3, -7.3e-12, 5.0e-4, 1.0, -1e20, 0.0};
  for (const double x : values) {
    for (const double y : values) {
      const Interval a(x), b(y);
      const Quad qx = x, qy = y;
      const auto holds = [](const Interval& i, Quad exact) {
        return static_cast<Quad>(i.lower()) < exact && exact < static_cast<Quad>(i.upper());
      };
      CHECK(holds(a + b, qx + qy));
      CHECK(holds(a - b, qx - qy));
      if (x != 0 && y != 0) CHECK(holds(a * b, qx * qy));
      if (x != 0 && y != 0) CHECK(holds(a / b, qx / qy));
    }
  }
}

TEST_CASE("what has no bound has none after any sum") {
  const double endless = std::numeric_limits<double>::infinity();
  const Interval none(endless, endless);
  CHECK((none + Interval(1.0)).upper() == endless);
  CHECK((Interval(0.5) * (Interval(2.0) + none)).upper() == endless);
  CHECK((Interval(1.0) - none).lower() == -endless);
}

TEST_CASE("the gain of one pole is the sum of its powers") {
  for (const double pole : {0.0, 0.5, 0.9995, -0.7, 1 - 5e-6}) {
    Quad sum = 0, power = 1;
    for (long k = 0; k < 60'000'000 && power != 0; ++k) {
      sum += magnitude_of(power);
      power *= pole;
      if (magnitude_of(power) < static_cast<Quad>(1e-25)) break;
    }
    const Interval gain = one_pole_gain(Interval(pole));
    CHECK(gain.upper() >= static_cast<double>(sum));
    CHECK(gain.upper() <= static_cast<double>(sum) * (1 + 1e-9));
  }
  CHECK(one_pole_gain(Interval(1.0)).upper() == std::numeric_limits<double>::infinity());
}

TEST_CASE("the gain of an exchanged coefficient covers the summed difference") {
  const double pairs[][2] = {{5.0e-4, 5.00003e-4}, {0.3, 0.31}, {0.01, 0.0099}, {1.0, 0.999}};
  for (const auto& [p, q] : pairs) {
    Quad sum = 0, a = p, b = q;
    for (long k = 0; k < 400'000; ++k) {
      sum += magnitude_of(a - b);
      a *= 1 - static_cast<Quad>(p);
      b *= 1 - static_cast<Quad>(q);
    }
    const double gain = lowpass_change_gain(Interval(p), Interval(q));
    INFO("coefficients " << p << ", " << q);
    CHECK(gain >= static_cast<double>(sum));
    if (p < 0.1) CHECK(gain <= static_cast<double>(sum) * 1.02);
  }
  CHECK(lowpass_change_gain(Interval(0.0), Interval(0.1)) ==
        std::numeric_limits<double>::infinity());
}

TEST_CASE("the gain behind a high-pass is the variation of the cascade's response") {
  const double pairs[][2] = {
      {0.9995, 0.9995}, {0.9995, 0.9996084}, {0.995, 0.9995}, {0.0, 0.5}, {0.5, -0.5}};
  for (const auto& [p, q] : pairs) {
    Quad response = 0, before = 0, power = 1, sum = 0, peak = 0;
    for (long k = 0; k < 120'000; ++k) {
      response = q * response + power;
      power *= p;
      sum += magnitude_of(response - before);
      peak = response > peak ? response : peak;
      before = response;
    }
    const double gain = high_passed_gain(Interval(p), Interval(q));
    INFO("poles " << p << ", " << q);
    CHECK(gain >= static_cast<double>(sum));
    CHECK(gain <= static_cast<double>(sum) * 1.001);
    // Both poles positive: the response rises once and falls once.
    if (q >= 0) CHECK(static_cast<double>(sum) <= static_cast<double>(2 * peak) * (1 + 1e-12));
  }
  CHECK(high_passed_gain(Interval(1.0), Interval(0.5)) == std::numeric_limits<double>::infinity());
}

}  // namespace

}  // namespace feltgate::bounds
