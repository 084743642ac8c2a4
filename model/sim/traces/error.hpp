// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The error that every reader of recordings throws. Documentation: docs/traces.md
#pragma once

#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace feltgate::traces {

/// A recording that cannot be read. what() is one line: `file:position: what is wrong; mend`.
class TraceError : public std::runtime_error {
 public:
  /// Control characters in the message are shown as '?', so that it stays one line.
  explicit TraceError(const std::string& message);
};

/// Throws TraceError("where: what; mend").
[[noreturn]] void fail(const std::string& where, const std::string& what, const std::string& mend);

/// The text in single quotes, cut after 40 bytes, safe to print whatever a broken file holds.
std::string shown(std::string_view text);

/// The names as one text for messages, the first 32 of them.
std::string list_names(const std::vector<std::string>& names);

}  // namespace feltgate::traces
