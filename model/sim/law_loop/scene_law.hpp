// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// A compiled law for simulated loops: the image, loaded by the host's writes, and beside it the law
// in real numbers. Documentation: docs/laws.md
#pragma once

#include <memory>
#include <string>

#include "law/compile.hpp"
#include "sim/loop/scene_law.hpp"

namespace feltgate {

/// Refuses a law with a torque for a second axis, which a loop of one lever cannot run:
/// std::invalid_argument with `path`, the line and the mend.
void require_one_torque(const law::Compiled& law, const std::string& path);
/// Compiles the law of a file for a design. Throws law::LawError, law::Refused, and
/// std::invalid_argument for a law of several axes, which a loop of one lever cannot run.
std::unique_ptr<SceneLaw> make_scene_law(const std::string& path, const DesignInfo& design);
/// The same for a law of one axis that is already compiled for the design.
std::unique_ptr<SceneLaw> make_scene_law(law::Compiled law, const DesignInfo& design);
/// The law of a file, for a design with `axes` axes. Errors: law::LawError, law::Refused;
/// std::invalid_argument if it does not have exactly these axes.
std::unique_ptr<SceneLaw> make_axes_law(const std::string& path, const DesignInfo& design,
                                        int axes);
/// The same for a law that is compiled for the design; `path` is used in messages.
std::unique_ptr<SceneLaw> make_axes_law(law::Compiled law, const std::string& path,
                                        const DesignInfo& design, int axes);

}  // namespace feltgate
