// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Selects the active copy in a block with seeded defects, and the mutant of a block, from the
// environment variables FELTGATE_DEFECT and FELTGATE_MUTANT. The code that scripts/defects.py and
// scripts/mutants.py write calls these functions. Documentation: docs/testing.md
#include <cstdlib>
#include <iostream>
#include <sstream>
#include <string>

/// Returns the index of the chosen name in `names`. A program with several blocks with defects may
/// get several names; a block uses the last one that it has.
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

/// Returns the number of the mutant, or 0 for the unchanged block.
extern "C" int feltgate_chosen_mutant() {
  const char* chosen = std::getenv("FELTGATE_MUTANT");
  return chosen == nullptr ? 0 : std::atoi(chosen);
}
