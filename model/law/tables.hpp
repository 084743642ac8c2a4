// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Makes the words of table memory for functions, and proves their error. Documentation:
// docs/laws.md
#pragma once

#include <functional>

#include "law/program.hpp"

namespace feltgate::law {

/// A function that returns its jet: value, slope and curvature over a span of its argument, in SI.
using JetFunction = std::function<Jet(const Span&)>;

struct TableRequest {
  JetFunction function;
  Span domain;            ///< SI; the argument is clamped to it
  double argument_scale;  ///< SI value of one LSB of the argument's word
  int low, count;         ///< first index x >> 12, and how many segments
  double value_scale;     ///< SI value of one LSB of the result
  std::int32_t limit;     ///< largest magnitude of a value, words
};

/// The function, continued beyond its domain where the domain ends inside a segment: there it is
/// the line through the domain's end and the segment's sample inside. `request` must outlive the
/// result.
std::function<double(double)> extended(const TableRequest& request);

/// Makes linear segments between samples; each is shifted so that its largest positive and negative
/// errors are equal.
TableUse make_table(const TableRequest& request);

/// Sine over a full turn, wrapping: 2^21 words of the argument per turn, values of at most `limit`
/// words.
TableUse sine_turn(std::int32_t limit, double value_scale);
/// Sine over [-1/2, 1/2) turn in segments of 2^-bits turns; with `cosines`, over [-1/2, 3/4) turn.
TableUse sine_part(int bits, bool cosines, std::int32_t limit, double value_scale);

}  // namespace feltgate::law
