// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Writes a fault and its outcome as one line of JSON, and reads such a line. Documentation:
// docs/testing.md
#pragma once

#include <string>

#include "campaigns/faults/pin_faults.hpp"
#include "campaigns/faults/state_faults.hpp"

namespace feltgate::faults {

std::string line_of(const StateResult& result, const std::vector<StateBit>& bits,
                    const std::vector<std::string>& act_names);
std::string line_of(const PinResult& result);

/// A case of a list: a pin fault or a state fault. Throws std::invalid_argument with the reason.
struct CaseLine {
  bool pins = false;
  StateFault state;
  std::size_t kind = 0;
  std::uint64_t seed = 0;
  std::string design;    ///< of a pin fault
  std::string expected;  ///< name of the expected class
};
CaseLine read_case(const std::string& line);

}  // namespace feltgate::faults
