// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// A file that appears whole or not at all, and the outputs of a command together. Documentation:
// docs/json.md
#pragma once

#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include "files/destination.hpp"
#include "files/unfinished.hpp"

namespace feltgate::files {

/// What is written under a name that a user gave. A file, or one that is not there yet, is written
/// beside its name and renamed by commit(), with the mode that it had; without commit(), or when a
/// signal ends the program, nothing has happened. A symbolic link stays, its target is replaced.
/// Devices, pipes and stdout ("-") are written in place.
class OutputFile {
 public:
  /// `option` is how messages call it, e.g. "--json". Throws std::invalid_argument with what and
  /// mend where nothing can be written.
  OutputFile(const std::string& option, const std::string& path);
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  std::FILE* handle() { return file_; }
  /// What goes wrong is told by commit().
  void write(const std::string& text);
  /// For a library that wants a name: it writes the file `named()`. Nothing else may be written.
  /// Throws std::invalid_argument for what is written in place: such a library goes back and forth.
  const std::string& named();
  bool in_place() const { return destination_.in_place >= 0; }
  const Destination& destination() const { return destination_; }
  const std::string& path() const { return path_; }
  /// As the user gave it, with the option.
  std::string label() const { return option_ + " " + path_; }

  /// Throws std::runtime_error when not everything could be written.
  void commit();
  /// As if it had never been asked for.
  void discard();

 private:
  [[noreturn]] void fail(int error);

  std::string option_, path_, part_;
  Destination destination_;
  std::FILE* file_ = nullptr;
  int error_ = 0;  ///< errno of the first write() that failed
  std::unique_ptr<Unfinished> unfinished_, beside_;
};

/// A folder that is made where it is not there; while it is empty, it goes again with this. One for
/// a single run has a file `last` that ends it, and is locked for this program.
class OutputFolder {
 public:
  /// Throws std::invalid_argument where it cannot be made or written, or `last` is not empty and
  /// another program has the folder or a run before has ended in it.
  OutputFolder(const std::string& option, const std::string& path, const std::string& last);
  ~OutputFolder();
  OutputFolder(const OutputFolder&) = delete;
  OutputFolder& operator=(const OutputFolder&) = delete;

 private:
  std::vector<std::string> made_;  ///< by this, the outermost first
  int lock_ = -1;
  std::vector<std::unique_ptr<Unfinished>> unfinished_;
};

/// All outputs of a command, opened before it works: what cannot be written must not cost a run.
class Outputs {
 public:
  /// The output of an option, nullptr where no path is given. Throws std::invalid_argument where it
  /// cannot be written, or would overwrite another output or what reads() named.
  OutputFile* open(const std::string& option, const std::string& path);
  /// A folder for outputs; of a single run with `last`. Nothing where no path is given.
  void folder(const std::string& option, const std::string& path, const std::string& last = "");
  /// A file that the command reads: no output may replace it. Before open().
  void reads(const std::string& path);
  /// Where text for people goes: stdout, or stderr when an output goes to stdout.
  std::FILE* text() const;
  /// Writes it there; whether stdout took everything is looked at when the program ends.
  void say(const std::string& text) const { std::fputs(text.c_str(), this->text()); }
  /// Commits every output; throws std::runtime_error that names those that failed.
  void commit();

 private:
  std::vector<std::unique_ptr<OutputFolder>> folders_;
  std::vector<std::unique_ptr<OutputFile>> files_;
  std::vector<std::pair<std::string, struct stat>> inputs_;
};

}  // namespace feltgate::files
