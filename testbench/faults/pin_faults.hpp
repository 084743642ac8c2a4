// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Faults at the encoder's pins, at the stop and at the register port, on the core's twin in closed
// loop, beside a sound one on the same lever. Documentation: docs/verification.md
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "faults/outcome.hpp"

namespace feltgate::faults {

/// What docs/safety.md says of a kind of fault.
enum class Promise {
  none,
  flagged,  ///< a fault in >= 99 %
  unseen,   ///< nothing sees it: what is unsafe is reported apart
};

/// A kind of fault: how many of it, and what its row says.
struct PinKind {
  const char* name;
  const char* point;  ///< "pins" or "words"
  const char* about;
  int share;  ///< in hundredths of what --pins asks for
  Promise promise;
};
const std::vector<PinKind>& pin_kinds();

struct PinResult {
  std::size_t kind = 0;
  std::uint64_t seed = 0;  ///< of this fault: the kind and the seed give it again
  std::string what;        ///< scene, speed and so on
  Outcome outcome;
};

/// One fault of a kind.
PinResult run_pin_fault(const std::string& root, std::size_t kind, std::uint64_t seed);

}  // namespace feltgate::faults
