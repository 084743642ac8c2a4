// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// A core's twin with what designs with a current loop, an absolute encoder or three phases have at
// their pins: modulator, driver, sensor, the gates of a bridge, motor and hand; and what breaks of
// it. Documentation: docs/testing.md
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <deque>
#include <optional>
#include <string>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

#include "campaigns/faults/outcome.hpp"
#include "campaigns/faults/world.hpp"
#include "feltgate/current_sense.hpp"
#include "feltgate/design_info.hpp"
#include "feltgate/feltgate_core.hpp"
#include "feltgate/generated/gimbal_current.hpp"
#include "feltgate/generated/gimbal_motor.hpp"
#include "feltgate/generated/hall_motor.hpp"
#include "feltgate/generated/lever_absolute.hpp"
#include "feltgate/generated/lever_current.hpp"
#include "random.hpp"
#include "sim/backends/absolute_sensor.hpp"
#include "sim/backends/backend.hpp"
#include "sim/plant/drive.hpp"
#include "sim/plant/plant.hpp"
#include "sim/plant/plant_file.hpp"
#include "sim/plant/sigma_delta.hpp"
#include "sim/plant/three_phase.hpp"
#include "twins.hpp"

namespace feltgate::faults {

template <class D>
struct Option {
  using Design = D;
  const char* plant;
  double arm_s;       ///< when it may be armed: a sensor must have been read, an offset be known
  double most_rad_s;  ///< of a hand in lives without a fault
};
/// The designs other than lever whose pins the campaign breaks.
constexpr std::tuple options{
    Option<LeverCurrent>{"p24", 0.011, 30}, Option<LeverAbsolute>{"p24", 0.001, 30},
    Option<GimbalMotor>{"gimbal_motor", 0.001, 20},
    Option<GimbalCurrent>{"gimbal_motor", 0.011, 20}, Option<HallMotor>{"hall_motor", 0.001, 50}};
/// Calls f(option) for the one of this name; false: there is none.
template <class F>
bool with_option(const std::string& design, F f) {
  const auto one = [&](const auto& o) {
    if (design != std::decay_t<decltype(o)>::Design::name) return false;
    f(o);
    return true;
  };
  return std::apply([&](const auto&... all) { return (one(all) || ...); }, options);
}

/// One core in its loop. A copy goes on from the same state.
template <class D>
class Rig {
 public:
  using Motor = std::conditional_t<D::phases == 3, plant::ThreePhasePlant, plant::Plant>;

  /// `offset_rad`: what is added to the electrical angle of the plant.
  Rig(plant::Parameters p, const plant::Hand& hand, double offset_rad = 0)
      : hall_(p.phases ? p.phases->hall : std::nullopt),
        motor_(made(turned(std::move(p), offset_rad), hand)),
        modulators_{modulator(), modulator()} {
    if constexpr (D::absolute_encoder != 0) sensor_.emplace(test::absolute_parameters<D>());
    if (hall_) hall_->begin_rad += offset_rad;  // else they would turn with the rotor
    in_.encoder = motor_.encoder().pins();
    sense_hall();
  }

  static const DesignInfo& info() {
    static const DesignInfo all = design_info<D>();
    return all;
  }
  void write(Word word) { words_.push_back(word); }
  void ask(Word arm) {
    write(arm);
    asked_ = now_;
  }
  /// From now on this is broken.
  void harm(const Harm& harm, std::uint64_t seed) {
    harm_ = harm;
    since_ = 0;
    random_ = test::Random(seed);
    if (sensor_) sensor_->set(harm.sensor);
    slipping_.emplace(in_.encoder);
    if (sensor_ && harm.stuck_bit >= 0) sensor_->stick(harm.stuck_bit, harm.stuck_high);
    if constexpr (D::phases == 3) {
      if (harm.open_phase) motor_.open_phase(*harm.open_phase);
      wiring_a_ = motor_.motor().phase_a();
    } else {
      // What is left is the wiring.
      if (harm.shorted) motor_.short_motor(0.05, 4e-6);
    }
  }

  /// The gates of the last step drive the motor in this one, so nothing depends on its own future.
  void step() {
    const bool late = harm_.late_s > 0 && asked_ >= 0;
    if (late && static_cast<double>(now_ - asked_) >= harm_.late_s * D::clock_hz) harm({}, 0);
    const double before_rad = angle_rad();
    advance();
    torque_.add(kStep, harm_.shorted ? 0 : motor_.observables().motor_torque_mean_nm);
    if (sensor_) sensor_->turn(before_rad, angle_rad(), now_, kStep);
    if constexpr (D::current_loop != 0) in_.current_data = modulated();
    sense_hall();
    in_.driver_fault = harm_.driver_fault && since_ == 0;
    in_.stop = harm_.stop && since_ == 0;
    const GateCounts last = core_.gate_clocks();
    run_core();
    for (std::size_t n = 0; n < last.size(); ++n) {
      gates_[n] = static_cast<double>(core_.gate_clocks()[n] - last[n]) / kStep;
    }
    if (since_ >= 0) since_ += kStep;
  }

  const CoreOut& out() const { return core_.out(); }
  Clock now() const { return now_; }
  bool on() const {
    return std::any_of(gates_.begin(), gates_.end(), [](double share) { return share > 0; });
  }
  /// Clocks of the last step with both switches of a leg on.
  int both_clocks() const {
    double most = 0;
    for (std::size_t n = 0; n < gates_.size(); n += 2) {
      most = std::max(most, gates_[n] + gates_[n + 1] - 1);
    }
    return static_cast<int>(std::lround(most * kStep));
  }
  /// Of the motor, mean of the last PWM period; a shorted one gives none.
  double torque_nm() const { return torque_.mean(); }
  double shaft_rad() const { return motor_.observables().theta_rad; }

  /// A clock of the modulator; of a sensor that is read bit by bit, a fifth of a tick.
  static constexpr Clock kStep =
      D::current_loop != 0 ? CurrentSense::Parameters{}.divider : D::clocks_per_tick / 5;

 private:
  static plant::Parameters turned(plant::Parameters p, double offset_rad) {
    if (p.phases) p.phases->offset_rad += offset_rad;
    return p;
  }
  static Motor made(const plant::Parameters& p, const plant::Hand& hand) {
    const plant::Drive drive = plant::drive_of(info());
    if constexpr (D::phases == 3) {
      return Motor(p, *p.phases, p.effects, drive, hand);
    } else {
      return Motor(p, p.effects, drive, hand);
    }
  }

  double angle_rad() const { return shaft_rad() + (since_ >= 0 ? harm_.slipped_rad : 0); }
  /// The gates of the last step drive the motor, or what is left of a shorted one with three
  /// phases.
  void advance() {
    if constexpr (D::phases == 3) {
      if (harm_.shorted) {
        motor_.advance(plant::Legs::off(), kStep);
        return flow();
      }
    }
    motor_.advance(bridge(), kStep);
  }
  /// A star of the wiring's 50 mohm and 4 uH.
  void flow() {
    const double dt_s = static_cast<double>(kStep) / D::clock_hz;
    std::array<double, 3> volts{};
    for (std::size_t n = 0; n < volts.size(); ++n) {
      const double dead = 1 - gates_[2 * n] - gates_[2 * n + 1];
      volts[n] = info().supply_v * (gates_[2 * n] + (wiring_a_[n] < 0 ? dead : 0));
    }
    const double mean_v = (volts[0] + volts[1] + volts[2]) / 3;
    for (std::size_t n = 0; n < volts.size(); ++n) {
      wiring_a_[n] += (volts[n] - mean_v - 0.05 * wiring_a_[n]) * dt_s / 4e-6;
    }
  }
  bool loose() const {
    return harm_.loose_s == 0 || static_cast<double>(since_) < harm_.loose_s * D::clock_hz;
  }
  auto bridge() const {
    std::array<double, 6> g{};
    std::copy(gates_.begin(), gates_.end(), g.begin());
    for (unsigned n = 0; n < g.size(); ++n) {
      if ((harm_.dead_gates >> n & 1u) != 0 && since_ >= 0 && loose()) g[n] = 0;
    }
    if (harm_.swapped_phases) std::swap(g[2], g[4]), std::swap(g[3], g[5]);
    if constexpr (D::phases == 3) {
      return plant::Legs::gates(g[0], g[1], g[2], g[3], g[4], g[5]);
    } else {
      return plant::Bridge::gates(g[0], g[1], g[2], g[3]);
    }
  }
  static plant::SigmaDelta modulator() {
    return plant::SigmaDelta(D::current_loop != 0 ? info().current_full_scale_a : 1);
  }
  /// In the shunt of this leg.
  double amperes(std::size_t shunt) const {
    if constexpr (D::phases == 3) {
      if (harm_.shorted) return wiring_a_[shunt];
      return motor_.motor().phase_a()[harm_.swapped_phases && shunt == 1 ? 2 : shunt];
    } else {
      return motor_.observables().motor_current_a;
    }
  }
  std::uint8_t modulated() {
    unsigned bits = 0;
    for (std::size_t n = 0; n < (D::phases == 3 ? 2 : 1); ++n) {
      bits |= (modulated(n) ? 1U : 0U) << (harm_.exchanged ? 1 - n : n);
    }
    return static_cast<std::uint8_t>(bits);
  }
  bool modulated(std::size_t n) {
    using Line = Harm::Line;
    const bool mine = (harm_.shunts >> n & 1U) != 0;
    const bool bit =
        modulators_[n].next(mine ? harm_.reads * amperes(n) + harm_.offset_a : amperes(n));
    switch (mine ? harm_.modulator : Line::sound) {
      case Line::sound:
        return bit;
      case Line::held:
        return (in_.current_data >> n & 1U) != 0;
      case Line::noise:
        return random_.coin();
      default:
        return harm_.modulator == Line::high;
    }
  }
  /// The lines at the end of the step, which is less than a sample of their filter.
  void sense_hall() {
    if constexpr (D::hall != 0) {
      const double rad = motor_.motor().electrical_rad(shaft_rad());
      in_.hall = broken_hall(hall_->code(rad), harm_);
    }
  }
  void sense() {
    in_.encoder_data = sensor_->pin(now_, core_.out().serial | harm_.cut_lines);
    if (harm_.flips > 0 && random_.below(1'000'000) < harm_.flips * 1e6) {
      in_.encoder_data = !in_.encoder_data;
    }
  }
  void run_core() {
    const auto& events = motor_.events();
    std::size_t next = 0;
    const auto pins = [&](Clock until) {
      for (; next < events.size() && events[next].clock <= until; ++next) {
        if (harm_.slips > 0) {
          in_.encoder = slipping_->shown(events[next].pins, harm_.slips);
        } else if (!harm_.channels_held) {
          in_.encoder = events[next].pins;
        }
      }
    };
    for (const Clock end = now_ + kStep; now_ < end;) {
      pins(now_);
      if (sensor_) sense();
      if (!words_.empty() && core_.clock_of_tick() == host_write_clock && !core_.out().reg_busy) {
        in_.reg_addr = static_cast<std::uint16_t>(words_.front().address);
        in_.reg_wdata = words_.front().data;
        in_.reg_write = true;
        words_.pop_front();
        core_.clock(in_);
        in_.reg_write = false;
        ++now_;
        continue;
      }
      Clock until = sensor_ || !words_.empty() ? now_ + 1 : end;
      if (next < events.size()) until = std::min(until, events[next].clock);
      core_.run(in_, until - now_, [] {});
      now_ = until;
    }
    pins(now_);
  }

  test::CoreOf<D> core_;
  CoreIn in_;
  std::optional<plant::HallLines> hall_;
  Motor motor_;
  std::optional<SlippingEncoder> slipping_;
  std::array<plant::SigmaDelta, 2> modulators_;  // the second of three phases
  plant::Phases wiring_a_{};                     // of a shorted motor with three phases
  std::optional<AbsoluteSensor> sensor_;
  plant::PeriodMean torque_{D::pwm_period};
  std::array<double, std::tuple_size_v<GateCounts>> gates_{};  // shares of the last step
  std::deque<Word> words_;
  Harm harm_;
  test::Random random_{0};
  Clock since_ = -1;  // clocks since something is broken; -1: nothing is
  Clock asked_ = -1;  // when arming was asked for
  Clock now_ = 0;
};

/// A fault: when and in which loop.
struct Case {
  std::string what;
  Harm harm;
  double torque_nm = 0, from_rad = 0;
  double rad_s = 0;         ///< at which a hand moves the shaft
  bool free = false;        ///< no hand does
  double seconds = 0.01;    ///< after the fault, or after arming
  bool at_arming = false;   ///< it is there from the start, and the self-test is on
  bool from_start = false;  ///< it is there from the start
  double offset_rad = 0;    ///< of the electrical angle
  bool wall = false;        ///< the design's wall acts from 0 rad on, in place of the torque
};

/// Runs it beside a sound core with a motor of its own; `arm_s`: when both are armed.
template <class D>
Outcome run_case(const std::string& root, const Case& c, const char* plant_name, double arm_s,
                 std::uint64_t seed) {
  const DesignInfo& info = Rig<D>::info();
  const auto clocks = [](double s) { return static_cast<Clock>(s * D::clock_hz); };
  const auto p = plant::read_plant_file(root + "/vectors/plants/" + plant_name + ".toml");
  plant::Hand hand;
  if (!c.free) hand = moving_hand(c.from_rad, c.rad_s);
  hand.start_rad = c.from_rad;
  Rig<D> sound(p, hand), faulty(p, hand, c.offset_rad);
  const auto scene = static_cast<std::uint32_t>(c.wall ? D::S::wall : D::S::setpoint);
  const std::uint32_t control = static_cast<std::uint32_t>(D::control_reset) |
                                1u << D::C::control_host | scene << D::C::control_scene;
  std::vector<Word> setup{word_of(info, "setpoint_torque", c.torque_nm), {D::C::control, control}};
  if (c.wall) setup.push_back(word_of(info, "wall_contact", 0));
  if (!c.at_arming) {  // the torque at once
    setup.push_back({D::A::self_test_pulse, 0});
    setup.push_back({D::A::ramp_step, (1u << (D::P::ramp_step.width() - 1)) - 1});
  }
  const Word arm{D::C::control, control | 1u << D::C::control_arm};
  const bool late = c.harm.late_s > 0, before = c.at_arming || c.from_start || late;
  if (before) faulty.harm(c.harm, seed);
  // Both as far as the arming; a fault under way comes 5 to 6 ms later, and until then both are
  // one.
  const auto start = [&](Rig<D>* rig) {
    for (const Word& w : setup) rig->write(w);
    while (rig->now() < clocks(arm_s)) rig->step();
    rig->ask(arm);
  };
  start(&sound);
  if (before) {
    start(&faulty);
  } else {
    test::Random when(seed + 1);
    const double share = 1e-6 * (1 + static_cast<double>(when.below(999998)));
    const Clock to = clocks(arm_s + 0.005 + 0.001 * share);
    while (sound.now() < to) sound.step();
    faulty = sound;
    faulty.harm(c.harm, seed);
  }
  const Clock from = faulty.now();
  const double from_rad = faulty.shaft_rad();
  Limits limits;
  limits.torque_nm = info.find("torque_limit")->si;
  TorqueLimits judge(limits);
  Outcome o;
  Clock off_for = 0;
  bool differed = false, position_wrong = false, opened = false;
  while (faulty.now() < from + clocks(c.seconds) && (late || off_for < 60 * D::clocks_per_tick)) {
    faulty.step();
    sound.step();
    const CoreOut &f = faulty.out(), &s = sound.out();
    const bool off = closed(f, s.faults, s.gates_enable,
                            (faulty.now() - from + D::clocks_per_tick - 1) / D::clocks_per_tick,
                            std::abs(faulty.shaft_rad() - from_rad), &o);
    o.both_clocks = std::max(o.both_clocks, faulty.both_clocks());
    judge.step(faulty.torque_nm() - sound.torque_nm(), faulty.torque_nm(),
               1e6 * Rig<D>::kStep / D::clock_hz, faulty.on(), off, &o);
    position_wrong = !c.free && f.position != s.position;
    o.count_changed = o.count_changed || position_wrong;
    differed = differed || f.gates != s.gates || f.position != s.position || f.tau_ref != s.tau_ref;
    opened = opened || f.gates_enable;
    if (judge.unsafe(o)) break;
    off_for = off && !faulty.on() ? off_for + Rig<D>::kStep : 0;
  }
  settle({judge.unsafe(o), off_for > 0, judge.torque_wrong(), position_wrong, differed}, limits,
         &o);
  if (late && opened) o.is = Class::unsafe, o.why = "armed by its sensor";
  return o;
}

}  // namespace feltgate::faults
