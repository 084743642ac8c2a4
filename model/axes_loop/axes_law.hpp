// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// A compiled law of several axes for a closed loop: the host's writes that load it, and the law in
// real numbers beside it, on the words that the engine got. Documentation: docs/devices.md
#pragma once

#include <array>
#include <map>
#include <memory>
#include <string>

#include "engines/axes_cores.hpp"
#include "law/compile.hpp"
#include "loop/scene_law.hpp"

namespace feltgate {

/// The law in real numbers; it runs when the engine's program runs, on the same words.
class AxesLawRider {
 public:
  using Torques = std::array<double, most_axes>;
  virtual ~AxesLawRider() = default;
  /// Sets the state after arming and entry into the scene.
  virtual void enter() = 0;
  /// The next set of host values comes into force.
  virtual void change() = 0;
  /// Torques, in Nm, of the run that is in force in this tick; nullptr if not known.
  virtual const Torques* torques_nm(const AxesSnapshot& s) = 0;
  /// Executes the run that began with this tick, if any; call it after torques_nm().
  virtual void follow(const AxesSnapshot& s) = 0;
};

/// A compiled law of several axes, for one design.
class AxesLaw {
 public:
  virtual ~AxesLaw() = default;
  /// The law as the host loads it, with the ranges of its parameters.
  virtual const SceneLaw& host() const = 0;
  /// Like SceneLaw::set().
  virtual SceneLaw::Writes set(const std::map<std::string, double>& values) = 0;
  /// Number of axes for which it gives torques.
  virtual int axes() const = 0;
  virtual double rate_hz() const = 0;
  /// Ticks from sample to torque.
  virtual int divider() const = 0;
  /// Largest error of an axis' torque against the law in real numbers on the same words, Nm.
  /// Infinite if its states are not bounded, or if a comparison can have the other result.
  virtual double bound_nm(std::size_t axis) const = 0;
  /// A rider, "double" or "quad"; it starts with the values before the first set().
  virtual std::unique_ptr<AxesLawRider> rider(const std::string& kind) const = 0;
};

/// The law of a file, for a design with `axes` axes. Errors: law::LawError, law::Refused;
/// std::invalid_argument if it does not have exactly these axes.
std::unique_ptr<AxesLaw> make_axes_law(const std::string& path, const DesignInfo& design, int axes);
/// The same for a law that is compiled for the design; `path` is used in messages.
std::unique_ptr<AxesLaw> make_axes_law(law::Compiled law, const std::string& path,
                                       const DesignInfo& design, int axes);

}  // namespace feltgate
