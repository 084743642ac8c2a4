// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The first of a run's faults in words. Documentation: docs/safety.md
#include "first_fault.hpp"

#include <fmt/core.h>

namespace feltgate {

std::string first_fault(const std::map<std::string, Acted>& faults) {
  const Acted* first = nullptr;
  std::string text;
  for (const auto& [name, acted] : faults) {
    if (first != nullptr && acted.first_s >= first->first_s) continue;
    first = &acted;
    text = fmt::format("{} at {:.3g} s", name, acted.first_s);
  }
  return text;
}

}  // namespace feltgate
