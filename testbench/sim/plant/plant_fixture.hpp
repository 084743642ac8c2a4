// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Shared by the tests of the plant: shipped plants, drives and hands in one line each.
// docs/plant.md
#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "catch.hpp"
#include "sim/plant/plant.hpp"
#include "sim/plant/plant_file.hpp"

namespace feltgate::plant {

inline Parameters shipped(const std::string& name) {
  return read_plant_file(std::string(FELTGATE_SOURCE_DIR) + "/vectors/plants/" + name + ".toml");
}

inline constexpr Effects kNoEffects{false, false, false, false, false, false, false, false};

inline constexpr double kClockHz = 50e6;

inline Clock clocks_of(double seconds) { return std::llround(seconds * kClockHz); }

/// The averaged bridge with the duty that gives `volts` at the nominal supply.
inline Bridge volts(const Parameters& p, double volts) {
  return Bridge::averaged(volts / p.supply.voltage_v);
}

inline void run(Plant& plant, const Bridge& bridge, double seconds, Clock step = 25) {
  const Clock end = plant.now() + clocks_of(seconds);
  while (plant.now() < end) plant.advance(bridge, step);
}

inline Hand hand_of(HandPhase phase) {
  Hand hand;
  hand.phases.push_back(std::move(phase));
  return hand;
}

inline Hand hand_of(HandPhase::Kind kind) {
  HandPhase phase;
  phase.kind = kind;
  return hand_of(phase);
}

inline Segment segment(Segment::Kind kind, double duration_s, double to = 0.0) {
  Segment s;
  s.kind = kind;
  s.duration_s = duration_s;
  s.to = to;
  return s;
}

inline Segment sine(double duration_s, double amplitude, double frequency_hz, double phase_rad) {
  Segment s;
  s.kind = Segment::Kind::kSine;
  s.duration_s = duration_s;
  s.amplitude = amplitude;
  s.frequency_hz = frequency_hz;
  s.phase_rad = phase_rad;
  return s;
}

inline Hand moving(Profile profile) {
  HandPhase phase;
  phase.kind = HandPhase::Kind::kPrescribed;
  phase.profile = std::move(profile);
  return hand_of(phase);
}

}  // namespace feltgate::plant
