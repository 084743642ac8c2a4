// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// One design point: RTL against twin, the error against the exact design, delays. Compiled once per
// structure with POINT_HEADER, POINT_TYPE and the Verilated class Vpoint; the values of the point
// come at run time. Used by scripts/exploration/point.py. Documentation: docs/speed-for-accuracy.md
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "Vpoint.h"
#include POINT_HEADER
#include "design/design.hpp"
#include "feltgate/feltgate_core.hpp"
#include "feltgate/generated/causes.hpp"
#include "feltgate/largest.hpp"
#include "feltgate/while_armed.hpp"
#include "sim/backends/lock_step_core.hpp"
#include "sim/plant/brushed_motor.hpp"
#include "sim/plant/parameters.hpp"
#include "sim/plant/plant_file.hpp"
#include "sim/reference/chain.hpp"
#include "studies/explore/measurement.hpp"

// Runs RTL and twin of a design point in lock-step and compares every output on every clock, and
// the chain once per tick.

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
      if (!design_of<D>().has_scene(scene)) continue;
      write(D::A::setpoint_torque,
            std::llround(std::ldexp(motion.setpoint_nm, D::f.torque.fraction)));
      control(scene, closed_loop, true);
      play(motion, window);
    }
    // A design without feedback of tau_hat would not exercise that path.
    const Motion& last = motions().back();
    control(0, closed_loop, false);  // what follows is not let through while armed
    write(D::A::observer_gain, fixed_of<D::P::observer_gain.key()>::max_raw() / 3);
    control(D::scene_number("spring_tension"), closed_loop, true);
    play(last, window / 2);
    control(0, Map::mode_open, false);
    control(0, Map::mode_open, true);
    play(last, window / 8);
    write(D::A::voltage_setpoint, std::int64_t{3} << D::f.voltage.fraction);
    control(0, Map::mode_voltage, false);
    control(0, Map::mode_voltage, true);
    play(last, window / 8);
    overheat(last, window / 8);
    control(0, closed_loop, false);
    play(last, window / 8);
    control(0, closed_loop, true);
    write(D::A::overspeed, 0);
    play(last, window / 8);
    core_.follow();
    if (core_.mismatches() > 0) m_->first_mismatch = core_.first_mismatch();
    m_->mismatches += core_.mismatches();
  }

 private:
  static constexpr int closed_loop = 0;  ///< mode

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
      chain_.set_word(pending_.address, pending_.word);
    }
  }
  void control(int scene, int mode, bool arm) {
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
    control(0, closed_loop, false);
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
    const ChainRaw& chain = *chain_.raw();
    const bool same = chain.velocity == twin.velocity && chain.tau_hat == twin.tau_hat &&
                      chain.tau_ref == twin.tau_ref && chain.current_ref == twin.current_ref &&
                      chain.voltage == twin.voltage && chain.duty == twin.duty;
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
  LockStepCore<Rtl> core_{design_of<D>()};
  Chain<axis::Fixed> chain_{"fixed", design_info<D>()};
  CoreIn in_;
  Write pending_;
  HostBeside host_{static_cast<std::uint32_t>(D::control_reset)};
  std::int64_t count_ = 0;
  int since_step_ = 0;
};

}  // namespace feltgate::explore

namespace feltgate::explore {

/// The exact factor of the N-method, rad/s a count.
template <class D>
constexpr double exact_gain_rad_s = D::count_rad* static_cast<double>(D::tick_hz) / D::m1;

/// Design D with it in place of its power of two or quantised gain.
template <class D>
DesignInfo with_exact_gain() {
  DesignInfo design = design_info<D>();
  design.velocity_gain_rad_s = exact_gain_rad_s<D>;
  return design;
}

/// Runs both chains of one design on the same counts.
template <class D>
class ErrorRun {
 public:
  explicit ErrorRun(const std::vector<Value>& values) : values_(values) {}

  /// Runs every motion of the stimulus whose scene is built in.
  void run(Measurement* m) {
    for (const Motion& motion : motions()) {
      const int scene = D::scene_number(motion.scene);
      if (design_of<D>().has_scene(scene)) run(motion, scene, m);
    }
  }

 private:
  void run(const Motion& motion, int scene, Measurement* m) {
    reset(motion);
    const double ktn = value(values_, "torque_constant").si;
    const auto ticks =
        static_cast<std::int64_t>(std::ceil(motion.duration_s * static_cast<double>(D::tick_hz)));
    const std::int32_t start = counts(motion, 0);
    note_speed(motion, ticks, m);
    for (std::int64_t k = 0; k < ticks; ++k) {
      ChainIn in;
      in.position = counts(motion, k);
      in.travel = static_cast<std::int16_t>(in.position - start);
      in.armed = true;
      in.scene = scene;
      fixed_.tick(in);
      exact_.tick(in);
      const unsigned limits = fixed_.raw()->limits;
      for (std::size_t bit = 0; bit < m->limited.size(); ++bit) {
        m->limited[bit] += (limits >> bit) & 1u;
      }
      // A saturation is not a rounding error, and the filters keep its effect.
      if ((limits & (limit::velocity | limit::tau_hat)) != 0) {
        m->ticks_left_out += ticks - k;
        return;
      }
      ++m->ticks;
      const auto off = [](double fixed, Quad exact) {
        return static_cast<double>(static_cast<Quad>(fixed) - exact);
      };
      const ChainOut& fixed = fixed_.out();
      m->velocity.add(off(fixed.velocity_rad_s, exact_.velocity()), motion.name);
      m->tau_hat.add(off(fixed.tau_hat_nm, exact_.tau_hat()), motion.name);
      m->tau_ref.add(off(fixed.tau_ref_nm, exact_.tau_ref()), motion.name);
      m->torque.add(ktn * off(fixed.current_a, exact_.current()), motion.name);
      m->voltage.add(off(fixed.voltage_v, exact_.voltage()), motion.name);
    }
  }

  /// The largest count of m1 ticks as a speed; what is asked of a bound.
  static void note_speed(const Motion& motion, std::int64_t ticks, Measurement* m) {
    for (std::int64_t k = 0; k < ticks; ++k) {
      const auto before = counts(motion, k < D::m1 ? 0 : k - D::m1);
      const double size = std::abs(counts(motion, k) - before) * exact_gain_rad_s<D>;
      m->raw_velocity_rad_s = larger(m->raw_velocity_rad_s, size);
    }
  }

  /// Parameters of the point. The ramp after arming is over at once: its step is no matter of
  /// rounding, and its time would hide the rest.
  void reset(const Motion& motion) {
    fixed_.reset();
    exact_.reset();
    for (const Value& v : values_) {
      fixed_.set_word(v.address, static_cast<std::uint32_t>(v.raw));
      exact_.set_parameter(v.address, v.si);
    }
    fixed_.set_word(D::A::ramp_step, fixed_of<D::f.ramp.key()>::max_raw());
    exact_.set_parameter(D::A::ramp_step, 1e6);
    fixed_.set_parameter(D::A::setpoint_torque, motion.setpoint_nm);
    exact_.set_parameter(D::A::setpoint_torque, motion.setpoint_nm);
  }

  /// What an ideal encoder counts at the start of tick k.
  static std::int32_t counts(const Motion& motion, std::int64_t k) {
    const double t_s = static_cast<double>(k) / static_cast<double>(D::tick_hz);
    return static_cast<std::int32_t>(std::floor(motion.angle_rad(t_s) / D::count_rad));
  }

  const std::vector<Value>& values_;
  Chain<axis::Fixed> fixed_{"fixed", design_info<D>()};
  Chain<axis::Real<Quad>> exact_{"quad", with_exact_gain<D>()};
};

constexpr double settling_step_nm = 0.2;

/// Seconds from a register write (at worst a whole tick before it takes effect) until the torque
/// stays within 2 % of the step around its final value; -1 if the design has no scene "setpoint".
/// Uses the fixed-point chain.
template <class D>
double torque_settling_s(const std::vector<Value>& values, const plant::MotorParameters& motor) {
  const int scene = D::scene_number("setpoint");
  if (!design_of<D>().has_scene(scene)) return -1;
  Chain<axis::Fixed> chain("fixed", design_info<D>());
  for (const Value& v : values) chain.set_word(v.address, static_cast<std::uint32_t>(v.raw));
  chain.set_word(D::A::ramp_step, fixed_of<D::f.ramp.key()>::max_raw());
  chain.set_word(D::A::setpoint_torque, 0);
  ChainIn in;
  in.armed = true;
  in.scene = scene;
  for (int k = 0; k < 100; ++k) chain.tick(in);
  chain.set_parameter(D::A::setpoint_torque, settling_step_nm);

  // Time in clocks from the start of the tick in which the write is in force.
  constexpr std::int64_t duty_clock = axis::TickCounter::sample_clock + design::latency_clocks;
  constexpr std::int64_t end = D::clock_hz / 20;  // 50 ms
  plant::Winding winding(motor.resistance_ohm, motor.inductance_h);
  winding.set_step(static_cast<double>(D::pwm_period) / static_cast<double>(D::clock_hz));
  std::vector<double> torque_nm;
  double current_a = 0, held_v = 0;
  std::int64_t next_tick = 0;
  for (std::int64_t period = 0; period * D::pwm_period < end; ++period) {
    // The bridge takes the duty that is there at the start of its period.
    const std::int64_t now = period * D::pwm_period;
    while (next_tick + duty_clock <= now) {
      chain.tick(in);
      held_v = chain.out().duty_clocks / D::pwm_period * D::supply_v;
      next_tick += D::clocks_per_tick;
    }
    const auto step = winding.advance(current_a, held_v, held_v);
    current_a = step.end_a;
    torque_nm.push_back(motor.torque_constant_nm_a * current_a);
  }
  std::size_t last = torque_nm.size();
  while (last > 0 && std::abs(torque_nm[last - 1] - torque_nm.back()) <= 0.02 * settling_step_nm) {
    --last;
  }
  return static_cast<double>(D::clocks_per_tick +
                             (static_cast<std::int64_t>(last) + 1) * D::pwm_period) /
         static_cast<double>(D::clock_hz);
}

}  // namespace feltgate::explore

namespace {

using D = feltgate::POINT_TYPE;

feltgate::explore::Measurement measure(const std::string& values_path, const std::string& plant) {
  using namespace feltgate::explore;
  const auto values = read_values(values_path);
  Measurement m;
  m.latency_clocks = feltgate::design::latency_clocks;
  m.clock_hz = static_cast<double>(D::clock_hz);
  const double tick_s = 1.0 / static_cast<double>(D::tick_hz);
  const double cutoff_rad_s = -std::log1p(-value(values, "velocity_a1").si) / tick_s;
  m.estimator_delay_s = 0.5 * D::m1 * tick_s + 1.0 / cutoff_rad_s;
  LockStepRun<Vpoint, D>(values, &m).run();
  if (m.mismatches > 0) return m;
  ErrorRun<D>(values).run(&m);
  m.torque_settling_s = torque_settling_s<D>(values, feltgate::plant::read_plant_file(plant).motor);
  return m;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) {
    std::fprintf(stderr, "usage: point VALUES.txt PLANT.toml\n");
    return 2;
  }
  try {
    const auto m = measure(argv[1], argv[2]);
    std::printf("%s\n", feltgate::explore::measurement_json(m).c_str());
    return m.mismatches == 0 ? 0 : 1;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
  }
}
