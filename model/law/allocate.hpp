// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Turns the steps of a program into engine instructions: assigns registers and memory addresses and
// adds the last instruction. Documentation: docs/laws.md
#pragma once

#include <string>
#include <vector>

#include "law/bound.hpp"
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

// Bounds what a comparison changes that comes out otherwise within its strip: over small cells, of
// which only those at the strip count.

/// Lowers Strip::jump of each strip of `b` where small cells allow it, and fills
/// Strip::jump_as_set, which is for the parameters of `as_set`. Large jumps go first, as the work
/// is limited.
void tighten_jumps(const Law& law, const Target& target, const Program& program, const Cell& as_set,
                   Bound* b);

// Splits a function of a wide range into a sum of pieces, each with its own table.

constexpr int kMostPieces = 4;

/// A law that is equal in real numbers. It replaces every sqrt, 1/x, exp and log of a changing
/// argument by f(x) = f(min(x, t)) + f(max(x, t)) - f(t), in up to `pieces` pieces, and moves a
/// constant limit of the value to the argument. `whole`, `b`: program and bound of the unchanged
/// law. `narrowed` becomes true where an argument is limited to what matters of it, interest().
Law in_pieces(const Law& law, const Target& target, const Program& whole, const Bound& b,
              int pieces, bool* narrowed = nullptr);

}  // namespace feltgate::law
