// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// A study as text for a terminal and as JSON for pictures. Documentation:
// docs/speed-for-accuracy.md
#pragma once

#include <string>

#include "studies/stability/study.hpp"

namespace feltgate::stability {

std::string study_text(const Study& study);

/// Schema feltgate-stability/1, pretty-printed.
std::string study_json(const Study& study);

}  // namespace feltgate::stability
