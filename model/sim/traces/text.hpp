// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// What every reader of recordings throws; text of bounded memory: bytes, lines and numbers of a
// file, with positions for messages. Documentation: docs/traces.md
#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "feltgate/fixed.hpp"

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

std::string_view trim(std::string_view text);
std::string lower(std::string_view text);

/// A decimal real number, the whole text; NaN and infinities are not numbers.
std::optional<double> parse_real(std::string_view text);

/// A decimal integer from 0 to 2^62, digits only.
std::optional<std::int64_t> parse_count(std::string_view text);

/// A decimal number times 10^power, exactly, rounded half away from zero; |result| < 2^120.
std::optional<int128_t> parse_decimal(std::string_view text, int power);

/// "1 MHz", "500 kHz" or "2000000" in Hz, to 1e12; nothing for 0 and for no whole number of Hz.
std::optional<std::int64_t> parse_rate(std::string_view text);

/// Reads a file byte by byte through one buffer of 64 KiB and counts its lines.
class ByteReader {
 public:
  /// Skips the mark that UTF-8 may begin with. Throws TraceError when the file cannot be opened, is
  /// empty, or is UTF-16.
  explicit ByteReader(const std::filesystem::path& path);

  /// The next byte, or -1 at the end.
  int get() { return at_ < filled_ || refill() ? take() : -1; }

  /// The next line without its end (LF or CR LF); false at the end of the file.
  bool line(std::string& text);

  /// `file:line` of the byte read last.
  std::string where() const;

  [[noreturn]] void fail(const std::string& what, const std::string& mend) const;

 private:
  bool refill();
  int take();

  std::string name_;
  std::ifstream file_;
  std::vector<char> buffer_;
  std::size_t at_ = 0;
  std::size_t filled_ = 0;
  std::int64_t line_ = 1;
  bool line_ended_ = false;
};

}  // namespace feltgate::traces
