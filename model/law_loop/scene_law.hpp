// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// A compiled law for loops: loaded by the host's writes, beside it the law in real numbers.
// Documentation: docs/laws.md
#pragma once

#include <cmath>
#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "law/compile.hpp"
#include "loop/scene_law.hpp"

namespace feltgate {

/// The law of a file for a design. Errors: law::LawError, law::Refused; std::invalid_argument for a
/// law of several axes, which a loop of one lever cannot run.
std::unique_ptr<SceneLaw> make_scene_law(const std::string& path, const DesignInfo& design);
/// One that is compiled for the design, of one axis.
std::unique_ptr<SceneLaw> make_scene_law(law::Compiled law, const DesignInfo& design);

/// A parameter's number, and the value in SI that the host has set.
struct LawChange {
  std::size_t parameter;
  double si;
};
/// Its value in the numbers of a chain: its word times its step, so that one in counts
/// equals the position in counts that it is compared with.
template <class N>
N rounded(const law::Compiled& law, const LawChange& c) {
  for (const law::ImageWord& w : law.image.words) {
    if (!w.formula.empty() || w.name != law.law.parameters[c.parameter].name) continue;
    return static_cast<N>(std::nearbyint(c.si / w.scale)) * static_cast<N>(w.scale);
  }
  return static_cast<N>(c.si);
}

/// Runs it in the numbers of a chain of this kind: "fixed" runs the image, "quad" the graph in
/// binary128, the others in double. `changes` are the parameters' numbers and SI values, in the
/// order in which they are set, those of a commit together; it may grow.
using LawChanges = std::vector<std::vector<LawChange>>;
std::unique_ptr<LawRider> make_law_rider(const law::Compiled& law, const DesignInfo& design,
                                         const std::string& kind, const LawChanges& changes);
/// Runs the image too, and tells its states.
std::unique_ptr<LawWatch> make_law_watch(const law::Compiled& law, const DesignInfo& design,
                                         const LawChanges& changes, SceneLaw::Told told);

}  // namespace feltgate
