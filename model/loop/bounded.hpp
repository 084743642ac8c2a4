// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// A run whose errors are held to their proven bounds. Documentation: docs/error-bounds.md
#pragma once

#include <string>

#include "loop.hpp"
#include "replay.hpp"

namespace feltgate {

namespace design {
struct Elaborated;
}

/// run_scenario() with the bounds of its motion: the errors of the core in `felt`, and in `broken`
/// each that exceeds its bound in a tick for which the bound holds. `options.coverage` is set here.
/// `e` is the design `options.design`; without quad beside the core there is nothing to compare.
RunResult run_within_bounds(const design::Elaborated& e, const Scenario& scenario,
                            const plant::Parameters& plant, RunOptions options);

/// The same of a recording.
RunResult replay_within_bounds(const design::Elaborated& e, EncoderSource& source,
                               const std::string& subject, ReplayOptions options);

/// The engines in fixed point, whose errors have bounds.
bool is_core(const EngineFigures& e);

}  // namespace feltgate
