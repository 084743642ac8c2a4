// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Energy that a hand gives to a device and gets back, from the work that the plant counts.
// Documentation: docs/devices.md
#pragma once

#include <algorithm>

#include "feltgate/largest.hpp"
#include "sim/loop/felt.hpp"

namespace feltgate {

/// Sums of the energy in both directions.
class HandWork {
 public:
  /// Updates the sums; `work_j` is the plant's present count, J.
  void follow(double work_j) {
    const double more_j = work_j - net_j_;
    net_j_ = work_j;
    (more_j > 0 ? energy_.taken_from_hand_j : given_j_) += more_j;
    energy_.peak_from_hand_j = larger(energy_.peak_from_hand_j, net_j_);
    energy_.peak_to_hand_j = larger(energy_.peak_to_hand_j, -net_j_);
  }
  double net_j() const { return net_j_; }
  FeltEnergy energy() const {
    FeltEnergy energy = energy_;
    energy.given_to_hand_j = 0.0 - given_j_;
    return energy;
  }

 private:
  FeltEnergy energy_;
  double net_j_ = 0, given_j_ = 0;
};

}  // namespace feltgate
