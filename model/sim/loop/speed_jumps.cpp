// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Finds jumps in the speed that a scene's hand imposes. Documentation: docs/plant.md
#include "sim/loop/speed_jumps.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "sim/loop/felt.hpp"

namespace feltgate {

namespace {

using plant::HandPhase;

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

/// Follows angle and speed of the lever through the phases; NaN: known only in a run.
class Jumps {
 public:
  Jumps(const Scenario& s, const plant::Hand& hand, double inertia_kg_m2)
      : s_(s), inertia_kg_m2_(inertia_kg_m2), rad_(hand.initial_rad()) {}

  void add(const HandPhase& phase, bool last) {
    double left_s = last ? std::numeric_limits<double>::infinity() : phase.duration_s;
    int line = phase.line;
    switch (kind_of(phase)) {
      case HandPhase::Kind::kPrescribed:
        for (const plant::Segment& segment : phase.profile) {
          if (!(left_s > 0)) return;
          line = segment.line > 0 ? segment.line : line;
          impose(segment, std::min(segment.duration_s, left_s), line);
          left_s -= segment.duration_s;
        }
        if (left_s > 0) stand(line);
        break;
      case HandPhase::Kind::kTrace:  // at rest at both ends
        stand(line);
        rad_ = unknown;
        break;
      case HandPhase::Kind::kLocked:
        stand(line);
        break;
      default:
        rad_ = rad_s_ = unknown;
    }
    at_s_ += std::max(left_s, 0.0);
  }
  std::vector<std::string> all() const { return all_; }

 private:
  HandPhase::Kind kind_of(const HandPhase& phase) const {
    const bool imposed = phase.kind == HandPhase::Kind::kImpedance && !s_.effects.hand_dynamics;
    return imposed ? HandPhase::Kind::kPrescribed : phase.kind;
  }

  void impose(const plant::Segment& segment, double length_s, int line) {
    plant::ProfileRun run({segment}, rad_);
    tell(run.at(0).rate, line);
    rad_s_ = run.at(std::nextafter(length_s, 0.0)).rate;
    rad_ = run.at(length_s).value;
    at_s_ += length_s;
  }

  void stand(int line) {
    tell(0, line);
    rad_s_ = 0;
  }

  void tell(double to_rad_s, int line) {
    const double by = to_rad_s - rad_s_;
    if (std::isnan(by) || std::abs(by) < least_jump_rad_s || at_s_ >= s_.duration_s) return;
    const char* mend =
        all_.empty()
            ? "; write kind = \"minimum_jerk\", a ramp with ease_s, or a sine with phase_rad = "
              "1.5707963, which begin at rest, or hold the lever with kind = \"impedance\""
            : "";
    all_.push_back(fmt::format(
        "{}{}: the hand's speed jumps by {:.3g} rad/s at {:.4g} s, which costs the hand {:.3g} Nm "
        "over 1 ms for the lever's inertia alone{}",
        s_.path, line > 0 ? fmt::format(":{}", line) : "", by, at_s_,
        std::abs(inertia_kg_m2_ * by) / felt_window_s, mend));
  }

  const Scenario& s_;
  double inertia_kg_m2_, rad_, rad_s_ = 0, at_s_ = 0;
  std::vector<std::string> all_;
};

}  // namespace

std::vector<std::string> speed_jumps(const Scenario& scenario, const plant::Parameters& plant) {
  return speed_jumps(scenario, scenario.hand, plant.lever.inertia_kg_m2);
}

std::vector<std::string> speed_jumps(const Scenario& scenario, const plant::Hand& hand,
                                     double inertia_kg_m2) {
  Jumps jumps(scenario, hand, inertia_kg_m2);
  const auto& phases = hand.phases;
  for (const HandPhase& phase : phases) jumps.add(phase, &phase == &phases.back());
  return jumps.all();
}

}  // namespace feltgate
