// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// A compiled law of several axes for a loop: loaded by the host's writes, beside it the law in real
// numbers on the words that the engine got. Documentation: docs/devices.md
#pragma once

#include <array>
#include <map>
#include <memory>
#include <string>

#include "engines/axes_cores.hpp"
#include "law/compile.hpp"
#include "loop/scene_law.hpp"

namespace feltgate {

/// The law in real numbers: the same runs on the same words as the engine's.
class AxesLawRider {
 public:
  using Torques = std::array<double, most_axes>;
  virtual ~AxesLawRider() = default;
  /// As after arming and entry into the scene.
  virtual void enter() = 0;
  /// The next value that the host has set comes into force.
  virtual void change() = 0;
  /// Torques of the run that is in force in the tick, Nm; nullptr: not known.
  virtual const Torques* torques_nm(const AxesSnapshot& s) = 0;
  /// The run that began with this tick, if one did. After torques_nm().
  virtual void follow(const AxesSnapshot& s) = 0;
};

class AxesLaw {
 public:
  virtual ~AxesLaw() = default;
  /// What the host loads, and the ranges of its parameters.
  virtual const SceneLaw& host() const = 0;
  /// SceneLaw::set().
  virtual SceneLaw::Writes set(const std::map<std::string, double>& values) = 0;
  /// Axes that it gives torques for.
  virtual int axes() const = 0;
  virtual double rate_hz() const = 0;
  /// From sample to torque, ticks.
  virtual int divider() const = 0;
  /// Largest error of an axis' torque against the law in real numbers on the same words, Nm;
  /// infinite where its states are not bounded, or a comparison can go the other way.
  virtual double bound_nm(std::size_t axis) const = 0;
  /// "double" or "quad", with the values of before the first set().
  virtual std::unique_ptr<AxesLawRider> rider(const std::string& kind) const = 0;
};

/// The law of a file for a design with `axes` axes. Errors: law::LawError, law::Refused,
/// std::invalid_argument where it has not exactly these axes.
std::unique_ptr<AxesLaw> make_axes_law(const std::string& path, const DesignInfo& design, int axes);
/// One that is compiled for the design; `path` is for messages.
std::unique_ptr<AxesLaw> make_axes_law(law::Compiled law, const std::string& path,
                                       const DesignInfo& design, int axes);

}  // namespace feltgate
