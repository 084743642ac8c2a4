// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// A reader with every fault that fuzzing must find, chosen by the input. Documentation:
// docs/testing.md
#include <fstream>
#include <stdexcept>
#include <vector>

#include "reader_inputs.hpp"

namespace feltgate::fuzz {

Ending use_faulty(const std::filesystem::path& file) {
  std::string fault;
  std::ifstream(file) >> fault;
  Ending ending;
  ending.read = true;
  if (fault == "crash") {
    const std::vector<int> values(fault.size());
    ending.read = values.data()[fault.size()] == 0;  // one beyond the end
  } else if (fault == "hang") {
    for (volatile bool for_ever = true; for_ever;) {
    }
  } else if (fault == "write") {
    std::ofstream("left_behind") << fault;
  } else if (fault == "message") {
    ending = {false, "something is wrong", ""};
  } else if (fault == "throw") {
    throw std::out_of_range("of the reader's own");
  }
  return ending;
}

}  // namespace feltgate::fuzz
