// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Other motions of the same scene. Documentation: docs/speed-for-accuracy.md
#include "studies/trim/subject.hpp"

#include <algorithm>
#include <cmath>

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

/// Another person's: each constant 0.8 to 1.25 times.
void change(plant::Impedance& i, SplitMix64& random) {
  for (double* constant : {&i.mass_kg, &i.damping_ns_m, &i.stiffness_n_m, &i.grip_stiffness_n_m,
                           &i.grip_damping_ns_m}) {
    *constant *= random.between(0.8, 1.25);
  }
}

/// How a motion differs from the scene's own.
struct Change {
  double amplitude, speed;
};

Change change_of(std::uint64_t seed, double most, SplitMix64& random) {
  // Consecutive seeds go round the four quarters: long or short, fast or slow.
  const bool far = (seed & 1) != 0, fast = (seed & 2) == 0;
  const double amplitude = far ? random.between(1.0, 1 + most) : random.between(1 - most, 1.0);
  return {amplitude, fast ? random.between(1.0, 1.4) : random.between(0.7, 1.0)};
}

/// The hand of a lever or slide, started up to two counts away.
void change(plant::Hand& hand, const Change& c, double count_rad, SplitMix64& random) {
  const double start_rad = hand.initial_rad();
  for (plant::HandPhase& phase : hand.phases) {
    phase.duration_s /= c.speed;
    stretch(phase.profile, phase.kind == Kind::kTorque ? 0.0 : start_rad, c.amplitude, c.speed);
    for (double& time_s : phase.trace.time_s) time_s /= c.speed;
    for (double& theta_rad : phase.trace.theta_rad) {
      theta_rad = start_rad + (theta_rad - start_rad) * c.amplitude;
    }
    if (phase.kind == Kind::kImpedance) change(phase.impedance, random);
  }
  hand.start_rad = start_rad + random.between(-2.0, 2.0) * count_rad;
}

/// What the host does, and how long it lasts.
void change(Scenario& s, const Change& c) {
  scale_setpoints(s.parameters, c.amplitude);
  for (Event& e : s.events) {
    e.at_s /= c.speed;
    scale_setpoints(e.set, c.amplitude);
    if (e.step_nm) *e.step_nm *= c.amplitude;
  }
  s.arm_s /= c.speed;
  s.duration_s /= c.speed;
  s.expectations.clear();  // they are of the scene's own motion
}

double count_rad(const plant::EncoderParameters& encoder) {
  return 6.283185307179586 / (4.0 * encoder.lines);
}

template <std::size_t N>
void change(plant::LeverSetParameters& p, std::array<plant::Hand, N>& hands, const Change& c,
            SplitMix64& random) {
  for (plant::Hand& hand : hands) change(hand, c, count_rad(p.encoder), random);
  p.lever.encoder.seed = random.bits() >> 1;
}

void change(TwoLeversSetup& s, const Change& c, SplitMix64& random) {
  change(s.parameters, s.hand, c, random);
}
void change(StylusSetup& s, const Change& c, SplitMix64& random) {
  change(s.parameters, s.hand, c, random);
}

void change(PantographSetup& s, const Change& c, SplitMix64& random) {
  const plant::Vec2 start = s.hand.start_m.value_or(s.parameters.start_m);
  for (plant::PenPhase& phase : s.hand.phases) {
    phase.duration_s /= c.speed;
    const bool force = phase.kind == plant::PenPhase::Kind::kForce;
    stretch(phase.x, force ? 0.0 : start.x, c.amplitude, c.speed);
    stretch(phase.y, force ? 0.0 : start.y, c.amplitude, c.speed);
    if (phase.kind == plant::PenPhase::Kind::kImpedance) change(phase.impedance, random);
  }
  s.parameters.encoder.seed = random.bits() >> 1;
}

void change(GimbalSetup& s, const Change& c, SplitMix64& random) {
  for (plant::TurnPhase& phase : s.hand.phases) {
    phase.duration_s /= c.speed;
    stretch(phase.way, 0.0, c.amplitude, c.speed);
  }
  s.parameters.encoder.seed = random.bits() >> 1;
}

}  // namespace

Motion perturbed(const Scenario& scene, const plant::Parameters& plant, std::uint64_t seed) {
  SplitMix64 random(seed);
  const Change c = change_of(seed, 0.3, random);
  Motion m{scene, plant, c.amplitude, c.speed};
  change(m.scene.hand, c, count_rad(plant.encoder), random);
  change(m.scene, c);
  m.plant.encoder.seed = random.bits() >> 1;
  return m;
}

AxesMotion perturbed(const AxesScene& scene, std::uint64_t seed) {
  SplitMix64 random(seed);
  const Change c = change_of(seed, 0.1, random);
  AxesMotion m{scene, c.amplitude, c.speed};
  std::visit([&](auto& setup) { change(setup, c, random); }, m.scene.device);
  change(m.scene.scenario, c);
  return m;
}

bool has_mass(const plant::Hand& hand) {
  return std::any_of(hand.phases.begin(), hand.phases.end(),
                     [](const plant::HandPhase& p) { return p.kind == Kind::kImpedance; });
}

bool has_mass(const DeviceSetup& device) {
  const auto any = [](const auto& hands) {
    return std::any_of(hands.begin(), hands.end(),
                       [](const plant::Hand& hand) { return has_mass(hand); });
  };
  if (const auto* levers = std::get_if<TwoLeversSetup>(&device)) return any(levers->hand);
  if (const auto* stylus = std::get_if<StylusSetup>(&device)) return any(stylus->hand);
  if (const auto* pen = std::get_if<PantographSetup>(&device)) {
    const auto& phases = pen->hand.phases;
    return std::any_of(phases.begin(), phases.end(), [](const plant::PenPhase& p) {
      return p.kind == plant::PenPhase::Kind::kImpedance;
    });
  }
  return false;
}

}  // namespace feltgate::trim
