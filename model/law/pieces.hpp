// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// A function over a wide range as a sum of itself over parts of it, each with a table of its own.
// Documentation: docs/law-compiler.md
#pragma once

#include "law/bound.hpp"
#include "law/law.hpp"
#include "law/program.hpp"
#include "law/target.hpp"

namespace feltgate::law {

constexpr int kMostPieces = 4;

/// The same law in real numbers. Every sqrt, 1/x and exp of what changes in a run is
/// f(x) = f(min(x, t)) + f(max(x, t)) - f(t), in up to `pieces` pieces, and a constant limit of its
/// value is one of its argument. `whole`, `b`: of the law as it is.
Law in_pieces(const Law& law, const Target& target, const Program& whole, const Bound& b,
              int pieces);

}  // namespace feltgate::law
