// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Checks, before a run, that design and plant can run a scene. Documentation: docs/scenes.md
#pragma once

#include <optional>
#include <string>

#include "../backends/backend.hpp"
#include "scenario.hpp"
#include "scene_law.hpp"

namespace feltgate {

namespace design {
struct Elaborated;
}

/// Number of a torque law. Errors: config::ConfigError that names the design's laws.
int scene_number(const DesignInfo& design, const std::string& name);

/// The value of a parameter from text, with or without a unit (law/units.hpp), in the unit of the
/// law or of the design; nothing if neither has the parameter. Errors: std::invalid_argument.
std::optional<double> parameter_in(const std::string& name, const std::string& text,
                                   const DesignInfo& design, const SceneLaw* law);

/// Converts the values that the file gives with units to numbers; no amounts remain. Errors:
/// config::ConfigError "file:line: what; mend".
void resolve_amounts(Scenario& scenario, const DesignInfo& design, const SceneLaw* law = nullptr);
/// Whether values with units are left to convert.
bool has_amounts(const Scenario& scenario);

/// Turns a scene that is made for a lever into one for a smaller motor: torques are `scale` times
/// those of `made_for`, the scene's own design, which also gives the parameters that the file does
/// not set. Places become counts of `design`, bounds on torques and energies are scaled, and what
/// is expected of `made_for` alone is expected. Call it before resolve_amounts(). Hand and plant
/// stay. Errors: std::invalid_argument for a scene with a law.
void scale_torques(Scenario& scenario, double scale, const design::Elaborated& made_for,
                   const DesignInfo& design);

/// Checks that the design has every scene that is named, that every parameter that is set exists in
/// the law or the design and fits its word, and that the plant's step is short enough for each
/// phase of the hand (docs/plant.md). Errors: config::ConfigError "file:line: what; mend"; no file
/// and line for what was not read from a file.
void check_scenario(const Scenario& scenario, const plant::Parameters& plant,
                    const DesignInfo& design, const SceneLaw* law = nullptr);

/// The same without the plant's step; for devices of several axes.
void check_asked(const Scenario& scenario, const DesignInfo& design, const SceneLaw* law);

/// Checks that motor and bridge have as many phases, and that only a motor with phases loses one.
void check_phases(const Scenario& scenario, const plant::Parameters& plant,
                  const DesignInfo& design);

/// Checks only the plant's step, for a clock of `clock_hz`.
void check_step(const Scenario& scenario, const plant::Parameters& plant, double clock_hz);

}  // namespace feltgate
