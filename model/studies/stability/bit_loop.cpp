// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Documentation: docs/speed-for-accuracy.md
#include "studies/stability/bit_loop.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "design/info.hpp"
#include "sim/backends/backend.hpp"
#include "sim/plant/drive.hpp"
#include "sim/reference/chain.hpp"

namespace feltgate::stability {

namespace {

constexpr double kLimitNm = 0.95;  ///< torque limit while measuring, from it follows the current

/// The largest value that fits a word.
double largest(const design::Word& w) {
  const int bits = w.format.width() - w.format.sign;
  return std::ldexp(std::ldexp(1.0, bits) - 1, -w.format.fraction);
}

}  // namespace

BitLoop::BitLoop(const design::Elaborated& design, const BitLoopSetting& s)
    : design_(design),
      wall_(s.wall),
      chain_(s.made_chain ? s.made_chain() : make_chain(design::info_of(design), s.chain)),
      plant_(s.plant, s.plant.effects, plant::drive_of(design::info_of(design)), s.hand),
      count_rad_(design.design.count_rad()),
      pwm_ticks_(pwm_ticks(design.design)),
      pwm_clocks_(design.design.pwm_period_clocks()),
      clocks_per_tick_(design.design.clocks_per_tick()),
      setpoint_address_(address("setpoint_torque")) {
  const bool own = s.wall.scene_ticks == 1;
  in_.armed = true;
  in_.scene = design.registers.scene_number(own ? "wall" : "setpoint");
  const auto set = [&](const char* name, double v) { chain_->set_parameter(address(name), v); };
  if (own) {
    set("wall_contact", 0);
    set("wall_stiffness", s.wall.stiffness_nm_rad * count_rad_);
    set("wall_damping", s.wall.damping_nm_s_rad);
  }
  set("ramp_step", 1.0);  // the ramp after arming ends within a tick
  if (s.linear) {
    set("dead_voltage", 0);
    set("dead_voltage_slope", 0);
    set("region_torque", largest(design.word("region_torque")));
    set("torque_limit", kLimitNm);
    set("current_limit", largest(design.word("current_limit")));
    set("voltage_window", largest(design.word("voltage_window")));
  }
  position_ = reading_ = counts();
  host_ = [this](double theta_rad, double omega_rad_s) {
    if (theta_rad <= 0) return 0.0;
    return std::min(0.0,
                    -wall_.stiffness_nm_rad * theta_rad - wall_.damping_nm_s_rad * omega_rad_s);
  };
}

std::int32_t BitLoop::counts() const {
  return static_cast<std::int32_t>(std::floor(theta_rad() / count_rad_));
}

void BitLoop::tick() {
  if (k_ % pwm_ticks_ == 0) duty_ = duty_new_;
  const int every = wall_.scene_ticks;
  if (every > 1 && k_ >= host_ticks && (k_ - host_ticks) % every == 0) {
    chain_->set_parameter(setpoint_address_, host_torque_);
  }
  if (!design_.design.absolute) {
    position_ = counts();
  } else {
    const int period = design_.design.absolute_period_ticks();
    if ((k_ - design_.design.absolute_delay_ticks()) % period == 0) position_ = reading_;
    if (k_ % period == 0) reading_ = counts();
  }
  in_.position = position_;
  in_.travel = static_cast<std::int16_t>(position_);
  chain_->tick(in_);
  if (every > 1 && k_ % every == 0) {
    host_torque_ = host_(position_ * count_rad_, chain_->out().velocity_rad_s);
  }
  duty_new_ = chain_->out().duty_clocks / pwm_clocks_;
  plant_.advance(plant::Bridge::averaged(std::clamp(duty_, -1.0, 1.0)), clocks_per_tick_);
  ++k_;
}

double swing_rad(double stiffness_nm_rad) { return 0.6 * press_nm / stiffness_nm_rad; }

Growth swing(const design::Elaborated& design, const plant::Parameters& plant, const Wall& wall,
             const std::string& chain, double expected_rad_s) {
  BitLoopSetting s;
  s.chain = chain;
  s.wall = wall;
  s.plant = plant;
  return swing(design, s, expected_rad_s);
}

Growth swing(const design::Elaborated& design, BitLoopSetting s, double expected_rad_s) {
  const Wall wall = s.wall;
  const double depth_rad = press_nm / wall.stiffness_nm_rad;
  s.hand.start_rad = depth_rad - swing_rad(wall.stiffness_nm_rad);
  plant::HandPhase press;
  press.kind = plant::HandPhase::Kind::kTorque;
  press.profile = {{plant::Segment::Kind::kStep, 1.0, press_nm}};
  s.hand.phases = {press};
  BitLoop loop(design, s);
  const double tick_s = design.design.tick_s();
  constexpr int wanted = 26;
  const double longest_s = 1.5 * wanted * 3.141592653589793 / expected_rad_s;
  SwingMeter meter(s.hand.start_rad.value(), 2.5 * design.design.count_rad(), wanted);
  for (double now_s = 0; now_s < longest_s;) {
    loop.tick();
    now_s = static_cast<double>(loop.ticks()) * tick_s;
    // Before the first samples of a slow host there is no torque yet.
    const double torque = loop.tau_ref_nm();
    const bool acts = loop.ticks() > 3 * wall.scene_ticks;
    if (acts && (torque > -0.005 || torque < -0.99 * kLimitNm)) {
      meter.leave();
      break;
    }
    if (!meter.add(now_s, loop.theta_rad(), loop.omega_rad_s())) break;
  }
  return meter.growth();
}

double measured_border(const design::Elaborated& design, const plant::Parameters& plant,
                       double damping_nm_s_rad, int scene_ticks, const Border& near) {
  const auto grows = [&](double k) {
    const Growth g = swing(design, plant, {k, damping_nm_s_rad, scene_ticks}, "fixed", near.rad_s);
    return g.rate_1_s > 0;
  };
  double low = 0.96 * near.stiffness_nm_rad, high = 1.04 * near.stiffness_nm_rad;
  for (int i = 0; grows(low); ++i, low *= 0.9) {
    if (i == 6) return std::numeric_limits<double>::quiet_NaN();
    high = low;
  }
  for (int i = 0; !grows(high); ++i, high *= 1.1) {
    if (i == 6) return std::numeric_limits<double>::quiet_NaN();
    low = high;
  }
  while (high - low > 0.005 * high) {
    const double middle = (low + high) / 2;
    (grows(middle) ? high : low) = middle;
  }
  return (low + high) / 2;
}

bool SwingMeter::add(double time_s, double theta_rad, double omega_rad_s) {
  constexpr int skipped = 3;
  if (done_ || left_) return false;
  if (speed_ * omega_rad_s < 0) {
    const double size = std::abs(theta_rad - extreme_rad_) / 2;
    extreme_rad_ = theta_rad;
    if (++seen_ > skipped) {
      times_s_.push_back(time_s);
      logs_.push_back(std::log(size));
      done_ = size < smallest_rad_ || seen_ == wanted_ + skipped;
    }
  }
  if (omega_rad_s != 0) speed_ = omega_rad_s;
  return !done_;
}

Growth SwingMeter::growth() const {
  Growth g;
  g.left = left_;
  g.swings = static_cast<int>(logs_.size());
  if (g.swings < 3) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    g.rate_1_s = left_ ? infinity : -infinity;
    return g;
  }
  double t = 0, y = 0, tt = 0, ty = 0;
  for (std::size_t i = 0; i < logs_.size(); ++i) {
    t += times_s_[i];
    y += logs_[i];
    tt += times_s_[i] * times_s_[i];
    ty += times_s_[i] * logs_[i];
  }
  const double n = static_cast<double>(logs_.size());
  g.rate_1_s = (n * ty - t * y) / (n * tt - t * t);
  g.rad_s = 3.141592653589793 * (n - 1) / (times_s_.back() - times_s_.front());
  return g;
}

}  // namespace feltgate::stability
