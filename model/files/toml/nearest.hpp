// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Suggests the nearest known name for a misspelt one; shared with the twin's facade. Documentation:
// docs/designs.md
#pragma once

#include "feltgate/nearest.hpp"  // IWYU pragma: export
