// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// What holds the pen of a linkage: the lever's hand in two dimensions. docs/pantograph.md
#pragma once

#include <cstddef>
#include <limits>
#include <optional>
#include <vector>

#include "../hand.hpp"
#include "feltgate/encoder_source.hpp"
#include "linkage_mechanics.hpp"

namespace feltgate::plant {

struct PenPhase {
  enum class Kind {
    kFree,        ///< nothing touches the pen
    kPrescribed,  ///< the pen follows (x, y), m
    kImpedance,   ///< mass, spring, damper behind a grip; the spring's other end follows (x, y), m
    kForce,       ///< the hand applies (x, y), N, starting from 0
  };
  Kind kind = Kind::kFree;
  double duration_s = std::numeric_limits<double>::infinity();  ///< infinite: for good
  Profile x, y;
  Impedance impedance;  ///< the same in both directions
};

struct PenHand {
  std::optional<Vec2> start_m;   ///< the pen at clock 0; default: that of the plant
  std::vector<PenPhase> phases;  ///< empty: free for good; the last one lasts for good
};

/// The phases under way, step by step on the integer clock.
class PenHandRun {
 public:
  /// Without `dynamics` an impedance hand imposes its motion on the pen.
  PenHandRun(PenHand hand, double clock_hz, bool dynamics = true);

  /// Prepares the step of dt_s from clock `now` with the pen here. A phase begins with the first
  /// step at or after its time and takes the pen's place and speed from there.
  void begin_step(Clock now, double dt_s, Vec2 pen_m, Vec2 pen_m_s, LinkageState& state);
  /// Writes the hand's part of a load: force, or mass and target.
  void load(LinkageLoad& load) const;

  /// The first clock after `now` at which the hand begins something else.
  Clock next_corner(Clock now) const;

  PenPhase::Kind kind() const { return kind_; }
  bool imposes() const { return kind_ == PenPhase::Kind::kPrescribed; }
  bool has_mass() const { return kind_ == PenPhase::Kind::kImpedance; }
  /// Where an imposing hand puts the pen at the end of the step.
  Vec2 target_m() const { return target_m_; }
  Vec2 target_m_s() const { return target_m_s_; }

  /// The equilibrium of an impedance hand is here now and moves on at this rate, whatever its
  /// profiles say, until the next call or phase.
  void steer(Vec2 target_m, Vec2 rate_m_s, Clock now);
  /// The caller takes the hand over: `phase` begins with the next step and lasts for good.
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
  Vec2 target_m_, target_m_s_;  ///< m and m/s, or N for a force
  bool steered_ = false;
  Vec2 steered_from_m_, steered_m_s_;
  Clock steered_since_ = 0;
};

}  // namespace feltgate::plant
