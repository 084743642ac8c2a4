// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// A scene file: what the core renders, what the hand does, which effects of the plant are on, how
// long it lasts, and which results are expected. Documentation: docs/scenes.md
#pragma once

#include <functional>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "../plant/hand.hpp"
#include "../plant/parameters.hpp"
#include "tracker.hpp"

namespace feltgate {

namespace config {
class TomlReader;
}
struct DesignInfo;

/// A timed event: the host changes scene, mode or parameters, or a pin changes.
struct Event {
  double at_s = 0;
  int line = 0;  ///< line in the file; 0: not from a file
  std::optional<std::string> scene;
  std::optional<int> mode;
  std::optional<bool> arm;
  std::optional<bool> stop;
  std::string encoder;  ///< breaks an absolute encoder, or mends it: AbsoluteSensor::defects
  std::optional<int> open_phase;  ///< 0, 1, 2: from now on this phase of the motor has no current
  std::map<std::string, double> set;           ///< parameters in their units
  std::map<std::string, std::string> amounts;  ///< given with units: resolve_amounts()
  std::optional<double> step_nm;               ///< a torque step to this reference starts here
};

/// A bound on one figure of the run.
struct Expectation {
  std::string figure;
  std::optional<std::string> design;  ///< only for runs on this design
  /// Infinite where the file gives no such bound.
  double low = -std::numeric_limits<double>::infinity(),
         high = std::numeric_limits<double>::infinity();
  int line = 0;
};

/// An effect that a scene switches, overriding its plant.
struct EffectSetting {
  bool plant::Effects::*flag;
  bool on;
};

/// The contents of a scene file.
struct Scenario {
  std::string name, path, title, about;
  double duration_s = 0;
  std::string design;        ///< the design for which it is made; empty: own_design()
  std::string plant;         ///< name of the plant file
  bool plant_given = false;  ///< else a design may have another: choose_plant()
  int step_clocks = 25;      ///< plant step in clocks
  bool step_given = false;   ///< steps without events are not made longer
  bool switched = false;     ///< gates drive the plant, instead of the mean duty
  std::string scene = "free";
  int scene_line = 0;  ///< line in the file; 0: not from a file
  std::string law;     ///< for the scene "law": a name in rtl/laws or a path; else empty
  int law_line = 0;
  int mode = 0;
  double arm_s = 0;
  std::map<std::string, double> parameters;    ///< set before arming, in their units
  std::map<std::string, std::string> amounts;  ///< given with units: resolve_amounts()
  std::map<std::string, int> parameter_lines;  ///< lines of those that the file sets
  std::vector<Event> events;                   ///< in order of time
  double feed_hz = 0;  ///< how often the host sends the mailbox again, Hz; 0: never
  int feed_line = 0;
  std::optional<TrackerSettings> tracker;
  std::optional<double> rest_from_s;  ///< from this time on the lever should rest
  int rest_line = 0;
  std::optional<double> drag_from_s;  ///< from this time on a hand swings the lever
  int drag_line = 0;
  std::vector<EffectSetting> effects_set;  ///< set by the scene
  plant::Effects effects;                  ///< of the plant, overridden by the scene
  plant::Hand hand;
  std::vector<Expectation> expectations;
};

/// Reads vectors/scenes/NAME.toml. Errors: config::ConfigError "file:line: what; mend", also for a
/// scene whose device has several axes.
Scenario read_scenario(const std::string& path);

/// The same for a scene of a device with several axes: `device` reads the keys "device" and "hand"
/// of the file, and what else the device has.
Scenario read_device_scene(const std::string& path,
                           const std::function<void(config::TomlReader& file)>& device);

/// Whether the scene names a device of several axes. Errors: those of a file that is not TOML.
bool names_device(const std::string& path);

/// The simplifications of a scene's plant, by their names in files: effects that are off; "gates"
/// where the bridge is averaged; hand_dynamics only where the scene has a hand with a mass.
std::vector<std::string> effects_off(const Scenario& scenario);

/// The torque laws that a scene renders: its own and those that its events select.
std::set<std::string> scenes_used(const Scenario& scenario);

/// The design on which a scene runs where none is given: that for which it is made, lever_law for a
/// law, else lever.
std::string own_design(const Scenario& scenario);

/// The plant of a design where none is given.
std::string default_plant(const DesignInfo& design);
/// Sets the plant of a scene that names none to one that fits the design.
void choose_plant(Scenario& scenario, const DesignInfo& design);

/// Sets scenario.effects: those of the plant, overridden by the scene.
void resolve_effects(Scenario& scenario, const plant::Effects& of_plant);

}  // namespace feltgate
