// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The error budget: its whole is the chain in fixed point, each row stays below what is proven of
// its source, and the whole below the sum of these. Documentation: docs/error-bounds.md
#include "studies/budget/budget.hpp"

#include <algorithm>

#include "catch.hpp"
#include "design/design.hpp"

namespace feltgate::bounds {

namespace {

ChainNumbers numbers_of(const std::string& name) {
  const std::string rtl = std::string(FELTGATE_ROOT) + "/rtl/";
  return chain_numbers(design::elaborate(design::read_design(rtl + "designs/" + name + ".toml"),
                                         design::read_registers(rtl + "registers.toml")));
}

const BudgetRow& row(const Budget& budget, const std::string& name) {
  const auto& rows = budget.rows();
  const auto found =
      std::find_if(rows.begin(), rows.end(), [&](const BudgetRow& r) { return r.name == name; });
  REQUIRE(found != rows.end());
  return *found;
}

}  // namespace

TEST_CASE("each row of a budget is below its source's bound, the whole below their sum") {
  for (const char* design : {"lever", "paper"}) {
    const ChainNumbers numbers = numbers_of(design);
    const auto budget = make_budget(design);
    const auto fixed = make_real_chain(design, "fixed");
    InputRegion region;
    region.scene = "spring_tension";
    budget->cover(Coverage(error_bounds(numbers, region), numbers));
    ChainIn in;
    in.scene = 5;  // this spring, armed at its rest
    for (int k = 0; k < 200'000; ++k) {
      in.armed = k > 1000;
      in.position = k < 100'000 ? k / 200 : 500 - (k - 100'000) / 300;
      in.travel = static_cast<std::int16_t>(in.position);
      budget->tick(in);
      fixed->tick(in);
      REQUIRE(budget->raw()->tau_hat == fixed->raw()->tau_hat);
    }
    CHECK(budget->largest_velocity_rad_s() > 4);
    region.velocity_rad_s = budget->largest_velocity_rad_s();
    SourceBound sum{};
    double velocity = 0;
    for (const SourceBound& source : source_bounds(numbers, region)) {
      const BudgetRow& r = row(*budget, source.name);
      CAPTURE(design, source.name);
      CHECK(r.velocity_rad_s.max() <= source.velocity_rad_s);
      CHECK(r.tau_hat_nm.max() <= source.tau_hat_nm);
      CHECK(r.current_a.max() <= source.current_a);
      if (source.name == "gain") continue;  // of the reference itself, in no other figure
      sum.velocity_rad_s += source.velocity_rad_s;
      sum.tau_hat_nm += source.tau_hat_nm;
      sum.current_a += source.current_a;
      velocity += r.velocity_rad_s.max();
    }
    const BudgetRow& whole = row(*budget, "whole");
    CAPTURE(design);
    CHECK(whole.tau_hat_nm.count() > 100'000);
    CHECK(whole.tau_hat_nm.max() > 0);
    CHECK(whole.velocity_rad_s.max() <= sum.velocity_rad_s);
    CHECK(whole.tau_hat_nm.max() <= sum.tau_hat_nm);
    CHECK(whole.current_a.max() <= sum.current_a);
    // The estimator is linear but for its rounding: there the rows themselves add up.
    CHECK(whole.velocity_rad_s.max() <= velocity * (1 + 1e-9));
  }
}

}  // namespace feltgate::bounds
