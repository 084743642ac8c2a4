// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Runs a user's design file on a core that is already compiled. The file may differ from that
// core's design only in parameter values. Documentation: docs/page.md
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "design/design.hpp"

namespace feltgate::page {

struct OwnDesign {
  std::string base;  ///< the compiled design with the same formats and times
  std::vector<std::pair<std::string, double>> values;  ///< parameters, quantised, in their units
};

/// Finds the compiled design for `text`. Throws config::ConfigError for an invalid file, and
/// std::invalid_argument when no compiled design has its formats; the message names the differences
/// from the nearest design.
OwnDesign own_design(const std::string& text, const std::vector<std::string>& compiled,
                     const std::string& designs_folder, const std::string& registers);

/// The elaborated design of `text`, or of the file at `path` if `text` is empty.
design::Elaborated elaborated(const std::string& text, const std::string& path,
                              const std::string& registers);

}  // namespace feltgate::page
