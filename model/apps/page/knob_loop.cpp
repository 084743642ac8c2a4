// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The page's knob on a motor of three phases. Documentation: docs/page.md
#include "apps/page/knob_loop.hpp"

#include <algorithm>
#include <cmath>

#include "sim/plant/drive.hpp"

namespace feltgate::page {

namespace {

constexpr int ticks_per_step = 5;  // of the plant: on-times hold for 20 ticks
constexpr int ticks_per_sample = 1000;
constexpr double core_share = 0.2;   // of the pitch: where a detent's torque is largest
constexpr double past_crest = 0.01;  // of the pitch: from there on the host moves the detent

std::uint32_t word(const ParameterInfo& info, double value) {
  return static_cast<std::uint32_t>(quantise_parameter(info, value));
}

}  // namespace

KnobCore::KnobCore()
    : design_(design_named(design_name)),
      chain_(make_real_chain(design_name, "fixed")),
      beside_(design_.control_reset),
      commutation_(design_.pwm_period),
      sampling_tick_((design_.pwm_period - 1 - axis::ThreePhase::lead) / design_.clocks_per_tick),
      gain_(static_cast<std::uint32_t>(design_.find("commutation_gain")->raw)),
      offset_(static_cast<std::uint32_t>(design_.find("commutation_offset")->raw)),
      scene_(design_.scene_number("charge_attract")) {
  chain_->reset();
}

void KnobCore::set(const std::string& parameter, double value) {
  const ParameterInfo* info = design_.find(parameter);
  if (info == nullptr) throw std::invalid_argument(design_.unknown(parameter));
  const std::uint32_t data = word(*info, value);
  if (!beside_.write(info->address, data, armed_)) return;
  chain_->set_parameter(info->address, value);
  if (parameter == "commutation_offset") offset_ = data;
}

void KnobCore::tick(std::int32_t position) {
  const auto of_period = ticks_++ % (design_.pwm_period / design_.clocks_per_tick);
  if (of_period == 0) {
    gates_ = armed_ && sampled_;
    on_ = gates_ ? next_ : std::array<std::int16_t, 3>{};
  }
  if (of_period == sampling_tick_) {
    axis::Commutation::In in;
    in.position = position;
    in.gain = gain_;
    in.offset = offset_;
    in.amplitude = raw().duty;
    next_ = commutation_.on_times(in);
    sampled_ = armed_;
  }
  ChainIn in;
  in.position = position;
  in.travel = static_cast<std::int16_t>(position);
  in.armed = armed_;
  in.scene = scene_;
  in.mode = beside_.mode();
  in.restart = beside_.restart(armed_, scene_);
  chain_->tick(in);
}

double KnobCore::electrical_turns(std::int32_t position) const {
  return std::ldexp(gain_ * static_cast<std::uint32_t>(position) + offset_, -32);
}
double KnobCore::offset_turns() const { return std::ldexp(offset_, -32); }

KnobLoop::KnobLoop(const plant::Parameters& plant)
    : plant_(plant, plant.phases.value(), plant.effects, plant::drive_of(core_.design()),
             plant::Hand{}),
      tick_s_(1.0 / static_cast<double>(core_.design().tick_hz)) {
  detents(0.5, 0.012);
  arm(true);
}

void KnobLoop::detents(double pitch_rad, double peak_nm) {
  pitch_ = pitch_rad / core_.design().count_rad;
  const double core = std::round(core_share * pitch_);
  core_.set("attract_core", core);
  core_.set("attract_core_slope", peak_nm / core);
  core_.set("attract_strength", peak_nm * core * core);
  centre_ = pitch_ * std::round(position_ / pitch_);
  core_.set("attract_centre", centre_);
}

void KnobLoop::offset(double turns) {
  const bool armed = core_.armed();
  arm(false);  // an armed core refuses this word
  step();
  core_.set("commutation_offset", turns);
  arm(armed);
}

int KnobLoop::pole_pairs() const {
  const double turns = core_.design().find("commutation_gain")->si;
  return static_cast<int>(std::lround(std::ldexp(turns, core_.design().absolute->bits)));
}

void KnobLoop::hold(bool held) {
  if (held == held_) return;
  held_ = held;
  plant::HandPhase phase;
  phase.kind = held ? plant::HandPhase::Kind::kImpedance : plant::HandPhase::Kind::kFree;
  plant_.take(phase);
  hand_rad_ = wanted_rad_ = plant_.observables().theta_rad;
}

void KnobLoop::lead(double theta_rad) { wanted_rad_ = std::clamp(theta_rad, -most_rad, most_rad); }

void KnobLoop::advance(double seconds) {
  samples_.clear();
  const double step_s = ticks_per_step * tick_s_;
  owed_s_ += seconds;
  const int steps = static_cast<int>(owed_s_ / step_s);
  owed_s_ -= steps * step_s;
  const double rate = steps > 0 && held_ ? (wanted_rad_ - hand_rad_) / (steps * step_s) : 0;
  for (int n = 0; n < steps; ++n) {
    step();
    // The phase of a hand begins with a step.
    if (n == 0 && held_) plant_.steer(hand_rad_ + rate * step_s, rate);
  }
  if (held_ && steps > 0) {
    hand_rad_ = wanted_rad_;
    plant_.steer(hand_rad_, 0);
  }
}

void KnobLoop::step() {
  const double before_rad = plant_.observables().theta_rad;
  const double period = core_.design().pwm_period;
  const auto& on = core_.on_clocks();
  plant_.advance(
      plant::Legs::averaged({on[0] / period, on[1] / period, on[2] / period}, core_.gates()),
      ticks_per_step * core_.design().clocks_per_tick);
  const double way_rad = plant_.observables().theta_rad - before_rad;
  for (int k = 0; k < ticks_per_step; ++k) tick(before_rad + way_rad * k / ticks_per_step);
}

void KnobLoop::tick(double theta_rad) {
  const DesignInfo& design = core_.design();
  const int latency = design.absolute->reading_clocks() / design.clocks_per_tick + 1;
  const auto of_reading = ticks_ % design.data["ABSOLUTE_PERIOD"];
  if (of_reading == 0) {
    read_ = static_cast<std::int32_t>(std::floor(theta_rad / core_.design().count_rad));
  }
  if (of_reading == latency) position_ = read_;
  core_.tick(position_);
  move_detent();
  if (ticks_++ % ticks_per_sample != 0) return;
  const double period = core_.design().pwm_period;
  const auto& on = core_.on_clocks();
  samples_.push_back({on[0] / period, on[1] / period, on[2] / period, core_.out().tau_ref_nm,
                      plant_.observables().motor_torque_nm});
}

/// The action of a host: past a crest the detent is the next one.
void KnobLoop::move_detent() {
  if (std::abs(position_ - centre_) < (0.5 + past_crest) * pitch_) return;
  centre_ = pitch_ * std::round(position_ / pitch_);
  const ValueRange range = range_of(*core_.design().find("attract_centre"));
  core_.set("attract_centre", std::clamp(centre_, range.low, range.high));
}

}  // namespace feltgate::page
