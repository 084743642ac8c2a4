// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// A design file of the user on a core that is already compiled: it runs there when it differs from
// that core's design in parameter values only. Documentation: docs/page.md
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

/// Throws config::ConfigError for a file that is none, std::invalid_argument where no compiled
/// design has its formats: it says what differs from the nearest.
OwnDesign own_design(const std::string& text, const std::vector<std::string>& compiled,
                     const std::string& designs_folder, const std::string& registers);

/// The design of `text`, or of the file at `path` where the text is empty.
design::Elaborated elaborated(const std::string& text, const std::string& path,
                              const std::string& registers);

}  // namespace feltgate::page
