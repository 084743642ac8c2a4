// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Test cases of scenes: the laws in fixed point against those in 113-bit arithmetic with the
// design's exact values, given position and velocity. Documentation: docs/blocks/scenes.md
#pragma once

#include "catch.hpp"
#include "feltgate/largest.hpp"
#include "feltgate/quad.hpp"
#include "scenes_bench.hpp"

namespace feltgate::test {

/// Twin and reference side by side, both past the ramp; the largest distance in torque steps.
class Comparison {
 public:
  explicit Comparison(int scene) : scene_(scene) {
    // A step of 8 Nm ends every ramp in the first tick.
    fixed_words_.set_raw(A::ramp_step, (std::int64_t{1} << 27) - 1);
    real_words_.set_value(A::ramp_step, 8);
    fixed_words_.set_raw(A::setpoint_torque, 13371);
    real_words_.set_value(A::setpoint_torque, Quad{13371} / 65536);
    // In a wall, two large products may cancel: what is left shows every bit of its coefficients.
    use_quantised(A::wall_stiffness, Design::P::wall_stiffness);
    use_quantised(A::wall_damping, Design::P::wall_damping);
    at(0, 0);
  }
  void at(std::int32_t position, std::int64_t velocity) {
    fixed_.tick(fixed_words_, true, scene_, position,
                ScenesLaw<Design, Fixed>::Velocity::from_raw(velocity));
    const Quad exact_velocity = static_cast<Quad>(velocity) /
                                static_cast<Quad>(std::int64_t{1} << Design::f.velocity.fraction);
    real_.tick(real_words_, true, scene_, position, exact_velocity);
    const Quad lsb = Quad{1} / static_cast<Quad>(std::int64_t{1} << kTorque.fraction);
    const Quad error = real_.tau_ref() / lsb - static_cast<Quad>(fixed_.tau_ref().raw());
    const double size = static_cast<double>(error < 0 ? -error : error);
    worst = larger(worst, size);
    acting += fixed_.tau_ref().raw() != 0;
    limited += fixed_.limit_torque();
  }
  double worst = 0;
  std::int64_t acting = 0, limited = 0;

 private:
  void use_quantised(int address, Format format) {
    for (const ParameterInfo& p : Design::parameters) {
      if (p.address != address) continue;
      real_words_.set_value(address, static_cast<Quad>(p.raw) /
                                         static_cast<Quad>(std::int64_t{1} << format.fraction));
    }
  }

  int scene_;
  Words<Design, Fixed> fixed_words_;
  Words<Design, Real<Quad>> real_words_;
  ScenesLaw<Design, Fixed> fixed_;
  ScenesLaw<Design, Real<Quad>> real_;
};

}  // namespace feltgate::test

TEST_CASE("scenes: within one step of torque of the exact laws, given position and velocity") {
  for (const int scene :
       {S::free, S::setpoint, S::membrane, S::spring_compression, S::spring_tension, S::damper,
        S::charge_attract, S::charge_repel, S::wall}) {
    Comparison c(scene);
    Random random(11);
    for (std::int32_t p = -2500; p <= 2500; ++p) c.at(p, p * 20011);
    for (int k = 0; k < 50000; ++k) {
      const std::int64_t range = std::int64_t{1} << random.between(2, 17);
      c.at(static_cast<std::int32_t>(random.between(-range, range - 1)),
           static_cast<std::int32_t>(random.bits()) >> random.below(12));
    }
    INFO("scene " << scene << ", worst " << c.worst << ", acting " << c.acting << ", limited "
                  << c.limited);
    REQUIRE(c.worst <= 1.0);
    REQUIRE((c.acting > 500) == (scene != S::free));
  }
}
