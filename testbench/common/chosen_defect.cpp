// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Which copy in a block of seeded defects is alive, and which mutant a block is: what the
// environment variables FELTGATE_DEFECT and FELTGATE_MUTANT name. Called by what scripts/defects.py
// and scripts/mutants.py write. Documentation: docs/testing.md
#include <cstdlib>
#include <iostream>
#include <sstream>
#include <string>

/// The place of the chosen name among these. Where one program has several blocks with defects, it
/// names several: the last one that a block has is chosen there.
extern "C" int feltgate_chosen_defect(const char* names) {
  const char* chosen = std::getenv("FELTGATE_DEFECT");
  std::istringstream words(chosen == nullptr ? "" : chosen);
  int found = -1;
  for (std::string word, name; words >> word;) {
    std::istringstream list(names);
    for (int place = 0; list >> name; ++place) found = name == word ? place : found;
  }
  if (found >= 0) return found;
  std::cerr << "FELTGATE_DEFECT must be one of: " << names << std::endl;
  std::abort();
}

/// The number of a mutant, or 0 for the block as it is.
extern "C" int feltgate_chosen_mutant() {
  const char* chosen = std::getenv("FELTGATE_MUTANT");
  return chosen == nullptr ? 0 : std::atoi(chosen);
}
