// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Reads a TOML table key by key: a missing, mistyped, out-of-range or unknown key becomes one line
// with file, line and the mend.
#pragma once

#include <toml++/toml.h>

#include <set>
#include <string>

#include "design/design.hpp"

namespace feltgate::design {

/// Parses a file. Throws DesignError when it cannot be opened or is not TOML.
inline toml::table parse_toml(const std::string& path) {
  try {
    return toml::parse_file(path);
  } catch (const toml::parse_error& e) {
    throw DesignError(path + ":" + std::to_string(e.source().begin.line) + ": " +
                      std::string(e.description()) + "; mend the TOML syntax there");
  }
}

/// One table of a file; remembers which keys were asked for, so that the rest can be refused.
class TomlReader {
 public:
  TomlReader(std::string path, std::string name, const toml::table& table)
      : path_(std::move(path)), name_(std::move(name)), table_(table) {}

  [[noreturn]] void fail(const std::string& key, const std::string& what) const {
    const toml::node* node = table_.get(key);
    const auto line = (node != nullptr ? node->source() : table_.source()).begin.line;
    throw DesignError(path_ + ":" + std::to_string(line) + ": " + what);
  }

  bool has(const std::string& key) const { return table_.contains(key); }

  double number(const std::string& key, double low, double high) {
    const auto value = node(key).value<double>();
    if (!value) fail(key, label(key) + " is not a number; write one");
    if (!(*value >= low && *value <= high)) {
      fail(key, label(key) + " = " + short_text(*value) + " is out of range; choose " +
                    short_text(low) + " to " + short_text(high));
    }
    return *value;
  }

  std::int64_t integer(const std::string& key, std::int64_t low, std::int64_t high) {
    const auto value = node(key).value_exact<std::int64_t>();
    if (!value) fail(key, label(key) + " is not an integer; write one without a point");
    if (*value < low || *value > high) {
      fail(key, label(key) + " = " + std::to_string(*value) + " is out of range; choose " +
                    std::to_string(low) + " to " + std::to_string(high));
    }
    return *value;
  }

  std::string text(const std::string& key) {
    const auto value = node(key).value<std::string>();
    if (!value) fail(key, label(key) + " is not a string; put it in quotes");
    return *value;
  }

  std::string text_or(const std::string& key, const std::string& fallback) {
    return has(key) ? text(key) : fallback;
  }

  /// A nested table; missing is an error.
  const toml::table& table(const std::string& key) {
    const toml::table* t = node(key).as_table();
    if (t == nullptr) fail(key, label(key) + " is not a table; write [" + key + "]");
    return *t;
  }

  const toml::array& array(const std::string& key) {
    const toml::array* a = node(key).as_array();
    if (a == nullptr) fail(key, label(key) + " is not a list; write [ ... ]");
    return *a;
  }

  /// Refuses every key that nobody asked for.
  void finish() const {
    for (const auto& [key, value] : table_) {
      const std::string k(key.str());
      if (asked_.count(k) == 0) fail(k, label(k) + " is not a known key; check its spelling");
    }
  }

 private:
  const toml::node& node(const std::string& key) {
    asked_.insert(key);
    const toml::node* n = table_.get(key);
    if (n == nullptr) fail(key, label(key) + " is missing; add it");
    return *n;
  }
  std::string label(const std::string& key) const {
    return name_.empty() ? key : name_ + "." + key;
  }
  static std::string short_text(double v) {
    std::string s = std::to_string(v);
    while (s.find('.') != std::string::npos && (s.back() == '0' || s.back() == '.')) {
      const bool point = s.back() == '.';
      s.pop_back();
      if (point) break;
    }
    return s;
  }

  std::string path_, name_;
  const toml::table& table_;
  std::set<std::string> asked_;
};

}  // namespace feltgate::design
