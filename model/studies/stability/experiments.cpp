// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Documentation: docs/speed-for-accuracy.md
#include "studies/stability/experiments.hpp"

#include <algorithm>
#include <cmath>
#include <random>

#include "feltgate/largest.hpp"
#include "studies/stability/axes_linear_loop.hpp"

namespace feltgate::stability {

namespace {

constexpr double kTwoPi = 6.283185307179586;

class Spread {
 public:
  void add(double v) {
    n_ += 1;
    const double before = v - mean_;
    mean_ += before / n_;
    sum_ += before * (v - mean_);
  }
  double rms() const { return n_ > 0 ? std::sqrt(sum_ / n_) : 0.0; }

 private:
  double n_ = 0, mean_ = 0, sum_ = 0;
};

plant::HandPhase pressing(plant::HandPhase::Kind kind, double to, double ramp_s) {
  plant::HandPhase phase;
  phase.kind = kind;
  phase.profile = {{plant::Segment::Kind::kMinimumJerk, ramp_s, to}};
  return phase;
}

/// A hand with impedance comes from outside and presses with a torque into a wall; 0: a face.
plant::Hand held(double press_nm, double stiffness_nm_rad, const plant::Parameters& plant) {
  plant::Hand hand;
  hand.start_rad = -0.05;
  const double own = plant::dynamics_of(plant::Impedance{}, plant.lever.radius_m).stiffness_nm_rad;
  const double depth_rad = stiffness_nm_rad > 0 ? press_nm / stiffness_nm_rad : 0;
  hand.phases = {pressing(plant::HandPhase::Kind::kImpedance, press_nm / own + depth_rad, 0.3)};
  return hand;
}

/// Where something begins to hold, to 0.5 %, by bisection; NaN where it does not between the ends.
template <class Holds>
double between(double low, double high, Holds holds) {
  if (holds(low) || !holds(high)) return std::nan("");
  while (high - low > 0.005 * high) {
    const double middle = std::sqrt(low * high);
    (holds(middle) ? high : low) = middle;
  }
  return std::sqrt(low * high);
}

std::int64_t ticks_of(const design::Design& d, double seconds) {
  return std::llround(seconds * static_cast<double>(d.tick_hz));
}

}  // namespace

Rest rest_in_wall(const design::Elaborated& design, const plant::Parameters& plant,
                  const Wall& wall, double count, int presses) {
  const double count_nm = wall.stiffness_nm_rad * design.design.count_rad();
  Rest out;
  out.stiffness_nm_rad = wall.stiffness_nm_rad;
  out.first_count = count;
  out.presses = presses;
  for (int i = 0; i < presses; ++i) {
    BitLoopSetting s;
    s.linear = false;
    s.plant = plant;
    s.wall = wall;
    s.hand.phases = {pressing(plant::HandPhase::Kind::kTorque, (count + i) * count_nm, 0.2)};
    BitLoop loop(design, s);
    while (loop.ticks() < ticks_of(design.design, 0.5)) loop.tick();
    Spread torque, motor;
    std::int32_t low = loop.position(), high = low;
    while (loop.ticks() < ticks_of(design.design, 0.7)) {
      loop.tick();
      torque.add(loop.tau_ref_nm());
      motor.add(loop.motor_torque_nm());
      low = std::min(low, loop.position());
      high = larger(high, loop.position());
    }
    out.quiet += high == low;
    out.counts = larger(out.counts, high - low);
    out.torque_rms_nm = larger(out.torque_rms_nm, torque.rms());
    out.motor_torque_rms_nm = larger(out.motor_torque_rms_nm, motor.rms());
  }
  return out;
}

double encoder_rule_nm_rad(const design::Elaborated& design, const plant::Parameters& plant) {
  return 2 * plant.lugre.coulomb_nm / design.design.count_rad();
}

HostFigures host_wall(const design::Elaborated& design, const plant::Parameters& plant,
                      const HostCase& c) {
  BitLoopSetting s;
  s.linear = false;
  s.plant = plant;
  s.wall = {c.stiffness_nm_rad, 0, scene_ticks(design.design, c.rate_hz)};
  s.hand = held(c.press_nm, 0, plant);
  BitLoop loop(design, s);
  std::mt19937_64 bits(1);
  const auto gauss = [&bits] {
    // Box-Muller by hand: std::normal_distribution differs between libraries.
    const double u = (static_cast<double>(bits() >> 11) + 1) * 0x1p-53;
    const double v = static_cast<double>(bits() >> 11) * 0x1p-53;
    return std::sqrt(-2 * std::log(u)) * std::cos(kTwoPi * v);
  };
  double smooth = s.hand.start_rad.value();
  loop.set_host([&](double theta_rad, double) {
    const double seen = theta_rad + (c.noise_rad > 0 ? c.noise_rad * gauss() : 0.0);
    smooth += c.smoothing * (seen - smooth);
    return std::min(0.0, -c.stiffness_nm_rad * smooth);
  });
  Spread torque, angle;
  while (loop.ticks() < ticks_of(design.design, 1.0)) loop.tick();
  double low_nm = loop.tau_ref_nm(), high_nm = low_nm;
  std::int32_t low = loop.position(), high = low;
  while (loop.ticks() < ticks_of(design.design, 2.0)) {
    loop.tick();
    torque.add(loop.tau_ref_nm());
    angle.add(loop.theta_rad());
    low_nm = std::min(low_nm, loop.tau_ref_nm()), high_nm = larger(high_nm, loop.tau_ref_nm());
    low = std::min(low, loop.position()), high = larger(high, loop.position());
  }
  return {static_cast<double>(design.design.tick_hz) / s.wall.scene_ticks, torque.rms(),
          angle.rms(), high_nm - low_nm, high - low};
}

HeldWall held_wall(const design::Elaborated& e, const plant::Parameters& linear,
                   const plant::Parameters& full, double rate_hz, double stiffness_nm_rad) {
  const int ticks = scene_ticks(e.design, rate_hz);
  const double tick_s = e.design.tick_s();
  double age_ticks = 0;
  if (e.design.absolute) {
    age_ticks = e.design.absolute_delay_ticks() + (e.design.absolute_period_ticks() - 1) / 2.0;
  }
  HeldWall w;
  w.rate_hz = static_cast<double>(e.design.tick_hz) / ticks;
  w.stiffness_nm_rad = stiffness_nm_rad;
  const double late_s =
      actuator_delay_s(make_axes_model(e, linear).axis, ticks) + age_ticks * tick_s;
  w.needed_nm_s_rad = stiffness_nm_rad * (ticks * tick_s / 2 + late_s);
  const plant::HandDynamics hand = plant::dynamics_of(plant::Impedance{}, linear.lever.radius_m);
  const AxesLoopModel model = make_axes_model(e, linear, &hand);
  AxesWall wall{Eigen::MatrixXd(1, 1), Eigen::MatrixXd::Zero(1, 1), Eigen::MatrixXd::Zero(1, 1),
                ticks, host_ticks + static_cast<int>(std::lround(age_ticks))};
  w.border_nm_rad = between(1, 1e4, [&](double k) {
    wall.stiffness_nm_rad(0, 0) = k;
    return poles(model, wall).front().real() > 0;
  });
  constexpr double enough_counts = 8;
  w.bits_nm_rad = std::nan("");
  if (press_nm / w.border_nm_rad > enough_counts * e.design.count_rad()) {
    w.bits_nm_rad = between(0.7 * w.border_nm_rad, 1.4 * w.border_nm_rad, [&](double k) {
      BitLoopSetting s;
      s.plant = linear;
      s.wall = {k, 0, ticks};
      s.hand = held(press_nm, k, linear);
      BitLoop loop(e, s);
      while (loop.ticks() < ticks_of(e.design, 1.5)) loop.tick();
      std::int32_t low = loop.position(), high = low;
      while (loop.ticks() < ticks_of(e.design, 1.75)) {
        loop.tick();
        low = std::min(low, loop.position()), high = larger(high, loop.position());
      }
      return high - low > enough_counts / 2;
    });
  }
  w.leaning = host_wall(e, full, {rate_hz, stiffness_nm_rad});
  w.pressing = host_wall(e, full, {rate_hz, stiffness_nm_rad, 0, 1, 0.25});
  return w;
}

int scene_ticks(const design::Design& d, double rate_hz) {
  const double ticks = static_cast<double>(d.tick_hz) / rate_hz;
  const int pwm = pwm_ticks(d);
  const int whole = std::max(1, static_cast<int>(std::lround(ticks / pwm))) * pwm;
  if (std::abs(whole - ticks) < 0.01 * ticks) return whole;
  return std::max(1, static_cast<int>(std::lround(ticks)));
}

}  // namespace feltgate::stability
