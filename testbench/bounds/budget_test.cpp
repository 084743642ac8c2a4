// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The error budget: its rows add up to the whole, its whole is the chain in fixed point.
// Documentation: docs/error-bounds.md
#include "budget/budget.hpp"

#include "catch.hpp"

namespace feltgate::bounds {

TEST_CASE("the rows of a budget add up to the whole") {
  for (const char* design : {"lever", "paper"}) {
    const auto budget = make_budget(design);
    const auto fixed = make_real_chain(design, "fixed");
    ChainIn in;
    in.scene = 5;  // a spring, armed at its rest
    for (int k = 0; k < 200'000; ++k) {
      in.armed = k > 1000;
      in.position = k < 100'000 ? k / 200 : 500 - (k - 100'000) / 300;
      in.travel = static_cast<std::int16_t>(in.position);
      budget->tick(in);
      fixed->tick(in);
      REQUIRE(budget->raw()->tau_hat == fixed->raw()->tau_hat);
    }
    double velocity = 0, tau_hat = 0, current = 0;
    for (const BudgetRow& r : budget->rows()) {
      if (r.name == "whole") {
        INFO(design);
        CHECK(r.velocity_rad_s.max() <= velocity * (1 + 1e-9));
        CHECK(r.tau_hat_nm.max() <= tau_hat * 1.05);
        CHECK(r.current_a.max() <= current * 1.05);
        CHECK(r.tau_hat_nm.max() >= tau_hat * 0.2);
        break;
      }
      velocity += r.velocity_rad_s.max();
      tau_hat += r.tau_hat_nm.max();
      current += r.current_a.max();
    }
    CHECK(budget->largest_velocity_rad_s() > 4);
  }
}

}  // namespace feltgate::bounds
