// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Reports of lock-step runs, compiled once for all benches. Documentation: docs/testing.md
#include "mismatch.hpp"

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <sstream>
#include <stdexcept>

#include "catch.hpp"

namespace feltgate::test {

bool waveform_wanted() { return std::getenv("FELTGATE_MUTANT") == nullptr; }

std::string mismatch_file(const char* block) {
  const char* asked = std::getenv("FELTGATE_MISMATCH_DIR");
  const std::filesystem::path directory =
      asked != nullptr ? asked : std::filesystem::path(FELTGATE_BUILD_DIR) / "mismatch";
  std::filesystem::create_directories(directory);
  return (directory / (std::string(block) + ".fst")).string();
}

void fail_with(const char* block, std::uint64_t seed, const Mismatch& mismatch,
               const std::string& waveform) {
  std::ostringstream text;
  if (mismatch.is_property) {
    text << block << ": mismatch with a property at clock " << mismatch.cycle << ": "
         << mismatch.signal;
  } else {
    text << block << ": mismatch at clock " << mismatch.cycle << ", signal " << mismatch.signal
         << ' ' << mismatch.instant << ": RTL " << mismatch.rtl << ", twin " << mismatch.twin;
  }
  text << " (seed " << seed << ")";
  if (!waveform.empty()) {
    text << "\nwaveform: " << waveform << " (clock c rises at 20 c + 10 ns)";
  }
  const std::filesystem::path save = std::filesystem::path(FELTGATE_SOURCE_DIR) / "scripts" /
                                     "gtkwave" / (std::string(block) + ".gtkw");
  if (!waveform.empty() && std::filesystem::exists(save)) {
    text << "\nview: gtkwave " << waveform << ' ' << save.string();
  }
  // Catch breaks lines at 80 columns, but a user must be able to search and copy these lines.
  std::cerr << text.str() << std::endl;
  FAIL(text.str());
  throw std::logic_error("FAIL returned");
}

std::int64_t scaled_clocks(std::int64_t n) {
  const char* factor = std::getenv("FELTGATE_LONG");
  if (factor == nullptr) return n;
  const long long times = std::strtoll(factor, nullptr, 10);
  return times > 1 ? n * times : n;
}

bool defects_run() { return std::getenv("FELTGATE_DEFECT") != nullptr; }

std::uint64_t seeds_of(std::uint64_t n) {
  return defects_run() && !whole_run() ? std::max<std::uint64_t>(1, n / 2) : n;
}

bool whole_run() { return std::getenv("FELTGATE_WHOLE") != nullptr; }

std::uint64_t share_of_week(std::uint64_t shares) {
  constexpr std::chrono::hours kWeek(24 * 7);
  const char* week = std::getenv("FELTGATE_WEEK");
  if (week != nullptr) return std::stoull(week) % shares;
  const auto since_1970 = std::chrono::system_clock::now().time_since_epoch();
  return static_cast<std::uint64_t>(since_1970 / kWeek) % shares;
}

bool tried(std::uint64_t k, std::uint64_t shares) {
  return whole_run() || k % shares == share_of_week(shares);
}

bool case_tried(std::uint64_t k, std::uint64_t shares) {
  if (tried(k, shares)) return true;
  WARN("in another week, or with --whole");
  return false;
}

}  // namespace feltgate::test
