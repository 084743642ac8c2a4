// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// A trimmed scene as a scene file. Documentation: docs/trim.md
#pragma once

#include <string>

#include "trim/felt.hpp"

namespace feltgate::trim {

/// The scene of `scene.path` with bridge, step and effects of `model`, and the plant that
/// scene.plant names. The rest is the original's text. Recordings beside the original are
/// named by their whole path. `comment` goes first, each of its lines behind a #.
std::string scene_text(const Scenario& scene, const Model& model, const std::string& comment);

}  // namespace feltgate::trim
