// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Bits of parameters flip while the motor is armed. Their check must find the flip and turn the
// gates off within a tick. RTL against twin on every clock. Documentation: docs/architecture.md
#include <Vcore_open.h>
#include <Vcore_open___024root.h>

#include <cstdlib>
#include <memory>

#include "catch.hpp"
#include "feltgate/feltgate_core.hpp"
#include "feltgate/generated/lever.hpp"
#include "random.hpp"
#include "sim/backends/rtl_ports.hpp"

using feltgate::CoreIn;
using feltgate::CoreOut;
using feltgate::Fault;
using D = feltgate::Lever;

namespace {

constexpr int kTick = D::clocks_per_tick;

/// RTL and twin in step, with access to the RTL's memory.
class Pair {
 public:
  CoreIn in;

  Pair() {
    rtl_->rst_ni = 1;
    rtl_->clk_i = 0;
    rtl_->eval();
    rtl_->rst_ni = 0;
    edge();
    rtl_->rst_ni = 1;
    write(D::A::self_test_pulse, 0);
  }

  void clocks(std::int64_t n) {
    for (; n > 0; --n) {
      feltgate::drive_inputs<D>(*rtl_, in);
      edge();
      twin_.clock(in);
      if (!(feltgate::read_outputs<D>(*rtl_) == twin_.out())) ++mismatches_;
    }
  }
  void to_next_tick() { clocks(kTick - twin_.clock_of_tick()); }
  void write(int address, std::uint32_t word) {
    in.reg_addr = static_cast<std::uint16_t>(address);
    in.reg_wdata = word;
    in.reg_write = true;
    clocks(1);
    in.reg_write = false;
    to_next_tick();
  }
  void flip(int address, int bit) {
    const auto at = static_cast<std::size_t>(address);
    rtl_->rootp->feltgate_core__DOT__u_wave__DOT__u_registers__DOT__parameter_ram[at] ^= QData{1}
                                                                                         << bit;
    twin_.flip(address, bit);
  }
  void flip_control(int bit) {
    if (bit < D::C::control_width) {
      rtl_->rootp->feltgate_core__DOT__u_wave__DOT__u_registers__DOT__control_o ^=
          static_cast<SData>(1u << bit);
    } else {
      rtl_->rootp->feltgate_core__DOT__u_wave__DOT__u_registers__DOT__held_check_q ^= 1u;
    }
    twin_.flip_control(bit);
  }
  /// Flips a bit of the velocity's register, in the RTL only.
  void flip_velocity(int bit) {
    auto& y =
        rtl_->rootp
            ->feltgate_core__DOT__u_estimators__DOT__g_n_method__DOT__u_velocity_n__DOT__u_lowpass__DOT__y_q;
    y ^= IData{1} << bit;
  }
  CoreOut rtl() const { return feltgate::read_outputs<D>(*rtl_); }
  /// Arms in `scene` and fills the pipeline of the parameter bus.
  void arm(int scene) {
    in.scene = static_cast<std::uint8_t>(scene);
    in.arm = false;
    to_next_tick();
    clocks(2 * kTick);
    in.arm = true;
    clocks(2 * kTick);
  }
  void clear() {
    in.arm = false;
    to_next_tick();
    write(D::C::command, 1u << D::C::command_clear_faults);
  }
  const CoreOut& out() const { return twin_.out(); }
  int mismatches() const { return mismatches_; }

 private:
  void edge() {
    rtl_->clk_i = 0;
    rtl_->eval();
    rtl_->clk_i = 1;
    rtl_->eval();
  }

  std::unique_ptr<Vcore_open> rtl_ = std::make_unique<Vcore_open>();
  feltgate::FeltgateCore<D> twin_;
  int mismatches_ = 0;
};

/// The design's word, but with the self-test off, as in a new Pair.
std::uint32_t word_of_design(int address) {
  if (address == D::A::self_test_pulse) return 0;
  for (const auto& p : D::parameters) {
    if (p.address == address) return static_cast<std::uint32_t>(p.raw);
  }
  return 0;
}

/// Clocks until the gates fall, at most `limit`.
int clocks_to_fall(Pair& pair, int limit) {
  int n = 0;
  while (n < limit && pair.out().gates_enable) pair.clocks(1), ++n;
  return n;
}

/// Checks that a flipped bit of an armed pair turns the gates off if and only if the word is
/// `used`.
void check_flip(Pair& pair, int address, int bit, bool used) {
  REQUIRE(pair.out().gates_enable);
  pair.flip(address, bit);
  pair.clocks(3 * kTick);
  CHECK(pair.out().gates_enable != used);
  CHECK(pair.mismatches() == 0);
}

}  // namespace

TEST_CASE("core: each bit of each word that a scene uses opens the gates within a tick") {
  Pair pair;
  int flips = 0;
  for (const auto& p : D::parameters) {
    // This word is on the bus only in place of another word, at high torque.
    if (p.address == D::A::voltage_gain_high) continue;
    const int scene = p.address < 64 ? D::S::free : p.address / 32;
    for (int bit = 0; bit < 36; ++bit) {
      pair.arm(scene);
      REQUIRE(pair.out().gates_enable);
      pair.flip(p.address, bit);
      INFO(p.name << ", bit " << bit);
      CHECK(clocks_to_fall(pair, 2 * kTick) <= kTick);
      // A flipped limit may trip by itself before its check does.
      pair.clocks(kTick);
      CHECK(((pair.out().faults >> static_cast<unsigned>(Fault::word)) & 1u) == 1);
      pair.in.arm = false;
      pair.to_next_tick();
      pair.write(p.address, word_of_design(p.address));
      pair.clear();
      REQUIRE(pair.out().faults == 0);
      ++flips;
    }
  }
  CHECK(flips > 1400);
  CHECK(pair.mismatches() == 0);
}

TEST_CASE("core: a bit of the voltage gain of high torque opens the gates where that is used") {
  constexpr std::int32_t border = 1 << 13;  // far below the limit
  for (const int bit : {0, 17, 31, 35}) {
    for (const int address : {D::A::voltage_gain, D::A::voltage_gain_high}) {
      for (const std::int32_t torque : {border / 2, 2 * border, -2 * border}) {
        Pair pair;
        pair.write(D::A::setpoint_torque, static_cast<std::uint32_t>(torque));
        pair.write(D::A::region_torque, border);
        pair.write(D::A::ramp_step,
                   1u << D::P::ramp_step.fraction);  // 1 Nm a tick: the ramp ends soon
        pair.arm(D::S::setpoint);
        pair.clocks(8 * kTick);
        REQUIRE(std::abs(pair.out().tau_ref) == std::abs(torque));
        const bool used = (address == D::A::voltage_gain_high) == (std::abs(torque) > border);
        INFO("address " << address << " bit " << bit << " torque " << torque);
        check_flip(pair, address, bit, used);
      }
    }
  }
}

TEST_CASE("core: flips of several bits, found or not as the four parities say") {
  Pair pair;
  feltgate::test::Random random(1);
  int found = 0, hidden = 0;
  for (int k = 0; k < 400; ++k) {
    pair.arm(D::S::free);
    const int count = 2 + static_cast<int>(random.below(3));
    for (int n = 0; n < count; ++n) {
      pair.flip(D::A::polarity_ticks, static_cast<int>(random.below(36)));
    }
    pair.clocks(2 * kTick);
    (((pair.out().faults >> static_cast<unsigned>(Fault::word)) & 1u) != 0 ? found : hidden) += 1;
    pair.in.arm = false;
    pair.to_next_tick();
    pair.write(D::A::polarity_ticks, word_of_design(D::A::polarity_ticks));
    pair.clear();
  }
  CHECK(found > 300);
  CHECK(hidden > 10);
  CHECK(pair.mismatches() == 0);
}

TEST_CASE("core: each control bit that holds while armed opens the gates at once") {
  for (int bit = D::C::control_mode; bit <= D::C::control_width; ++bit) {
    Pair pair;
    pair.arm(D::S::free);
    REQUIRE((pair.out().gates_enable && pair.rtl().gates_enable));
    REQUIRE(pair.mismatches() == 0);
    // A Verilated wire sees what is put into a register only after the next edge: a clock later
    // than the twin, so that here each is looked at by itself.
    pair.flip_control(bit);
    pair.clocks(4);
    INFO("bit " << bit);
    for (const CoreOut& o : {pair.out(), pair.rtl()}) {
      CHECK_FALSE(o.gates_enable);
      CHECK(o.first_fault == static_cast<unsigned>(Fault::word));
    }
  }
}

TEST_CASE("core: a velocity that jumps opens the gates within a tick") {
  constexpr int weight =
      D::f.velocity.width() + D::P::velocity_a1.width() - D::P::velocity_a1.fraction;
  for (int bit = 0; bit < D::f.velocity.width(); ++bit) {
    if (bit == weight + 1) continue;  // may be found or not: the filter absorbs a part at once
    Pair pair;
    pair.arm(D::S::free);
    // Half of full scale also trips over-speed, whose number is lower.
    pair.flip_velocity(bit);
    pair.clocks(kTick);
    INFO("bit " << bit);
    CHECK(((pair.rtl().faults >> static_cast<unsigned>(Fault::jump)) & 1u) == (bit > weight));
    CHECK(pair.rtl().gates_enable == (bit <= weight));
  }
}
