// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The claims of papers with files of their own. Documentation: docs/claims.md
#pragma once

#include "studies/claims/claims.hpp"
#include "studies/stability/mass_loop.hpp"

namespace feltgate::claims {

std::vector<Source> touch_world();
std::vector<Source> dimple();

}  // namespace feltgate::claims
