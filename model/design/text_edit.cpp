// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Changes values in the text of a design file. Documentation: docs/designs.md
#include "design/text_edit.hpp"

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <fstream>
#include <iterator>

#include <fmt/format.h>

#include "files/toml/toml_reader.hpp"

namespace feltgate::design {

namespace {

/// Whether two written values are the same number or the same text.
bool same_value(const std::string& a, const std::string& b) {
  if (a == b) return true;
  std::string digits;
  for (const char c : a) {
    if (c != '_') digits += c;
  }
  char* end = nullptr;
  const double x = std::strtod(digits.c_str(), &end);
  if (end == digits.c_str() || *end != '\0') return false;
  const double y = std::strtod(b.c_str(), &end);
  return end != b.c_str() && *end == '\0' && x == y;
}

}  // namespace

std::size_t offset_of(const std::string& text, const toml::source_position& at) {
  std::size_t offset = 0;
  for (auto line = at.line; line > 1; --line) offset = text.find('\n', offset) + 1;
  return offset + at.column - 1;
}

std::string text_of_file(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  if (!in) throw config::ConfigError(path + ":0: cannot be read; check the path");
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

TextEdit::TextEdit(const std::string& path, std::string reason)
    : path_(path), reason_(std::move(reason)), text_(text_of_file(path)) {
  (void)config::parse_toml_file(path);  // complains as every reader does
  parse();
}

void TextEdit::parse() { root_ = toml::parse(text_); }

const toml::node* TextEdit::find(const std::string& section, const std::string& key) const {
  return section.empty() ? root_[key].node() : root_[section][key].node();
}

std::optional<std::string> TextEdit::text_of(const std::string& section,
                                             const std::string& key) const {
  const toml::node* node = find(section, key);
  if (node == nullptr) return {};
  const std::size_t begin = offset_of(text_, node->source().begin);
  return text_.substr(begin, offset_of(text_, node->source().end) - begin);
}

void TextEdit::set(const std::string& section, const std::string& key, const std::string& value) {
  const auto old = text_of(section, key);
  if (!old) {
    throw config::ConfigError(
        fmt::format("{}:0: [{}] has no key \"{}\"; add it", path_, section, key));
  }
  if (same_value(*old, value)) return;
  const std::size_t begin = offset_of(text_, find(section, key)->source().begin);
  const std::size_t end = text_.find('\n', begin + old->size());
  text_.replace(begin, end - begin, fmt::format("{}  # {}", value, reason_));
  parse();
}

void TextEdit::replace(const std::string& section, const std::string& key,
                       const std::string& new_key, const std::string& value) {
  set(section, key, value);
  const std::size_t at = offset_of(text_, find(section, key)->source().begin);
  const std::size_t line = text_.rfind('\n', at) + 1;
  text_.replace(text_.find(key, line), key.size(), new_key);
  parse();
}

void TextEdit::set_description(const std::string& text) {
  const std::string old = *text_of("", "description");
  const std::size_t begin = offset_of(text_, find("", "description")->source().begin);
  text_.replace(begin, old.size(), "\"" + text + "\"");
  parse();
}

void TextEdit::leave_out(const std::string& section, const std::string& why) {
  const toml::node* node = root_[section].node();
  if (node == nullptr) return;
  const std::size_t begin = text_.rfind('\n', offset_of(text_, node->source().begin)) + 1;
  const std::size_t end = std::min(text_.find("\n[", begin), text_.size());
  text_.replace(begin, end - begin, fmt::format("# [{}] is left out: {}\n", section, why));
  parse();
}

std::string TextEdit::text() const {
  std::size_t begin = 0;
  while (begin < text_.size() && (text_[begin] == '#' || text_[begin] == '\n')) {
    begin = text_.find('\n', begin) + 1;
  }
  return text_.substr(begin);
}

// Makes names and heads of the generated files.

std::string upper(std::string name) {
  std::transform(name.begin(), name.end(), name.begin(),
                 [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  return name;
}

std::string camel(const std::string& name) {
  std::string out;
  bool start = true;
  for (char c : name) {
    if (c == '_' || c == '-') {
      start = true;
    } else {
      out += start ? static_cast<char>(std::toupper(static_cast<unsigned char>(c))) : c;
      start = false;
    }
  }
  return out;
}

std::string real_literal(double v) {
  std::string s = fmt::format("{:.17g}", v);
  if (s.find_first_of(".en") == std::string::npos) s += ".0";
  return s;
}

std::string generated_banner(const std::string& sources, const std::string& what) {
  return "// SPDX-License-Identifier: Apache-2.0\n"
         "// SPDX-FileCopyrightText: 2026 the feltgate authors\n//\n// Generated from " +
         sources + " by\n// `feltgate generate`: do not edit." + (what.empty() ? "" : " ") + what +
         "\n";
}

}  // namespace feltgate::design
