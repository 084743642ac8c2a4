// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Cleans up when a signal ends the program: unfinished files, folders that are still empty, a
// started program. Documentation: docs/json.md
#pragma once

#include <sys/types.h>

#include <string>

namespace feltgate::files {

/// Installs handlers: SIGINT, SIGTERM, SIGHUP and SIGPIPE remove unfinished paths and end the
/// program with 128 + their number (130 for Ctrl-C). A signal that is ignored, as under nohup,
/// stays ignored.
void end_on_signals();

/// A path that a signal removes during this object's lifetime: a file, or a folder if it is empty.
class Unfinished {
 public:
  enum class Kind { file, folder };
  /// Throws std::runtime_error when there are more than 32, or for a path of 4096 bytes or more.
  Unfinished(const std::string& path, Kind kind);
  ~Unfinished();
  Unfinished(const Unfinished&) = delete;
  Unfinished& operator=(const Unfinished&) = delete;

 private:
  int slot_;
};

/// Names a started program: a signal to this program is passed to it and its end is awaited; 0:
/// none.
void note_child(pid_t child);

}  // namespace feltgate::files
