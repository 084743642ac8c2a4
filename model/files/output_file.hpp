// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// An output file that appears either complete or not at all, and the set of outputs of a command.
// Documentation: docs/json.md
#pragma once

#include <cstdio>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <sys/stat.h>
#include <sys/types.h>

namespace feltgate::files {

// Cleans up when a signal ends the program: unfinished files, folders that are still empty, a
// started program.

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

// Resolves the name that a user gives for an output.

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

/// An output under a name that a user gave. A file is written under a temporary name; commit()
/// renames it and keeps the old file's mode. Without commit(), or when a signal ends the program,
/// nothing changes. A symbolic link stays and its target is replaced. Devices, pipes and stdout
/// ("-") are written in place.
class OutputFile {
 public:
  /// `option` names the output in messages, e.g. "--json". Throws std::invalid_argument with what
  /// and mend when the output cannot be written.
  OutputFile(const std::string& option, const std::string& path);
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  std::FILE* handle() { return file_; }
  /// Writes `text`; commit() reports errors.
  void write(const std::string& text);
  /// The name of the temporary file, for a library that writes to a named file; do not call write()
  /// then. Throws std::invalid_argument for an output that is written in place, because such a
  /// library seeks.
  const std::string& named();
  bool in_place() const { return destination_.in_place >= 0; }
  const Destination& destination() const { return destination_; }
  const std::string& path() const { return path_; }
  /// The option and the path as the user gave it.
  std::string label() const { return option_ + " " + path_; }

  /// Throws std::runtime_error when not everything could be written.
  void commit();
  /// Drops the output as if it had never been requested.
  void discard();

 private:
  [[noreturn]] void fail(int error);

  std::string option_, path_, part_;
  Destination destination_;
  std::FILE* file_ = nullptr;
  int error_ = 0;  ///< errno of the first write() that failed
  std::unique_ptr<Unfinished> unfinished_, beside_;
};

/// A folder for outputs, created if missing; the destructor removes a created folder that is still
/// empty. A folder for a single run has a final file `last`, and is locked for this program.
class OutputFolder {
 public:
  /// Throws std::invalid_argument when the folder cannot be created or written; and, if `last` is
  /// not empty, when another program uses the folder or an earlier run has ended in it.
  OutputFolder(const std::string& option, const std::string& path, const std::string& last);
  ~OutputFolder();
  OutputFolder(const OutputFolder&) = delete;
  OutputFolder& operator=(const OutputFolder&) = delete;

 private:
  std::vector<std::string> made_;  ///< folders created by this object, the outermost first
  int lock_ = -1;
  std::vector<std::unique_ptr<Unfinished>> unfinished_;
};

/// All outputs of a command. They are opened before the work, so that an output that cannot be
/// written does not waste a run.
class Outputs {
 public:
  /// The output of an option; nullptr without a path. Throws std::invalid_argument when it cannot
  /// be written, or would overwrite another output or a file named by reads().
  OutputFile* open(const std::string& option, const std::string& path);
  /// Adds a folder for outputs; with `last`, a folder for a single run. Does nothing without a
  /// path.
  void folder(const std::string& option, const std::string& path, const std::string& last = "");
  /// Names a file that the command reads; no output may replace it. Call it before open().
  void reads(const std::string& path);
  /// The stream for text to people: stdout, or stderr when an output goes to stdout.
  std::FILE* text() const;
  /// Writes `text` to that stream; the program's end checks that stdout accepted everything.
  void say(const std::string& text) const { std::fputs(text.c_str(), this->text()); }
  /// Commits every output; throws std::runtime_error that names those that failed.
  void commit();

 private:
  std::vector<std::unique_ptr<OutputFolder>> folders_;
  std::vector<std::unique_ptr<OutputFile>> files_;
  std::vector<std::pair<std::string, struct stat>> inputs_;
};

}  // namespace feltgate::files
