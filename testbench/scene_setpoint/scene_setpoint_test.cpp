// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// scene_setpoint: RTL against twin on every clock, clock() against tick().
// Documentation: docs/blocks/scene_setpoint.md
#include <Vscene_setpoint.h>

#include "../scenes/scene_wave.hpp"
#include "catch.hpp"
#include "feltgate/scene_setpoint.hpp"

using namespace feltgate;
using namespace feltgate::test;

namespace {

using Twin = SceneSetpoint<Design>;

struct Block {
  static Twin::In in(const Wave& wave, const Bus& bus) {
    return {wave.scene == Design::S::setpoint, bus.start, bus.param};
  }
  static std::int64_t operand(const Twin::Out&) { return 0; }
  static void drive(Vscene_setpoint& rtl, const Twin::In& in) {
    rtl.select_i = in.select;
    rtl.start_i = in.start;
    rtl.param_i = in.param;
  }
  template <class Check>
  static void compare(Check& check, const Vscene_setpoint& rtl, const Twin::Out& out) {
    check("tau", sign_extend<kTorque.width()>(rtl.tau_o), out.tau);
  }
};

struct Tally {
  std::int64_t waves = 0, selected = 0, left = 0;
};

struct TickBeside {
  Tally* tally;
  Twin beside{};
  bool before = false;
  void forget() { beside.reset(); }
  const char* operator()(const Probe& p, const Vscene_setpoint&, const Twin& twin) {
    const bool selected = p.wave.scene == Design::S::setpoint;
    beside.tick(p.memory.words(), selected);
    ++tally->waves;
    tally->selected += selected;
    tally->left += before && !selected;
    before = selected;
    return beside.out().tau == twin.out().tau ? nullptr : "tick() differs from clock()";
  }
};

struct Next {
  Random random;
  int scene = Design::S::setpoint;
  Wave operator()(Memory& memory, std::int64_t) {
    memory.write(Design::A::setpoint_torque, any_word(random));
    if (random.one_in(5)) scene = static_cast<int>(random.below(9));
    Wave wave;
    wave.scene = scene;
    wave.length = static_cast<int>(random.between(30, 50));
    return wave;
  }
};

}  // namespace

TEST_CASE("scene_setpoint: random words, scenes and resets") {
  Tally tally;
  const auto probe = std::make_shared<Probe>();
  LockStep<Vscene_setpoint, Twin, Block> bench("scene_setpoint", 1);
  bench.run(Waves<Block, Next>(2, Next{Random(3)}, probe), scaled_clocks(300000), {3000},
            AfterWave<TickBeside>(probe, {&tally}));
  INFO("waves " << tally.waves << ", selected " << tally.selected << ", left " << tally.left);
  REQUIRE(tally.waves > 6000);
  REQUIRE(tally.selected > 500);
  REQUIRE(tally.left > 100);
}

TEST_CASE("scene_setpoint: the word is the torque, whatever lies above its bits") {
  Twin twin;
  for (const std::int64_t raw : {0, 1, -1, 32768, -32768, 1048575, -1048576}) {
    Memory memory;
    memory.write(Design::A::setpoint_torque, (raw & 0x1fffff) | 0x5a800000);
    twin.tick(memory.words(), true);
    REQUIRE(twin.out().tau == raw);
    twin.tick(memory.words(), false);
    REQUIRE(twin.out().tau == 0);
  }
}
