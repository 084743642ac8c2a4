// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// A scene file: what the core renders, what the hand does, which effects of the plant matter, how
// long it lasts and what must come out. Documentation: docs/scenes.md
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

/// Something that happens at a time: the host changes scene, mode or parameters, or a pin moves.
struct Event {
  double at_s = 0;
  int line = 0;  ///< of the file; 0: not of a file
  std::optional<std::string> scene;
  std::optional<int> mode;
  std::optional<bool> arm;
  std::optional<bool> stop;
  std::map<std::string, double> set;           ///< parameters in their units
  std::map<std::string, std::string> amounts;  ///< further ones with units: resolve_amounts()
  std::optional<double> step_nm;               ///< a torque step to this reference begins here
};

/// A bound on one figure of the run.
struct Expectation {
  std::string figure;
  std::optional<std::string> design;  ///< only when run on this design
  /// Infinite where the file gives no such bound.
  double low = -std::numeric_limits<double>::infinity(),
         high = std::numeric_limits<double>::infinity();
  int line = 0;
};

/// An effect that a scene switches, whatever its plant says.
struct EffectSetting {
  bool plant::Effects::*flag;
  bool on;
};

struct Scenario {
  std::string name, path, title, about;
  double duration_s = 0;
  std::string plant;     ///< name of the plant file
  int step_clocks = 25;  ///< plant step
  bool step_given =
      false;              ///< every step is so long; else those in which nothing happens are longer
  bool switched = false;  ///< gates drive the plant instead of the mean duty
  std::string scene = "free";
  int scene_line = 0;  ///< of the file; 0: not of a file
  std::string law;     ///< of the scene "law": a name in rtl/laws or a path; empty: none
  int law_line = 0;
  int mode = 0;
  double arm_s = 0;
  std::map<std::string, double> parameters;    ///< set before arming, in their units
  std::map<std::string, std::string> amounts;  ///< further ones with units: resolve_amounts()
  std::map<std::string, int> parameter_lines;  ///< of those that the file sets
  std::vector<Event> events;                   ///< in order of time
  double feed_hz = 0;  ///< how often the host sends the mailbox anew; 0: it does not
  int feed_line = 0;
  std::optional<TrackerSettings> tracker;
  std::optional<double> rest_from_s;  ///< from then on the lever should rest
  int rest_line = 0;
  std::optional<double> drag_from_s;  ///< from then on a hand swings the lever
  int drag_line = 0;
  std::vector<EffectSetting> effects_set;  ///< by the scene
  plant::Effects effects;                  ///< of the plant, as the scene overrides them
  plant::Hand hand;
  std::vector<Expectation> expectations;
};

/// Reads vectors/scenes/NAME.toml. Throws config::ConfigError: "file:line: what; mend", also for a
/// scene whose device has several axes.
Scenario read_scenario(const std::string& path);

/// The same of a scene that names a device of several axes: `device` asks the file for its keys
/// "device" and "hand", and whatever else the device has.
Scenario read_device_scene(const std::string& path,
                           const std::function<void(config::TomlReader& file)>& device);

/// Whether the scene names a device of several axes. Errors: those of a file that is not TOML.
bool names_device(const std::string& path);

/// What the plant of a scene leaves out, by the names of the file: the effects that are off,
/// "gates" where the bridge is averaged; hand_dynamics only where the scene has a hand with a mass.
std::vector<std::string> effects_off(const Scenario& scenario);

/// The torque laws that a scene renders: its own and those that its events switch to.
std::set<std::string> scenes_used(const Scenario& scenario);

/// Fills scenario.effects: those of the plant, as the scene sets them.
void resolve_effects(Scenario& scenario, const plant::Effects& of_plant);

}  // namespace feltgate
