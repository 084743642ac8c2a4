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

void SigrokCapture::parse_metadata(const std::string& text, std::int64_t given_hz) {
  const std::string at = path_ + ":metadata";
  const auto keys = device_section(text);
  const auto value = [&](const std::string& key) {
    const auto found = keys.find(key);
    return found == keys.end() ? std::string() : found->second;
  };

  // A rate that the caller gives stands in for one that is wrong, 0 or not there at all.
  const std::string rate = value("samplerate");
  sample_hz_ = given_hz > 0 ? given_hz : parse_rate(rate).value_or(0);
  if (sample_hz_ == 0) {
    fail(at,
         rate.empty() ? "the recording has no samplerate"
                      : "samplerate " + shown(rate) + " is not a rate",
         "give the rate of the samples in Hz (--sample-hz)");
  }

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
