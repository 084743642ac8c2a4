// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Axes with their engine: the host loads a law for two axes; RTL against twin in every clock. The
// tests include arming, ramps and the age monitor. Documentation: docs/architecture.md
#include "../../engine/machine/machine_programs.hpp"
#include "axes_life.hpp"

using namespace feltgate;
using namespace feltgate::test;
using D = Design;

namespace feltgate::test {

using H = EngineMap::H;

/// Axes whose host loads a law.
class LawLife : public Life {
 public:
  void idle() {
    int n = 0;
    while (twin().out().reg_busy) {
      REQUIRE(++n < 20'000);
      clocks(1);
    }
  }
  void engine(int address, std::uint32_t word) {
    in.reg_addr = static_cast<std::uint16_t>(axes_engine + address);
    in.reg_wdata = word;
    clocks(1);
    idle();
    in.reg_write = true;
    clocks(1);
    in.reg_write = false;
    clocks(1);
    idle();
  }
  void parameters(std::int32_t minus, std::int32_t plus) {
    engine(kParameter, static_cast<std::uint32_t>(minus));
    engine(kParameter + 1, static_cast<std::uint32_t>(plus));
    engine(H::commit, 1);
    clocks(600);
  }
  void load(const EngineMemory& m, std::uint32_t crc, std::uint32_t max_age = 10) {
    for (int n = 0; n < 3; ++n) {
      engine(H::high, static_cast<std::uint32_t>(m.program_at(n) >> 32));
      engine(H::program + n, static_cast<std::uint32_t>(m.program_at(n)));
    }
    for (int n = 0; n < 2; ++n) {
      engine(EngineMap::D::lower + n,
             static_cast<std::uint32_t>(m.data_at(EngineMap::D::lower + n)));
      engine(EngineMap::D::upper + n,
             static_cast<std::uint32_t>(m.data_at(EngineMap::D::upper + n)));
    }
    engine(H::crc, crc);
    engine(H::max_age, max_age);
    parameters(-100, 100);
    engine(H::run, 1);
  }
  void ask(int scene) {
    for (int n = 0; n < kAxes; ++n) control(n, scene, false);
    write_all(A::self_test_pulse, 0);
    write_all(A::ramp_step, 0x7ffffff);
    write_all(C::command, 1u << C::command_clear_faults);
    ticks(2);
    for (int n = 0; n < kAxes; ++n) control(n, scene, true);
  }
  bool armed() const { return out(0).armed && out(1).armed; }
  /// Returns the number of ticks until both are armed, at most `limit`.
  int until_armed(int limit) {
    int n = 0;
    while (!armed() && n < limit) ticks(1), ++n;
    return n;
  }
  void arm_law() {
    ask(Design::S::law);
    REQUIRE(until_armed(5000) < 5000);
    ticks(8);
  }
  void step(int n, bool up) {
    turn(n, up);
    ticks(1);
  }
};

}  // namespace feltgate::test

namespace {

/// A spring couples two levers. Parameters 0 and 1 are minus and plus the stiffness, in torque
/// steps per count.
EngineMemory coupling() {
  using Op = EngineOp;
  EngineMemory m;
  program(m, 0,
          {to(0, Op::sub, kPosition, kPosition + 3),
           word(Op::mul, 0, 0, kParameter, EngineTarget::output, 0),
           out(1, Op::mul, 0, kParameter + 1)});
  for (int n = 0; n < 2; ++n) {
    m.set_data(EngineMap::D::lower + n, -2000);
    m.set_data(EngineMap::D::upper + n, 2000);
  }
  return m;
}

const EngineMemory kLaw = coupling();
const std::uint32_t kCrc = image_crc(kLaw);

}  // namespace

TEST_CASE("engine: a law on two axes, each with its torque, two ticks after the count") {
  LawLife s;
  s.load(kLaw, kCrc);
  s.arm_law();
  for (int k = 0; k < 5; ++k) s.step(0, true);
  s.step(1, false);
  s.ticks(3);
  CHECK(s.out(0).position == 5);
  CHECK(s.out(1).position == -1);
  CHECK(s.out(0).tau_ref == -600);
  CHECK(s.out(1).tau_ref == 600);
  // The time from the sample of a count to the tick in which its torque is the reference.
  s.step(0, true);
  int ticks = 0;
  while (s.out(0).tau_ref != -700 && ticks < 10) s.ticks(1), ++ticks;
  CHECK(ticks <= 2);
  CHECK(s.out(0).tau_ref == -700);
  s.play();
}

TEST_CASE("engine: a law is given velocities with their signs") {
  static_assert(D::f.velocity.width() < 32, "else there is no sign to lose");
  using Op = EngineOp;
  for (int n = 0; n < kAxes; ++n) {
    // -100, parameter 0, on both axes while axis n turns down.
    EngineMemory m = kLaw;
    program(
        m, 0,
        {to(0, Op::min, kVelocity + EngineMap::input_axis_words * n, kConstant),
         word(Op::max, 0, 0, kParameter, EngineTarget::output, 0), out(1, Op::max, 0, kParameter)});
    LawLife s;
    s.load(m, image_crc(m));
    s.arm_law();
    const auto turn_until = [&](bool up, auto&& reached) {
      for (int k = 0; k < 100 && !reached(s.out(n).velocity); ++k) s.step(n, up), s.ticks(3);
      CHECK(reached(s.out(n).velocity));
      s.ticks(3);
    };
    turn_until(true, [](std::int64_t v) { return v > 0; });
    for (int a = 0; a < kAxes; ++a) CHECK(s.out(a).tau_ref == 0);
    turn_until(false, [](std::int64_t v) { return v < -10'000; });
    for (int a = 0; a < kAxes; ++a) CHECK(s.out(a).tau_ref == -100);
    s.play();
  }
}

TEST_CASE(
    "engine: arming waits for the CRC, which must be that of the image in the scene of laws") {
  LawLife s;
  s.load(kLaw, kCrc ^ 1u);
  s.ask(D::S::law);
  CHECK(s.until_armed(6000) == 6000);
  // A wrong CRC has no effect in a scene without a law; entering the law scene is then a fault.
  s.ask(D::S::setpoint);
  const int waited = s.until_armed(6000);
  INFO("ticks " << waited);
  CHECK(waited > 100);
  CHECK(waited * 1000.0 / D::tick_hz < 5.0);
  for (int n = 0; n < kAxes; ++n) s.control(n, D::S::law, true);
  s.ticks(2);
  for (int n = 0; n < kAxes; ++n) {
    CHECK_FALSE(s.out(n).gates_enable);
    CHECK(s.out(n).tau_ref == 0);
  }
  CHECK(s.out(0).first_fault == static_cast<unsigned>(Fault::engine));
  s.play();
}

TEST_CASE("engine: a law that gives no fresh torque in its time is a fault of all axes") {
  LawLife s;
  s.load(kLaw, kCrc);
  s.engine(H::divider0, 200);
  s.ask(D::S::law);
  CHECK(s.until_armed(6000) < 6000);
  s.ticks(30);
  for (int n = 0; n < kAxes; ++n) {
    CHECK_FALSE(s.out(n).gates_enable);
    CHECK(s.out(n).first_fault == static_cast<unsigned>(Fault::engine));
  }
  s.play();
}

TEST_CASE("engine: random levers and hosts around a law") {
  LawLife s;
  s.load(kLaw, kCrc);
  struct Loaded {
    std::vector<In> first;
    AxesStimulus<D, kAxes> then;
    In operator()(std::int64_t clock) {
      const std::int64_t k = clock - AxesBench::kFirstReset;
      if (k < 0) return {};
      return k < static_cast<std::int64_t>(first.size()) ? first[static_cast<std::size_t>(k)]
                                                         : then(clock);
    }
  };
  // Runs in which the check of the law ends before a lever of the stimulus causes another fault.
  Tally tally;
  for (const unsigned seed : {13U, 16U, 25U}) {
    AxesBench bench("feltgate_axes", seed);
    bench.run(Loaded{s.inputs(), AxesStimulus<D, kAxes>(seed, 150'000)}, scaled_clocks(400'000), {},
              Watch{&tally});
  }
  INFO("armed in " << tally.armed << " of " << tally.clocks);
  CHECK(tally.armed > tally.clocks / 200);
}
