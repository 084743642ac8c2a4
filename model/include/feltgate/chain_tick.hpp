// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The chain tick by tick, without pins or clocks: from a sampled count to the duty, in number
// policy N. In Fixed its integers equal those of the core's snapshots. Documentation:
// docs/speed-for-accuracy.md
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "feltgate/dob.hpp"
#include "feltgate/generated/map.hpp"
#include "feltgate/scenes.hpp"
#include "feltgate/torque_control.hpp"
#include "feltgate/velocity_n.hpp"
#include "feltgate/words.hpp"

namespace feltgate {

/// The position that scenes see: saturated to 18 bits in fixed point, unchanged in real arithmetic.
template <class D, class N>
constexpr std::int32_t scene_position(std::int32_t position) {
  if constexpr (N::is_fixed) {
    constexpr std::int32_t end = (1 << (D::f.scene_position.width() - 1)) - 1;
    return std::clamp(position, -end - 1, end);
  } else {
    return position;
  }
}

/// The laws of one design in their order, with their state and the parameter words. tick() computes
/// a whole tick; the core's twin instead calls the four stages, each in the clock in which the RTL
/// shows its result.
template <class D, class N>
class ChainTick {
 public:
  using Velocity = typename VelocityLaw<D, N>::Velocity;
  using Torque = typename DobLaw<D, N>::Torque;
  using Current = decltype(TorqueControlStep<D, N>::current);

  /// The state after a reset; the parameter words stay, as in the RTL.
  void reset() {
    line_.reset();
    scenes_.reset();
    estimator_ = {};
    observer_ = {};
    control_ = {};
    measured_ = {};
  }

  Words<D, N>& words() { return words_; }
  const Words<D, N>& words() const { return words_; }

  /// Lets the torque ramp; call it before a tick whose torque may jump.
  void restart() { scenes_.ramp().restart(); }

  /// One tick. `position` [count] and `travel` [count, wraps] are the samples at the start of the
  /// wave; `armed`, `scene`, `mode` and `relief` hold during the tick.
  void tick(std::int32_t position, std::int16_t travel, bool armed, int scene, Mode mode,
            Relief relief = {}) {
    estimate(travel);
    observe(armed);
    render(armed, scene, position, relief);
    drive(armed, mode);
  }

  /// Stage 1: velocity from the travel.
  void estimate(std::int16_t travel) {
    static_assert(D::mt_counts == 0, "M/T needs the clocks of the edges: take FeltgateCore");
    const std::int16_t counts = travel_difference(travel, line_.oldest());
    line_.push(travel);
    estimator_.tick(words_, counts);
  }
  /// Stage 1 of a design with the M/T estimator, fixed only: from what its edges told.
  template <class Meter>
  void estimate_from(const Meter& meter) {
    using Raw = typename Velocity::raw_type;
    const auto raw = Velocity::from_raw(static_cast<Raw>(meter.raw()));
    estimator_.limit = meter.limited();
    if (meter.follows(velocity().raw())) {
      estimator_.velocity = raw;
    } else {
      estimator_.filter(words_, raw);
    }
  }
  /// Fixed only: raw input of the velocity's low-pass in a tick with this travel.
  std::int64_t velocity_input(std::int16_t travel) const {
    bool unused = false;
    return N::raw(VelocityLaw<D, N>::raw(travel_difference(travel, line_.oldest()), &unused));
  }
  /// With a current loop: the measured current, raw in the format of the current, before observe().
  void measure(std::int32_t raw) {
    if constexpr (N::is_fixed) {
      measured_ = Current::from_raw(raw);
    } else {
      measured_ =
          static_cast<Current>(std::ldexp(static_cast<double>(raw), -D::f.current.fraction));
    }
  }
  /// Stage 2: tau_hat from the velocity and the current: the measured one, or the reference of the
  /// tick before.
  void observe(bool armed) {
    observer_.tick(words_, armed, D::current_loop != 0 ? measured_ : control_.current, velocity());
  }
  /// Stage 3: tau_ref from the position, and from the velocity in a damper.
  void render(bool armed, int scene, std::int32_t position, Relief relief = {},
              TestPulse pulse = TestPulse::none) {
    scenes_.tick(words_, armed, scene, scene_position<D, N>(position), velocity(), relief, pulse);
  }
  /// Sets the torque that a program asks for [Nm]; call it before render().
  void program(Torque torque) { scenes_.program(torque); }
  /// Stage 4: current, voltage and duty.
  void drive(bool armed, Mode mode) { drive(armed, mode, tau_ref()); }
  /// The same for another torque than the scene's, such as that of a controller around it.
  void drive(bool armed, Mode mode, Torque asked) {
    control_.tick(words_, armed, mode, asked, tau_hat(), velocity());
  }

  Velocity velocity() const { return estimator_.velocity; }
  Torque tau_hat() const { return observer_.tau_hat; }
  Torque tau_ref() const { return scenes_.tau_ref(); }
  /// Current, voltage, duty, their limits, and the region of the voltage gain.
  const TorqueControlStep<D, N>& control() const { return control_; }

  // The limits of the last tick; in real arithmetic only the first five can be set.
  bool limit_torque() const { return scenes_.limit_torque(); }
  bool limit_ramp() const { return scenes_.limit_ramp(); }
  bool limit_velocity() const { return estimator_.limit; }
  bool limit_tau_hat() const { return observer_.limit; }
  /// The limits of the last tick as bits of the limits word.
  std::uint16_t limits() const {
    using L = Map::L;
    return static_cast<std::uint16_t>(
        limit_torque() << L::torque | limit_ramp() << L::ramp |
        control_.limit.current << L::current | control_.limit.voltage << L::voltage |
        control_.limit.duty << L::duty | estimator_.limit << L::velocity |
        observer_.limit << L::tau_hat);
  }

 private:
  Words<D, N> words_;
  DelayLine<D::m1> line_;
  EstimatorStep<D, N> estimator_;
  ObserverStep<D, N> observer_;
  ScenesLaw<D, N> scenes_;
  TorqueControlStep<D, N> control_;
  Current measured_{};
};

}  // namespace feltgate
