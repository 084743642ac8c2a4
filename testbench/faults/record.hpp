// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// A fault and what became of it as one line of JSON, and back. Documentation: docs/verification.md
#pragma once

#include <string>

#include "faults/pin_faults.hpp"
#include "faults/state_faults.hpp"

namespace feltgate::faults {

std::string line_of(const StateResult& result, const std::vector<StateBit>& bits,
                    const std::vector<std::string>& act_names);
std::string line_of(const PinResult& result);

/// A case of a list: either of the two. Throws std::invalid_argument naming what is wrong.
struct CaseLine {
  bool pins = false;
  StateFault state;
  std::size_t kind = 0;
  std::uint64_t seed = 0;
  std::string expected;  ///< class
};
CaseLine read_case(const std::string& line);

}  // namespace feltgate::faults
