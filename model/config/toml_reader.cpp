// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Strict reading of a TOML table. Documentation: docs/designs.md
#include "config/toml_reader.hpp"

#include <cmath>
#include <sstream>
#include <utility>

namespace feltgate::config {
namespace {

std::string place(const std::string& file, const toml::source_region& source) {
  return file + ":" + std::to_string(source.begin.line) + ": ";
}

std::string printed(double value) {
  std::ostringstream out;
  out << value;
  return out.str();
}

std::string printed(Range range) {
  if (range.min >= 1e-300 && range.min < 1e-200 && range.max >= 1e300) return "greater than 0";
  if (range.min <= -1e300 && range.max >= 1e300) return "finite";
  if (range.max >= 1e300) return "at least " + printed(range.min);
  return "from " + printed(range.min) + " to " + printed(range.max);
}

}  // namespace

toml::table parse_toml_file(const std::string& path) {
  try {
    return toml::parse_file(path);
  } catch (const toml::parse_error& error) {
    const auto line = error.source().begin.line;
    if (line == 0) {
      throw ConfigError(path + ":0: cannot be read; give the path of a readable TOML file");
    }
    throw ConfigError(place(path, error.source()) + "not TOML (" +
                      std::string(error.description()) + "); correct the syntax of this line");
  }
}

TomlReader::TomlReader(const toml::table& table, std::string file, std::string name)
    : table_(&table), file_(std::move(file)), name_(std::move(name)) {}

bool TomlReader::has(const std::string& key) {
  asked_.insert(key);
  return table_->contains(key);
}

int TomlReader::line(const std::string& key) const {
  const toml::node* node = table_->get(key);
  const toml::node& at = node != nullptr ? *node : static_cast<const toml::node&>(*table_);
  return static_cast<int>(at.source().begin.line);
}

void TomlReader::fail(const std::string& key, const std::string& what,
                      const std::string& mend) const {
  throw ConfigError(file_ + ":" + std::to_string(line(key)) + ": " + what + "; " + mend);
}

const toml::node& TomlReader::required(const std::string& key) {
  asked_.insert(key);
  const toml::node* node = table_->get(key);
  if (node == nullptr) fail(key, "key \"" + key + "\" is missing in " + name_, "add it");
  return *node;
}

double TomlReader::checked(const toml::node& node, const std::string& key, Range range) const {
  const auto value = node.value<double>();
  if (!node.is_number() || !value) {
    fail(key, "\"" + key + "\" is not a number", "write a number in the unit that the key names");
  }
  if (!std::isfinite(*value) || *value < range.min || *value > range.max) {
    fail(key, "\"" + key + "\" = " + printed(*value) + " is out of range",
         "it must be " + printed(range));
  }
  return *value;
}

std::int64_t TomlReader::checked(const toml::node& node, const std::string& key, std::int64_t min,
                                 std::int64_t max) const {
  const auto value = node.value<std::int64_t>();
  if (!node.is_integer() || *value < min || *value > max) {
    fail(key, "\"" + key + "\" is not an integer of its range",
         "it must be from " + std::to_string(min) + " to " + std::to_string(max));
  }
  return *value;
}

std::string TomlReader::checked_text(const toml::node& node, const std::string& key) const {
  if (!node.is_string()) fail(key, "\"" + key + "\" is not a text", "write it in quotes");
  return *node.value<std::string>();
}

const toml::array& TomlReader::list(const std::string& key) {
  const toml::array* array = required(key).as_array();
  if (array == nullptr) fail(key, "\"" + key + "\" is not an array", "write [a, b, ...]");
  return *array;
}

double TomlReader::number(const std::string& key, Range range) {
  return checked(required(key), key, range);
}

double TomlReader::number_or(const std::string& key, double fallback, Range range) {
  return has(key) ? number(key, range) : fallback;
}

std::vector<double> TomlReader::numbers(const std::string& key, Range range) {
  std::vector<double> values;
  for (const toml::node& node : list(key)) values.push_back(checked(node, key, range));
  return values;
}

std::int64_t TomlReader::integer(const std::string& key, std::int64_t min, std::int64_t max) {
  return checked(required(key), key, min, max);
}

std::vector<std::int64_t> TomlReader::integers(const std::string& key, std::int64_t min,
                                               std::int64_t max) {
  std::vector<std::int64_t> values;
  for (const toml::node& node : list(key)) values.push_back(checked(node, key, min, max));
  return values;
}

bool TomlReader::flag(const std::string& key) {
  const toml::node& node = required(key);
  if (!node.is_boolean()) fail(key, "\"" + key + "\" is not a flag", "write true or false");
  return *node.value<bool>();
}

bool TomlReader::flag_or(const std::string& key, bool fallback) {
  return has(key) ? flag(key) : fallback;
}

std::string TomlReader::text(const std::string& key) { return checked_text(required(key), key); }

std::vector<std::string> TomlReader::texts(const std::string& key) {
  std::vector<std::string> values;
  for (const toml::node& node : list(key)) values.push_back(checked_text(node, key));
  return values;
}

std::size_t TomlReader::choice(const std::string& key, const std::vector<std::string>& choices) {
  const std::string value = text(key);
  std::string list;
  for (std::size_t i = 0; i < choices.size(); ++i) {
    if (choices[i] == value) return i;
    list += (i == 0 ? "" : ", ") + choices[i];
  }
  fail(key, "\"" + key + "\" = \"" + value + "\" is not known", "it must be one of " + list);
}

TomlReader TomlReader::section(const std::string& key) {
  const toml::table* table = required(key).as_table();
  if (table == nullptr) fail(key, "\"" + key + "\" is not a table", "write [" + key + "]");
  return TomlReader(*table, file_, "[" + key + "]");
}

std::vector<TomlReader> TomlReader::sections(const std::string& key) {
  std::vector<TomlReader> readers;
  if (!has(key)) return readers;
  const toml::array* array = table_->get(key)->as_array();
  if (array == nullptr) fail(key, "\"" + key + "\" is not an array of tables", "write [[...]]");
  for (const toml::node& node : *array) {
    const toml::table* table = node.as_table();
    if (table == nullptr) fail(key, "\"" + key + "\" holds what is no table", "write {...}");
    readers.emplace_back(*table, file_, "\"" + key + "\"");
  }
  return readers;
}

void TomlReader::finish() const {
  for (const auto& [key, node] : *table_) {
    const std::string name(key.str());
    if (asked_.count(name) != 0) continue;
    std::ostringstream text;
    text << place(file_, node.source()) << "key \"" << name << "\" is unknown in " << name_
         << "; remove it or use one of: ";
    const char* comma = "";
    for (const std::string& known : asked_) {
      text << comma << known;
      comma = ", ";
    }
    throw ConfigError(text.str());
  }
}

}  // namespace feltgate::config
