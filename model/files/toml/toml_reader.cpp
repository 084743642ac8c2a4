// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Strict reading of a TOML table. Documentation: docs/designs.md
#ifndef TOML_SHARED_LIB  // as pip has it
#define TOML_IMPLEMENTATION
#endif
#include "files/toml/toml_reader.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "feltgate/nearest.hpp"

namespace feltgate::config {
namespace {

std::string place(const std::string& file, const toml::source_region& source) {
  return fmt::format("{}:{}: ", file, source.begin.line);
}

std::string printed(Range range) {
  if (range.min >= 1e-300 && range.min < 1e-200 && range.max >= 1e300) return "greater than 0";
  if (range.min <= -1e300 && range.max >= 1e300) return "a finite number up to 1e300";
  if (range.max >= 1e300) return fmt::format("at least {}", range.min);
  return fmt::format("from {} to {}", range.min, range.max);
}

bool is_control(char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7f; }

/// Names from a file may hold anything; a message is one line that can be printed.
std::string one_line(std::string text) {
  std::replace_if(text.begin(), text.end(), is_control, '?');
  return text;
}

}  // namespace

ConfigError::ConfigError(const std::string& message) : std::runtime_error(one_line(message)) {}

toml::table parse_toml_file(const std::string& path) {
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored)) {
    throw ConfigError(path + ":0: is a folder; give the path of one TOML file");
  }
  std::ifstream in(path, std::ios::binary);
  if (!in) {
    throw ConfigError(path + ":0: cannot be read; give the path of a readable TOML file");
  }
  return parse_toml_text({std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()},
                         path);
}

toml::table parse_toml_text(const std::string& text, const std::string& path) {
  if (const int line = stray_line(text)) {
    throw ConfigError(fmt::format(
        "{}:{}: not TOML (a letter beyond ASCII outside quotation marks); correct this line", path,
        line));
  }
  try {
    return toml::parse(text, path);
  } catch (const toml::parse_error& error) {
    throw ConfigError(fmt::format("{}not TOML ({}); correct the syntax of this line",
                                  place(path, error.source()), error.description()));
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
  throw ConfigError(fmt::format("{}:{}: {}; {}", file_, line(key), what, mend));
}

// What is missing may be there under a misspelt name; or the like name is another key.
std::string TomlReader::how_to_add(const std::string& key) const {
  constexpr std::size_t letters_a_mistake = 3, most_mistakes = 2;
  std::size_t best = std::min(key.size() / letters_a_mistake, most_mistakes) + 1;
  std::string mend = "add it";
  for (const auto& [present, node] : *table_) {
    const std::string name(present.str());
    if (asked_.count(name) != 0 || name.size() > key.size() + most_mistakes) continue;
    const std::size_t mistakes = mistakes_between(name, key);
    if (mistakes >= best) continue;
    best = mistakes;
    mend = fmt::format("add it, or rename \"{}\" in line {} if that was meant", name,
                       node.source().begin.line);
  }
  return mend;
}

const toml::node& TomlReader::required(const std::string& key) {
  asked_.insert(key);
  const toml::node* node = table_->get(key);
  if (node == nullptr)
    fail(key, fmt::format("key \"{}\" is missing in {}", key, name_), how_to_add(key));
  return *node;
}

double TomlReader::checked(const toml::node& node, const std::string& key, Range range) const {
  const auto value = node.value<double>();
  if (!node.is_number() || !value) {
    fail(key, fmt::format("\"{}\" is not a number", key),
         "write a number in the unit that the key names");
  }
  if (!std::isfinite(*value) || *value < range.min || *value > range.max) {
    fail(key, fmt::format("\"{}\" = {} is out of range", key, *value),
         "it must be " + printed(range));
  }
  return *value;
}

std::int64_t TomlReader::checked(const toml::node& node, const std::string& key, std::int64_t min,
                                 std::int64_t max) const {
  const auto* value = node.as_integer();
  if (value == nullptr || value->get() < min || value->get() > max) {
    fail(key, fmt::format("\"{}\" is not an integer of its range", key),
         fmt::format("it must be from {} to {}", min, max));
  }
  return value->get();
}

std::string TomlReader::checked_text(const toml::node& node, const std::string& key) const {
  const auto* value = node.as_string();
  if (value == nullptr) fail(key, fmt::format("\"{}\" is not a text", key), "write it in quotes");
  return value->get();
}

const toml::array& TomlReader::list(const std::string& key) {
  const toml::array* array = required(key).as_array();
  if (array == nullptr) fail(key, fmt::format("\"{}\" is not an array", key), "write [a, b, ...]");
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
  if (!node.is_boolean())
    fail(key, fmt::format("\"{}\" is not a flag", key), "write true or false");
  return *node.value<bool>();
}

bool TomlReader::flag_or(const std::string& key, bool fallback) {
  return has(key) ? flag(key) : fallback;
}

std::string TomlReader::text(const std::string& key) {
  // Texts go into comments, names and tables, where a second line would mean something else.
  const std::string value = checked_text(required(key), key);
  if (std::none_of(value.begin(), value.end(), is_control)) return value;
  fail(key, fmt::format("\"{}\" holds a line break or another control character", key),
       "write it in one line");
}

std::string TomlReader::paragraph(const std::string& key) {
  const std::string value = checked_text(required(key), key);
  const auto bad = [](char c) { return is_control(c) && c != '\n' && c != '\r' && c != '\t'; };
  if (std::none_of(value.begin(), value.end(), bad)) return value;
  fail(key, fmt::format("\"{}\" holds a control character", key), "write plain text");
}

std::string TomlReader::identifier(const std::string& key) {
  const std::string name = text(key);
  const bool good = !name.empty() && name[0] >= 'a' && name[0] <= 'z' &&
                    std::all_of(name.begin(), name.end(), [](char c) {
                      return c == '_' || (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9');
                    });
  if (good) return name;
  fail(key, fmt::format("\"{}\" = \"{}\" is no name of a program's variable", key, name),
       "use a to z, 0 to 9 and _, a letter first");
}

std::vector<std::string> TomlReader::texts(const std::string& key) {
  std::vector<std::string> values;
  for (const toml::node& node : list(key)) values.push_back(checked_text(node, key));
  return values;
}

std::size_t TomlReader::choice(const std::string& key, const std::vector<std::string>& choices) {
  const std::string value = text(key);
  const auto found = std::find(choices.begin(), choices.end(), value);
  if (found != choices.end()) return static_cast<std::size_t>(found - choices.begin());
  fail(key, fmt::format("\"{}\" = \"{}\" is not known", key, value),
       fmt::format("{}it must be one of {}", did_you_mean(value, choices),
                   fmt::join(choices, ", ")));
}

TomlReader TomlReader::section(const std::string& key) {
  const toml::table* table = required(key).as_table();
  if (table == nullptr) {
    fail(key, fmt::format("\"{}\" is not a table", key), fmt::format("write [{}]", key));
  }
  return TomlReader(*table, file_, "[" + key + "]");
}

std::vector<TomlReader> TomlReader::sections(const std::string& key) {
  std::vector<TomlReader> readers;
  if (!has(key)) return readers;
  const toml::array* array = table_->get(key)->as_array();
  if (array == nullptr) {
    fail(key, fmt::format("\"{}\" is not an array of tables", key), "write [[...]]");
  }
  for (const toml::node& node : *array) {
    const toml::table* table = node.as_table();
    if (table == nullptr) {
      fail(key, fmt::format("\"{}\" holds what is no table", key), "write {...}");
    }
    readers.emplace_back(*table, file_, "\"" + key + "\"");
  }
  return readers;
}

void TomlReader::finish() const {
  for (const auto& [key, node] : *table_) {
    const std::string name(key.str());
    if (asked_.count(name) != 0) continue;
    throw ConfigError(fmt::format("{}key \"{}\" is unknown in {}; {}remove it or use one of: {}",
                                  place(file_, node.source()), name, name_,
                                  did_you_mean(name, asked_), fmt::join(asked_, ", ")));
  }
}

// Strings and comments of a TOML file, and what stands between them.

namespace {

/// The end of the string that begins at `at`; one of a single line ends with its line at the
/// latest.
std::size_t end_of_string(std::string_view text, std::size_t at) {
  const char quote = text[at];
  const std::string three(3, quote);
  const bool is_long = text.substr(at, 3) == three;
  at += is_long ? 3 : 1;
  while (at < text.size()) {
    if (quote == '"' && text[at] == '\\') {
      at += 2;
    } else if (is_long ? text.substr(at, 3) == three : text[at] == quote) {
      at += is_long ? 3 : 1;
      while (is_long && at < text.size() && text[at] == quote) ++at;
      return at;
    } else if (!is_long && text[at] == '\n') {
      return at;
    } else {
      ++at;
    }
  }
  return text.size();
}

}  // namespace

int stray_line(std::string_view text) {
  std::size_t at = text.substr(0, 3) == "\xef\xbb\xbf" ? 3 : 0;
  const auto line = [&text](std::size_t end) {
    int n = 1;
    for (const char c : text.substr(0, end)) n += c == '\n' ? 1 : 0;
    return n;
  };
  while (at < text.size()) {
    if (text[at] == '#') {
      at = text.find('\n', at);
      if (at == std::string_view::npos) return 0;
    } else if (text[at] == '"' || text[at] == '\'') {
      at = end_of_string(text, at);
    } else if (static_cast<unsigned char>(text[at]) >= 0x80) {
      return line(at);
    } else {
      ++at;
    }
  }
  return 0;
}

}  // namespace feltgate::config
