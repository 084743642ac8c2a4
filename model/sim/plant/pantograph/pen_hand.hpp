// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// What holds the pen of a linkage: the lever's hand in two dimensions. docs/devices/pantograph.md
#pragma once

#include <cstddef>
#include <limits>
#include <optional>
#include <vector>

#include "../hand.hpp"
#include "feltgate/encoder_source.hpp"
#include "linkage_mechanics.hpp"

namespace feltgate::plant {

/// One phase of a hand at the pen.
struct PenPhase {
  enum class Kind {
    kFree,        ///< nothing touches the pen
    kPrescribed,  ///< the pen follows (x, y), m
    kImpedance,   ///< mass, spring and damper behind a grip; the spring's end follows (x, y), m
    kForce,       ///< the hand applies (x, y), N, starting from 0
  };
  Kind kind = Kind::kFree;
  double duration_s = std::numeric_limits<double>::infinity();  ///< infinite: forever
  Profile x, y;
  Impedance impedance;  ///< the same in both directions
};

/// A hand at the pen.
struct PenHand {
  std::optional<Vec2> start_m;   ///< pen at clock 0; default: that of the plant
  std::vector<PenPhase> phases;  ///< empty: free forever; the last phase lasts forever
};

/// The phases in progress, step by step on the integer clock.
class PenHandRun {
 public:
  /// Without `dynamics`, an impedance hand imposes its motion on the pen.
  PenHandRun(PenHand hand, double clock_hz, bool dynamics = true);

  /// Prepares the step of dt_s that starts at clock `now` with this pen state. A phase starts with
  /// the first step at or after its time, from the position and speed of the pen at that moment.
  void begin_step(Clock now, double dt_s, Vec2 pen_m, Vec2 pen_m_s, LinkageState& state);
  /// Sets the hand's part of a load: force, or mass and target.
  void load(LinkageLoad& load) const;

  /// The first clock after `now` at which the hand's motion changes.
  Clock next_corner(Clock now) const;

  PenPhase::Kind kind() const { return kind_; }
  bool imposes() const { return kind_ == PenPhase::Kind::kPrescribed; }
  bool has_mass() const { return kind_ == PenPhase::Kind::kImpedance; }
  /// Position of the pen at the end of the step, for a hand that imposes it.
  Vec2 target_m() const { return target_m_; }
  Vec2 target_m_s() const { return target_m_s_; }

  /// Sets the equilibrium of an impedance hand at `now`; it moves on at this rate, instead of by
  /// its profiles, until the next call or phase.
  void steer(Vec2 target_m, Vec2 rate_m_s, Clock now);
  /// Replaces the hand's phases: `phase` begins with the next step and lasts forever.
  void take(PenPhase phase);

 private:
  PenPhase::Kind kind_of(const PenPhase& phase) const;
  void begin_phase(Vec2 pen_m, Vec2 pen_m_s, LinkageState& state);

  PenHand hand_;
  double clock_hz_;
  bool has_dynamics_;
  std::size_t index_ = 0;
  bool started_ = false;
  bool last_ = true;
  Clock phase_begin_ = 0, phase_end_ = 0;
  PenPhase::Kind kind_ = PenPhase::Kind::kFree;
  ProfileRun x_, y_;
  Vec2 target_m_, target_m_s_;  ///< m and m/s; N for a force
  bool steered_ = false;
  Vec2 steered_from_m_, steered_m_s_;
  Clock steered_since_ = 0;
};

}  // namespace feltgate::plant
