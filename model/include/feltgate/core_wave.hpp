// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The arithmetic of a wave inside the core's twin. Each law is evaluated once, at a step at which
// all its inputs are known; each result is shown at the step at which the RTL shows it.
// Documentation: docs/architecture.md
#pragma once

#include <cstdint>

#include "feltgate/chain_tick.hpp"
#include "feltgate/core_ports.hpp"
#include "feltgate/core_steps.hpp"
#include "feltgate/current_loop.hpp"

namespace feltgate {

/// The chain of design D in fixed point, executed step by step.
template <class D>
class CoreWave {
 public:
  using Step = Map::Step;

  /// The parameter words stay, as in the RTL.
  void reset() {
    chain_.reset();
    sampled_travel_ = 0;
    limits_ = 0;
    relief_ = {};
    meter_ = {};
  }

  /// The clocks [from, to) of a tick with the decoder's travel held; before their steps.
  void watch(int from, int to, std::uint16_t travel) {
    if constexpr (measures_spans<D>) meter_.pass(from, to, static_cast<std::int16_t>(travel));
  }

  /// Outputs of the encoder monitor and the hold timer; they act from the next step on.
  void set_frozen(bool frozen) {
    relief_.frozen = frozen;
    set(Map::L::chatter, frozen);
  }
  void set_derated(bool derated) { relief_.derated = derated; }

  void set_word(int address, std::uint32_t word) { chain_.words().set_raw(address, word); }

  /// Sets the torque that a program asks for, raw.
  void program(std::int32_t torque) { chain_.program(Fixed::from_raw<D::f.torque.key()>(torque)); }

  /// Lets the torque ramp in the next wave; call it between two waves.
  void restart() { chain_.restart(); }

  /// Executes one step; `position` and `travel` are the decoder's outputs at Step::sample.
  [[gnu::always_inline]] void take(Step step, std::int32_t position, std::uint16_t travel,
                                   Mode mode, TestPulse pulse, CoreOut& out) {
    switch (step) {
      case Step::sample:
        out.position = position;
        sampled_travel_ = static_cast<std::int16_t>(travel);
        break;
      case Step::ramp_begin:
        set(Map::L::hold, relief_.derated);
        break;
      case Step::velocity_raw:
        if constexpr (measures_spans<D>) {
          chain_.estimate_from(meter_);
        } else {
          chain_.estimate(sampled_travel_);
        }
        set(Map::L::velocity, chain_.limit_velocity());
        break;
      case Step::velocity:
        out.velocity = chain_.velocity().raw();
        break;
      case Step::tau_hat:
        if constexpr (D::current_loop != 0) chain_.measure(motor_current<D>(out.current));
        chain_.observe(out.armed);
        out.tau_hat = static_cast<std::int32_t>(chain_.tau_hat().raw());
        set(Map::L::tau_hat, chain_.limit_tau_hat());
        break;
      case Step::ramp_excess:
        chain_.render(out.armed, out.scene, out.position, relief_, pulse);
        set(Map::L::torque, chain_.limit_torque());
        break;
      case Step::tau_ref:
        out.tau_ref = static_cast<std::int32_t>(chain_.tau_ref().raw());
        set(Map::L::ramp, chain_.limit_ramp());
        break;
      case Step::current_limited:
        chain_.drive(out.armed, mode);
        break;
      case Step::current:
        out.current_ref = current();
        set(Map::L::current, chain_.control().limit.current);
        break;
      case Step::voltage:
        out.voltage = voltage();
        set(Map::L::voltage, chain_.control().limit.voltage);
        break;
      case Step::duty:
        out.duty = duty();
        set(Map::L::duty, chain_.control().limit.duty);
        break;
      default:
        break;
    }
  }

  /// The values after the limiter, one clock before the outputs show them.
  std::int32_t current() const { return static_cast<std::int32_t>(chain_.control().current.raw()); }
  std::int32_t applied() const { return static_cast<std::int32_t>(chain_.control().applied.raw()); }
  std::int32_t voltage() const { return static_cast<std::int32_t>(chain_.control().voltage.raw()); }
  std::int16_t duty() const { return static_cast<std::int16_t>(chain_.control().duty.raw()); }
  /// Raw input of the velocity's low-pass for this travel; the next velocity lies between it and
  /// the present one. With M/T it is of the edges before, whatever the travel: a magnitude.
  std::int64_t velocity_input(std::int16_t travel) const {
    if constexpr (measures_spans<D>) {
      return meter_.largest();
    } else {
      return chain_.velocity_input(travel);
    }
  }
  /// Whether the torque reference exceeds the word at this address, compared as the limiter does.
  bool beyond(int address) const {
    using Law = LimiterLaw<D, Fixed>;
    const auto limit =
        chain_.words().template get<Law::template key<D::f.torque.fraction>>(address);
    bool is = false;
    Law::template limited<typename RampLaw<D, Fixed>::Torque>(chain_.tau_ref(), limit, &is);
    return is;
  }
  /// Back-EMF and dead voltage of this tick, LSB of the voltage; from Step::voltage on.
  std::int64_t forwarded(Mode mode) const {
    using Step = TorqueControlStep<D, Fixed>;
    const auto& w = chain_.words();
    const std::int64_t emf = Step::Law::emf(chain_.velocity() * w.emf_constant()).raw();
    return mode == Mode::voltage ? emf : emf + Step::dead_voltage(w, chain_.tau_ref()).raw();
  }
  /// Free-running count at the start of the running wave.
  std::int16_t sampled_travel() const { return sampled_travel_; }

  /// Whether the voltage gain of high torque is in force; valid from the clock in which it is
  /// fetched.
  bool region_high() const {
    using Law = TorqueControlLaw<D, Fixed>;
    const auto border = chain_.words().template get<Law::kBorderKey>(D::A::region_torque);
    return Law::region_high(chain_.tau_ref(), border);
  }
  /// The limits word.
  std::uint16_t limits(bool gates_enable) const {
    return static_cast<std::uint16_t>(limits_ | (gates_enable ? 0 : 1 << Map::L::gates_closed));
  }

 private:
  void set(int bit, bool holds) {
    limits_ = static_cast<std::uint16_t>((limits_ & ~(1 << bit)) | (holds << bit));
  }

  ChainTick<D, Fixed> chain_;
  typename MeterOf<D>::type meter_;
  std::int16_t sampled_travel_ = 0;
  std::uint16_t limits_ = 0;  ///< all bits except gates_closed
  Relief relief_;
};

}  // namespace feltgate
