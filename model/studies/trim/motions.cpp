// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Other motions of the same scene. Documentation: docs/trim.md
#include "studies/trim/motions.hpp"

#include "feltgate/random.hpp"

namespace feltgate::trim {

namespace {

using Kind = plant::HandPhase::Kind;

void scale_setpoints(std::map<std::string, double>& values, double amplitude) {
  for (auto& [name, value] : values) {
    if (name == "setpoint_torque" || name == "voltage_setpoint") value *= amplitude;
  }
}

/// `centre` is what amplitudes are measured from.
void stretch(plant::Profile& profile, double centre, double amplitude, double speed) {
  for (plant::Segment& s : profile) {
    s.duration_s /= speed;
    s.to = centre + (s.to - centre) * amplitude;
    s.amplitude *= amplitude;
    s.frequency_hz *= speed;
  }
}

void stretch(plant::HandPhase& phase, double start_rad, double amplitude, double speed) {
  phase.duration_s /= speed;
  stretch(phase.profile, phase.kind == Kind::kTorque ? 0.0 : start_rad, amplitude, speed);
  for (double& time_s : phase.trace.time_s) time_s /= speed;
  for (double& theta_rad : phase.trace.theta_rad) {
    theta_rad = start_rad + (theta_rad - start_rad) * amplitude;
  }
}

}  // namespace

Motion perturbed(const Scenario& scene, const plant::Parameters& plant, std::uint64_t seed) {
  SplitMix64 random(seed);
  // Consecutive seeds go round the four quarters: long or short, fast or slow.
  const bool far = (seed & 1) != 0, fast = (seed & 2) == 0;
  Motion m{scene, plant, far ? random.between(1.0, 1.3) : random.between(0.7, 1.0),
           fast ? random.between(1.0, 1.4) : random.between(0.7, 1.0)};
  Scenario& s = m.scene;
  const double start_rad = s.hand.initial_rad();
  const double count_rad = 6.283185307179586 / (4.0 * plant.encoder.lines);
  for (plant::HandPhase& phase : s.hand.phases) {
    stretch(phase, start_rad, m.amplitude, m.speed);
    if (phase.kind != Kind::kImpedance) continue;
    plant::Impedance& i = phase.impedance;
    for (double* constant : {&i.mass_kg, &i.damping_ns_m, &i.stiffness_n_m, &i.grip_stiffness_n_m,
                             &i.grip_damping_ns_m}) {
      *constant *= random.between(0.8, 1.25);
    }
  }
  s.hand.start_rad = start_rad + random.between(-2.0, 2.0) * count_rad;
  scale_setpoints(s.parameters, m.amplitude);
  for (Event& e : s.events) {
    e.at_s /= m.speed;
    scale_setpoints(e.set, m.amplitude);
    if (e.step_nm) *e.step_nm *= m.amplitude;
  }
  s.arm_s /= m.speed;
  s.duration_s /= m.speed;
  s.expectations.clear();  // they are of the scene's own motion
  m.plant.encoder.seed = random.bits() >> 1;
  return m;
}

}  // namespace feltgate::trim
