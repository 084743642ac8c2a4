// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Turns the steps of a program into engine instructions: assigns registers and memory addresses and
// adds the last instruction. Documentation: docs/laws.md
#pragma once

#include <string>
#include <vector>

#include "law/law.hpp"
#include "law/program.hpp"
#include "law/target.hpp"

namespace feltgate::law {

struct Assembled {
  std::vector<EngineInstruction> instructions;
  std::vector<int> step_of;        ///< per instruction, its step; -1: starts or copies a state
  std::vector<int> state_address;  ///< private word of each of Program::states
  int private_words = 0;           ///< number of private words used
  int line_base = 512;             ///< first table word of delay lines
};

/// Assembles the program and places its tables in table memory. Throws Refused when words or
/// registers do not suffice.
Assembled assemble(const Law& law, const Target& target, Program& program);

}  // namespace feltgate::law
