// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Evaluates a law beside a run, without rate, counts and rounding: it gives the ideal torques and
// the error of the core's torques. Documentation: docs/speed-for-accuracy.md
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "law/evaluate.hpp"
#include "sim/loop/columns.hpp"
#include "sim/loop/figures.hpp"
#include "sim/loop/scenario.hpp"
#include "studies/stability/law_loop.hpp"

namespace feltgate::rates {

// A law with states, delay lines or a host as a linear law near a place of its run.

/// Where a law was in a run, SI: its inputs in the order of stability::LinearLaw, states,
/// parameters, and each line's values, the newest first.
struct Place {
  Eigen::VectorXd inputs;
  std::vector<double> states, parameters;
  std::vector<std::vector<double>> lines = {};
  Eigen::VectorXd at_rad = {};  ///< angles of the device, whose zero is not the law's
  double most_nm_rad = 0;       ///< stability::Steepness there
};

/// What a host sends after it has sampled these positions (the law's): filtered, and as they were.
using HostWords = std::function<void(const Eigen::VectorXd& filtered,
                                     const Eigen::VectorXd& sampled, law::Evaluation<double>& law)>;

/// The place of a motion where a law is the stiffest spring at 50 Hz, of several axes the one of
/// the fastest swing; where it is nowhere a spring, that with the most torque per angle.
class Places {
 public:
  void note(const Place& place, const stability::LinearLaw& law, double period_s,
            const Eigen::MatrixXd& per_torque);
  /// nullptr: none was noted that has a torque.
  const Place* steepest() const {
    return best_[0].value > 0 ? &best_[0].place : best_[1].value > 0 ? &best_[1].place : nullptr;
  }
  bool any_states() const { return any_states_; }  ///< some law there has states in the loop
  bool any_host() const { return any_host_; }      ///< some torque there is of what a host sampled

 private:
  struct Best {
    double value = 0;
    Place place;
  };
  Best best_[2];
  bool any_states_ = false, any_host_ = false;
};

/// The derivative of a law of so many axes there, without states that are whole numbers or phases,
/// which stay. `words`: of its host; empty: none. Nothing where the law has a jump within a count.
std::optional<stability::LinearLaw> linearised(const law::Law& law, const Place& place,
                                               double count_rad, const HostWords& words = {});

/// Slopes of the torques at the steepest place of the law that the motion reached; with several
/// axes, along the direction of the largest change.
struct Slope {
  double stiffness_nm_rad = 0;  ///< at the steepest place that is not a jump
  double damping_nm_s_rad = 0;  ///< at that place; the largest one if no place is stiff
  double jump_nm = 0;           ///< largest step of a torque at one position
  /// Somewhere the torque of one axis depends on another's angle but not vice versa, and no
  /// direction is stiff: the axes drive each other.
  bool coupled = false;
  /// Matrices at that place, with a row per torque and a column per axis: decrease of torque per
  /// angle and per speed, torque per tau_hat; and the device's angles. Empty if the law has neither
  /// stiffness nor damping.
  Eigen::MatrixXd stiffness, damping, observed;
  Eigen::VectorXd at_rad;
};

/// A change of a law's parameter: time and new value.
struct Change {
  double at_s = 0;
  std::size_t parameter = 0;
  double si = 0;
};

/// The changes of a scene that runs this law, in order of time; changes before the run are at 0 s.
std::vector<Change> changes_of(const Scenario& scene, const law::Law& law);

/// A design's velocity estimate in double, from the counts of one axis; its inputs of a law are
/// held over its tick.
struct Estimator {
  int every = 1;  ///< ticks of the run in one of the design
  int m1 = 1;
  double raw_rad_s_rad = 0;  ///< raw velocity per radian of travel in m1 ticks
  double a1 = 1;
};

/// The evaluation for a device with one or several axes; a row holds the loop's values of an axis
/// in a tick.
class Continuous {
 public:
  struct Setting {
    std::size_t axes = 1;
    double count_rad = 0;
    double limit_nm = 0;  ///< of the torque reference of each axis
    double run_s = 1e-6;  ///< from run to run
    int every = 1;        ///< ticks between two runs: 1, except for laws whose states count runs
    bool slope = false;   ///< search the steepest place
    /// Inertia of several axes at these angles, kg m^2: the steepest place is the one with the
    /// fastest oscillation.
    std::function<Eigen::MatrixXd(const Eigen::VectorXd&)> inertia;
    bool places = false;            ///< search the place for a law with states or a host
    HostWords words;                ///< of that host; empty: none
    bool floor = false;             ///< also run the law from the counts
    std::vector<Estimator> beside;  ///< of one axis: also run it from the counts by these
  };
  /// The law must outlive this.
  Continuous(const law::Law& law, std::vector<Change> changes, const Setting& setting);

  /// Call this for each tick of the core, with a row per axis.
  void tick(const std::vector<Row>& axes) { tick(axes.data()); }
  void tick(const Row& row) { tick(&row); }
  /// Notes that the host has set a parameter, from the next tick on.
  void set(std::size_t parameter, double si);

  /// Torque reference minus the law's torque at the device's true angles and speeds, Nm, of all
  /// axes. Excluded are ticks in which a motor is disarmed, its torque ramps, the core reduces a
  /// torque that is held too long, or a mailbox of the law is too old.
  const ErrorFigure& error() const { return error_; }
  const ErrorFigure& error(std::size_t axis) const { return axes_[axis].error; }
  double mean_error_nm(std::size_t axis = 0) const;
  /// The same error for the law in double in every tick, computed from the counts and the velocity
  /// of the core: no rate can reduce it.
  const ErrorFigure& floor() const { return floor_; }
  /// The same error with the n-th estimator of the setting.
  const ErrorFigure& beside(std::size_t n) const { return beside_[n].error; }
  const Slope& slope() const { return slope_; }
  const Places& places() const { return places_; }
  double largest_nm() const { return largest_nm_; }  ///< largest limited torque of any axis

 private:
  /// Inputs of a law for one axis.
  struct Sample {
    double position_rad = 0, velocity_rad_s = 0, tau_hat_nm = 0;
  };
  struct Axis {
    bool driven = false;  ///< the law has a torque for it
    double zero_rad = 0;  ///< the true angle at which the core's position is 0
    double ideal_nm = 0, of_counts_nm = 0, sum_nm = 0;
    ErrorFigure error;
  };
  struct Beside {
    Estimator by;
    law::Evaluation<double> law;
    std::vector<double> travelled_rad;  ///< of the last m1 ticks, a ring
    std::int64_t ticks = 0;
    std::vector<Sample> held;
    double of_counts_nm = 0;
    ErrorFigure error;
  };
  void estimate(Beside& b, const Row& row) const;
  void tick(const Row* rows);
  void place(const Row* rows);
  void run(law::Evaluation<double>& law, const std::vector<Sample>& samples, double Axis::*to_nm);
  double limited(double nm) const;
  /// Torques at `samples`, computed by a copy of the law that does not change this run.
  Eigen::VectorXd probe(const std::vector<Sample>& samples);
  /// Decrease of the torques over one input of each axis, from `step` below to `step` above.
  Eigen::MatrixXd fall(double Sample::*input, double step);
  /// Whether the decrease over a count (`wide`) and over a sixteenth of it (`narrow`) belongs to a
  /// slope; notes jumps.
  bool smooth(const Eigen::MatrixXd& wide, const Eigen::MatrixXd& narrow);
  void look();
  void look_at_place();
  Eigen::MatrixXd per_torque(const Eigen::VectorXd& at_rad) const;
  Eigen::VectorXd at_rad() const;

  const law::Law& law_;
  std::vector<Change> changes_;
  Setting setting_;
  law::Evaluation<double> true_, sampled_;
  std::vector<double> inputs_;
  std::vector<std::vector<double>> lines_;  ///< what the true law wrote into each, newest first
  std::vector<Sample> seen_, counted_;
  std::vector<Axis> axes_;
  std::vector<Beside> beside_;
  std::size_t next_ = 0;
  std::int64_t ticks_ = 0, runs_ = 0;
  bool placed_ = false;
  double largest_nm_ = 0;
  double steepest_ = 0, steepest_nm_ = 0;  ///< measure of steepness, and the torque there
  bool observes_ = false;                  ///< the law reads tau_hat
  ErrorFigure error_, floor_;
  Slope slope_;
  Places places_;
};

}  // namespace feltgate::rates
