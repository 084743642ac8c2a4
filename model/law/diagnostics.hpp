// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// What is wrong in a law file, and where. Documentation: docs/laws.md
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

/// "file:line:column: what; mend", with '?' for what cannot be printed. Line 0: of the file as a
/// whole, "file: what; mend".
std::string message(const std::string& file, const Diagnostic& diagnostic);

/// Collects what is wrong: each place once, the first twenty.
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

/// Offsets in a text as lines and columns.
class Places {
 public:
  explicit Places(std::string_view text);
  Place of(std::size_t offset) const;

 private:
  std::vector<std::size_t> line_begins_;
};

}  // namespace feltgate::law
