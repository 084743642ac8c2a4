// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Resolves the name that a user gives for an output. Documentation: docs/json.md
#pragma once

#include <sys/stat.h>

#include <optional>
#include <string>

namespace feltgate::files {

/// The destination of an output.
struct Destination {
  /// Open descriptor of an output that is written in place (stdout, devices, pipes, a shell's
  /// /dev/fd/N); -1 for a file, which is written under a temporary name and then renamed.
  int in_place = -1;
  std::string target;                 ///< of a file: its path with symbolic links resolved
  std::optional<struct stat> now;     ///< status of the existing file or device
  std::optional<struct stat> folder;  ///< of a file: status of the folder that holds it
  std::string name;                   ///< of a file: its name in that folder

  /// Whether two outputs would overwrite each other; /dev/null takes any number.
  bool same(const Destination& other) const;
  /// Whether this output and descriptor `fd` have the same destination, other than /dev/null.
  bool same(int fd) const;
};

/// Resolves `path`; "-" is stdout. Throws std::invalid_argument "option: what; mend" for a folder,
/// a missing folder, a write-protected file, and similar.
Destination find_destination(const std::string& option, const std::string& path);

}  // namespace feltgate::files
