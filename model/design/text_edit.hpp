// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Changes of values in the text of a design file, its layout kept. Documentation: docs/designs.md
#pragma once

#include <toml++/toml.h>

#include <optional>
#include <string>

namespace feltgate::design {

class TextEdit {
 public:
  /// Reads the file; `reason` becomes the comment of each value that changes. Throws
  /// config::ConfigError where it is no TOML.
  TextEdit(const std::string& path, std::string reason);

  /// Comment of the changes from here on.
  void because(const std::string& reason) { reason_ = reason; }
  /// Writes `value` (as TOML) in place of the one there; its comment goes with it. Nothing happens
  /// where it is that already. Throws config::ConfigError where the file has no such key.
  void set(const std::string& section, const std::string& key, const std::string& value);
  /// The same, the key renamed.
  void replace(const std::string& section, const std::string& key, const std::string& new_key,
               const std::string& value);
  void set_description(const std::string& text);
  /// What stands under a key, as it is written, or nothing.
  std::optional<std::string> text_of(const std::string& section, const std::string& key) const;

  /// The file without the comments before its first key.
  std::string text() const;

 private:
  const toml::node* find(const std::string& section, const std::string& key) const;
  void parse();

  std::string path_, reason_, text_;
  toml::table root_;
};

/// Where a position of the parser lies in the text.
std::size_t offset_of(const std::string& text, const toml::source_position& at);

/// The text of a file. Throws config::ConfigError where it cannot be read.
std::string text_of_file(const std::string& path);

}  // namespace feltgate::design
