// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Twin and plant of a scene as a model for co-simulation, and its variables, from which
// modelDescription.xml is written. Documentation: docs/other-tools.md
#pragma once

#include <cstdint>
#include <deque>
#include <memory>
#include <string>
#include <vector>

#include "sim/loop/columns.hpp"
#include "sim/loop/loop.hpp"
#include "sim/plant/parameters.hpp"

namespace feltgate::fmu {

/// A variable of the model; its value reference is its place in variables().
struct Variable {
  enum class Kind { time, own_hand, torque, output };
  Kind kind;
  Column column;  ///< of an output; of the others name, unit and meaning
};

/// Time, the parameter and the input, then every column of a run.
const std::vector<Variable>& variables();

/// A scene with its plant and design, as read from two files.
struct Scene {
  /// Errors: std::invalid_argument or config::ConfigError for files that are missing or wrong, and
  /// for a scene that this design cannot run alone: a law, a device, a recorded hand.
  Scene(const std::string& scene_path, const std::string& plant_path, const std::string& design);

  Scenario scenario;
  plant::Parameters plant;
  std::string design;
  std::string token;  ///< the instantiationToken: of the design and the text of both files
};

/// Path of the scene's plant: a name in `plants`, or beside the scene. Errors: as Scene.
std::string plant_of_scene(const std::string& scene_path, const std::string& plants,
                           const std::string& design);

/// modelDescription.xml of a library that is called `identifier`.
std::string model_description(const Scene& scene, const std::string& identifier);

/// The scene in time; it goes on after its own end for as long as it is asked to.
class SceneModel {
 public:
  explicit SceneModel(const Scene& scene);

  /// Whether a torque acts instead of the scene's hand; before the first run_to().
  void own_hand(bool own) { own_hand_ = own; }
  bool has_own_hand() const { return own_hand_; }
  /// Of the own hand, Nm, from now on.
  void push(double torque_nm) { torque_nm_ = torque_nm; }
  double pushed_nm() const { return torque_nm_; }
  /// Runs to this time, s. Errors: std::runtime_error.
  void run_to(double time_s);
  double time_s() const { return time_s_; }
  /// The last tick that was over at time_s().
  const Row& row() const { return row_; }

 private:
  void start();

  Scenario scenario_;
  plant::Parameters plant_;
  RunOptions options_;
  DesignInfo design_;
  std::unique_ptr<SteppedRun> run_;
  Row row_;
  std::deque<Row> later_;  ///< of ticks that a step of the plant ran past time_s()
  std::int64_t ticks_shown_ = 0;
  bool own_hand_ = false;
  double torque_nm_ = 0, acting_nm_ = 0, time_s_ = 0;
};

}  // namespace feltgate::fmu
