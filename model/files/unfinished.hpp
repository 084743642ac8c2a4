// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// What must not stay behind when a signal ends the program: files under construction, folders that
// are still empty, a program that was started. Documentation: docs/json.md
#pragma once

#include <sys/types.h>

#include <string>

namespace feltgate::files {

/// From now on SIGINT, SIGTERM, SIGHUP and SIGPIPE remove what is unfinished and end the program
/// with 128 + their number (130 for Ctrl-C). One that is ignored, as under nohup, stays ignored.
void end_on_signals();

/// A path that a signal removes as long as this lives: a file, or a folder if it is empty.
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

/// A program that a signal to this one reaches too, and which then is waited for; 0: none.
void note_child(pid_t child);

}  // namespace feltgate::files
