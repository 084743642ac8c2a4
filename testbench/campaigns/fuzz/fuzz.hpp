// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The readers that are fuzzed, each as a function of one file. Documentation: docs/testing.md
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace feltgate::fuzz {

/// How a reader ended: with a value, or with an error of its own kind.
struct Ending {
  bool read = false;
  std::string error;    ///< what() where it refused the file
  std::string trouble;  ///< what is wrong with the ending itself; empty: nothing
};

struct Reader {
  const char* name;
  const char* file;  ///< the name that the input gets: readers look at the suffix
  /// Bytes of the input to bytes of the file.
  std::string (*packed)(const std::string& input);
  /// Reads the file and uses what was read, short of running anything. Throws nothing but what is
  /// a finding.
  Ending (*use)(const std::filesystem::path& file);
};

const std::vector<Reader>& readers();

/// Where the plants, designs and the register map of the project lie.
void set_root(const std::filesystem::path& root);

}  // namespace feltgate::fuzz
