// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Zeros of an analytic function by the argument principle: the number of zeros in a region is the
// number of turns that the function makes around 0 along its border. Documentation: docs/designs.md
#pragma once

#include <complex>
#include <functional>
#include <vector>

namespace feltgate::stability {

using Complex = std::complex<double>;
/// Analytic in the region asked for, f(conj(s)) = conj(f(s)).
using AnalyticFunction = std::function<Complex(Complex)>;

/// Zeros with Re s > `real` and |Im s| < `top` of a function that repeats with period 2j*top and
/// tends to a constant as Re s grows. `pieces`: steps along the line that are surely short enough
/// for the function to be followed; they shorten toward Im s = 0, and where it turns fast.
int zeros_right_of(const AnalyticFunction& f, double real, double top, int pieces);

/// Zeros in the rectangle between two corners (lower left, upper right), as often as their
/// multiplicity, to 1e-9 of its size. The border should be free of zeros.
std::vector<Complex> zeros_in(const AnalyticFunction& f, Complex low, Complex high);

}  // namespace feltgate::stability
