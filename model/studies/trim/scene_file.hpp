// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Writes a trimmed scene as a scene file. Documentation: docs/trim.md
#pragma once

#include <string>

#include "studies/trim/felt_difference.hpp"

namespace feltgate::trim {

/// Text of the scene file `scene.path` with bridge, step and effects of `model`, and the plant that
/// scene.plant names. The rest of the text is unchanged, but recordings in the original's folder
/// get their full path. `comment` comes first, with # before each line.
std::string scene_text(const Scenario& scene, const Model& model, const std::string& comment);

}  // namespace feltgate::trim
