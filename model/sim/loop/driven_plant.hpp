// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The plant of a run with what drives it: a motor with brushes behind an H-bridge, or one with
// three phases behind three legs. Documentation: docs/plant.md
#pragma once

#include <algorithm>
#include <cstddef>
#include <variant>

#include "../backends/backend.hpp"
#include "../plant/drive.hpp"
#include "../plant/three_phase.hpp"

namespace feltgate {

/// Where a core's gates or duty move a plant. The core's last bridge state drives the motor.
class DrivenPlant {
 public:
  /// `switched`: by its gates. Errors: std::invalid_argument for an impossible drive.
  DrivenPlant(const plant::Parameters& parameters, const plant::Effects& effects,
              const plant::Hand& hand, const DesignInfo& design, bool switched)
      : switched_(switched),
        period_(design.pwm_period),
        plant_(made(parameters, effects, plant::drive_of(design), hand)) {}

  plant::ShaftPlant& shaft() {
    return std::visit([](auto& p) -> plant::ShaftPlant& { return p; }, plant_);
  }
  std::size_t state_size() const {
    return std::visit([](const auto& p) { return p.state().size(); }, plant_);
  }
  plant::Evaluations evaluations() const {
    return std::visit([](const auto& p) { return p.evaluations(); }, plant_);
  }
  /// Of a motor with three phases.
  void open_phase(std::size_t phase) { std::get<plant::ThreePhasePlant>(plant_).open_phase(phase); }

  /// Advances by `clocks`; the core's gates are those of its last `last` clocks.
  void advance(const Backend& core, Clock last, Clock clocks) {
    if (auto* brushed = std::get_if<plant::Plant>(&plant_)) {
      brushed->advance(bridge(core, last), clocks);
    } else {
      std::get<plant::ThreePhasePlant>(plant_).advance(legs(core, last), clocks);
    }
  }
  /// The same for a duty, in clocks, that is none of the core's; only behind an H-bridge.
  void advance(double duty_clocks, bool enabled, Clock clocks) {
    const double duty = std::clamp(duty_clocks / period_, -1.0, 1.0);
    std::get<plant::Plant>(plant_).advance(plant::Bridge::averaged(duty, enabled), clocks);
  }

 private:
  using Either = std::variant<plant::Plant, plant::ThreePhasePlant>;

  static Either made(const plant::Parameters& p, const plant::Effects& effects,
                     const plant::Drive& drive, const plant::Hand& hand) {
    if (!p.phases) return Either(std::in_place_index<0>, p, effects, drive, hand);
    return Either(std::in_place_index<1>, p, *p.phases, effects, drive, hand);
  }

  plant::Bridge bridge(const Backend& core, Clock last) {
    if (switched_) {
      const GateClocks g = core.gates();
      const double n = steps(last);
      return plant::Bridge::gates(static_cast<double>(g.a_hi) / n, static_cast<double>(g.a_lo) / n,
                                  static_cast<double>(g.b_hi) / n, static_cast<double>(g.b_lo) / n);
    }
    if (core.duty() != duty_clocks_) {
      duty_clocks_ = core.duty();
      duty_ = static_cast<double>(duty_clocks_) / period_;
    }
    return plant::Bridge::averaged(duty_, core.gates_enabled());
  }

  plant::Legs legs(const Backend& core, Clock last) const {
    if (switched_) {
      const GateClocks g = core.gates();
      const double n = steps(last);
      return plant::Legs::gates(static_cast<double>(g.a_hi) / n, static_cast<double>(g.a_lo) / n,
                                static_cast<double>(g.b_hi) / n, static_cast<double>(g.b_lo) / n,
                                static_cast<double>(g.c_hi) / n, static_cast<double>(g.c_lo) / n);
    }
    plant::Phases duty;
    for (std::size_t k = 0; k < duty.size(); ++k) duty[k] = core.on_time(k) / period_;
    return plant::Legs::averaged(duty, core.gates_enabled());
  }

  /// 0 before the first step.
  static double steps(Clock last) { return static_cast<double>(std::max<Clock>(last, 1)); }

  bool switched_;
  double period_;  ///< of the PWM, clocks
  Either plant_;
  int duty_clocks_ = 0;  ///< duty of the bridge; duty_ is its share of a period
  double duty_ = 0;
};

}  // namespace feltgate
