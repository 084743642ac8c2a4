// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// scene_setpoint: RTL against twin on every clock, and against the law.
// Documentation: docs/blocks/scenes.md
#include <Vscene_setpoint.h>

#include "../scenes/scene_bench.hpp"
#include "../scenes/scene_twins.hpp"
#include "catch.hpp"
#include "feltgate/scene_setpoint.hpp"
#include "ports.hpp"

using namespace feltgate;
using namespace feltgate::test;

namespace {

using Law = SceneSetpointLaw<Design, Fixed>;

struct Block : BlockOf<Vscene_setpoint, SceneSetpoint<Design>> {
  static Twin::In in(const Wave& wave, const Bus& bus) {
    return {wave.scene == S::setpoint, bus.wave, bus.param};
  }
  static void drive(Rtl& rtl, const Twin::In& in) {
    rtl.select_i = in.select;
    FELTGATE_STROBES(rtl, in.wave, param_is, W, setpoint_torque);
    rtl.param_i = in.param;
  }
  template <class Check>
  static void compare(Check& check, const Rtl& rtl, const Twin::Out& out) {
    check("plus", sign_extend<kTorque.width()>(rtl.plus_o), out.plus);
  }
};

struct Tally {
  std::int64_t waves = 0, selected = 0, left = 0;
};

struct LawBeside {
  Tally* tally;
  bool before = false;
  void forget() {}
  const char* at(const Probe& p, const Block::Rtl& rtl, const Block::Twin&) {
    if (p.t != kRendered) return nullptr;
    const bool selected = p.wave.scene == S::setpoint;
    ++tally->waves;
    tally->selected += selected;
    tally->left += before && !selected;
    before = selected;
    const std::int64_t wanted = selected ? Law::torque(p.memory.words()).raw() : 0;
    return sign_extend<kTorque.width()>(rtl.plus_o) == wanted ? nullptr : "the law's torque";
  }
};

struct Next {
  Random random;
  int scene = S::setpoint;
  Wave operator()(Memory& memory, std::int64_t) {
    memory.write(A::setpoint_torque, any_word(random));
    if (random.one_in(5)) scene = static_cast<int>(random.below(9));
    Wave wave;
    wave.scene = scene;
    wave.length = static_cast<int>(random.between(Wave::kShortest, 50));
    return wave;
  }
};

}  // namespace

TEST_CASE("scene_setpoint: random words, scenes and resets") {
  Tally tally;
  run_waves<Block>("scene_setpoint", 1, Next{Random(3)}, LawBeside{&tally}, scaled_clocks(300000),
                   3000);
  INFO("waves " << tally.waves << ", selected " << tally.selected << ", left " << tally.left);
  REQUIRE(tally.waves > 6000);
  REQUIRE(tally.selected > 500);
  REQUIRE(tally.left > 100);
}

TEST_CASE("scene_setpoint: the word is the torque, whatever lies above its bits") {
  for (const std::int64_t raw : {0, 1, -1, 32768, -32768, 1048575, -1048576}) {
    Memory memory;
    memory.write(A::setpoint_torque, (raw & 0x1fffff) | 0x5a800000);
    REQUIRE(Law::torque(memory.words()).raw() == raw);
  }
}
