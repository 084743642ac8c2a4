// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Laws for the engine that equal the core's scenes, so that the scenes can run at any rate.
// Documentation: docs/speed-for-accuracy.md
#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "feltgate/design_info.hpp"
#include "sim/loop/scenario.hpp"

namespace feltgate::rates {

/// A scene of the core and the law that demands the same torque.
struct BlockLaw {
  std::string scene;
  std::string file;  ///< name in rtl/laws; empty: `text` is the law
  std::string text;
  std::vector<std::string> names;  ///< the scene's parameters, docs/registers.md
  /// Computes the law's parameters, in the units of its file, from the scene's parameters and the
  /// angle of a count.
  using Values = std::map<std::string, double>;
  std::function<Values(const Values&, double count_rad)> parameters;
  std::string gates;  ///< size of the block, docs/synthesis.md
};

/// The law of a scene; nullptr if the scene has no torque law of its own.
const BlockLaw* block_law(const std::string& scene);

/// The scene with its law in place of the core's block, without expectations. `design` has the
/// block and gives the values that the scene does not set. Throws config::ConfigError for a scene
/// that changes to another one.
Scenario as_law(const Scenario& scene, const BlockLaw& law, const DesignInfo& design);

/// Throws config::ConfigError when the scene changes to another one or uses the voltage mode.
void require_one_law(const Scenario& scene);

}  // namespace feltgate::rates
