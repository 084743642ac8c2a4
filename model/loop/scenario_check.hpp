// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// What a scene asks of design and plant, checked before a run. Documentation: docs/scenes.md
#pragma once

#include <optional>
#include <string>

#include "../engines/engine.hpp"
#include "scenario.hpp"
#include "scene_law.hpp"

namespace feltgate {

/// Number of a torque law. Throws config::ConfigError with the laws that the design has.
int scene_number(const DesignInfo& design, const std::string& name);

/// A parameter's value as someone writes it, with a unit or without (law/amount.hpp), in the unit
/// of the law or of the design; none: neither has the parameter. Throws std::invalid_argument.
std::optional<double> parameter_in(const std::string& name, const std::string& text,
                                   const DesignInfo& design, const SceneLaw* law);

/// Makes numbers of the values that the file gives with units; after that there are none. Errors:
/// config::ConfigError "file:line: what; mend".
void resolve_amounts(Scenario& scenario, const DesignInfo& design, const SceneLaw* law = nullptr);
bool has_amounts(const Scenario& scenario);

/// Every scene that is named is in the design, every parameter that is set is one of the law or of
/// the design and fits its word, and the plant's step is short enough for each phase of the hand
/// (docs/plant.md). Errors: config::ConfigError "file:line: what; mend", without file and line for
/// what was not read from a file.
void check_scenario(const Scenario& scenario, const plant::Parameters& plant,
                    const DesignInfo& design, const SceneLaw* law = nullptr);

/// The same without the plant's step, for devices of several axes.
void check_asked(const Scenario& scenario, const DesignInfo& design, const SceneLaw* law);

/// Throws std::invalid_argument "file:line: what; mend" where the scene runs a law, which the
/// subcommand cannot.
void require_no_law(const Scenario& scenario, const std::string& command);

/// The step alone, at a clock of `clock_hz`.
void check_step(const Scenario& scenario, const plant::Parameters& plant, double clock_hz);

}  // namespace feltgate
