// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// All that `feltgate stability` finds out. Documentation: docs/speed-for-accuracy.md
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "studies/stability/linear_loop.hpp"

namespace feltgate::stability {

/// The border at one scene rate and one damping.
struct BorderPoint {
  double rate_hz = 0;  ///< asked for
  int scene_ticks = 0;
  double damping_nm_s_rad = 0;
  Border exact;                 ///< by eigenvalues
  double bits_nm_rad = 0;       ///< by bisection on the chain's own bits; NaN: not found
  double closed_nm_rad = 0;     ///< (b+B)/(T/2+td)
  double estimator_nm_rad = 0;  ///< the same with the lag of the velocity estimator
  double swing_counts = 0;      ///< how large the swing of the bit-exact loop is, in counts
  double z_width = 0;           ///< border over the impedance of the free lever at 10 Hz
};

struct Study {
  std::string design, linear_plant, full_plant;
  LoopModel model;
  std::vector<BorderPoint> borders;
  double rule_nm_rad = 0;  ///< 2 f / q: below it friction can hold a lever between two counts
};

struct StudyOptions {
  std::vector<double> rates_hz{144, 490, 1e3, 40e3, 1e6};
  std::vector<double> damping_nm_s_rad{0, 0.001, 0.002, 0.005, 0.01, 0.02};
  bool bits = true;                           ///< bisection on the bit-exact loop
  std::function<void(double done)> progress;  ///< 0..1; may be empty
};

/// Errors: std::invalid_argument for a rate outside 1 to 1e6 Hz or a damping outside 0 to 1.
/// `design` must be built in; `linear` has no friction, dead voltage and dead time.
Study run_study(const design::Elaborated& design, const plant::Parameters& linear,
                const plant::Parameters& full, const StudyOptions& options);

/// The study as text for a terminal.
std::string study_text(const Study& study);

/// Schema feltgate-stability/2, pretty-printed.
std::string study_json(const Study& study);

}  // namespace feltgate::stability
