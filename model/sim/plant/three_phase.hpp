// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// A brushless motor of three phases in a star with free neutral, behind three half bridges, and the
// plant that it drives. Equations, diodes and dead time: docs/plant.md#three-phases
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "plant.hpp"

namespace feltgate::plant {

/// One value of each phase or leg: A, B, C.
using Phases = std::array<double, 3>;

/// State of the three half bridges during one step.
struct Legs {
  enum class Mode {
    kOff,       ///< no gate on: six diodes return the current to the supply
    kAveraged,  ///< mean over PWM periods, with the mean effect of dead time
    kSwitched,  ///< gate signals
  };
  Mode mode = Mode::kOff;
  Phases duty{};  ///< averaged: share of the period for which the high gate is commanded, in [0, 1]
  /// Switched: share of the step for which each gate is on, in [0, 1]; high + low <= 1 in each leg.
  Phases high{}, low{};

  static Legs off() { return {}; }
  /// `enabled` = false gives off() for any duty.
  static Legs averaged(const Phases& duty, bool enabled = true);
  static Legs gates(double a_hi, double a_lo, double b_hi, double b_lo, double c_hi, double c_lo);
};

/// Voltage of a leg: share*bus + diode_v. The supply delivers this share of the leg's current.
struct LegVoltage {
  double share = 0.0;
  double diode_v = 0.0;
  double volts(double bus_v) const { return share * bus_v + diode_v; }
};

/// Voltage of a leg by the current that leaves it. It falls in steps: at -edge_a and +edge_a, or
/// once, at 0, where diodes turn over. At a step the leg has any voltage between.
struct LegCurve {
  bool stepped = false;  ///< no: one voltage for every current
  double edge_a = 0.0;
  LegVoltage below, between, above;  ///< `between` counts only if edge_a > 0
};

/// Computes the curves of the legs from the gates or the duties.
class LegModel {
 public:
  /// Errors: std::invalid_argument for a dead time of half a PWM period or more.
  LegModel(const Drive& drive, const SupplyParameters& supply, const PhaseParameters& motor,
           const Effects& effects);

  /// `connected`: the phases that are.
  const std::array<LegCurve, 3>& curves(const Legs& legs, double bus_v,
                                        const std::array<bool, 3>& connected);

 private:
  double whole_pulses(double on) const;
  void average(const Phases& duty, double bus_v, const std::array<bool, 3>& connected);

  double diode_v_;
  double dead_fraction_;  ///< dead time over PWM period; 0: its loss is left out
  double least_;          ///< (dead time + shortest pulse) over PWM period; 0: no minimum
  double ripple_a_v_;     ///< A per volt and unit of duty*duty; 0 without inductance
  Phases duty_{};
  double bus_v_ = -1.0;  ///< -1: no averaged curves held
  std::array<bool, 3> connected_{};
  std::array<LegCurve, 3> curves_;
};

/// Means of the currents over one step.
struct StarStep {
  Phases mean_a{};
  double bridge_a = 0.0;  ///< drawn from the bus
};

/// Currents of three equal windings in a star, whose sum is 0: the exact solution over a step with
/// constant back-EMF, from one turn-over of a diode to the next.
class StarWinding {
 public:
  StarWinding(double resistance_ohm, double inductance_h)
      : resistance_ohm_(resistance_ohm), tau_s_(inductance_h / resistance_ohm) {}

  /// Sets the length of the following steps, s.
  void set_step(double dt_s);
  /// Opens a phase for good. The other two keep the flux of their loop.
  void open(std::size_t phase);

  StarStep advance(const std::array<LegCurve, 3>& legs, const Phases& emf_v, double bus_v);
  /// The same without inductance, where the currents follow the voltage at once.
  StarStep settle(const std::array<LegCurve, 3>& legs, const Phases& emf_v, double bus_v);

  const Phases& current_a() const { return current_a_; }
  const std::array<bool, 3>& connected() const { return connected_; }

 private:
  StarStep fail();

  double resistance_ohm_;
  double tau_s_;
  double dt_s_ = 0.0;
  double reach_ = 0.0;  ///< 1 - exp(-dt/tau)
  std::array<bool, 3> connected_{true, true, true};
  Phases current_a_{};
};

/// Legs, windings and magnets, step by step.
class ThreePhaseMotor {
 public:
  /// Errors: std::invalid_argument for impossible constants or an impossible drive (LegModel).
  ThreePhaseMotor(const PhaseParameters& motor, const SupplyParameters& supply, const Drive& drive,
                  const Effects& effects);

  /// Sets the length of the following steps, s.
  void set_step(double dt_s) { star_.set_step(dt_s); }
  void open_phase(std::size_t phase) { star_.open(phase); }

  /// One step with these legs; bus voltage (V) and the shaft in the middle of the step are held.
  MotorStep advance(const Legs& legs, double bus_v, const Shaft& middle);

  double electrical_rad(double theta_rad) const {
    return p_.pole_pairs * theta_rad + p_.offset_rad;
  }
  /// Back-EMF of each phase over Ke*omega at this electrical angle.
  Phases shape(double electrical_rad) const;
  const Phases& phase_a() const { return star_.current_a(); }
  const Phases& phase_mean_a() const { return mean_a_; }
  /// Sinusoidal currents of this amplitude, in phase with a sinusoidal back-EMF, give the torque.
  double current_a(double theta_rad) const { return amplitude_a(torque_nm(theta_rad)); }
  /// At this angle, with the present currents, Nm.
  double torque_nm(double theta_rad) const {
    return torque(shape(electrical_rad(theta_rad)), star_.current_a());
  }

 private:
  double torque(const Phases& shape, const Phases& current_a) const;
  double amplitude_a(double torque_nm) const;

  PhaseParameters p_;
  Effects on_;
  LegModel legs_;
  StarWinding star_;
  Phases mean_a_{};
};

/// The plant of a lever whose motor has three phases; `parameters.motor` does not count.
class ThreePhasePlant : public ShaftPlant {
 public:
  /// Errors: those of ThreePhaseMotor.
  ThreePhasePlant(const Parameters& parameters, const PhaseParameters& motor,
                  const Effects& effects, const Drive& drive, const Hand& hand)
      : ShaftPlant(parameters, effects, drive.clock_hz, hand),
        motor_(motor, parameters.supply, drive, effects),
        inductance_(effects.inductance) {}

  /// Advances by `clocks` >= 1 FPGA clocks with these legs. Errors: MotionError.
  void advance(const Legs& legs, Clock clocks);
  /// From now on this phase (0, 1, 2) carries no current.
  void open_phase(std::size_t phase) { motor_.open_phase(phase); }

  const ThreePhaseMotor& motor() const { return motor_; }
  /// Number of continuous states; two of the three currents are independent.
  std::size_t state_size() const { return shaft_states() + (inductance_ ? 2 : 0); }

 private:
  ThreePhaseMotor motor_;
  bool inductance_;
};

}  // namespace feltgate::plant
