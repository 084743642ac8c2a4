// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Computes the proven error bounds for the motion of a work. Documentation: docs/error-bounds.md
#pragma once

#include "studies/bench/work.hpp"
#include "studies/bounds/error_bounds.hpp"

namespace feltgate::bench {

/// Bounds for all scenes, modes and parameters of the work, up to its largest velocity.
bounds::ErrorBounds work_bounds(const design::Elaborated& e, const Work& work);

}  // namespace feltgate::bench
