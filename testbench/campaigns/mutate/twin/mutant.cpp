// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// FELTGATE_MUTANT chooses a mutant; FELTGATE_MUTANTS_REACHED names a file for the numbers of those
// that a run has reached. Documentation: docs/testing.md
#include "mutant.hpp"

#include <cstdio>
#include <cstdlib>

namespace feltgate_mutant {

unsigned char state[FELTGATE_MUTANTS];

namespace {

int chosen = 0;
bool noted[FELTGATE_MUTANTS];

// Before the constructors of other files, and it outlives their destructors.
[[gnu::constructor(101)]] void choose() {
  if (const char* number = std::getenv("FELTGATE_MUTANT")) {
    chosen = std::atoi(number);
    if (chosen > 0 && chosen < FELTGATE_MUTANTS) state[chosen] = 1;
  }
  if (std::getenv("FELTGATE_MUTANTS_REACHED") != nullptr) {
    for (unsigned char& s : state) s = 2;
  }
}

[[gnu::destructor(101)]] void write() {
  const char* name = std::getenv("FELTGATE_MUTANTS_REACHED");
  if (name == nullptr) return;
  std::FILE* file = std::fopen(name, "w");
  if (file == nullptr) return;
  for (int n = 0; n < FELTGATE_MUTANTS; ++n) {
    if (noted[n]) std::fprintf(file, "%d\n", n);
  }
  std::fclose(file);
}

}  // namespace

bool reached(int number) {
  noted[number] = true;
  return number == chosen;
}

}  // namespace feltgate_mutant
