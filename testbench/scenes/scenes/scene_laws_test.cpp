// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The scenes' law by itself, where the block's lock-step does not come: self-test pulses, relief, a
// program's torque, the ends of the scenes' numbers, and a charge in real arithmetic.
// Documentation: docs/blocks/scenes.md
#include <array>

#include "catch.hpp"
#include "feltgate/generated/lever.hpp"
#include "feltgate/quad.hpp"
#include "feltgate/scenes.hpp"

namespace {

using namespace feltgate;

/// The lever with programs, too.
struct Built : Lever {
  static constexpr std::uint32_t scene_mask = Lever::scene_mask | 1u << Lever::S::law;
};
struct AllBits : Lever {
  static constexpr std::uint32_t scene_mask = ~0u;
};

using A = Lever::A;
using S = Lever::S;
using Law = ScenesLaw<Built, Fixed>;
constexpr Law::Velocity at_rest{};
constexpr std::int64_t most_setpoint = fixed_of<Lever::P::setpoint_torque.key()>::max_raw();

/// A torque reference without ramps: the largest step ends them in a tick.
struct Device {
  Words<Built, Fixed> words;
  Law law;

  Device() { words.set_raw(A::ramp_step, fixed_of<Lever::P::ramp_step.key()>::max_raw()); }
  std::int64_t tick(int scene, bool armed = true, Relief relief = {},
                    TestPulse pulse = TestPulse::none, std::int32_t position = 0) {
    law.tick(words, armed, scene, position, at_rest, relief, pulse);
    return law.tau_ref().raw();
  }
  /// Past the tick that ends a ramp.
  std::int64_t settled(int scene, bool armed = true, Relief relief = {}) {
    tick(scene, armed, relief);
    return tick(scene, armed, relief);
  }
  std::int64_t limit_word(int address) const {
    return words.get<RampLaw<Built, Fixed>::kLimitKey>(address).raw();
  }
};

}  // namespace

TEST_CASE("scenes: numbers 0 to 15 are scenes, whatever the mask") {
  for (const int scene : {-32, -1, 16, 32}) CHECK_FALSE(scene_built<AllBits>(scene));
  for (const int scene : {0, 1, 15}) CHECK(scene_built<AllBits>(scene));
  CHECK(scene_built<Built>(S::law));
  CHECK_FALSE(scene_built<Lever>(S::law));
}

TEST_CASE("scenes: a pulse of the self-test stands instead of the scene, at once") {
  Device d;
  const std::int64_t pulse = d.limit_word(A::self_test_torque);
  d.words.set_raw(A::setpoint_torque, 13371);
  REQUIRE(pulse > 0);
  REQUIRE(pulse != 13371);
  CHECK(d.settled(S::setpoint) == 13371);
  CHECK(d.tick(S::setpoint, true, {}, TestPulse::rest) == 0);
  CHECK_FALSE(d.law.limit_ramp());
  CHECK(d.tick(S::setpoint, true, {}, TestPulse::up) == pulse);
  CHECK_FALSE(d.law.limit_torque());
  CHECK(d.tick(S::setpoint, true, {}, TestPulse::down) == -pulse);
  CHECK(d.tick(S::setpoint, true, {}, TestPulse::rest) == 0);
  // The scene comes back by the ramp.
  d.words.set_raw(A::ramp_step, 16);
  CHECK(d.tick(S::setpoint) < 13371);
  CHECK(d.law.limit_ramp());
}

TEST_CASE("scenes: disarmed there is no torque, and no limit is told") {
  Device d;
  d.words.set_raw(A::setpoint_torque, most_setpoint);
  CHECK(d.settled(S::setpoint, false) == 0);
  CHECK_FALSE(d.law.limit_torque());
  CHECK_FALSE(d.law.limit_ramp());
  CHECK(d.tick(S::setpoint) == 0);  // ends the ramp, the reference follows with the next
  CHECK(d.law.limit_torque());
  CHECK(d.law.limit_ramp());
  CHECK(d.tick(S::setpoint) == d.limit_word(A::torque_limit));
  CHECK(d.settled(S::setpoint, false) == 0);
}

TEST_CASE("scenes: a relief eases the limit") {
  Device d;
  d.words.set_raw(A::setpoint_torque, most_setpoint);
  const std::int64_t whole = d.limit_word(A::torque_limit), derated = d.limit_word(A::hold_limit);
  REQUIRE(derated < whole);
  CHECK(d.settled(S::setpoint) == whole);
  CHECK(d.law.limit_torque());
  CHECK(d.settled(S::setpoint, true, {false, true}) == derated);
  CHECK(d.settled(S::setpoint) == whole);
}

TEST_CASE("scenes: the least limit is in force, in a held torque and in a pulse") {
  Device d;
  d.words.set_raw(A::setpoint_torque, most_setpoint);
  d.words.set_raw(A::torque_limit, 100);
  CHECK(d.settled(S::setpoint, true, {false, true}) == 100);
  CHECK(d.tick(S::setpoint, true, {}, TestPulse::up) == 100);
  CHECK(d.tick(S::setpoint, true, {}, TestPulse::down) == -100);
  d.words.set_raw(A::hold_limit, 70);
  CHECK(d.settled(S::setpoint, true, {false, true}) == 70);
  CHECK(d.tick(S::setpoint, true, {false, true}, TestPulse::down) == -70);
  CHECK(d.settled(S::setpoint) == 100);
}

TEST_CASE("scenes: a program's torque is that of the scene `law` alone; reset forgets it") {
  Device d;
  d.law.program(Law::Torque::from_raw(-4242));
  CHECK(d.settled(S::law) == -4242);
  CHECK(d.settled(S::free) == 0);
  d.law.reset();
  CHECK(d.law.tau_ref().raw() == 0);
  CHECK(d.settled(S::law) == 0);
}

TEST_CASE("scenes: a membrane's side can be given") {
  Device d;
  d.words.set_raw(A::membrane_lower, -256 * 100);
  d.words.set_raw(A::membrane_upper, 256 * 100);
  d.words.set_raw(A::membrane_torque, 777);
  CHECK(d.settled(S::membrane) == 0);
  d.law.set_side(MembraneSide::above);
  CHECK(d.settled(S::membrane) == 777);
  CHECK(d.law.side() == MembraneSide::above);
  d.law.set_side(MembraneSide::below);
  CHECK(d.settled(S::membrane) == -777);
}

TEST_CASE("scenes: a product too large for a part saturates, at both ends") {
  using Part = ScenePartLaw<Lever, Fixed>::Part;
  using Wide = fixed<1, Part::format.integer + 4, Part::format.fraction>;
  const auto part = [](std::int64_t raw) {
    return ScenePartLaw<Lever, Fixed>::part(Wide::from_raw(raw)).raw();
  };
  CHECK(part(Part::max_raw()) == Part::max_raw());
  CHECK(part(Part::max_raw() + 1) == Part::max_raw());
  CHECK(part(Part::min_raw() - 1) == Part::min_raw());
  CHECK(part(Wide::max_raw()) == Part::max_raw());
  CHECK(part(Wide::min_raw()) == Part::min_raw());
}

TEST_CASE("scenes: the distance is from the position to the reference, exact") {
  using Part = ScenePartLaw<Lever, Fixed>;
  using Offset = Part::Offset;
  const std::array<std::int64_t, 5> references{Offset::min_raw(), -1, 0, 384, Offset::max_raw()};
  for (const std::int32_t position : {-131072, -5, 0, 7, 131071}) {
    for (const std::int64_t reference : references) {
      INFO(reference << "/256 from " << position);
      const auto distance = Part::distance(position, Offset::from_raw(reference));
      CHECK(distance.raw() == reference - std::int64_t{position} * 256);
    }
  }
}

TEST_CASE("scenes: a charge in real arithmetic") {
  using Charge = SceneChargeLaw<Lever, Real<Quad>>;
  Words<Lever, Real<Quad>> words;
  const auto torque = [&](bool attract, std::int32_t position) {
    return static_cast<double>(Charge::torque(words, attract, position));
  };
  for (const bool attract : {true, false}) {
    INFO((attract ? "attracting" : "repelling"));
    const double sign = attract ? 1 : -1;
    words.set_value(attract ? A::attract_core : A::repel_core, 0);
    words.set_value(attract ? A::attract_strength : A::repel_strength, 12);
    const int centre = attract ? A::attract_centre : A::repel_centre;
    words.set_value(centre, 0);
    CHECK(torque(attract, -2) == sign * 3);
    CHECK(torque(attract, 2) == sign * -3);
    CHECK(torque(attract, -4) == sign * 0.75);
    // Endless at the centre, towards lower positions where it attracts.
    CHECK(torque(attract, 0) == sign * -1e30);
    // The centre's fraction is ignored, downward.
    words.set_value(centre, 0.75);
    CHECK(torque(attract, -2) == sign * 3);
    words.set_value(centre, -0.25);
    CHECK(torque(attract, 1) == sign * -3);
    words.set_value(centre, -1);
    CHECK(torque(attract, 1) == sign * -3);
  }
}
