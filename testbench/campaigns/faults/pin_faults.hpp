// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Faults at the encoder's pins, at the stop and at the register port of lever: the core's twin runs
// in closed loop beside a sound twin on the same lever. And faults at the pins that lever does not
// have: of a current loop, an absolute encoder, three phases, Hall lines. Documentation:
// docs/testing.md
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "campaigns/faults/outcome.hpp"

namespace feltgate::faults {

/// The promise of docs/safety.md for a kind of fault.
enum class Promise {
  none,
  flagged,  ///< a fault in >= 99 %
  unseen,   ///< the core cannot see the fault: unsafe outcomes are reported separately
  refused,  ///< the request to arm is, for good: the gates never open
};

/// A kind of fault: its share of the runs, and the text of its row.
struct PinKind {
  const char* name;
  const char* point;  ///< "pins" or "words"
  const char* about;
  int share;  ///< in hundredths of the number given by --pins
  Promise promise;
  int within_us = 0;  ///< the gates are off by then, where it is flagged; 0: not promised
};
/// Of a design: lever, and those whose options have pins of their own.
const std::vector<PinKind>& pin_kinds(const std::string& design = "lever");

struct PinResult {
  std::size_t kind = 0;
  std::uint64_t seed = 0;  ///< seed of this fault: kind and seed reproduce it
  std::string what;        ///< scene, speed and so on
  Outcome outcome;
  std::string design;
};

/// Runs one fault of a kind.
PinResult run_pin_fault(const std::string& root, std::size_t kind, std::uint64_t seed,
                        const std::string& design = "lever");

/// Names of the designs whose options have pins of their own.
std::vector<std::string> option_designs();
/// Those of one of these designs; none for another.
const std::vector<PinKind>& option_kinds(const std::string& design);

/// Runs one fault. The sound core has a motor and a hand of its own: what it measures is what its
/// gates make.
PinResult run_option_fault(const std::string& root, const std::string& design, std::size_t kind,
                           std::uint64_t seed);

}  // namespace feltgate::faults
