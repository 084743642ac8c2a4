// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The laws of a design in a row, stage by stage: what the core's twin asks of them beside ticks.
// Documentation: docs/architecture.md
#include "feltgate/chain_tick.hpp"

#include "catch.hpp"
#include "feltgate/generated/lever.hpp"

namespace {

using namespace feltgate;

/// The lever with programs, too.
struct Built : Lever {
  static constexpr std::uint32_t scene_mask = Lever::scene_mask | 1u << Lever::S::law;
};
using Chain = ChainTick<Built, Fixed>;
using A = Lever::A;
using S = Lever::S;

/// The largest ramp step: a ramp ends in a tick.
constexpr std::int64_t at_once = fixed_of<Lever::P::ramp_step.key()>::max_raw();

}  // namespace

TEST_CASE("chain: a reset takes the torque and its ramp away") {
  Chain chain;
  chain.words().set_raw(A::ramp_step, at_once);
  chain.words().set_raw(A::setpoint_torque, 4242);
  for (int k = 0; k < 3; ++k) chain.tick(0, 0, true, S::setpoint, Mode::closed_loop);
  CHECK(chain.tau_ref().raw() == 4242);
  CHECK_FALSE(chain.limit_ramp());
  chain.reset();
  CHECK(chain.tau_ref().raw() == 0);
  chain.render(true, S::setpoint, 0);
  CHECK(chain.limit_ramp());
}

TEST_CASE("chain: a program's torque is rendered") {
  Chain chain;
  chain.words().set_raw(A::ramp_step, at_once);
  chain.program(Chain::Torque::from_raw(-777));
  for (int k = 0; k < 3; ++k) chain.render(true, S::law, 0);
  CHECK(chain.tau_ref().raw() == -777);
}

TEST_CASE("chain: the velocity's input is of the travel since m1 ticks ago") {
  Chain chain;
  const auto one = VelocityLaw<Built, Fixed>::raw(1, nullptr);
  REQUIRE(one.raw() > 0);
  CHECK(chain.velocity_input(1) == one.raw());
  CHECK(chain.velocity_input(-1) == -one.raw());
  for (int k = 0; k < Built::m1; ++k) chain.estimate(5);
  CHECK(chain.velocity_input(5) == 0);
  CHECK(chain.velocity_input(6) == one.raw());
  CHECK(chain.velocity_input(4) == -one.raw());
}
