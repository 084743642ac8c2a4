// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Words of table memory for functions, and the proof of their error. Documentation:
// docs/law-compiler.md
#pragma once

#include <functional>

#include "law/program.hpp"

namespace feltgate::law {

/// A function by jets: value, slope and curvature over a span of its argument, in SI.
using JetFunction = std::function<Jet(const Span&)>;

struct TableRequest {
  JetFunction function;
  Span domain;            ///< SI; the argument is taken to its ends
  double argument_scale;  ///< SI value of 1 of the argument's word
  int low, count;         ///< first index x >> 12, and how many segments
  double value_scale;     ///< SI value of 1 of the result
  std::int32_t limit;     ///< largest size of a value
};

/// The function, and beyond its domain, where that ends inside a segment, the line of that segment:
/// from the end to the sample within. `request` must outlive it.
std::function<double(double)> extended(const TableRequest& request);

/// Segments between samples, each moved so that its largest errors to both sides are equal.
TableUse make_table(const TableRequest& request);

/// Sine over all turns: argument 2^21 a turn, values of at most `limit` words.
TableUse sine_turn(std::int32_t limit, double value_scale);
/// Sine over [-1/2, 1/2 + 1/4) turn in segments of 2^-bits turns; more than half a turn for
/// cosines.
TableUse sine_part(int bits, bool cosines, std::int32_t limit, double value_scale);

}  // namespace feltgate::law
