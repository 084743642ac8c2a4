// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The core's scenes as laws for the engine, so that they can run at any rate. Documentation:
// docs/rates.md
#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "feltgate/design_info.hpp"
#include "loop/scenario.hpp"

namespace feltgate::rates {

/// A scene of the core and the law that asks for the same torque.
struct BlockLaw {
  std::string scene;
  std::string file;  ///< name in rtl/laws; empty: `text` is the law
  std::string text;
  std::vector<std::string> names;  ///< the scene's parameters, docs/registers.md
  /// The law's parameters in the units of its file, from the scene's in theirs and the angle of a
  /// count.
  using Values = std::map<std::string, double>;
  std::function<Values(const Values&, double count_rad)> parameters;
  std::string gates;  ///< what the block costs, docs/synthesis.md
};

/// nullptr where the scene has no torque law of its own.
const BlockLaw* block_law(const std::string& scene);

/// The scene with its law for the core's block, expectations left out. `design` has the block, for
/// the values that the scene does not set. Errors: config::ConfigError for a scene that changes to
/// another one.
Scenario as_law(const Scenario& scene, const BlockLaw& law, const DesignInfo& design);

/// Throws config::ConfigError where the scene changes to another one, or has the voltage mode.
void require_one_law(const Scenario& scene);

}  // namespace feltgate::rates
