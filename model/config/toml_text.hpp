// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// A look at a TOML file before the library parses it: toml++ 3.3 runs into an unreachable point
// where a letter beyond ASCII stands outside strings and comments. Documentation: docs/testing.md
#pragma once

#include <string_view>

namespace feltgate::config {

/// Line of the first byte beyond ASCII outside strings and comments, 0 where there is none. TOML
/// allows none there but a byte order mark at the very beginning.
int stray_line(std::string_view text);

}  // namespace feltgate::config
