// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// scene_membrane: RTL against twin on every clock, and against the law in every wave; the law's
// entries from every side and its energy balance. Documentation: docs/blocks/scenes.md
#include <Vscene_membrane.h>

#include <vector>

#include "../scenes/scene_bench.hpp"
#include "../scenes/scene_twins.hpp"
#include "catch.hpp"
#include "ports.hpp"

using namespace feltgate;
using namespace feltgate::test;

namespace {

using Law = SceneMembraneLaw<Design, Fixed>;

struct Block : BlockOf<Vscene_membrane, SceneMembrane<Design>> {
  static Twin::In in(const Wave& wave, const Bus& bus) {
    return {wave.scene == S::membrane, bus.distance > 0, bus.face_gap < 0, bus.wave, bus.param};
  }
  static void drive(Rtl& rtl, const Twin::In& in) {
    FELTGATE_DRIVE(rtl, in, select, distance_positive, gap_negative, param);
    FELTGATE_STROBES(rtl, in.wave, param_is, W, membrane_upper, membrane_torque);
    FELTGATE_STROBES(rtl, in.wave >> 1, param_was, W, membrane_upper);
  }
  template <class Check>
  static void compare(Check& check, const Rtl& rtl, const Twin::Out& out) {
    check("plus", sign_extend<kTorque.width()>(rtl.plus_o), out.plus);
    check("minus", sign_extend<kTorque.width()>(rtl.minus_o), out.minus);
  }
};

struct Tally {
  std::int64_t waves = 0, up = 0, down = 0, unknown = 0;
};

struct LawBeside {
  Tally* tally;
  MembraneSide side = MembraneSide::unknown;
  void forget() { side = MembraneSide::unknown; }
  const char* at(const Probe& p, const Block::Rtl& rtl, const Block::Twin&) {
    if (p.t != kRendered) return nullptr;
    const bool selected = p.wave.scene == S::membrane;
    std::int64_t wanted = 0;
    if (selected) {
      wanted = Law::torque(p.memory.words(), p.wave.position, &side).raw();
    } else {
      side = MembraneSide::unknown;
    }
    const std::int64_t tau =
        sign_extend<kTorque.width()>(rtl.plus_o) - sign_extend<kTorque.width()>(rtl.minus_o);
    ++tally->waves;
    tally->up += tau > 0;
    tally->down += tau < 0;
    tally->unknown += selected && side == MembraneSide::unknown;
    return tau == wanted ? nullptr : "the law's torque";
  }
};

/// Faces and torque at random, a shaft that walks or jumps around them.
struct Next {
  Random random;
  Wave wave{};
  Wave operator()(Memory& memory, std::int64_t number) {
    if (number == 0 || random.one_in(40)) {
      std::int64_t lower = random.between(-40000, 40000);
      if (random.one_in(4)) lower = (lower & ~std::int64_t{255}) + (1 << random.below(8));
      // Now and then the faces cross: both sides at once, until they are written again.
      const std::int64_t least = random.one_in(4) ? -256 * 60 : -300;
      memory.write(A::membrane_lower, lower);
      memory.write(A::membrane_upper, lower + random.between(least, 256 * 60));
      memory.write(A::membrane_torque, random.one_in(4) ? any_word(random) : random.below(65536));
      if (random.one_in(16)) memory.write(A::membrane_lower, any_word(random));
    }
    if (random.one_in(20)) {
      wave.scene = random.coin() ? S::membrane : static_cast<int>(random.below(9));
    }
    if (number == 0) wave.scene = S::membrane;
    if (random.one_in(12)) {
      wave.position = any_position(random, memory, S::membrane);
    } else {
      wave.position += static_cast<std::int32_t>(random.between(-12, 12));
      if (wave.position > kEnd || wave.position < -kEnd - 1) wave.position = 0;
    }
    wave.length = static_cast<int>(random.between(Wave::kShortest, 30));
    return wave;
  }
};

constexpr std::int32_t kLower = 100, kUpper = 110;
constexpr std::int64_t kNm = 20000;

/// A membrane over [100, 110] of torque kNm, both faces with the fraction given in 1/256 count.
Memory membrane(int lower_fraction = 0, int upper_fraction = 0) {
  Memory memory;
  memory.write(A::membrane_lower, kLower * 256 + lower_fraction);
  memory.write(A::membrane_upper, kUpper * 256 + upper_fraction);
  memory.write(A::membrane_torque, kNm);
  return memory;
}

/// Torques along a path.
std::vector<std::int64_t> felt(const Memory& memory, const std::vector<std::int32_t>& path) {
  auto side = MembraneSide::unknown;
  std::vector<std::int64_t> tau;
  for (const std::int32_t position : path) {
    tau.push_back(Law::torque(memory.words(), position, &side).raw());
  }
  return tau;
}

using Torques = std::vector<std::int64_t>;

}  // namespace

TEST_CASE("scene_membrane: random faces, motions, scenes and resets") {
  Tally tally;
  run_waves<Block>("scene_membrane", 1, Next{Random(3)}, LawBeside{&tally}, scaled_clocks(1500000),
                   5000);
  INFO("waves " << tally.waves << ", up " << tally.up << ", down " << tally.down << ", unknown "
                << tally.unknown);
  REQUIRE(tally.up > 1000);
  REQUIRE(tally.down > 1000);
  REQUIRE(tally.unknown > 200);
}

TEST_CASE("scene_membrane: the sign is that of the side of entry until it is left") {
  const Memory m = membrane();
  REQUIRE(felt(m, {99, 100, 105, 103, 110, 111, 110, 104, 100, 99}) ==
          Torques{0, -kNm, -kNm, -kNm, -kNm, 0, kNm, kNm, kNm, 0});
  REQUIRE(felt(m, {111, 110, 111, 100, 99, 100}) == Torques{0, kNm, 0, kNm, 0, -kNm});
  // Selected inside: nothing until it is left and entered again.
  REQUIRE(felt(m, {105, 100, 110, 105, 99, 100}) == Torques{0, 0, 0, 0, 0, -kNm});
  // Jumped across within one tick: nothing.
  REQUIRE(felt(m, {90, 120, 90}) == Torques{0, 0, 0});
  // Jumped in from afar and back.
  REQUIRE(felt(m, {-5000, 109, 101, 5000, 101}) == Torques{0, -kNm, -kNm, 0, kNm});
}

TEST_CASE("scene_membrane: faces are compared with their fraction") {
  REQUIRE(felt(membrane(1, 0), {99, 100, 101}) == Torques{0, 0, -kNm});
  REQUIRE(felt(membrane(255, 255), {99, 100, 101, 110, 111}) == Torques{0, 0, -kNm, -kNm, 0});
  REQUIRE(felt(membrane(0, 255), {112, 111, 110}) == Torques{0, 0, kNm});
  REQUIRE(felt(membrane(-1, -1), {98, 99, 100, 109, 110}) == Torques{0, 0, -kNm, -kNm, 0});
}

TEST_CASE("scene_membrane: a negative torque word counts as 0") {
  Memory memory = membrane();
  memory.write(A::membrane_torque, -1);
  REQUIRE(felt(memory, {99, 105}) == Torques{0, 0});
}

TEST_CASE("scene_membrane: absorbs energy over any motion of at most a count per tick") {
  // A count per tick is 1534 rad/s. Turning points lie in the middle of a count.
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    Random random(seed);
    const Memory memory =
        membrane(static_cast<int>(random.below(256)), static_cast<int>(random.below(256)));
    auto side = MembraneSide::unknown;
    std::int32_t position = static_cast<std::int32_t>(random.between(80, 130));
    std::int64_t tau = 0, twice_work = 0, crossings = 0;
    std::int32_t direction = 1;
    for (int k = 0; k < 20000; ++k) {
      if (random.one_in(12)) direction = static_cast<std::int32_t>(random.between(-1, 1));
      if (position < 70) direction = 1;
      if (position > 140) direction = -1;
      position += direction;
      const std::int64_t now = Law::torque(memory.words(), position, &side).raw();
      twice_work += (tau + now) * direction;
      crossings += tau == 0 && now != 0;
      tau = now;
      REQUIRE(twice_work <= 0);
    }
    REQUIRE(crossings > 50);
    REQUIRE(twice_work < -100 * kNm);
  }
}
