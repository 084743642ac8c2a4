// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The first of a run's faults in words. Documentation: docs/safety.md
#pragma once

#include <cstdio>
#include <map>
#include <string>

#include "felt.hpp"

namespace feltgate {

/// The earliest of these faults, with its time; empty if there is none.
inline std::string first_fault(const std::map<std::string, Acted>& faults) {
  const Acted* first = nullptr;
  std::string text;
  for (const auto& [name, acted] : faults) {
    if (first != nullptr && acted.first_s >= first->first_s) continue;
    first = &acted;
    char at[32];
    std::snprintf(at, sizeof at, " at %.3g s", acted.first_s);
    text = name + at;
  }
  return text;
}

}  // namespace feltgate
