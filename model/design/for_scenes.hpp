// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Reduces a design to the blocks that some scenes need. Documentation: docs/designs.md
#pragma once

#include <set>
#include <string>
#include <vector>

#include "design/registers.hpp"

namespace feltgate::design {

/// Text of the design file `path` with [scenes] include reduced to `laws` (names of scenes in the
/// register map) and "free", in the file's order. `comment` comes first, with # before each line.
/// Throws config::ConfigError when the design does not build one of the laws.
std::string text_for_scenes(const std::string& path, const std::set<std::string>& laws,
                            const std::string& comment);

/// RTL blocks of scenes that a design with these laws does not contain.
std::vector<std::string> blocks_left_out(const std::set<std::string>& laws,
                                         const RegisterMap& registers);

}  // namespace feltgate::design
