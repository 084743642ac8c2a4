// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Changes values in the text of a design file and keeps its layout. Documentation: docs/designs.md
#pragma once

#include <toml++/toml.h>

#include <optional>
#include <string>

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

}  // namespace feltgate::design
