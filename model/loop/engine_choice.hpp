// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Which engines a run starts, from the names a user gives. Documentation: docs/engines.md
#pragma once

#include <string>
#include <vector>

namespace feltgate {

/// The engines of a run: one core in front, chains of real arithmetic on its sampled counts.
struct EngineChoice {
  std::string lead;                 ///< "rtl", "twin" or "lockstep"
  std::vector<std::string> riders;  ///< "float", "double" and "quad", as they were named
  bool rider_drives = false;        ///< riders[0] drives the motor instead of the lead

  /// Engines that have values of their own in a tick, in order: in lock-step the RTL's are the
  /// twin's, and a lead that only carries the riders is none.
  std::vector<std::string> names() const;
  /// The most exact of several, "quad" or "double", which the others are compared with; or nothing.
  std::string reference() const;
};

/// `engines` is a comma list of rtl, twin, float (binary32), double (binary64) and quad
/// (binary128), or "all" for these five. RTL and twin together run in lock-step; without either the
/// first one drives the motor. Throws std::invalid_argument naming what there is.
EngineChoice choose_engines(const std::string& engines);

/// A law's riders must know of which run a torque is, and the RTL alone does not tell. Throws
/// std::invalid_argument with the engines that do.
void require_runs_of_law(const EngineChoice& choice);

}  // namespace feltgate
