// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// What a misspelt name was meant to be; the twin's facade asks the same. Documentation:
// docs/designs.md
#pragma once

#include "feltgate/nearest.hpp"  // IWYU pragma: export
