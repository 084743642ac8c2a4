// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Reads a TOML table strictly: the caller requests every key by name with its range, a key that was
// not requested is an error, and every error gives file, line, what is wrong and the mend.
// Documentation: docs/designs.md
#pragma once

#include <cstdint>
#include <set>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#define TOML_HEADER_ONLY 0        // compiled once, in toml_reader.cpp
#define TOML_ENABLE_FORMATTERS 0  // nothing writes TOML by them
#include <toml++/toml.h>

namespace feltgate::config {

/// A file that cannot be used; what() reads "file:line: what; mend".
class ConfigError : public std::runtime_error {
 public:
  /// Control characters in the message are shown as '?', so that it stays one line.
  explicit ConfigError(const std::string& message);
};

/// Closed interval of admissible values, in the unit of the key.
struct Range {
  double min;
  double max;
};

inline constexpr Range kAnyNumber{-1e300, 1e300};
inline constexpr Range kPositive{1e-300, 1e300};
inline constexpr Range kNotNegative{0.0, 1e300};

/// Parses a whole file. Errors: ConfigError when it cannot be opened or is not TOML.
toml::table parse_toml_file(const std::string& path);
/// The same for a text; errors name it `path`.
toml::table parse_toml_text(const std::string& text, const std::string& path);

/// One table of a file. It keeps a reference: the parsed file must outlive it.
class TomlReader {
 public:
  /// `name` is the table's name in errors, e.g. "[motor]".
  TomlReader(const toml::table& table, std::string file, std::string name);

  /// Whether the table holds `key`; asking makes it a known key.
  bool has(const std::string& key);
  /// Numbers may be written as integers; NaN and infinities are errors.
  double number(const std::string& key, Range range);
  double number_or(const std::string& key, double fallback, Range range);
  std::vector<double> numbers(const std::string& key, Range range);
  std::int64_t integer(const std::string& key, std::int64_t min, std::int64_t max);
  std::vector<std::int64_t> integers(const std::string& key, std::int64_t min, std::int64_t max);
  bool flag(const std::string& key);
  bool flag_or(const std::string& key, bool fallback);
  /// One line: control characters are an error.
  std::string text(const std::string& key);
  /// A text of several lines.
  std::string paragraph(const std::string& key);
  /// A text that is an identifier in generated code: a to z, 0 to 9 and _, a letter first.
  std::string identifier(const std::string& key);
  std::vector<std::string> texts(const std::string& key);
  /// Index of the text under `key` in `choices`; the error lists them.
  std::size_t choice(const std::string& key, const std::vector<std::string>& choices);
  TomlReader section(const std::string& key);
  /// An array of tables ([[a.b]] or inline); empty when the key is missing.
  std::vector<TomlReader> sections(const std::string& key);

  /// Checks that every key was requested. Throws ConfigError for the first one that was not.
  void finish() const;
  /// Throws ConfigError at the line of `key`, or of the table when the key is missing.
  [[noreturn]] void fail(const std::string& key, const std::string& what,
                         const std::string& mend) const;
  const std::string& file() const { return file_; }
  /// Line of `key`, or of the table when the key is missing.
  int line(const std::string& key) const;

 private:
  const toml::node& required(const std::string& key);
  std::string how_to_add(const std::string& key) const;
  const toml::array& list(const std::string& key);
  double checked(const toml::node& node, const std::string& key, Range range) const;
  std::int64_t checked(const toml::node& node, const std::string& key, std::int64_t min,
                       std::int64_t max) const;
  std::string checked_text(const toml::node& node, const std::string& key) const;

  const toml::table* table_;
  std::string file_;
  std::string name_;
  std::set<std::string> asked_;
};

// Checks a TOML file before the library parses it: toml++ 3.3 reaches an "unreachable" point at a
// non-ASCII character outside strings and comments.

/// Line of the first non-ASCII byte outside strings and comments, 0 if there is none. TOML allows
/// only a byte order mark there, at the very beginning.
int stray_line(std::string_view text);

}  // namespace feltgate::config
