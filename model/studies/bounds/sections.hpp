// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Worst-case peak gains of the chain's filters: the largest output for inputs of magnitude at
// most 1. Documentation: docs/error-bounds.md
#pragma once

#include "studies/bounds/interval.hpp"

namespace feltgate::bounds {

/// Sum over k of |pole|^k, 1/(1 - |pole|): the peak gain of e[k+1] = pole*e[k] + r[k].
/// Endless (infinity) when |pole| >= 1.
Interval one_pole_gain(const Interval& pole);

/// Upper bound of the sum over k of |p*(1-p)^k - q*(1-q)^k|: the effect of exchanging the
/// coefficient of a unit-gain low-pass. Both in (0, 1].
double lowpass_change_gain(const Interval& p, const Interval& q);

/// Upper bound of the peak gain of (1 - z^-1)/((1 - p z^-1)(1 - q z^-1)): the gain from an error
/// that enters the low-pass of pole p to the output of a high-pass of pole q. Interval summation of
/// the impulse response with a closed bound of its tail. p >= 0; infinity if p or |q| reaches 1.
double high_passed_gain(const Interval& p, const Interval& q);

}  // namespace feltgate::bounds
