// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// A law without rate, counts and rounding beside a run: what the torques should be, and how far
// from them the core's are. Documentation: docs/rates.md
#pragma once

#include <Eigen/Dense>
#include <functional>
#include <string>
#include <vector>

#include "law/evaluate.hpp"
#include "loop/columns.hpp"
#include "loop/figures.hpp"
#include "loop/scenario.hpp"

namespace feltgate::rates {

/// How the torques change where the motion met the law at its steepest; of several axes along the
/// direction in which they change most.
struct Slope {
  double stiffness_nm_rad = 0;  ///< of the steepest place that is no jump
  double damping_nm_s_rad = 0;  ///< there, or the largest where nothing is stiff
  double jump_nm = 0;           ///< largest step of a torque at one position
  /// Somewhere an axis' torque changes with another's angle, not the other way round, and no
  /// direction is stiff: the axes drive each other.
  bool coupled = false;
  /// There, a row a torque, a column an axis: less torque per angle and per speed, torque per
  /// tau_hat; and the device's angles. Empty where the law has neither stiffness nor damping.
  Eigen::MatrixXd stiffness, damping, observed;
  Eigen::VectorXd at_rad;
};

/// What a value of the law's parameter becomes, and when.
struct Change {
  double at_s = 0;
  std::size_t parameter = 0;
  double si = 0;
};

/// The changes of a scene that runs this law, in order of time; those of before the run at 0 s.
std::vector<Change> changes_of(const Scenario& scene, const law::Law& law);

/// Of a device with one axis or several; a row is what the loop tells of an axis in a tick.
class Continuous {
 public:
  struct Setting {
    std::size_t axes = 1;
    double count_rad = 0;
    double limit_nm = 0;  ///< of the torque reference of each axis
    int every = 1;        ///< ticks between two runs: 1, but for a law whose states count runs
    bool slope = false;   ///< look for the steepest place
    /// Of several axes at these angles, kg m^2: steepest is where a swing would be the fastest.
    std::function<Eigen::MatrixXd(const Eigen::VectorXd&)> inertia;
    bool floor = false;  ///< run it from the counts, too
  };
  /// The law must outlive this.
  Continuous(const law::Law& law, std::vector<Change> changes, const Setting& setting);

  /// A tick of the core, called for each; a row an axis.
  void tick(const std::vector<Row>& axes) { tick(axes.data()); }
  void tick(const Row& row) { tick(&row); }
  /// The host has set a parameter, from the next tick on.
  void set(std::size_t parameter, double si);

  /// Torque reference less the law at the device's true angles and speeds, Nm, of all axes. Left
  /// out are ticks in which an axis' motor is disarmed, its torque ramps, the core relieves a
  /// torque that is held, or a mailbox of the law is too old.
  const ErrorFigure& error() const { return error_; }
  const ErrorFigure& error(std::size_t axis) const { return axes_[axis].error; }
  double mean_error_nm(std::size_t axis = 0) const;
  /// The same of the law in double in every tick, from the counts and the velocity of the core:
  /// what no rate makes smaller.
  const ErrorFigure& floor() const { return floor_; }
  const Slope& slope() const { return slope_; }
  double largest_nm() const { return largest_nm_; }  ///< of the law, limited, on any axis

 private:
  /// What a law may see of an axis.
  struct Sample {
    double position_rad = 0, velocity_rad_s = 0, tau_hat_nm = 0;
  };
  struct Axis {
    bool driven = false;  ///< the law has a torque for it
    double zero_rad = 0;  ///< the true angle at which the core's position is 0
    double ideal_nm = 0, of_counts_nm = 0, sum_nm = 0;
    ErrorFigure error;
  };
  void tick(const Row* rows);
  void place(const Row* rows);
  void run(law::Evaluation<double>& law, const std::vector<Sample>& samples, double Axis::*to_nm);
  double limited(double nm) const;
  /// Torques by a copy, which this run does not change.
  Eigen::VectorXd probe(const std::vector<Sample>& samples);
  /// How they change with one input of each axis, to either side of the samples by `step`.
  Eigen::MatrixXd fall(double Sample::*input, double step);
  /// Whether torques that fall by so much over a count and over a sixteenth of it are of a slope;
  /// notes jumps.
  bool smooth(const Eigen::MatrixXd& wide, const Eigen::MatrixXd& narrow);
  void look();

  const law::Law& law_;
  std::vector<Change> changes_;
  Setting setting_;
  law::Evaluation<double> true_, sampled_;
  std::vector<double> inputs_;
  std::vector<Sample> seen_, counted_;
  std::vector<Axis> axes_;
  std::size_t next_ = 0;
  std::int64_t ticks_ = 0, runs_ = 0;
  bool placed_ = false;
  double largest_nm_ = 0;
  double steepest_ = 0, steepest_nm_ = 0;  ///< what is compared, and the torque there
  bool observes_ = false;                  ///< the law has tau_hat
  ErrorFigure error_, floor_;
  Slope slope_;
};

}  // namespace feltgate::rates
