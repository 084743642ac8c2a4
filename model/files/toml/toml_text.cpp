// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Strings and comments of a TOML file, and what stands between them. Documentation: docs/testing.md
#include "files/toml/toml_text.hpp"

#include <string>

namespace feltgate::config {

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
