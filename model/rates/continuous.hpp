// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// A law without rate, counts and rounding beside a run: what the torque should be, and how far from
// it the core's is. Documentation: docs/rates.md
#pragma once

#include <string>
#include <vector>

#include "law/evaluate.hpp"
#include "law/image.hpp"
#include "loop/columns.hpp"
#include "loop/figures.hpp"
#include "loop/scenario.hpp"

namespace feltgate::rates {

/// How the torque changes where the motion met the law at its steepest.
struct Slope {
  double stiffness_nm_rad = 0;  ///< of the steepest place that is no jump
  double damping_nm_s_rad = 0;  ///< there, or the largest where nothing is stiff
  double jump_nm = 0;           ///< largest step of the torque at one position
};

/// What a value of the law's parameter becomes, and when.
struct Change {
  double at_s = 0;
  std::size_t parameter = 0;
  double si = 0;
};

/// The changes of a scene that runs this law, in order of time; those of before the run at 0 s.
/// With an image its values are those that its words say.
std::vector<Change> changes_of(const Scenario& scene, const law::Law& law,
                               const law::Image* image = nullptr);

class Continuous {
 public:
  struct Setting {
    double count_rad = 0;
    double limit_nm = 0;  ///< of the torque reference
    int every = 1;        ///< ticks between two runs: 1, but for a law with a rate of its own
    bool slope = false;   ///< look for the steepest place and for the floor
  };
  /// The law must outlive this.
  Continuous(const law::Law& law, std::vector<Change> changes, const Setting& setting);

  /// A tick of the core; called for each.
  void tick(const Row& row);

  /// Torque reference less the law at the lever's true angle and speed, Nm. Left out are ticks in
  /// which the motor is disarmed, the torque ramps, or the core relieves a torque that is held.
  const ErrorFigure& error() const { return error_; }
  double mean_error_nm() const { return error_.count() == 0 ? 0 : sum_nm_ / count(); }
  /// The same of the law in double in every tick, from the counts and the velocity of the core:
  /// what no rate makes smaller.
  const ErrorFigure& floor() const { return floor_; }
  const Slope& slope() const { return slope_; }
  double largest_nm() const { return largest_nm_; }  ///< of the law, limited

 private:
  double count() const { return static_cast<double>(error_.count()); }
  void fill(double position_rad, double velocity_rad_s, double tau_hat_nm);
  double torque(law::Evaluation<double>& law);
  /// Of a copy, which this run does not change.
  double probe(double position_rad, double velocity_rad_s, double tau_hat_nm);
  void look(double position_rad, double velocity_rad_s, double tau_hat_nm);

  const law::Law& law_;
  std::vector<Change> changes_;
  Setting setting_;
  law::Evaluation<double> true_, sampled_;
  std::vector<double> inputs_;
  std::size_t next_ = 0;
  std::int64_t ticks_ = 0, runs_ = 0;
  bool placed_ = false;
  double zero_rad_ = 0;  ///< the true angle at which the core's position is 0
  double ideal_nm_ = 0, of_counts_nm_ = 0, sum_nm_ = 0, largest_nm_ = 0, steepest_nm_ = 0;
  ErrorFigure error_, floor_;
  Slope slope_;
};

}  // namespace feltgate::rates
