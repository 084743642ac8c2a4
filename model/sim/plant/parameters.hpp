// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Constants of the motor, lever, friction, encoder and supply, in SI units, and the list of effects
// that a scene switches on. Documentation: docs/plant.md
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace feltgate::plant {

constexpr double kTwoPi = 6.283185307179586476925286766559;

struct MotorParameters {
  double torque_constant_nm_a = 0.0;
  double back_emf_constant_v_s_rad = 0.0;
  double resistance_ohm = 0.0;  ///< total series resistance: winding, wiring, driver
  double inductance_h = 0.0;
  double dead_voltage_v = 0.0;  ///< brush drop, opposes the current
};

/// A harmonic of the back-EMF's shape: share*cos(order*x) beside the fundamental cos(x).
struct EmfHarmonic {
  int order = 0;
  double share = 0.0;
};

/// Three Hall sensors of a motor. Line n is high in half of an electrical turn, from a third of a
/// turn after line n - 1 on.
struct HallLines {
  double begin_rad = 0;                  ///< electrical angle at which line 0 rises
  std::array<double, 3> error_rad = {};  ///< electrical: how far each sensor is from its place
  /// The lines at an electrical angle; bit n: line n.
  unsigned code(double electrical_rad) const {
    unsigned code = 0;
    for (std::size_t n = 0; n < 3; ++n) {
      const double third_rad = kTwoPi / 3 * static_cast<double>(n);
      const double since_rad = electrical_rad - begin_rad - third_rad - error_rad[n];
      if (std::sin(since_rad) >= 0) code |= 1u << n;
    }
    return code;
  }
};

/// Constants of a motor with three phases. Electrical angle = pole_pairs*theta + offset_rad;
/// back-EMF of phase k = back_emf_v_s_rad*omega*shape(electrical angle - k*120 degrees).
struct PhaseParameters {
  double resistance_ohm = 0.0;  ///< of one phase, terminal to neutral, with its wiring and switch
  double inductance_h = 0.0;    ///< of one phase: half of that between two terminals
  int pole_pairs = 1;
  double offset_rad = 0.0;
  double back_emf_v_s_rad = 0.0;       ///< peak of one phase; also Nm/A of one phase
  std::vector<EmfHarmonic> harmonics;  ///< empty: sinusoidal
  std::optional<HallLines> hall;       ///< nullopt: the motor has none

  /// Current: the peak of a phase, whose sinusoid is in phase with the back-EMF.
  MotorParameters as_brushed() const {
    return {1.5 * back_emf_v_s_rad, back_emf_v_s_rad, resistance_ohm, inductance_h, 0.0};
  }
};

struct LeverParameters {
  double inertia_kg_m2 = 0.0;  ///< rotor and lever
  double viscous_nm_s_rad = 0.0;
  double radius_m = 0.0;  ///< where the hand holds the lever
};

/// LuGre friction: g(w) = coulomb + (static - coulomb)*exp(-(w/stribeck)^2).
struct LugreParameters {
  double stiffness_nm_rad = 0.0;  ///< sigma0
  double damping_nm_s_rad = 0.0;  ///< sigma1
  double viscous_nm_s_rad = 0.0;  ///< sigma2
  double coulomb_nm = 0.0;
  double static_nm = 0.0;
  double stribeck_rad_s = 0.0;
};

struct SupplyParameters {
  double voltage_v = 0.0;
  double current_limit_a = 0.0;
  double bus_capacitance_f = 0.0;
  double diode_drop_v = 0.0;  ///< of each free-wheeling diode of the bridge
};

/// One harmonic of the motor's cogging: torque on the lever of
/// amplitude_nm * sin(per_turn * angle + phase_rad).
struct CoggingHarmonic {
  int per_turn = 0;
  double amplitude_nm = 0.0;
  double phase_rad = 0.0;
};

/// End stops of the lever: a spring at each end returns restitution^2 of the energy that it took,
/// so a free lever leaves with `restitution` times the speed with which it arrived.
struct EndStops {
  double low_rad = 0.0, high_rad = 0.0;
  double stiffness_nm_rad = 0.0;
  double restitution = 0.0;
};

struct EncoderParameters {
  int lines = 0;                                  ///< 4*lines counts per revolution
  std::array<double, 4> edge_offset_counts = {};  ///< of the edges 4k, 4k+1, 4k+2, 4k+3
  double line_jitter_counts_rms = 0.0;            ///< one draw per line, shared by its edges
  std::uint64_t seed = 0;
  /// What an absolute encoder shows beyond the angle: cosine 1, sine 1, cosine 2, ... of what it
  /// shows; only with the effect encoder_imperfect.
  std::vector<double> absolute_error_mrad;
};

/// Switches of the model. An effect that is off is not part of the state vector.
struct Effects {
  bool inductance = true;  ///< off: current follows the voltage at once
  bool back_emf = true;
  bool dead_voltage = true;
  bool lugre = true;
  bool viscous = false;       ///< LeverParameters::viscous_nm_s_rad
  bool supply_limit = false;  ///< current limit of the source, bus voltage as a state
  bool dead_time = true;      ///< what dead time and shortest pulse take, in averaged mode
  bool encoder_imperfect = false;
  bool hand_dynamics = true;  ///< off: an impedance hand imposes its motion, without mass or grip
};

/// Every effect with its name in files.
struct EffectName {
  const char* name;
  bool Effects::*flag;
};
inline constexpr EffectName effect_names[] = {{"inductance", &Effects::inductance},
                                              {"back_emf", &Effects::back_emf},
                                              {"dead_voltage", &Effects::dead_voltage},
                                              {"lugre", &Effects::lugre},
                                              {"viscous", &Effects::viscous},
                                              {"supply_limit", &Effects::supply_limit},
                                              {"dead_time", &Effects::dead_time},
                                              {"encoder_imperfect", &Effects::encoder_imperfect},
                                              {"hand_dynamics", &Effects::hand_dynamics}};

struct Parameters {
  std::string name;
  std::string place;  ///< "file:line" of the lever's inertia, for errors; empty: not from a file
  MotorParameters motor;                  ///< of one with three phases: as_brushed()
  std::optional<PhaseParameters> phases;  ///< nullopt: the motor has brushes
  LeverParameters lever;
  LugreParameters lugre;
  SupplyParameters supply;
  EncoderParameters encoder;
  std::optional<EndStops> end_stops;     ///< nullopt: the lever turns freely
  std::vector<CoggingHarmonic> cogging;  ///< empty: the motor has none
  Effects effects;                       ///< defaults of the file; a scene may override each
};

/// Viscous torque per speed, from the effects that are on.
inline double smooth_damping_nm_s_rad(const Parameters& p, const Effects& on) {
  return (on.viscous ? p.lever.viscous_nm_s_rad : 0.0) +
         (on.lugre ? p.lugre.viscous_nm_s_rad : 0.0);
}

/// The transmission between a motor and its joint.
struct JointParameters {
  double rotor_inertia_kg_m2 = 0.0;
  double drum_inertia_kg_m2 = 0.0;  ///< turns with the joint
  double pulley_radius_m = 0.0;     ///< capstan pulley, on the motor
  double drum_radius_m = 0.0;
  double viscous_nm_s_rad = 0.0;  ///< at the joint
  bool encoder_on_motor = false;  ///< the counts are those of the motor's angle

  /// Turns of the motor per turn of the joint.
  double ratio() const { return drum_radius_m / pulley_radius_m; }
  double encoder_ratio() const { return encoder_on_motor ? ratio() : 1.0; }
  double inertia_kg_m2() const {
    return drum_inertia_kg_m2 + ratio() * ratio() * rotor_inertia_kg_m2;
  }
};

/// Parameters of a device with equal joints.
struct AxesParameters {
  JointParameters joint;
  MotorParameters motor;
  LugreParameters lugre;      ///< at the motor's shaft
  SupplyParameters supply;    ///< one for all motors
  EncoderParameters encoder;  ///< of axis 0; the other axes have the next seeds
  Effects effects;            ///< defaults of the file; a scene may override each

  /// Viscous torque per speed of a joint, from the effects that are on, Nm s/rad.
  double smooth_nm_s_rad(const Effects& on) const {
    return (on.viscous ? joint.viscous_nm_s_rad : 0.0) +
           (on.lugre ? joint.ratio() * joint.ratio() * lugre.viscous_nm_s_rad : 0.0);
  }
};

}  // namespace feltgate::plant
