// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// A compiled law in a page: the interpreter executes its program words, run by run, without a core.
// Documentation: docs/page.md
#pragma once

#include <cstdint>
#include <map>
#include <string>

#include "feltgate/design_info.hpp"
#include "law/compile.hpp"
#include "law/engine/machine.hpp"
#include "law/image.hpp"
#include "law/load.hpp"
#include "sim/plant/rotation.hpp"

namespace feltgate::page {

/// The place of a law's state in an image: a data word of the engine, and the SI value of one LSB.
struct StateWord {
  int address = 0;
  double scale = 1;
};
/// Finds a state by name. Throws std::invalid_argument when the law has no such state.
StateWord state_word(const law::Compiled& law, const std::string& name);
class ImageLaw {
 public:
  /// `image_text`: an image for one of design_named(). Throws std::invalid_argument.
  explicit ImageLaw(const std::string& image_text);
  ImageLaw(const ImageLaw&) = delete;
  ImageLaw& operator=(const ImageLaw&) = delete;

  const std::string& name() const { return image_.name; }
  double period_s() const { return period_s_; }
  /// Sets a parameter or a mailbox, in its unit. Throws std::invalid_argument when it is unknown or
  /// out of range.
  void set(const std::string& parameter, double value);
  /// Sets several values with one commit. Throws like set() of one value, and then sets nothing.
  void set(const std::map<std::string, double>& values);
  double value(const std::string& parameter) const { return values_.value(parameter); }
  /// Inputs of joint `axis` (0 to 2) for the next run. The absolute angle is rounded down to
  /// counts; speed and observed torque are rounded to the design's words.
  void joint(int axis, double angle_rad, double speed_rad_s, double observed_nm = 0);
  /// All three of them.
  void joints(plant::Vec3 rad, plant::Vec3 rad_s);
  /// Counts of the joint for the next run.
  std::int32_t counts(int axis) const { return inputs_[static_cast<std::size_t>(3 * axis)]; }
  /// The angle of these counts, rad.
  double counted_rad(int axis) const { return counts(axis) * design_.count_rad; }
  /// Executes one run of the law. Throws std::runtime_error for a program that does not end.
  void run();
  /// Torque of the last run for a joint, Nm, limited to the design's torque word.
  double torque_nm(int axis) const;
  plant::Vec3 torques_nm() const { return {torque_nm(0), torque_nm(1), torque_nm(2)}; }
  /// A state after the last run, SI.
  double state(const StateWord& s) const { return machine_.memory().data_at(s.address) * s.scale; }
  /// Events of the last run: numbers and words.
  const std::vector<law::MachineEvent>& events() const { return run_->events; }
  const std::vector<law::ImageEvent>& event_names() const { return image_.events; }

 private:
  law::Image image_;
  DesignInfo design_;
  law::LoadedParameters values_;
  law::Machine machine_;
  double period_s_;
  law::MachineInputs inputs_{};
  const law::MachineRun* run_ = nullptr;
};

}  // namespace feltgate::page
