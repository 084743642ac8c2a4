// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Bounds what a comparison changes that comes out otherwise within its strip: over small cells, of
// which only those at the strip count. Documentation: docs/laws.md
#pragma once

#include "law/bound.hpp"

namespace feltgate::law {

/// Lowers Strip::jump of each strip of `b` where small cells allow it, and fills
/// Strip::jump_as_set, which is for the parameters of `as_set`. Large jumps go first, as the work
/// is limited.
void tighten_jumps(const Law& law, const Target& target, const Program& program, const Cell& as_set,
                   Bound* b);

}  // namespace feltgate::law
