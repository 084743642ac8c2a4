// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// supervisor: the largest time of the watchdog, 2^24 ticks without a kick. The twin counts all
// ticks; the test writes all but the last few directly into the RTL's counter. Documentation:
// docs/blocks/supervisor.md
#include <Vsupervisor_open.h>
#include <Vsupervisor_open___024root.h>

#include "bus.hpp"
#include "catch.hpp"
#include "mismatch.hpp"
#include "sim/backends/rtl_model.hpp"

using namespace feltgate::test;
using feltgate::Fault;

namespace {

constexpr std::int64_t kLongest = std::int64_t{1} << feltgate::Map::kickless_bits;

/// RTL and twin of the supervisor, tick by tick.
class Pair {
 public:
  Scenario now;

  Pair() {
    drive({});
    rtl_.reset(1);
    twin_.reset();
  }
  void tick() {
    for (int c = 0; c < Design::clocks_per_tick; ++c) {
      clock(bus_.clock(wave_.out(), now, twin_.out().current_estimate));
      wave_.clock({});
    }
  }
  /// Passes `ticks` ticks without a wave.
  void pass(std::int64_t ticks) {
    Twin::In in;
    in.arm = in.tick = true;
    for (std::int64_t k = 0; k < ticks; ++k) twin_.clock(in);
    rtl_->rootp->supervisor__DOT__kickless_ticks_q += static_cast<IData>(ticks);
  }
  const Twin::Out& out() const { return twin_.out(); }

 private:
  void drive(const Twin::In& in) {
    rtl_->tick_i = in.tick;
    rtl_->period_start_i = 0;
    rtl_->host_i = rtl_->host_arm_i = rtl_->disarm_i = rtl_->axis_silent_i = 0;
    rtl_->arm_i = in.arm;
    rtl_->stop_i = 0;
    rtl_->clear_faults_i = in.clear_faults;
    rtl_->kick_i = in.kick;
    rtl_->encoder_error_i = 0;
    rtl_->axis_blocked_i = 0;
    rtl_->trips_i = 0;
    rtl_->velocity_i = static_cast<std::uint32_t>(in.velocity);
    rtl_->current_ref_i = port_bits<Design::f.current.width()>(in.current_ref);
    drive_strobes(*rtl_, in.wave);
    rtl_->param_i = in.param;
    rtl_->product_i = port_bits<Design::product_bits, std::uint64_t>(in.product);
  }
  void clock(const Twin::In& in) {
    drive(in);
    rtl_.clock();
    twin_.clock(in);
    REQUIRE((rtl_->gates_enable_o != 0) == twin_.out().gates_enable);
    REQUIRE(rtl_->faults_o == twin_.out().faults);
    REQUIRE(rtl_->first_fault_o == twin_.out().first_fault);
  }

  feltgate::RtlModel<Vsupervisor_open> rtl_{3};
  Clock wave_;
  Bus bus_{1};
  Twin twin_;
};

}  // namespace

TEST_CASE("supervisor: the longest watchdog there is bears 2^24 ticks without a kick and ends") {
  Pair s;
  s.now.words.nominal_current_squared = (1U << 31) - 1;
  s.now.words.watchdog_ticks = 0x7fffffff;
  for (int k = 0; k < 4; ++k) s.tick();
  s.now.arm = s.now.kick = true;
  s.tick();
  s.now.kick = false;
  REQUIRE(s.out().gates_enable);
  s.pass(kLongest - 5);
  for (int k = 0; k < 5; ++k) {
    REQUIRE(s.out().gates_enable);
    s.tick();
  }
  if (Twin::watchdog_clock != Design::clocks_per_tick - 1) REQUIRE(s.out().gates_enable);
  s.tick();
  REQUIRE(s.out().faults == fault_bit(Fault::watchdog));
}

TEST_CASE("supervisor: a limit that the counter can hold counts in all its bits") {
  for (const std::int64_t limit : {kLongest - 1, kLongest / 2 + 1}) {
    Pair s;
    s.now.words.nominal_current_squared = (1U << 31) - 1;
    s.now.words.watchdog_ticks = static_cast<std::uint32_t>(limit);
    for (int k = 0; k < 4; ++k) s.tick();
    s.now.arm = s.now.kick = true;
    s.tick();
    s.now.kick = false;
    s.pass(limit - 2);
    for (int k = 0; k < 2; ++k) s.tick();
    REQUIRE(s.out().gates_enable);
    s.tick();
    REQUIRE(s.out().faults == fault_bit(Fault::watchdog));
  }
}
