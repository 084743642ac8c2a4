// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Runs a scene or a recording and compares its errors with their proven bounds. Documentation:
// docs/error-bounds.md
#pragma once

#include <string>

#include "loop.hpp"
#include "replay.hpp"

namespace feltgate {

namespace design {
struct Elaborated;
}

/// Runs a scene and computes the bounds for its motion. `felt` gets the errors of the core,
/// `broken` each error that exceeds its bound in a tick for which the bound holds. Sets
/// `options.coverage`. `e` is the design `options.design`. Without quad beside the core nothing is
/// compared.
RunResult run_within_bounds(const design::Elaborated& e, const Scenario& scenario,
                            const plant::Parameters& plant, RunOptions options);

/// The same for a recording.
RunResult replay_within_bounds(const design::Elaborated& e, EncoderSource& source,
                               const std::string& subject, ReplayOptions options);

/// Whether this is an engine in fixed point, whose errors have bounds.
bool is_core(const BackendFigures& e);

}  // namespace feltgate
