// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Splits a function of a wide range into a sum of pieces, each with its own table.
// Documentation: docs/laws.md
#pragma once

#include "law/bound.hpp"
#include "law/law.hpp"
#include "law/program.hpp"
#include "law/target.hpp"

namespace feltgate::law {

constexpr int kMostPieces = 4;

/// A law that is equal in real numbers. It replaces every sqrt, 1/x, exp and log of a changing
/// argument by f(x) = f(min(x, t)) + f(max(x, t)) - f(t), in up to `pieces` pieces, and moves a
/// constant limit of the value to the argument. `whole`, `b`: program and bound of the unchanged
/// law. `narrowed` becomes true where an argument is limited to what matters of it, interest().
Law in_pieces(const Law& law, const Target& target, const Program& whole, const Bound& b,
              int pieces, bool* narrowed = nullptr);

}  // namespace feltgate::law
