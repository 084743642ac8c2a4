// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Starts programs, always with a list of arguments and never through a shell. Documentation:
// docs/json.md
#pragma once

#include <string>
#include <vector>

namespace feltgate::files {

/// Runs words[0], found on the PATH, with the other words as arguments, and waits for its end. Its
/// stdout and stderr are the given descriptors. A signal to this program also ends it. Returns its
/// exit code, or 128 + the signal that ended it. Throws std::runtime_error when it cannot be
/// started.
int run_program(const std::vector<std::string>& words, int stdout_fd = 1, int stderr_fd = 2);

/// Replaces this process by words[0], found on the PATH. Throws std::runtime_error on failure.
[[noreturn]] void become_program(const std::vector<std::string>& words);

}  // namespace feltgate::files
