// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Changes values in the text of a design file and keeps its layout. Documentation: docs/designs.md
#pragma once

#include <optional>
#include <string>

#include "files/toml/toml_reader.hpp"

namespace feltgate::design {

class TextEdit {
 public:
  /// Reads the file; `reason` becomes the comment of each changed value. Throws config::ConfigError
  /// when the file is not TOML.
  TextEdit(const std::string& path, std::string reason);

  /// Sets the comment of the following changes.
  void because(const std::string& reason) { reason_ = reason; }
  /// Replaces a value and its comment by `value` (as TOML). An equal value is left unchanged.
  /// Throws config::ConfigError when the file has no such key.
  void set(const std::string& section, const std::string& key, const std::string& value);
  /// The same, and renames the key.
  void replace(const std::string& section, const std::string& key, const std::string& new_key,
               const std::string& value);
  void set_description(const std::string& text);
  /// Puts one line of comment in the place of a section.
  void leave_out(const std::string& section, const std::string& why);
  /// The value of a key as written, or nothing.
  std::optional<std::string> text_of(const std::string& section, const std::string& key) const;

  /// The file without the comments before its first key.
  std::string text() const;

 private:
  const toml::node* find(const std::string& section, const std::string& key) const;
  void parse();

  std::string path_, reason_, text_;
  toml::table root_;
};

/// Offset in the text of a position of the parser.
std::size_t offset_of(const std::string& text, const toml::source_position& at);

/// The text of a file. Throws config::ConfigError when the file cannot be read.
std::string text_of_file(const std::string& path);

// Converts names and numbers to the forms used in generated files.

/// Converts a_name to A_NAME.
std::string upper(std::string name);
/// Converts a_name or a-name to AName.
std::string camel(const std::string& name);
/// A double as a C literal that keeps every bit.
std::string real_literal(double v);
/// The licence and "Generated from SOURCES by `feltgate generate`: do not edit. WHAT".
std::string generated_banner(const std::string& sources, const std::string& what);

}  // namespace feltgate::design
