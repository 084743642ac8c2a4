// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// A compiled law for simulated loops: the image, loaded by the host's writes, and beside it the law
// in real numbers. Documentation: docs/laws.md
#pragma once

#include <cmath>
#include <cstddef>
#include <memory>
#include <string>
#include <vector>

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

/// A host's change of a parameter: its number, and the new value in SI.
struct LawChange {
  std::size_t parameter;
  double si;
};
/// The changed value in the number type of a chain: word times step. A value in counts is thus
/// equal to the position in counts with which it is compared.
template <class N>
N rounded(const law::Compiled& law, const LawChange& c) {
  for (const law::ImageWord& w : law.image.words) {
    if (!w.formula.empty() || w.name != law.law.parameters[c.parameter].name) continue;
    return static_cast<N>(std::nearbyint(c.si / w.scale)) * static_cast<N>(w.scale);
  }
  return static_cast<N>(c.si);
}

/// Changes of parameters in the order in which the host sets them, one entry per commit; the list
/// may grow. Laws run in the number type of their chain: "fixed" runs the image, "quad" the graph
/// in binary128, the others the graph in double.
using LawChanges = std::vector<std::vector<LawChange>>;
std::unique_ptr<LawRider> make_law_rider(const law::Compiled& law, const DesignInfo& design,
                                         const std::string& kind, const LawChanges& changes);
/// Runs the image and reports its states.
std::unique_ptr<LawWatch> make_law_watch(const law::Compiled& law, const DesignInfo& design,
                                         const LawChanges& changes, SceneLaw::Told told);

}  // namespace feltgate
