// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Typed lines. Documentation: docs/calibration.md
#include "apps/commands/host/verbs.hpp"

#include <fmt/format.h>
#include <poll.h>
#include <unistd.h>

#include <stdexcept>

namespace feltgate::host {

namespace {

std::string kept;  // of the line after the one that was asked for

std::optional<std::string> whole_line() {
  const std::size_t end = kept.find('\n');
  if (end == std::string::npos) return {};
  std::string line = kept.substr(0, end);
  kept.erase(0, end + 1);
  if (!line.empty() && line.back() == '\r') line.pop_back();
  return line;
}

}  // namespace

std::optional<std::string> typed_line(const std::string& what, const std::function<bool()>& go_on,
                                      const std::function<void()>& meanwhile) {
  constexpr int wait_ms = 20;
  while (go_on()) {
    if (auto line = whole_line()) return line;
    pollfd p{STDIN_FILENO, POLLIN, 0};
    if (poll(&p, 1, wait_ms) > 0) {
      char text[256];
      const ssize_t size = read(STDIN_FILENO, text, sizeof text);
      if (size <= 0) {
        throw std::invalid_argument(
            fmt::format("the input ended where {} was asked for; type it", what));
      }
      kept.append(text, static_cast<std::size_t>(size));
    }
    meanwhile();
  }
  return {};
}

}  // namespace feltgate::host
