// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// A law that someone writes on the page: what is wrong with it, what came of it, and its torque
// over a turn by the interpreter. Documentation: docs/page.md
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "engine/machine.hpp"
#include "law/compile.hpp"
#include "law/diagnostics.hpp"
#include "law/load.hpp"
#include "loop/scene_law.hpp"

namespace feltgate::page {

/// A parameter that someone may turn; values in `unit`.
struct LawParameter {
  std::string name, unit, comment;
  double value = 0, low = 0, high = 0;
  double step = 0;  ///< of its word; of integers 1
};

/// A law of one axis, compiled for one design.
class UserLaw {
 public:
  /// Errors: law::LawError with all that is wrong, each at its place.
  UserLaw(const std::string& text, const DesignInfo& design);
  UserLaw(const UserLaw&) = delete;
  UserLaw& operator=(const UserLaw&) = delete;

  /// The table that `feltgate law` prints, with so many random runs beside the law in double.
  std::string report(int runs) const;
  std::vector<LawParameter> parameters() const;
  /// The law for a loop, as often as wanted; each has its own values.
  std::unique_ptr<SceneLaw> scene() const;

  /// For curve(). Errors: std::invalid_argument for an unknown name or a value out of its range.
  void set(const std::string& name, double value);
  /// Torques in Nm at `points` positions, the first and the last half a turn from 0, on the way up
  /// and then, as many, on the way back down: words of the program. Velocity and tau_hat are 0.
  /// States go on from run to run, so a law that remembers has two ways; at each place it runs
  /// until its torque stays, 16 times at most.
  std::vector<double> curve(int points) const;

 private:
  DesignInfo design_;
  law::Compiled law_;
  law::LoadedParameters values_;
  law::Machine machine_;
};

}  // namespace feltgate::page
