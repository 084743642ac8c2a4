// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// What every reader of recordings throws. Documentation: docs/traces.md
#include "traces/error.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace feltgate::traces {
namespace {

std::string one_line(std::string text) {
  for (char& c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte < 0x20 || byte == 0x7f) c = '?';
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
