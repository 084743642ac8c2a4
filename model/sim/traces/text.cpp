// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Text of bounded memory: bytes, lines and numbers of a file. Documentation: docs/traces.md
#include "sim/traces/text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

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

namespace {

constexpr std::size_t kBuffer = 65536;
constexpr std::size_t kLongestLine = 1U << 20U;
constexpr int kMostPower = 60;

bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n'; }

}  // namespace

std::string_view trim(std::string_view text) {
  while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
  return text;
}

std::string lower(std::string_view text) {
  std::string result(text);
  for (char& c : result) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return result;
}

std::optional<double> parse_real(std::string_view text) {
  if (text.size() > 1 && text.front() == '+' && text[1] != '-') text.remove_prefix(1);
  double value = 0.0;
  const char* const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc() || stop != end || !std::isfinite(value)) return std::nullopt;
  return value;
}

std::optional<std::int64_t> parse_count(std::string_view text) {
  constexpr std::int64_t kMost = std::int64_t{1} << 62U;
  if (text.empty() || !is_digit(text.front())) return std::nullopt;
  std::int64_t value = 0;
  const char* const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc() || stop != end || value > kMost) return std::nullopt;
  return value;
}

std::optional<int128_t> parse_decimal(std::string_view text, int power) {
  constexpr int128_t kFull = static_cast<int128_t>(1'000'000'000'000'000) * 1'000'000'000'000'000;
  constexpr int128_t kMost = int128_t{1} << 120U;
  const bool negative = !text.empty() && text.front() == '-';
  if (!text.empty() && (negative || text.front() == '+')) text.remove_prefix(1);
  int128_t mantissa = 0;
  bool digits = false;
  bool point = false;
  std::size_t i = 0;
  for (; i < text.size() && (is_digit(text[i]) || (text[i] == '.' && !point)); ++i) {
    if (text[i] == '.') {
      point = true;
      continue;
    }
    digits = true;
    // Beyond 30 digits only the place counts: no clock resolves them.
    const bool kept = mantissa < kFull;
    if (kept) mantissa = mantissa * 10 + (text[i] - '0');
    if (point && kept) --power;
    if (!point && !kept) ++power;
  }
  if (!digits) return std::nullopt;
  if (i < text.size() && (text[i] == 'e' || text[i] == 'E')) {
    std::string_view exponent = text.substr(i + 1);
    if (exponent.size() > 1 && exponent.front() == '+' && is_digit(exponent[1])) {
      exponent.remove_prefix(1);
    }
    int value = 0;
    const char* const end = exponent.data() + exponent.size();
    const auto [stop, error] = std::from_chars(exponent.data(), end, value);
    if (error != std::errc() || stop != end || value < -10000 || value > 10000) return std::nullopt;
    power += value;
  } else if (i != text.size()) {
    return std::nullopt;
  }
  if (mantissa == 0 || power < -kMostPower) return int128_t{0};
  for (; power > 0; --power) {
    mantissa *= 10;
    if (mantissa > kMost) return std::nullopt;
  }
  int dropped = 0;
  for (; power < 0; ++power) {
    dropped = static_cast<int>(mantissa % 10);
    mantissa /= 10;
  }
  if (dropped >= 5) ++mantissa;
  return negative ? -mantissa : mantissa;
}

std::optional<std::int64_t> parse_rate(std::string_view text) {
  constexpr int128_t kMost = 1'000'000'000'000;
  std::string low = lower(trim(text));
  if (low.size() >= 2 && low.compare(low.size() - 2, 2, "hz") == 0) low.resize(low.size() - 2);
  low = std::string(trim(low));
  int power = 0;
  const char last = low.empty() ? '0' : low.back();
  if (last == 'k') power = 3;
  if (last == 'm') power = 6;
  if (last == 'g') power = 9;
  if (power > 0) low.pop_back();
  const auto rate = parse_decimal(trim(low), power);
  if (!rate || *rate < 1 || *rate > kMost) return std::nullopt;
  return static_cast<std::int64_t>(*rate);
}

ByteReader::ByteReader(const std::filesystem::path& path) : name_(path.string()), buffer_(kBuffer) {
  std::error_code error;
  if (std::filesystem::is_directory(path, error)) {
    traces::fail(name_, "is a folder", "give one recording");
  }
  file_.open(path, std::ios::binary);
  if (!file_) traces::fail(name_, "cannot be opened", "check the path and the rights");
  if (!refill()) traces::fail(name_, "the file is empty", "give a recording with samples");
  const std::string_view head(buffer_.data(), std::min<std::size_t>(filled_, 3));
  if (head == "\xEF\xBB\xBF") at_ = 3;
  if (head.substr(0, 2) == "\xFF\xFE" || head.substr(0, 2) == "\xFE\xFF") {
    traces::fail(name_, "the text is UTF-16", "save it as UTF-8");
  }
}

bool ByteReader::refill() {
  file_.read(buffer_.data(), static_cast<std::streamsize>(buffer_.size()));
  at_ = 0;
  filled_ = static_cast<std::size_t>(file_.gcount());
  if (file_.bad()) fail("reading stopped with an error", "check the disk");
  return filled_ > 0;
}

int ByteReader::take() {
  if (line_ended_) ++line_;
  const char c = buffer_[at_++];
  line_ended_ = c == '\n';
  return static_cast<unsigned char>(c);
}

bool ByteReader::line(std::string& text) {
  text.clear();
  int c = get();
  if (c < 0) return false;
  for (; c >= 0 && c != '\n'; c = get()) {
    if (text.size() == kLongestLine) fail("a line is longer than 1 MiB", "give a text recording");
    text += static_cast<char>(c);
  }
  if (!text.empty() && text.back() == '\r') text.pop_back();
  return true;
}

std::string ByteReader::where() const { return fmt::format("{}:{}", name_, line_); }

void ByteReader::fail(const std::string& what, const std::string& mend) const {
  traces::fail(where(), what, mend);
}

}  // namespace feltgate::traces
