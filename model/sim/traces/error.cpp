// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// What every reader of recordings throws. Documentation: docs/traces.md
#include "sim/traces/error.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace feltgate::traces {
namespace {

/// How many bytes from `at` on are one printable character of UTF-8; 0: they are none.
std::size_t character(const std::string& text, std::size_t at) {
  const auto byte = [&](std::size_t n) { return static_cast<unsigned char>(text[n]); };
  const unsigned char first = byte(at);
  if (first < 0x80) return first < 0x20 || first == 0x7f ? 0 : 1;
  const std::size_t length = first < 0xc2   ? 0
                             : first < 0xe0 ? 2
                             : first < 0xf0 ? 3
                             : first < 0xf5 ? 4
                                            : 0;
  if (at + length > text.size()) return 0;
  for (std::size_t n = 1; n < length; ++n) {
    if ((byte(at + n) & 0xc0) != 0x80) return 0;
  }
  return length;
}

/// Names of a file that is none, such as a binary one, must not reach a terminal as they are.
std::string one_line(std::string text) {
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t length = character(text, at);
    if (length == 0) text[at] = '?';
    at += length == 0 ? 1 : length;
  }
  return text;
}

}  // namespace

TraceError::TraceError(const std::string& message) : std::runtime_error(one_line(message)) {}

void fail(const std::string& where, const std::string& what, const std::string& mend) {
  throw TraceError(where + ": " + what + "; " + mend);
}

std::string shown(std::string_view text) {
  constexpr std::size_t kLongest = 40;
  std::string printable;
  for (const char c : text.substr(0, kLongest)) {
    const auto byte = static_cast<unsigned char>(c);
    printable += byte < 0x20 || byte >= 0x7f ? '?' : c;
  }
  return "'" + printable + (text.size() > kLongest ? "...'" : "'");
}

std::string list_names(const std::vector<std::string>& names) {
  constexpr std::size_t kMostShown = 32;
  const auto shown_names = std::min(names.size(), kMostShown);
  std::string text = names.empty() ? "none" : "";
  for (std::size_t i = 0; i < shown_names; ++i) {
    constexpr std::size_t kLongest = 80;
    text += (i == 0 ? "" : ", ") + names[i].substr(0, kLongest);
  }
  if (names.size() > kMostShown) text += fmt::format(" and {} more", names.size() - kMostShown);
  return text;
}

}  // namespace feltgate::traces
