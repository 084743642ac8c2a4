// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Collects the errors of a law file with their places. Documentation: docs/laws.md
#pragma once

#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "law/law.hpp"

namespace feltgate::law {

struct Diagnostic {
  Place place;
  std::string what;  ///< e.g. "unknown name \"postion\""
  std::string mend;  ///< e.g. "did you mean \"position\"?"
};

/// A law file that cannot be used. what() is one line for each diagnostic, in the order of the
/// file: "file:line:column: what; mend".
class LawError : public std::runtime_error {
 public:
  LawError(const std::string& file, std::vector<Diagnostic> all);
  const std::vector<Diagnostic>& diagnostics() const { return diagnostics_; }

 private:
  std::vector<Diagnostic> diagnostics_;
};

/// "file:line:column: what; mend"; '?' replaces unprintable characters. Line 0 means the file as a
/// whole: "file: what; mend".
std::string message(const std::string& file, const Diagnostic& diagnostic);

/// Collects the first twenty errors, one per place.
class Diagnostics {
 public:
  void add(Place place, std::string what, std::string mend);
  bool empty() const { return all_.empty(); }
  std::size_t size() const { return all_.size(); }
  /// In the order of the file.
  std::vector<Diagnostic> sorted() const;

 private:
  std::vector<Diagnostic> all_;
};

/// Converts offsets in a text to lines and columns.
class Places {
 public:
  explicit Places(std::string_view text);
  Place of(std::size_t offset) const;

 private:
  std::vector<std::size_t> line_begins_;
};

}  // namespace feltgate::law
