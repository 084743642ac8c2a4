// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// A compiled law that a page carries: its program words in the interpreter, run by run, without a
// core around them. Documentation: docs/page.md
#pragma once

#include <cstdint>
#include <map>
#include <string>

#include "engine/machine.hpp"
#include "feltgate/design_info.hpp"
#include "law/compile.hpp"
#include "law/image.hpp"
#include "law/load.hpp"

namespace feltgate::page {

/// Where an image keeps a state of its law: a data word of the engine, and the SI value of its 1.
struct StateWord {
  int address = 0;
  double scale = 1;
};
/// Errors: std::invalid_argument, the law has no such state.
StateWord state_word(const law::Compiled& law, const std::string& name);

class ImageLaw {
 public:
  /// The text of an image for a design that is built in. Errors: std::invalid_argument.
  explicit ImageLaw(const std::string& image_text);
  /// The text of an image for this design, built in or not. Errors: std::invalid_argument.
  ImageLaw(const std::string& image_text, const DesignInfo& design);
  ImageLaw(const ImageLaw&) = delete;
  ImageLaw& operator=(const ImageLaw&) = delete;

  const std::string& name() const { return image_.name; }
  double period_s() const { return period_s_; }
  /// A parameter or a mailbox, in its unit. Errors: std::invalid_argument, unknown or out of range.
  void set(const std::string& parameter, double value);
  /// Several by one commit. Errors: as of one; nothing is set then.
  void set(const std::map<std::string, double>& values);
  double value(const std::string& parameter) const { return values_.value(parameter); }
  /// Joint `axis` (0 to 2) of the next run: an absolute angle, of which the counts that are below
  /// it are left, a speed and an observed torque, rounded to the design's words.
  void joint(int axis, double angle_rad, double speed_rad_s, double observed_nm = 0);
  /// Counts of the joint, as the next run gets them.
  std::int32_t counts(int axis) const { return inputs_[static_cast<std::size_t>(3 * axis)]; }
  /// The angle of these counts.
  double counted_rad(int axis) const { return counts(axis) * design_.count_rad; }
  /// One run of the law. Errors: std::runtime_error, of a program that does not end.
  void run();
  /// What the last run asks of a joint, Nm, within the design's torque word.
  double torque_nm(int axis) const;
  /// A state as the last run left it, SI.
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
