// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Selects the back-ends of a run by the names that a user gives. Documentation:
// docs/speed-for-accuracy.md
#pragma once

#include <string>
#include <vector>

namespace feltgate {

/// The back-ends of a run: one core leads; chains in real arithmetic ride on its sampled counts.
struct BackendChoice {
  std::string lead;                 ///< "rtl", "twin" or "lockstep"
  std::vector<std::string> riders;  ///< "float", "double" and "quad", in the user's order
  bool rider_drives = false;        ///< riders[0] drives the motor instead of the lead

  /// Back-ends that have their own values in a tick, in order. In lock-step the RTL's values are
  /// the twin's; a lead that only carries the riders is not listed.
  std::vector<std::string> names() const;
  /// The most exact back-end, "quad" or "double", with which the others are compared; empty if
  /// none.
  std::string reference() const;
};

/// `engines` is a comma list of rtl, twin, float (binary32), double (binary64) and quad
/// (binary128), or "all" for these five. RTL and twin together run in lock-step; without either,
/// the first one drives the motor. Errors: std::invalid_argument that names the choices.
BackendChoice choose_backends(const std::string& engines);

/// Checks that the riders of a law can know from which run a torque is; the RTL alone does not show
/// it. Errors: std::invalid_argument that names the back-ends that do.
void require_runs_of_law(const BackendChoice& choice);

}  // namespace feltgate
