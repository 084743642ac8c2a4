// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// A law with states, delay lines or a host as a linear law near a place of its run. Documentation:
// docs/speed-for-accuracy.md
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "law/evaluate.hpp"
#include "studies/stability/law_loop.hpp"

namespace feltgate::rates {

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

}  // namespace feltgate::rates
