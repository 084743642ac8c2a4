// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The torque that a hand feels at a free and at a damped lever, from the core's bits and from
// formulas. With FELTGATE_SHOW=1 it prints the table of the page. Simulation. Documentation:
// docs/devices/one-lever.md
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <functional>

#include "catch.hpp"
#include "design/design.hpp"
#include "loop_fixture.hpp"

namespace {

using namespace feltgate;
using design::Design;

constexpr double kTurn = 6.283185307179586;
constexpr double kAmplitude_rad = 0.5, kPulse_rad_s = 2 * kTurn;  // of the scene's swing

/// What is felt over half a swing.
struct Swing {
  double rms_nm, damping_nm_s_rad, inertia_kg_m2;
};

/// A row of the table: what is asked for and what the plant has.
struct Case {
  const char* design;
  double asked_nm_s_rad, viscous_nm_s_rad;
};

Swing by_bits(const Case& c) {
  const bool free = c.asked_nm_s_rad == 0;
  Scenario scene = shipped_scene(free ? "free_lever" : "damped_lever");
  if (!free) scene.parameters["damper_damping"] = c.asked_nm_s_rad;
  scene.expectations.clear();
  plant::Parameters plant = p24();
  plant.effects.viscous = c.viscous_nm_s_rad > 0;
  plant.lever.viscous_nm_s_rad = c.viscous_nm_s_rad;
  resolve_effects(scene, plant.effects);
  RunOptions options;
  options.design = c.design;
  options.engine = "twin";
  const auto f = run_scenario(scene, plant, options).figures;
  // The stimulus is what the formulas take it for.
  CHECK(std::abs(f.at("theta_max_rad") - kAmplitude_rad) < 1e-9);
  CHECK(std::abs(f.at("theta_min_rad") + kAmplitude_rad) < 1e-9);
  return {f.at("drag_rms_nm"), f.at("drag_damping_nm_s_rad"), f.at("drag_inertia_kg_m2")};
}

/// The control of a design without counts, ticks and words: the N-method as a mean over m1
/// ticks and a low-pass, both in closed form, the observer as its differential equation.
class Control {
 public:
  Control(const Design& d, double asked_nm_s_rad, double step_s)
      : d_(d),
        asked_nm_s_rad_(asked_nm_s_rad),
        m1_s_(d.m1 * d.tick_s()),
        gain_((d.exact_gain ? d.velocity_gain_rad_s() : std::exp2(d.n)) / d.velocity_gain_rad_s()),
        of_speed_(-std::expm1(-d.velocity_cutoff_rad_s * step_s)),
        of_load_(-std::expm1(-d.observer_cutoff_rad_s * step_s)) {}

  /// Voltage over the back-EMF, of a lever that was at `angle(t)` and has this speed.
  double volts(double t, const std::function<double(double)>& angle, double speed_rad_s) {
    const double raw = gain_ * (angle(t) - angle(t - m1_s_)) / m1_s_;
    speed_ += of_speed_ * (raw - speed_);
    const double asked = -asked_nm_s_rad_ * speed_;
    const double ktn = d_.torque_constant_nm_a, share = d_.inertia_kg_m2 * d_.kp_1_kg_m2;
    const double turning = d_.observer_cutoff_rad_s * d_.inertia_kg_m2 * speed_;
    const double load = load_ - turning;
    const double amperes = (share * asked + (1 - share) * load) / ktn;
    load_ += of_load_ * (ktn * amperes + turning - load_);
    if (!d_.emf_in_law()) {
      return (std::abs(asked) > d_.region_nm ? d_.kv_high : d_.kv_low) * amperes -
             d_.emf_constant_v_s_rad * speed_rad_s;
    }
    const double brushes =
        d_.dead_voltage_v * std::clamp(asked / d_.dead_voltage_linear_nm, -1.0, 1.0);
    return d_.resistance_ohm * amperes + brushes + d_.emf_constant_v_s_rad * (speed_ - speed_rad_s);
  }

 private:
  Design d_;
  double asked_nm_s_rad_, m1_s_, gain_, of_speed_, of_load_;
  double speed_ = 0, load_ = 0;
};

/// Inertia, sliding friction, and the motor of that control behind its winding, over the half swing
/// that begins at rest.
Swing by_formulas(const Case& c) {
  const plant::Parameters p = p24();
  const Design d =
      design::read_design(std::string(FELTGATE_ROOT) + "/rtl/designs/" + c.design + ".toml");
  const int steps = 25000;
  const double step_s = 0.25 / steps;
  Control control(d, c.asked_nm_s_rad, step_s);
  const auto angle = [](double t) {
    return kAmplitude_rad * (t > 0 ? std::cos(kPulse_rad_s * t) : 1);
  };
  const double of_winding = -std::expm1(-step_s * p.motor.resistance_ohm / p.motor.inductance_h);
  double motor = 0, squares = 0, with_speed = 0, speeds = 0, with_acceleration = 0,
         accelerations = 0;
  for (int i = 0; i < steps; ++i) {
    const double t = (i + 0.5) * step_s;
    const double speed = -kAmplitude_rad * kPulse_rad_s * std::sin(kPulse_rad_s * t);
    const double acceleration = -kPulse_rad_s * kPulse_rad_s * angle(t);
    const double over = control.volts(t, angle, speed);
    const double still =
        p.motor.torque_constant_nm_a / p.motor.resistance_ohm *
        std::copysign(std::max(0.0, std::abs(over) - p.motor.dead_voltage_v), over);
    motor += of_winding * (still - motor);
    const double slow = speed / p.lugre.stribeck_rad_s;
    const double sliding =
        p.lugre.coulomb_nm + (p.lugre.static_nm - p.lugre.coulomb_nm) * std::exp(-slow * slow);
    const double hand = p.lever.inertia_kg_m2 * acceleration + std::copysign(sliding, speed) +
                        (p.lugre.viscous_nm_s_rad + c.viscous_nm_s_rad) * speed - motor;
    squares += hand * hand;
    with_speed += hand * speed;
    speeds += speed * speed;
    with_acceleration += hand * acceleration;
    accelerations += acceleration * acceleration;
  }
  return {std::sqrt(squares / steps), with_speed / speeds, with_acceleration / accelerations};
}

/// A row for the page.
void show(const Case& c, const Swing& bits, const Swing& formulas) {
  if (std::getenv("FELTGATE_SHOW") == nullptr) return;
  fmt::print("| `{}` | {:g} | {:g} | {:.2f} | {:.2f} | {:.3f} | {:.3f} | {:.1f} | {:.1f} |\n",
             c.design, 1e3 * c.asked_nm_s_rad, 1e3 * c.viscous_nm_s_rad, 1e3 * bits.rms_nm,
             1e3 * formulas.rms_nm, 1e3 * bits.damping_nm_s_rad, 1e3 * formulas.damping_nm_s_rad,
             1e6 * bits.inertia_kg_m2, 1e6 * formulas.inertia_kg_m2);
  std::fflush(stdout);
}

void title() {
  if (std::getenv("FELTGATE_SHOW") == nullptr) return;
  fmt::print(
      "| design | damper asked for | friction b of the plant | felt, rms | by formulas | as "
      "damping "
      "| by formulas | as inertia | by formulas |\n|---|---|---|---|---|---|---|---|---|\n");
}

}  // namespace

TEST_CASE("drag at 0.5 rad and 2 Hz, free and damped, is that of the formulas", "[free_lever]") {
  const double own_kg_m2 = p24().lever.inertia_kg_m2;
  title();
  for (const char* name : {"lever", "paper"}) {
    double before_nm = 0;
    for (const double damping : {0.0, 0.005, 0.01, 0.02, 0.03}) {
      const Case c{name, damping, 0};
      const Swing bits = by_bits(c), formulas = by_formulas(c);
      show(c, bits, formulas);
      INFO(name << ", " << damping << " Nm s/rad");
      CHECK(std::abs(bits.rms_nm / formulas.rms_nm - 1) < 0.01);
      CHECK(std::abs(bits.damping_nm_s_rad / formulas.damping_nm_s_rad - 1) < 0.01);
      CHECK(std::abs(bits.inertia_kg_m2 - formulas.inertia_kg_m2) < 0.03 * own_kg_m2);
      CHECK(bits.rms_nm > before_nm);  // it rises with the damping
      before_nm = bits.rms_nm;
    }
  }
}

TEST_CASE("viscous friction of the plant is felt as it is: no design takes it away",
          "[free_lever]") {
  for (const char* name : {"lever", "paper"}) {
    const double free = by_bits({name, 0, 0}).damping_nm_s_rad;
    for (const double viscous : {1e-3, 2e-3}) {
      const Case c{name, 0, viscous};
      const Swing bits = by_bits(c), formulas = by_formulas(c);
      show(c, bits, formulas);
      INFO(name << ", " << viscous << " Nm s/rad");
      CHECK(std::abs(bits.damping_nm_s_rad - free - viscous) < 0.01 * viscous);
      CHECK(std::abs(bits.rms_nm / formulas.rms_nm - 1) < 0.01);
    }
  }
}
