// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// A law with states as a linear law near a place of its run. Documentation: docs/rates.md
#pragma once

#include <optional>
#include <vector>

#include "law/evaluate.hpp"
#include "studies/stability/law_loop.hpp"

namespace feltgate::rates {

/// Where a law was in a run: its inputs, states and parameters, SI.
struct Place {
  double position_rad = 0, velocity_rad_s = 0, tau_hat_nm = 0;
  std::vector<double> states, parameters;
  double most_nm_rad = 0;  ///< stability::Steepness there
};

/// The place of a motion where a law of one axis is the stiffest spring at 50 Hz; where it is
/// nowhere a spring, that with the most torque per angle.
class Places {
 public:
  void note(const Place& place, const stability::LinearLaw& law, double period_s);
  /// nullptr: none was noted that has a torque.
  const Place* steepest() const {
    return best_[0].value > 0 ? &best_[0].place : best_[1].value > 0 ? &best_[1].place : nullptr;
  }
  bool any_states() const { return any_states_; }  ///< some law there has states in the loop

 private:
  struct Best {
    double value = 0;
    Place place;
  };
  Best best_[2];
  bool any_states_ = false;
};

/// The derivative of a law of one axis there, without states that are whole numbers or phases,
/// which stay. Nothing where the law has a jump within a count, or a delay line.
std::optional<stability::LinearLaw> linearised(const law::Law& law, const Place& place,
                                               double count_rad);

}  // namespace feltgate::rates
