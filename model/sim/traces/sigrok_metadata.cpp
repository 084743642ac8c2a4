// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// sigrok session files: the `metadata` entry, an INI text with the rate and the probes.
// Documentation: docs/traces.md
#include <fmt/format.h>

#include <map>

#include "sim/traces/error.hpp"
#include "sim/traces/sigrok.hpp"
#include "sim/traces/text.hpp"

namespace feltgate::traces {
namespace {

constexpr std::int64_t kMostUnitSize = 64;

/// "1 MHz", "500 kHz" or "2000000" in Hz; nothing for 0 and for what is not a whole number of Hz.
std::optional<std::int64_t> parse_rate(const std::string& text) {
  constexpr int128_t kMost = 1'000'000'000'000;
  std::string low = lower(text);
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

/// Keys of the first [device ...] section, in small letters.
std::map<std::string, std::string> device_section(std::string_view text) {
  std::map<std::string, std::string> keys;
  bool inside = false;
  while (!text.empty()) {
    const std::size_t end = text.find('\n');
    const std::string_view line = trim(text.substr(0, end));
    text = end == std::string_view::npos ? std::string_view{} : text.substr(end + 1);
    if (!line.empty() && line.front() == '[') {
      if (inside) break;
      inside = line.compare(0, 7, "[device") == 0;
      continue;
    }
    const std::size_t equals = line.find('=');
    if (!inside || equals == std::string_view::npos) continue;
    keys[lower(trim(line.substr(0, equals)))] = std::string(trim(line.substr(equals + 1)));
  }
  return keys;
}

}  // namespace

void SigrokCapture::parse_metadata(const std::string& text) {
  const std::string at = path_ + ":metadata";
  const auto keys = device_section(text);
  const auto value = [&](const std::string& key) {
    const auto found = keys.find(key);
    return found == keys.end() ? std::string() : found->second;
  };

  const std::optional<std::int64_t> rate = parse_rate(value("samplerate"));
  if (!rate) {
    fail(at, "samplerate " + shown(value("samplerate")) + " is not a rate", "give 1 Hz to 1 THz");
  }
  sample_hz_ = *rate;

  const auto unit_size = parse_count(keys.count("unitsize") != 0 ? value("unitsize") : "1");
  if (!unit_size || *unit_size < 1 || *unit_size > kMostUnitSize) {
    fail(at, "unitsize " + shown(value("unitsize")) + " is not a size", "give 1 to 64 bytes");
  }
  unit_size_ = static_cast<std::size_t>(*unit_size);

  if (!value("capturefile").empty()) capture_file_ = value("capturefile");

  for (std::size_t bit = 0; bit < unit_size_ * 8; ++bit) {
    const std::string name = value(fmt::format("probe{}", bit + 1));
    if (name.empty()) continue;
    names_.push_back(name);
    bits_.push_back(bit);
  }
  if (names_.empty()) fail(at, "no probe of the recording has a name", "give a logic recording");
}

}  // namespace feltgate::traces
