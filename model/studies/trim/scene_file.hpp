// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Writes a trimmed scene as a scene file. Documentation: docs/trim.md
#pragma once

#include <string>

#include "studies/trim/subject.hpp"

namespace feltgate::trim {

/// Text of the scene file `scene.path` with bridge, step and effects of `model`, and the plant that
/// scene.plant names; of a device with the effects alone. The rest of the text is unchanged, but
/// recordings and laws in the original's folder get their full path. `comment` comes first, with #
/// before each line.
std::string scene_text(const Scenario& scene, const Model& model, const std::string& comment);

}  // namespace feltgate::trim
