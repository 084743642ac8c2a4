// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Bits of parameters flip while the motor is armed. Their check must find the flip and turn the
// gates off within two ticks. RTL against twin on every clock. Documentation: docs/architecture.md
#include <Vcore_open.h>
#include <Vcore_open___024root.h>

#include <cstdlib>
#include <memory>

#include "catch.hpp"
#include "feltgate/feltgate_core.hpp"
#include "feltgate/generated/lever.hpp"
#include "random.hpp"
#include "sim/backends/rtl_ports.hpp"
#include "twins.hpp"

using feltgate::CoreIn;
using feltgate::CoreOut;
using feltgate::Fault;
using D = feltgate::Lever;

namespace {

#define FELTGATE_AXIS(name) \
  rtl_->rootp->feltgate_core__DOT__gen_lever__DOT__u_top__DOT__u_axis__DOT__##name

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
      feltgate::drive_inputs(*rtl_, feltgate::test::port_bits<D>(), in);
      edge();
      twin_.clock(in);
      if (!(feltgate::read_outputs(*rtl_, feltgate::test::port_bits<D>()) == twin_.out()))
        ++mismatches_;
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
    FELTGATE_AXIS(u_host__DOT__u_params__DOT__ram)[at] ^= QData{1} << bit;
    twin_.flip(address, bit);
  }
  void flip_control(int bit) {
    if (bit < D::C::control_width) {
      FELTGATE_AXIS(u_host__DOT__u_registers__DOT__control_o) ^= static_cast<SData>(1u << bit);
    } else {
      FELTGATE_AXIS(u_host__DOT__u_registers__DOT__parity_q) ^= 1u;
    }
    twin_.flip_control(bit);
  }
  /// Flips a bit of the velocity's register, in the RTL only.
  void flip_velocity(int bit) {
    FELTGATE_AXIS(u_velocity_estimator__DOT__velocity_o) ^= IData{1} << bit;
  }
  CoreOut rtl() const { return feltgate::read_outputs(*rtl_, feltgate::test::port_bits<D>()); }
  /// Arms in `scene`.
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
  feltgate::test::CoreOf<D> twin_;
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

}  // namespace

TEST_CASE(
    "core: each bit of each word that a scene uses opens the gates within two ticks, and has no "
    "effect") {
  Pair pair;
  int flips = 0;
  for (const auto& p : D::parameters) {
    const int scene = p.address < 64 ? D::S::free : p.address / 32;
    for (int bit = 0; bit < 36; ++bit) {
      pair.arm(scene);
      REQUIRE(pair.out().gates_enable);
      pair.flip(p.address, bit);
      INFO(p.name << ", bit " << bit);
      CHECK(clocks_to_fall(pair, 3 * kTick) <= 2 * kTick);
      // A word that is wrong is not loaded, so that no limit trips by it.
      CHECK(pair.out().faults == 1u << static_cast<unsigned>(Fault::word));
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
