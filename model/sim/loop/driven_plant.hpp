// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The plant of a run with what drives it: a motor with brushes behind an H-bridge, or one with
// three phases behind three legs. Documentation: docs/plant.md
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <variant>
#include <vector>

#include "../backends/backend.hpp"
#include "../plant/drive.hpp"
#include "../plant/sigma_delta.hpp"
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
        hall_(design.hall ? parameters.phases->hall : std::nullopt),
        plant_(made(parameters, effects, plant::drive_of(design), hand)) {
    if (design.current_full_scale_a > 0) {
      modulators_.assign(design.phases == 3 ? 2 : 1,
                         plant::SigmaDelta(design.current_full_scale_a));
    }
  }

  const plant::ShaftPlant& shaft() const {
    return std::visit([](const auto& p) -> const plant::ShaftPlant& { return p; }, plant_);
  }
  plant::ShaftPlant& shaft() {
    return std::visit([](auto& p) -> plant::ShaftPlant& { return p; }, plant_);
  }
  std::size_t state_size() const {
    return std::visit([](const auto& p) { return p.state_size(); }, plant_);
  }
  /// Of a design with a current loop: the next bits of the modulators at its shunts, bit n of the
  /// n-th; the shunts are in the motor's line, or in those of phases A and B.
  std::uint8_t current_bits() {
    const auto* three = std::get_if<plant::ThreePhasePlant>(&plant_);
    unsigned bits = 0;
    for (std::size_t n = 0; n < modulators_.size(); ++n) {
      const double current_a =
          three == nullptr ? shaft().observables().motor_current_a : three->motor().phase_a()[n];
      bits |= (modulators_[n].next(current_a) ? 1U : 0U) << n;
    }
    return static_cast<std::uint8_t>(bits);
  }
  bool has_hall() const { return hall_.has_value(); }
  /// The Hall lines while the shaft turns between these angles, in `clocks` from `now` on; it turns
  /// by less than a sector.
  HallChange hall(double from_rad, double to_rad, Clock now, Clock clocks) const {
    const auto code = [&](Clock after) {
      const double share = static_cast<double>(after) / static_cast<double>(clocks);
      const double rad = from_rad + share * (to_rad - from_rad);
      return static_cast<std::uint8_t>(
          hall_->code(std::get<plant::ThreePhasePlant>(plant_).motor().electrical_rad(rad)));
    };
    const std::uint8_t before = code(0), after = code(clocks);
    Clock low = 0, high = before == after ? 0 : clocks;
    while (high - low > 1) {
      const Clock middle = (low + high) / 2;
      (code(middle) == before ? low : high) = middle;
    }
    return {before, after, now + high};
  }
  /// Of a motor with three phases.
  void open_phase(std::size_t phase) { std::get<plant::ThreePhasePlant>(plant_).open_phase(phase); }

  /// Advances by `clocks`; the core's gates are those of its last `last` clocks.
  void advance(const Backend& core, Clock last, Clock clocks) {
    if (!switched_) return advance(core, clocks);
    advance(core.gates(), last, clocks);
  }
  /// The same by gates of `last` clocks.
  void advance(const GateClocks& g, Clock last, Clock clocks) {
    const double n = static_cast<double>(std::max<Clock>(last, 1));  // 0 before the first step
    const auto share = [n](std::int64_t on) { return static_cast<double>(on) / n; };
    const double a_hi = share(g.a_hi), a_lo = share(g.a_lo), b_hi = share(g.b_hi),
                 b_lo = share(g.b_lo);
    if (auto* brushed = std::get_if<plant::Plant>(&plant_)) {
      brushed->advance(plant::Bridge::gates(a_hi, a_lo, b_hi, b_lo), clocks);
    } else {
      std::get<plant::ThreePhasePlant>(plant_).advance(
          plant::Legs::gates(a_hi, a_lo, b_hi, b_lo, share(g.c_hi), share(g.c_lo)), clocks);
    }
  }
  /// The same by the duty in force: of a Backend, or of the core of a simulated board.
  template <class Core>
  void advance(const Core& core, Clock clocks) {
    if (auto* brushed = std::get_if<plant::Plant>(&plant_)) {
      if (core.duty() != duty_clocks_) {
        duty_clocks_ = core.duty();
        duty_ = static_cast<double>(duty_clocks_) / period_;
      }
      return brushed->advance(plant::Bridge::averaged(duty_, core.gates_enabled()), clocks);
    }
    plant::Phases duty;
    for (std::size_t k = 0; k < duty.size(); ++k) duty[k] = core.on_time(k) / period_;
    std::get<plant::ThreePhasePlant>(plant_).advance(
        plant::Legs::averaged(duty, core.gates_enabled()), clocks);
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

  bool switched_;
  double period_;                         ///< of the PWM, clocks
  std::optional<plant::HallLines> hall_;  ///< only of a design that has their pins
  Either plant_;
  std::vector<plant::SigmaDelta> modulators_;
  int duty_clocks_ = 0;  ///< duty of the bridge; duty_ is its share of a period
  double duty_ = 0;
};

}  // namespace feltgate
