// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The chain tick by tick: in fixed point the integers of the core's snapshots, on random lives of a
// core; in real arithmetic near them. Documentation: docs/speed-for-accuracy.md
#include <cmath>
#include <memory>
#include <string>

#include "../feltgate_core/core_stimulus.hpp"
#include "catch.hpp"
#include "feltgate/feltgate_core.hpp"
#include "feltgate/generated/lever.hpp"
#include "feltgate/generated/paper.hpp"
#include "feltgate/largest.hpp"
#include "feltgate/while_armed.hpp"
#include "mismatch.hpp"
#include "sim/backends/backend.hpp"
#include "sim/reference/chain.hpp"
#include "twins.hpp"

namespace {

using namespace feltgate;

/// A core clock by clock and the chain beside it, given the same samples and words.
template <class D>
class Beside {
 public:
  std::int64_t ticks = 0, armed = 0;

  explicit Beside(std::uint64_t seed)
      : stimulus_(seed), chain_(make_real_chain(D::name, "fixed")), host_(D::control_reset) {}

  void run(std::int64_t clocks) {
    for (std::int64_t k = 0; k < clocks; ++k) {
      CoreIn in = stimulus_(k);
      // A chain knows no self-test.
      if (in.reg_addr == D::A::self_test_pulse) in.reg_wdata = 0;
      if (in.reg_write && !core_.out().reg_busy) waiting_ = {in.reg_addr, in.reg_wdata};
      const std::int64_t before = core_.writes();
      const bool zero = zero_, disarmed = disarmed_;
      zero_ = zero_ || in.set_zero;
      disarmed_ =
          disarmed_ || (in.reg_write && in.reg_addr == D::C::control && disarms(in.reg_wdata));
      core_.clock(in);
      if (core_.out().snapshot_valid) tick();
      if (core_.writes() != before) {
        if (host_.write(waiting_.address, waiting_.word, core_.out().armed, disarmed)) {
          chain_->set_word(waiting_.address, waiting_.word);
        }
      }
      if (core_.clock_of_tick() != 0) continue;
      if (zero) host_.zero();
      zero_ = in.set_zero;
      disarmed_ = in.reg_write && in.reg_addr == D::C::control && disarms(in.reg_wdata);
    }
  }

 private:
  struct Write {
    int address = 0;
    std::uint32_t word = 0;
  };

  void tick() {
    const CoreOut& o = core_.out();
    ++ticks;
    armed += o.armed;
    ChainIn in;
    in.position = o.position;
    in.travel = core_.sampled_travel();
    in.armed = o.armed;
    in.scene = o.scene;
    in.mode = host_.mode();
    in.restart = host_.restart(o.armed, o.scene);
    in.relief = relief_of(o.limits);
    chain_->tick(in);
    const ChainRaw& r = *chain_->raw();
    const bool same = r.velocity == o.velocity && r.tau_hat == o.tau_hat &&
                      r.tau_ref == o.tau_ref && r.current_ref == o.current_ref &&
                      r.voltage == o.voltage && r.duty == o.duty &&
                      r.limits == (o.limits & ~limits_of_core);
    if (same) return;
    INFO(D::name << ", tick " << o.tick_count << ", scene " << in.scene << ", mode " << in.mode);
    CHECK(r.velocity == o.velocity);
    CHECK(r.tau_hat == o.tau_hat);
    CHECK(r.tau_ref == o.tau_ref);
    CHECK(r.current_ref == o.current_ref);
    CHECK(r.voltage == o.voltage);
    CHECK(r.duty == o.duty);
    CHECK(r.limits == (o.limits & ~limits_of_core));
    FAIL("the chain differs from the core");
  }

  test::CoreStimulus<D> stimulus_;
  test::CoreOf<D> core_;
  std::unique_ptr<RealChain> chain_;
  Write waiting_;
  HostBeside host_;
  bool zero_ = false, disarmed_ = false;  ///< asked for since the end of the last tick
};

template <class D>
void compare(std::uint64_t seed) {
  std::int64_t ticks = 0, armed = 0;
  for (std::uint64_t k = 0; k < 4; ++k) {
    Beside<D> life(seed + k);
    life.run(test::scaled_clocks(5'000'000));
    ticks += life.ticks;
    armed += life.armed;
  }
  INFO(D::name << ": ticks " << ticks << ", armed " << armed);
  REQUIRE(ticks > 350'000);
  REQUIRE(armed > ticks / 20);
}

}  // namespace

TEST_CASE("the chain in fixed point is the core", "[chain]") {
  compare<Lever>(31);
  compare<Paper>(41);
}

TEST_CASE("the chain in real arithmetic is near the chain in fixed point", "[chain]") {
  for (const char* design : {"lever", "paper"}) {
    const auto fixed = make_real_chain(design, "fixed");
    const auto quad = make_real_chain(design, "quad");
    for (const char* kind : {"float", "double", "quad"}) {
      const auto real = make_real_chain(design, kind);
      fixed->reset();
      quad->reset();
      double worst_velocity = 0, worst_torque = 0;
      ChainIn in;
      in.armed = true;
      in.scene = Lever::scene_number("spring_tension");
      for (int k = 0; k < 40'000; ++k) {
        in.position = in.travel = static_cast<std::int16_t>(300 * std::sin(2e-4 * k));
        for (RealChain* chain : {fixed.get(), quad.get(), real.get()}) chain->tick(in);
        worst_velocity = feltgate::larger(
            worst_velocity, std::fabs(real->out().velocity_rad_s - quad->out().velocity_rad_s));
        worst_torque = feltgate::larger(worst_torque,
                                        std::fabs(real->out().tau_hat_nm - quad->out().tau_hat_nm));
        REQUIRE(std::fabs(real->out().tau_ref_nm - fixed->out().tau_ref_nm) < 1e-3);
      }
      INFO(design << " " << kind << ": velocity " << worst_velocity << ", torque " << worst_torque);
      const bool narrow = std::string(kind) == "float";
      CHECK(worst_velocity < (narrow ? 1e-1 : 1e-9));
      CHECK(worst_torque < (narrow ? 1e-2 : 1e-9));
      if (narrow) CHECK(worst_velocity > 0);
    }
  }
}

TEST_CASE("a word and a value mean the same", "[chain]") {
  const auto fixed = make_real_chain("lever", "fixed");
  const auto real = make_real_chain("lever", "double");
  const std::uint32_t word = 12'345;
  for (RealChain* chain : {fixed.get(), real.get()}) {
    chain->set_word(Lever::A::setpoint_torque, word);
    chain->set_word(Lever::A::ramp_step, 1u << 20);
    ChainIn in;
    in.armed = true;
    in.scene = Lever::S::setpoint;
    for (int k = 0; k < 100; ++k) chain->tick(in);
    CHECK(chain->out().tau_ref_nm == 12'345.0 / 65'536);
  }
  CHECK(real->raw() == nullptr);
  CHECK(fixed->raw()->tau_ref == 12'345);
  CHECK_THROWS_AS(fixed->set_parameter(Lever::A::setpoint_torque, 1e9), std::invalid_argument);
  CHECK_THROWS_AS(fixed->set_parameter(511, 0.0), std::invalid_argument);
  CHECK_THROWS_AS(make_real_chain("lever", "half"), std::invalid_argument);
}

namespace {

using A = Lever::A;
using S = Lever::S;

/// Of the lever with programs, too.
class Direct {
 public:
  Chain<axis::Fixed> chain{"fixed", built()};
  ChainIn in;

  Direct() {
    in.armed = true;
    chain.set_word(A::ramp_step, ~0U >> 1);  // a ramp ends in a tick
  }
  std::int32_t tau_ref(int scene, int ticks) {
    in.scene = scene;
    for (int k = 0; k < ticks; ++k) chain.tick(in);
    return chain.raw()->tau_ref;
  }

 private:
  static DesignInfo built() {
    DesignInfo design = design_info<Lever>();
    design.data.constants["SCENE_MASK"] |= 1 << S::law;
    return design;
  }
};

}  // namespace

TEST_CASE("chain: a reset takes the torque and its ramp away", "[chain]") {
  Direct d;
  d.chain.set_word(A::setpoint_torque, 4242);
  CHECK(d.tau_ref(S::setpoint, 3) == 4242);
  CHECK_FALSE(d.chain.ramping());
  d.chain.reset();
  CHECK(d.chain.tau_ref() == 0);
  d.tau_ref(S::setpoint, 1);
  CHECK(d.chain.ramping());
}

TEST_CASE("chain: a program's torque is rendered", "[chain]") {
  Direct d;
  d.chain.program(std::ldexp(-777.0, -Lever::f.torque.fraction));
  CHECK(d.tau_ref(S::law, 3) == -777);
}

TEST_CASE("chain: the velocity's input is of the travel since m1 ticks ago", "[chain]") {
  Direct d;
  constexpr std::int64_t one = std::int64_t{1}
                               << (Lever::f.velocity.fraction + Lever::velocity_shift);
  CHECK(d.chain.velocity_input(1) == one);
  CHECK(d.chain.velocity_input(-1) == -one);
  d.in.travel = 5;
  for (int k = 0; k < Lever::m1; ++k) d.chain.tick(d.in);
  CHECK(d.chain.velocity_input(5) == 0);
  CHECK(d.chain.velocity_input(6) == one);
  CHECK(d.chain.velocity_input(4) == -one);
}
