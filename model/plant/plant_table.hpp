// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The tables of plants and hands, parsed: for readers of files that hold them. Users of the library
// need plant_file.hpp only, which knows nothing of TOML. Documentation: docs/plant.md
#pragma once

#include <array>
#include <string>

#include "config/toml_reader.hpp"
#include "plant/axes_parameters.hpp"
#include "plant/gimbal/gimbal.hpp"
#include "plant/hand.hpp"
#include "plant/pantograph/pen_hand.hpp"
#include "plant/parameters.hpp"

namespace feltgate::plant {

constexpr double kRadPerDegree = 3.14159265358979323846 / 180.0;

/// A plant from a parsed table, `file` being the name that errors print.
Parameters read_plant(const toml::table& root, const std::string& file);

/// [joint], [motor], [lugre], [supply], [encoder], [effects] of a device with several axes; keys
/// are required, unknown keys are errors.
void read_axes(config::TomlReader& root, AxesParameters& p);

/// Effects of a scene's [effects] table over `base`: a missing key keeps the value of `base`.
Effects read_effects(config::TomlReader table, const Effects& base);

/// A motion under `key`: segments with `to_UNIT`, `amplitude_UNIT`; one at least.
Profile read_profile(config::TomlReader& table, const std::string& key, const std::string& unit,
                     bool steps_allowed);
/// `duration_s` of a phase of a hand. Where it is not there that of the phase's motion, s, if it
/// has one; the last phase lasts for good.
double read_duration(config::TomlReader& table, double motion_s, bool last);
/// The five keys of an impedance; each may be missing.
Impedance read_impedance(config::TomlReader& table);

/// Reads [hand] and [[hand.phase]] of a hand that holds a pen in the plane.
/// Errors: config::ConfigError "file:line: what; mend".
PenHand read_pen_hand(config::TomlReader table);

/// The same of a hand that holds the pen of a stylus, as what it does to each axis: a lever whose
/// capstan has this radius, m.
std::array<Hand, 3> read_stylus_hand(config::TomlReader table, double capstan_m);

/// Reads [hand] and [[hand.phase]] of a hand that turns a handle whose middle joint has these
/// stops. Errors: config::ConfigError "file:line: what; mend".
TurningHand read_turning_hand(config::TomlReader table, const AngleStops& stops);

/// Reads [hand] and [[hand.phase]]; files of traces are relative to the folder of the scene.
/// Errors: config::ConfigError "file:line: what; mend".
Hand read_hand(config::TomlReader table);

}  // namespace feltgate::plant
