// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Where a name that a user gives for an output leads. Documentation: docs/json.md
#pragma once

#include <sys/stat.h>

#include <optional>
#include <string>

namespace feltgate::files {

/// Where an output goes.
struct Destination {
  /// An open descriptor of what is written in place (stdout, devices, pipes, what a shell opened
  /// as /dev/fd/N), and -1 for a file, which is written beside its name and then renamed.
  int in_place = -1;
  std::string target;                 ///< of a file: where its name leads, symbolic links followed
  std::optional<struct stat> now;     ///< what is there now
  std::optional<struct stat> folder;  ///< of a file: the folder that holds it
  std::string name;                   ///< of a file: its name in that folder

  /// Whether two outputs would overwrite each other; /dev/null takes any number.
  bool same(const Destination& other) const;
  /// Whether what is written here goes where descriptor `fd` goes, other than to /dev/null.
  bool same(int fd) const;
};

/// "-" is stdout. Throws std::invalid_argument with what and mend, beginning with `option`, for a
/// folder, a folder that is not there, a file that is write-protected, and the like.
Destination find_destination(const std::string& option, const std::string& path);

}  // namespace feltgate::files
