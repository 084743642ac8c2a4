// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Readers for parsed tables of plants and hands, for files that contain them. Users of the library
// need only plant_file.hpp, which does not depend on TOML. Documentation: docs/plant.md
#pragma once

#include <array>
#include <string>

#include "files/toml/toml_reader.hpp"
#include "sim/plant/gimbal/gimbal.hpp"
#include "sim/plant/hand.hpp"
#include "sim/plant/pantograph/pen_hand.hpp"

namespace feltgate::plant {

constexpr double kRadPerDegree = 3.14159265358979323846 / 180.0;

/// A plant from a parsed table; errors name it `file`.
Parameters read_plant(const toml::table& root, const std::string& file);

/// [joint], [motor], [lugre], [supply], [encoder], [effects] of a device with several axes; keys
/// are required, unknown keys are errors.
void read_axes(config::TomlReader& root, AxesParameters& p);

/// Effects of a scene's [effects] table over `base`; a missing key keeps the value of `base`.
Effects read_effects(config::TomlReader table, const Effects& base);

/// A motion under `key`: at least one segment, with `to_UNIT`, `amplitude_UNIT`.
Profile read_profile(config::TomlReader& table, const std::string& key, const std::string& unit,
                     bool steps_allowed);
/// `duration_s` of a hand's phase. If missing: the duration of the phase's motion, motion_s, if it
/// has one; the last phase lasts forever.
double read_duration(config::TomlReader& table, double motion_s, bool last);
/// The five keys of an impedance; each may be missing.
Impedance read_impedance(config::TomlReader& table);

/// Reads [hand] and [[hand.phase]] of a hand that holds a pen in the plane.
/// Errors: config::ConfigError "file:line: what; mend".
PenHand read_pen_hand(config::TomlReader table);

/// The same for a hand that holds the pen of a stylus; the result is its effect on each axis, as a
/// lever whose capstan has the radius capstan_m.
std::array<Hand, 3> read_stylus_hand(config::TomlReader table, double capstan_m);

/// Reads [hand] and [[hand.phase]] of a hand that turns a handle; `stops` are those of its middle
/// joint. Errors: config::ConfigError "file:line: what; mend".
TurningHand read_turning_hand(config::TomlReader table, const AngleStops& stops);

/// Reads [hand] and [[hand.phase]]; paths of traces are relative to the scene's folder.
/// Errors: config::ConfigError "file:line: what; mend".
Hand read_hand(config::TomlReader table);

}  // namespace feltgate::plant
