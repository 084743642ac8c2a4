// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Steps become program words: registers, addresses, the last instruction. Documentation:
// docs/law-compiler.md
#pragma once

#include <string>
#include <vector>

#include "law/law.hpp"
#include "law/program.hpp"
#include "law/target.hpp"

namespace feltgate::law {

struct Assembled {
  std::vector<EngineInstruction> instructions;
  std::vector<int> step_of;  ///< the step that an instruction is; -1: of a state's start or copy
  std::vector<int> state_address;  ///< private word of each of Program::states
  int private_words = 0;           ///< used
  int line_base = 512;             ///< first table word of delay lines
};

/// Throws Refused where words or registers do not suffice. Tables get their places.
Assembled assemble(const Law& law, const Target& target, Program& program);

}  // namespace feltgate::law
