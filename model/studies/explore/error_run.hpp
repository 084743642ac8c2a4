// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Measures the error of a design's chain against the same chain in 113 bits with the exact values.
// The error includes coefficients, gain and rounding. Documentation: docs/explore.md
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "feltgate/generated/causes.hpp"
#include "feltgate/largest.hpp"
#include "feltgate/scenes.hpp"
#include "sim/reference/chain.hpp"
#include "studies/explore/measurement.hpp"
#include "studies/explore/stimulus.hpp"

namespace feltgate::explore {

/// Design D with the exact factor of the N-method in place of its power of two or quantised gain.
template <class D>
struct ExactGain : D {
  static constexpr int velocity_gain = 1;  // any but 0: the factor below is taken
  static constexpr double velocity_gain_rad_s =
      D::count_rad * static_cast<double>(D::tick_hz) / D::m1;
};

/// Runs both chains of one design on the same counts.
template <class D>
class ErrorRun {
 public:
  explicit ErrorRun(const std::vector<Value>& values) : values_(values) {}

  /// Runs every motion of the stimulus whose scene is built in.
  void run(Measurement* m) {
    for (const Motion& motion : motions()) {
      const int scene = D::scene_number(motion.scene);
      if (scene_built<D>(scene)) run(motion, scene, m);
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
      const unsigned limits = fixed_.limits();
      for (std::size_t bit = 0; bit < m->limited.size(); ++bit) {
        m->limited[bit] += (limits >> bit) & 1u;
      }
      // A saturation is not a rounding error, and the filters keep its effect.
      if ((limits & (limit::velocity | limit::tau_hat)) != 0) {
        m->ticks_left_out += ticks - k;
        return;
      }
      ++m->ticks;
      const auto off = [](auto fixed, Quad exact) {
        return static_cast<double>(static_cast<Quad>(fixed.to_double()) - exact);
      };
      m->velocity.add(off(fixed_.velocity(), exact_.velocity()), motion.name);
      m->tau_hat.add(off(fixed_.tau_hat(), exact_.tau_hat()), motion.name);
      m->tau_ref.add(off(fixed_.tau_ref(), exact_.tau_ref()), motion.name);
      m->torque.add(ktn * off(fixed_.control().current, exact_.control().current), motion.name);
      m->voltage.add(off(fixed_.control().voltage, exact_.control().voltage), motion.name);
    }
  }

  /// The largest count of m1 ticks as a speed; what is asked of a bound.
  static void note_speed(const Motion& motion, std::int64_t ticks, Measurement* m) {
    for (std::int64_t k = 0; k < ticks; ++k) {
      const auto before = counts(motion, k < D::m1 ? 0 : k - D::m1);
      const double size = std::abs(counts(motion, k) - before) * ExactGain<D>::velocity_gain_rad_s;
      m->raw_velocity_rad_s = larger(m->raw_velocity_rad_s, size);
    }
  }

  /// Parameters of the point. The ramp after arming is over at once: its step is no matter of
  /// rounding, and its time would hide the rest.
  void reset(const Motion& motion) {
    fixed_.reset();
    exact_.reset();
    for (const Value& v : values_) {
      fixed_.words().set_raw(v.address, v.raw);
      exact_.words().set_value(v.address, static_cast<Quad>(v.si));
    }
    fixed_.words().set_raw(D::A::ramp_step, fixed_of<D::f.ramp.key()>::max_raw());
    exact_.words().set_value(D::A::ramp_step, Quad{1e6});
    fixed_.words().set_raw(D::A::setpoint_torque,
                           std::llround(std::ldexp(motion.setpoint_nm, D::f.torque.fraction)));
    exact_.words().set_value(D::A::setpoint_torque, static_cast<Quad>(motion.setpoint_nm));
  }

  /// What an ideal encoder counts at the start of tick k.
  static std::int32_t counts(const Motion& motion, std::int64_t k) {
    const double t_s = static_cast<double>(k) / static_cast<double>(D::tick_hz);
    return static_cast<std::int32_t>(std::floor(motion.angle_rad(t_s) / D::count_rad));
  }

  const std::vector<Value>& values_;
  ControlChain<D, Fixed> fixed_;
  ControlChain<ExactGain<D>, Real<Quad>> exact_;
};

}  // namespace feltgate::explore
