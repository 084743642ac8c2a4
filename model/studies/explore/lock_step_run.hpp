// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Runs RTL and twin of a design point in lock-step and compares every output on every clock, and
// the chain once per tick. Documentation: docs/speed-for-accuracy.md
#pragma once

#include <fmt/format.h>

#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <vector>

#include "feltgate/feltgate_core.hpp"
#include "feltgate/generated/causes.hpp"
#include "feltgate/while_armed.hpp"
#include "sim/backends/lock_step_core.hpp"
#include "sim/reference/control_chain.hpp"
#include "studies/explore/measurement.hpp"

namespace feltgate::explore {

/// Rtl is Verilator's class of feltgate_core for design D.
template <class Rtl, class D>
class LockStepRun {
 public:
  LockStepRun(const std::vector<Value>& values, Measurement* m) : values_(values), m_(m) {}

  /// Loads the point's values through the register port, then plays a window of every motion, the
  /// feedback of tau_hat, the modes, disarming and a fault. Between windows the lever moves at the
  /// encoder's maximum speed, so velocity and torque also reach their limits.
  void run() {
    core_.power_up(1, {});
    chain_.reset();
    for (const Value& v : values_) write(v.address, v.raw);
    write(D::A::ramp_step, fixed_of<D::f.ramp.key()>::max_raw() / 2);
    // The moves between windows are not realistic and must not trip the supervisor too early.
    write(D::A::overspeed, fixed_of<D::f.velocity.key()>::max_raw());
    write(D::A::polarity_speed, fixed_of<D::f.velocity.key()>::max_raw());
    write(D::A::i2t_budget, 0xffffffff);
    const auto window = static_cast<std::int64_t>(lock_step_s * static_cast<double>(D::clock_hz));
    for (const Motion& motion : motions()) {
      const int scene = D::scene_number(motion.scene);
      if (!scene_built<D>(scene)) continue;
      write(D::A::setpoint_torque,
            std::llround(std::ldexp(motion.setpoint_nm, D::f.torque.fraction)));
      control(scene, Mode::closed_loop, true);
      play(motion, window);
    }
    // A design without feedback of tau_hat would not exercise that path.
    const Motion& last = motions().back();
    control(0, Mode::closed_loop, false);  // what follows is not let through while armed
    write(D::A::observer_gain, fixed_of<D::P::observer_gain.key()>::max_raw() / 3);
    control(D::scene_number("spring_tension"), Mode::closed_loop, true);
    play(last, window / 2);
    control(0, Mode::open_loop, false);
    control(0, Mode::open_loop, true);
    play(last, window / 8);
    write(D::A::voltage_setpoint, std::int64_t{3} << D::f.voltage.fraction);
    control(0, Mode::voltage, false);
    control(0, Mode::voltage, true);
    play(last, window / 8);
    overheat(last, window / 8);
    control(0, Mode::closed_loop, false);
    play(last, window / 8);
    control(0, Mode::closed_loop, true);
    write(D::A::overspeed, 0);
    play(last, window / 8);
    core_.follow();
    if (core_.mismatches() > 0) m_->first_mismatch = core_.first_mismatch();
    m_->mismatches += core_.mismatches();
  }

 private:
  /// Performs one write early in a tick, and runs the rest of that tick.
  void write(int address, std::int64_t raw) {
    while (core_.twin().clock_of_tick() != 5) clock();
    in_.reg_addr = static_cast<std::uint16_t>(address);
    in_.reg_wdata = static_cast<std::uint32_t>(raw);
    in_.reg_write = true;
    pending_ = {address, in_.reg_wdata};
    clock();
    in_.reg_write = false;
    while (core_.twin().clock_of_tick() != 0) clock();
    carry_out();
  }
  /// Repeats the write that the core has carried out in the chain.
  void carry_out() {
    if (host_.write(pending_.address, pending_.word, core_.twin().out().armed)) {
      chain_.words().set_raw(pending_.address, pending_.word);
    }
  }
  void control(int scene, Mode mode, bool arm) {
    write(D::C::control, static_cast<std::int64_t>(D::control_reset) |
                             std::int64_t{1} << D::C::control_host |
                             std::int64_t{arm} << D::C::control_arm |
                             static_cast<std::int64_t>(scene) << D::C::control_scene |
                             static_cast<std::int64_t>(mode) << D::C::control_mode);
  }

  /// Tests the heat sum: first the motor is cold, then too hot at the first squared current.
  void overheat(const Motion& motion, std::int64_t clocks) {
    write(D::A::nominal_current_squared, 0x7fffffff);
    write(D::A::nominal_current_squared, 0x7fffffff);
    write(D::A::i2t_budget, 1);
    write(D::A::nominal_current_squared, 0);
    play(motion, clocks);
    if (core_.twin().out().first_fault != static_cast<unsigned>(Fault::i2t)) {
      note(fmt::format("the motor did not get too hot: the first fault is {}",
                       fault_names.at(core_.twin().out().first_fault)));
    }
    write(D::A::i2t_budget, 0xffffffff);
    control(0, Mode::closed_loop, false);
    write(D::C::command, std::int64_t{1} << D::C::command_clear_faults);
  }

  void play(const Motion& motion, std::int64_t clocks) {
    for (std::int64_t k = 0; k < clocks || count_ != target(motion, k);) {
      step_towards(target(motion, k));
      read_on();
      clock();
      if (k > 0 || count_ == target(motion, 0)) ++k;  // the window begins where its motion is
    }
  }
  /// Reads every word in turn, so that the read-back is compared too.
  void read_on() {
    if (m_->clocks_compared % 8 == 0)
      in_.reg_addr = static_cast<std::uint16_t>((in_.reg_addr + 1) % 0x340);
  }
  static std::int64_t target(const Motion& motion, std::int64_t clock) {
    const double t_s = motion.window_s + static_cast<double>(clock) / D::clock_hz;
    return static_cast<std::int64_t>(std::floor(motion.angle_rad(t_s) / D::count_rad));
  }
  /// Clocks per count of the fastest move. One more clock is used if otherwise both channels had
  /// changed at the end of every tick: encoder_monitor treats them as shorted then.
  static constexpr int slew_clocks = D::clocks_per_tick / 2 % 4 == 2 ? 3 : 2;
  void step_towards(std::int64_t target) {
    if (++since_step_ < slew_clocks || count_ == target) return;
    since_step_ = 0;
    count_ += count_ < target ? 1 : -1;
    const bool a = (count_ & 2) != 0;
    in_.encoder = {a, ((count_ & 1) != 0) != a, false};
  }

  void clock() {
    core_.lead(in_, 1, [this] { compare_chain(core_.twin().out()); });
    if (core_.room() == 0) core_.follow();
    ++m_->clocks_compared;
    m_->clocks_armed += core_.twin().out().armed ? 1 : 0;
  }
  void compare_chain(const CoreOut& twin) {
    const bool restart = host_.restart(twin.armed, twin.scene);
    chain_.tick({twin.position, core_.twin().sampled_travel(), twin.armed, twin.scene, host_.mode(),
                 restart});
    const bool same =
        chain_.velocity().raw() == twin.velocity && chain_.tau_hat().raw() == twin.tau_hat &&
        chain_.tau_ref().raw() == twin.tau_ref &&
        chain_.control().current.raw() == twin.current_ref &&
        chain_.control().voltage.raw() == twin.voltage && chain_.control().duty.raw() == twin.duty;
    if (!same) note(fmt::format("tick {}: the chain differs from the core", twin.tick_count));
  }
  void note(const std::string& what) {
    if (m_->mismatches++ == 0) m_->first_mismatch = what;
  }

  struct Write {
    int address = 0;
    std::uint32_t word = 0;
  };

  const std::vector<Value>& values_;
  Measurement* m_;
  LockStepCore<Rtl, D> core_;
  ControlChain<D, Fixed> chain_;
  CoreIn in_;
  Write pending_;
  HostBeside host_{static_cast<std::uint32_t>(D::control_reset)};
  std::int64_t count_ = 0;
  int since_step_ = 0;
};

}  // namespace feltgate::explore
