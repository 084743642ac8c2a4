// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// A law that a user writes on the page: its errors, its report, and its torque over a turn as the
// interpreter computes it. Documentation: docs/page.md
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "law/compile.hpp"
#include "law/diagnostics.hpp"
#include "law/engine/machine.hpp"
#include "law/load.hpp"
#include "sim/loop/scene_law.hpp"

namespace feltgate::page {

/// A parameter that the user can adjust; values in `unit`.
struct LawParameter {
  std::string name, unit, comment;
  double value = 0, low = 0, high = 0;
  double step = 0;  ///< LSB of its word; 1 for integers
};

/// A law of one axis, compiled for one design.
class UserLaw {
 public:
  /// Compiles `text`. Throws law::LawError with all errors and their places.
  UserLaw(const std::string& text, const DesignInfo& design);
  UserLaw(const UserLaw&) = delete;
  UserLaw& operator=(const UserLaw&) = delete;

  /// The table that `feltgate law` prints, with `runs` random runs compared to the law in double.
  std::string report(int runs) const;
  std::vector<LawParameter> parameters() const;
  /// A new instance of the law for a loop; each instance has its own values.
  std::unique_ptr<SceneLaw> scene() const;

  /// Sets a parameter for curve(). Throws std::invalid_argument for an unknown name or a value out
  /// of its range.
  void set(const std::string& name, double value);
  /// Torques in Nm, from the program's words, at `points` positions from half a turn below 0 to
  /// half a turn above it, and then at as many on the way back. Velocity and tau_hat are 0. States
  /// continue from run to run, so a law with memory has two branches. At each position the law runs
  /// until its torque settles, at most 16 times.
  std::vector<double> curve(int points) const;

 private:
  DesignInfo design_;
  law::Compiled law_;
  law::LoadedParameters values_;
  law::Machine machine_;
};

}  // namespace feltgate::page
