// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// What was measured, as values of a design file. Documentation: docs/calibration.md
#pragma once

#include <string>
#include <vector>

#include "design/design.hpp"
#include "host/calibrate/closed_loop.hpp"
#include "host/calibrate/open_loop.hpp"

namespace feltgate::host {

/// A key of the design file with its new value.
struct Change {
  std::string section, key;
  double value = 0;
  std::string reason;  ///< becomes the comment
};

/// "0.4197 (0.4172 to 0.4223)"
std::string text_of(const Interval& i);

/// Of a law that models the motor: R and dead voltage; of one in regions R alone, which its
/// estimated current takes, and only where the torque constant was given.
std::vector<Change> changes_of(const OpenLoop& open, const design::Elaborated& design,
                               double torque_constant_nm_a, bool constant_given,
                               std::vector<std::string>* warnings);
std::vector<Change> changes_of(const ClosedLoop& closed, const design::Elaborated& design,
                               std::vector<std::string>* warnings);

/// The text of the design file at `path` with these values, layout kept. Throws config::ConfigError
/// where that is no design that can be built.
std::string changed_design(const std::string& path, const std::string& name,
                           const std::vector<Change>& changes,
                           const design::RegisterMap& registers);

}  // namespace feltgate::host
