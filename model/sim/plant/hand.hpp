// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// What holds the lever: a list of timed phases. hand_file.cpp reads it from the [hand] table of a
// scene, hand_run.hpp executes it. Documentation: docs/plant.md
#pragma once

#include <limits>
#include <optional>
#include <vector>

#include "profile.hpp"

namespace feltgate::plant {

/// Linear impedance of a hand at the lever, in linear units at the radius of the hand.
/// Defaults: van Beek et al., Scientific Reports 5:18004 (2015), Fig. 3, one trial; grip assumed.
struct Impedance {
  double mass_kg = 0.554;
  double damping_ns_m = 6.45;
  double stiffness_n_m = 135.0;
  double grip_stiffness_n_m = 3000.0;
  double grip_damping_ns_m = 10.0;
};

/// A cord from the lever to ground. Defaults: assumed, stiff enough to settle within milliseconds.
struct Cord {
  double stiffness_nm_rad = 30.0;
  double damping_nm_s_rad = 0.1;
};

/// One phase of a hand.
struct HandPhase {
  enum class Kind {
    kFree,        ///< nothing touches the lever
    kLocked,      ///< the lever stops where it is
    kPrescribed,  ///< the angle follows `profile` (rad)
    kTrace,       ///< the angle follows `trace`, shifted to begin where the lever is
    kImpedance,   ///< `impedance`; its equilibrium angle follows `profile` (rad)
    kCord,        ///< `cord`, unstretched at the angle where the phase begins
    kTorque,      ///< the hand applies `profile` (Nm), starting from 0
  };
  Kind kind = Kind::kFree;
  int line = 0;  ///< line in the scene file; 0: not from a file
  double duration_s = std::numeric_limits<double>::infinity();  ///< infinite: forever
  Profile profile;
  Trace trace;
  Impedance impedance;
  Cord cord;
};

/// A hand at the lever.
struct Hand {
  std::optional<double> start_rad;  ///< angle at clock 0; default: start of a leading trace, or 0
  std::optional<double> radius_m;   ///< where the hand holds; default: that of the plant
  std::vector<HandPhase> phases;    ///< empty: free forever; the last phase lasts forever

  /// Angle of the lever at clock 0, rad.
  double initial_rad() const;
};

}  // namespace feltgate::plant
