// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// What the tests of the page's law loops share: images of shipped laws, and the closed form of a
// hand's step. Documentation: docs/page.md
#pragma once

#include <cmath>
#include <string>

#include "apps/page/law_loop.hpp"
#include "catch.hpp"
#include "law/compile.hpp"
#include "law/read_law.hpp"
#include "sim/backends/backend.hpp"

namespace feltgate::page {

inline const std::string root = FELTGATE_ROOT;
inline const plant::Impedance hand;
inline const double hand_nm_rad = hand.stiffness_n_m * Lever::radius_m * Lever::radius_m;
inline const double count_rad = design_named("lever").count_rad;

/// A shipped law at this rate; 0: at its own.
inline law::Compiled shipped(const std::string& law, const std::string& design = "lever",
                             double rate_hz = 0) {
  return law::compile(law::read_law(root + "/rtl/laws/" + law + ".law", rate_hz),
                      law::target_of(design_named(design)));
}
inline std::string image_of(const std::string& law, const std::string& design = "lever") {
  return law::text(shipped(law, design).image);
}

/// What is left at t of a step of the hand by 1, on a body in it of this mass in all and friction
/// of its own. The step goes through the hand's damper too, which throws the body.
struct Swing {
  double a, thrown, w;
  explicit Swing(double mass, double own = 0)
      : a((hand.damping_ns_m + own) / mass / 2),
        thrown(hand.damping_ns_m / mass),
        w(std::sqrt(hand.stiffness_n_m / mass - a * a)) {}
  double left(double t) const {
    return std::exp(-a * t) * (std::cos(w * t) + (a - thrown) / w * std::sin(w * t));
  }
};

}  // namespace feltgate::page
