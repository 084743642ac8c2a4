// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Checks a TOML file before the library parses it: toml++ 3.3 reaches an "unreachable" point at a
// non-ASCII character outside strings and comments. Documentation: docs/testing.md
#pragma once

#include <string_view>

namespace feltgate::config {

/// Line of the first non-ASCII byte outside strings and comments, 0 if there is none. TOML allows
/// only a byte order mark there, at the very beginning.
int stray_line(std::string_view text);

}  // namespace feltgate::config
