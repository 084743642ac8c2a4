// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Documentation: docs/controllers.md
#include "studies/controllers/current_loop.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <stdexcept>

namespace feltgate::controllers {

namespace {

constexpr double kMostDuty = 0.95;  // leaves the low gates a pulse in every period
constexpr int kStepPhases = 10;
constexpr double kSineBias_a = 8, kSine_a = 0.5;  // pulses stay longer than the dead time

plant::Hand hand_of(bool locked) {
  plant::HandPhase phase;
  phase.kind = locked ? plant::HandPhase::Kind::kLocked : plant::HandPhase::Kind::kFree;
  plant::Hand hand;
  hand.phases = {phase};
  return hand;
}

plant::Drive drive_of(const design::Design& d) {
  plant::Drive drive;
  drive.clock_hz = static_cast<double>(d.clock_hz);
  drive.pwm_hz = drive.clock_hz / d.pwm_period_clocks();
  return drive;
}

/// Clocks from the PWM's taking of a duty to the middle of its pulse at the terminals: half a
/// period, three of its registers, and half the dead time, by which one edge of the pulse is late.
int middle_of(const design::Design& d) {
  return d.pwm_period_clocks() / 2 + 3 + (d.dead_clocks() + 1) / 2;
}

/// The loop of an averaged winding, which is sampled in the middle of each pulse; half a period
/// later its voltage is replaced. The reference counts from when it is taken.
std::complex<double> closed_form(const Bench& bench, const CurrentSetting& setting, double hz) {
  const plant::MotorParameters& m = bench.plant.motor;
  const design::Design& d = bench.design.design;
  const double period_s = d.pwm_period_clocks() / static_cast<double>(d.clock_hz);
  const std::complex<double> s(0, plant::kTwoPi * hz), z = std::exp(s * period_s);
  const double half = std::exp(-m.resistance_ohm * period_s / m.inductance_h / 2);
  const double gain_ohm =
      plant::kTwoPi * setting.bandwidth_hz * period_s * m.resistance_ohm / (1 - half * half);
  const std::complex<double> law = gain_ohm * (z - half * half) / (z - 1.0);
  const std::complex<double> winding =
      (1 - half) / m.resistance_ohm * (1.0 + half / z) / (z - half * half);
  const CurrentSense::Parameters sense{};
  const double taken =
      middle_of(d) + sense.delay_clocks() + 1;  // a period before the pulse it acts in
  const double delay_s =
      (d.pwm_period_clocks() + middle_of(d) - taken) / static_cast<double>(d.clock_hz);
  return law / (1.0 + law * winding) / (m.resistance_ohm + s * m.inductance_h) *
         std::exp(-s * delay_s);
}

double db(std::complex<double> ratio) { return 20 * std::log10(std::abs(ratio)); }
/// From -270 to 90.
double degrees(std::complex<double> ratio) {
  const double phase = 360 / plant::kTwoPi * std::arg(ratio);
  return phase > 90 ? phase - 360 : phase;
}

}  // namespace

CurrentLoop::CurrentLoop(const Bench& bench, const CurrentSetting& setting)
    : plant_(setting.plant, setting.plant.effects, drive_of(bench.design.design),
             hand_of(setting.locked)),
      pwm_(bench.design.design.pwm_period_clocks(), bench.design.design.dead_clocks(),
           bench.design.design.shortest_clocks()),
      clock_hz_(static_cast<double>(bench.design.design.clock_hz)),
      means_a_(static_cast<std::size_t>(bench.design.design.pwm_period_clocks()), 0.0) {
  const plant::MotorParameters& m = bench.plant.motor;
  const double supply_v = bench.design.design.supply_v;
  const CurrentGains gains = current_gains(m.resistance_ohm, m.inductance_h, setting.bandwidth_hz,
                                           period() / clock_hz_, shunt_full_scale_a, supply_v);
  if (!gains.in_range) throw std::invalid_argument("current loop: no gains for this winding");
  control_in_.proportional = gains.proportional;
  control_in_.integral = gains.integral;
  control_in_.limit = static_cast<std::int32_t>(kMostDuty * CurrentControl::kSupply);
  per_v_ = CurrentControl::kSupply / supply_v;
  if (setting.feeds_lost) {
    lost_v_ = bench.design.word("dead_voltage").si;
    lost_v_a_ = bench.design.word("dead_voltage_slope").si * m.torque_constant_nm_a;
  }
  const CurrentSense::Parameters& p = sense_.parameters();
  sense_in_.armed = true;
  sense_in_.threshold = static_cast<std::int32_t>(overcurrent_a / shunt_full_scale_a *
                                                  static_cast<double>(p.fast_full_scale()));
  middle_at_ = middle_of(bench.design.design);
  strobe_at_ = middle_at_ - p.centre_clocks() - p.divider / 2;
  if (setting.adc_hz > 0) conversion_ = static_cast<int>(std::lround(clock_hz_ / setting.adc_hz));
}

bool CurrentLoop::convert() {
  constexpr int bits = 12;
  const int since = (in_period_ - middle_at_ + period()) % period();
  if (since % conversion_ != 0) return false;
  // The result of the last conversion; the next one samples now.
  const std::int32_t result = converted_;
  const double steps = std::round(seen().motor_current_a / shunt_full_scale_a * (1 << (bits - 1)));
  constexpr double end = 1 << (bits - 1);
  converted_ = static_cast<std::int32_t>(std::clamp(steps, -end, end - 1))
               << (kCurrentControlBits + 1 - bits);
  tripped_ = tripped_ ||
             std::abs(result) > overcurrent_a / shunt_full_scale_a * CurrentControl::kFullScale;
  control_in_.current = result;
  return since == conversion_;
}

Clock CurrentLoop::clocks(double seconds) const { return std::llround(seconds * clock_hz_); }

bool CurrentLoop::gates_on() const {
  const Pwm::Out& g = pwm_.out();
  return g.gate_a_hi || g.gate_a_lo || g.gate_b_hi || g.gate_b_lo;
}

void CurrentLoop::clock(double reference_a) {
  // Each block takes what the others showed before the edge.
  const CurrentSense::Out sensed = sense_.out();
  tripped_ = tripped_ || (conversion_ == 0 && sensed.overcurrent);
  in_period_ = pwm_.out().period_start ? 1 : in_period_ + 1;
  sense_in_.strobe = in_period_ == strobe_at_;
  if (conversion_ > 0) {
    control_in_.valid = convert();
  } else {
    control_in_.valid = sensed.aligned;
    control_in_.current = static_cast<std::int32_t>(sensed.current);
  }
  control_in_.armed = !tripped_;
  control_in_.reference = static_cast<std::int32_t>(
      std::lround(reference_a / shunt_full_scale_a * CurrentControl::kFullScale));
  control_in_.emf = static_cast<std::int32_t>(
      std::copysign(std::min(lost_v_a_ * std::abs(reference_a), lost_v_) * per_v_, reference_a));
  Pwm::In pwm;
  pwm.enable = !tripped_;
  pwm.duty = static_cast<std::int16_t>(
      (std::int64_t{control_.out().voltage} * period() + CurrentControl::kSupply / 2) >>
      kCurrentControlBits);

  pwm_.clock(pwm);
  control_.clock(control_in_);
  sense_.clock(sense_in_);
  if (sense_.out().modulator_clock && !sensed.modulator_clock) {
    sense_in_.data = modulator_.next(seen().motor_current_a);
  }
  const auto on = [](bool gate) { return gate ? 1.0 : 0.0; };
  const Pwm::Out& g = pwm_.out();
  plant_.advance(
      plant::Bridge::gates(on(g.gate_a_hi), on(g.gate_a_lo), on(g.gate_b_hi), on(g.gate_b_lo)), 1);
  double& oldest_a = means_a_[next_mean_];
  sum_a_ += seen().motor_current_mean_a - oldest_a;
  oldest_a = seen().motor_current_mean_a;
  next_mean_ = next_mean_ + 1 == means_a_.size() ? 0 : next_mean_ + 1;
}

CurrentStep current_step(const Bench& bench, const CurrentSetting& setting, double from_nm,
                         double to_nm) {
  const double kt = bench.plant.motor.torque_constant_nm_a;
  CurrentStep step;
  CurrentLoop before(bench, setting);
  before.run(before.clocks(2.5e-3), from_nm / kt);
  for (int phase = 0; phase < kStepPhases; ++phase) {
    CurrentLoop loop = before;
    before.run(before.period() / kStepPhases, from_nm / kt);
    StepSamples samples(from_nm);
    const Clock end = loop.clocks(2e-3), us = loop.clocks(1e-6);
    for (Clock c = 0; c < end; ++c) {
      loop.clock(to_nm / kt);
      const double mean_nm = kt * loop.period_mean_a();
      samples.add(mean_nm);
      if (phase != 0 || c % us != 0) continue;
      step.mean_nm.push_back(mean_nm);
      step.raw_nm.push_back(loop.seen().motor_torque_nm);
    }
    const StepResponse r = samples.response(1 / loop.clock_hz(), to_nm);
    step.settling_ms = std::max(step.settling_ms, r.settling_ms);
    step.overshoot_pct = std::max(step.overshoot_pct, r.overshoot_pct);
  }
  return step;
}

CurrentSine current_sine(const Bench& bench, const CurrentSetting& setting, double hz) {
  CurrentLoop loop(bench, setting);
  const Clock one = std::llround(loop.clock_hz() / hz);
  const double per_clock = plant::kTwoPi / static_cast<double>(one);
  const Clock begin = (loop.clocks(2.5e-3) / one + 1) * one;
  const Clock end = begin + (loop.clocks(5e-3) / one + 1) * one;
  std::complex<double> in, out;
  for (Clock c = 0; c < end; ++c) {
    const double at = per_clock * (static_cast<double>(c % one) + 0.5);
    const double reference_a = kSineBias_a + kSine_a * std::sin(at);
    loop.clock(reference_a);
    if (c < begin) continue;
    const std::complex<double> turn = std::polar(1.0, -at);
    in += reference_a * turn;
    out += loop.seen().motor_current_mean_a * turn;
  }
  const double true_hz = loop.clock_hz() / static_cast<double>(one);
  const std::complex<double> form = closed_form(bench, setting, true_hz);
  return {true_hz, db(out / in), degrees(out / in), db(form), degrees(form)};
}

}  // namespace feltgate::controllers
