// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Documentation: docs/stability.md
#include "studies/stability/experiments.hpp"

#include <algorithm>
#include <cmath>
#include <random>

#include "feltgate/largest.hpp"

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
  s.hand.start_rad = -0.05;
  // The default hand has 1.35 Nm/rad at 0.1 m: its aim 15 mrad beyond the face is 20 mNm.
  s.hand.phases = {pressing(plant::HandPhase::Kind::kImpedance, 0.015, 0.3)};
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
  while (loop.ticks() < ticks_of(design.design, 2.0)) {
    loop.tick();
    if (loop.ticks() < ticks_of(design.design, 1.0)) continue;
    torque.add(loop.tau_ref_nm());
    angle.add(loop.theta_rad());
  }
  return {static_cast<double>(design.design.tick_hz) / s.wall.scene_ticks, torque.rms(),
          angle.rms()};
}

int scene_ticks(const design::Design& d, double rate_hz) {
  const double ticks = static_cast<double>(d.tick_hz) / rate_hz;
  const int pwm = pwm_ticks(d);
  const int whole = std::max(1, static_cast<int>(std::lround(ticks / pwm))) * pwm;
  if (std::abs(whole - ticks) < 0.01 * ticks) return whole;
  return std::max(1, static_cast<int>(std::lround(ticks)));
}

}  // namespace feltgate::stability
