// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Starting programs: always with a list of words, never by way of a shell. Documentation:
// docs/json.md
#pragma once

#include <string>
#include <vector>

namespace feltgate::files {

/// Runs words[0], looked up on the PATH, with the other words as they are, and waits for its end.
/// Its stdout and stderr are these descriptors. A signal to this program ends it too. Returns its
/// exit code, or 128 + the signal that ended it. Throws std::runtime_error when it cannot be
/// started.
int run_program(const std::vector<std::string>& words, int stdout_fd = 1, int stderr_fd = 2);

/// This process becomes words[0], looked up on the PATH. Throws std::runtime_error when it cannot.
[[noreturn]] void become_program(const std::vector<std::string>& words);

}  // namespace feltgate::files
