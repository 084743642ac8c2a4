// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// What every reader of recordings throws. Documentation: docs/traces.md
#include "traces/error.hpp"

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

}  // namespace feltgate::traces
