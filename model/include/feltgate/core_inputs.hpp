// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The core's twin: the inputs of its blocks, made from the pins and the control word. Included by
// feltgate_core.hpp. Documentation: docs/architecture.md
#pragma once

#include <cstdint>
#include <type_traits>

#include "feltgate/feltgate_core.hpp"

namespace feltgate {

/// The word of commutation that is on the parameter bus in this clock of the wave.
template <class D, class Registers>
std::uint32_t commutation_word(const Registers& registers, int wave_clock) {
  const bool offset = wave_clock == Map::W::commutation_offset;
  return registers.parameter(offset ? D::A::commutation_offset : D::A::commutation_gain);
}

/// The count that a bridge or a loop turns with; of Hall lines their angle in its place.
template <class Decoder, class In>
void turned_by(const Decoder& decoder, In* in) {
  if constexpr (std::is_base_of_v<HallDecoder, Decoder>) {
    in->angle = decoder.angle();
  } else {
    in->count = decoder.count();
  }
}

/// Whether a sensor has no first value yet: a request to arm waits.
template <class Loop, class Decoder>
bool starts(const Loop& loop, const Decoder& decoder) {
  return loop.starts() || absolute_state(decoder) >> (Map::C::faults_absolute_width - 1) != 0;
}

/// Whether a sensor refuses a request to arm.
template <class Loop, class Decoder>
bool unfit(const Loop& loop, const Decoder& decoder) {
  constexpr std::uint32_t faults = (1u << (Map::C::faults_absolute_width - 1)) - 1;
  return loop.unfit() || (absolute_state(decoder) & faults) != 0;
}

template <class D, bool ReadBack>
void FeltgateCore<D, ReadBack>::ask(const In& in, typename Supervisor<D>::In* sup) const {
  sup->host = host();
  sup->host_arm = bit(registers_.out().control, D::C::control_arm);
  sup->arm = in.arm;
  sup->disarm = registers_.out().disarm;
  sup->axis_silent = in.axis_silent || starts(loop_, decoder_);
  sup->axis_blocked = in.axis_blocked || unfit(loop_, decoder_);
}

template <class D, bool ReadBack>
bool FeltgateCore<D, ReadBack>::arm_request(const In& in) const {
  typename Supervisor<D>::In sup;
  ask(in, &sup);
  return supervisor_.asks(sup) && !starts(loop_, decoder_);
}

template <class D, bool ReadBack>
bool FeltgateCore<D, ReadBack>::ready() const {
  return supervisor_.ready(host()) && !unfit(loop_, decoder_);
}

/// The scene that is asked for: by the control word if the host has control, else by the panel.
template <class D, bool ReadBack>
std::uint8_t FeltgateCore<D, ReadBack>::wanted_scene(const In& in) const {
  const std::uint32_t control = registers_.out().control;
  return static_cast<std::uint8_t>(
      host() ? field<D::C::control_scene, D::C::control_scene_width>(control) : in.scene);
}

/// The pulse that replaces the scene's torque; 0 torque while another axis runs its self-test.
template <class D, bool ReadBack>
TestPulse FeltgateCore<D, ReadBack>::pulse(const In& in) const {
  const TestPulse own = self_test_.pulse(out_.armed);
  return own == TestPulse::none && in.axis_testing && out_.armed ? TestPulse::rest : own;
}

template <class D, bool ReadBack>
typename Registers<D, ReadBack>::In FeltgateCore<D, ReadBack>::register_inputs(const In& in,
                                                                               bool tick,
                                                                               bool held) const {
  typename Registers<D, ReadBack>::In reg;
  reg.tick = tick;
  reg.reg_addr = in.reg_addr;
  reg.reg_wdata = in.reg_wdata;
  reg.reg_write = in.reg_write;
  reg.armed = held;
  if constexpr (kAbsolute) reg.polarity_holds = decoder_.has_read();
  reg.set_zero = in.set_zero;
  reg.scene = out_.scene;
  if (registers_.flipped()) {  // only then is the parameter bus modelled
    const int slot = clock_ < 63 ? clock_ : 63;
    reg.slot_fetch = static_cast<std::uint8_t>(slot);
    reg.scene_slot_fetch = ((Map::scene_slots >> slot) & 1u) != 0;
    reg.region_high = wave_.region_high();
    reg.testing = self_test_.busy(out_.armed);
    reg.derated = hold_.derated();
    reg.at_least_full = clock_ == core_steps::clock_of(T::least_full);
    reg.at_least_hold = clock_ == core_steps::clock_of(T::least_hold);
    reg.at_least_test = clock_ == core_steps::clock_of(T::least_test);
  }
  return reg;
}

template <class D, bool ReadBack>
typename FeltgateCore<D, ReadBack>::Decoder::In FeltgateCore<D, ReadBack>::decoder_inputs(
    const In& in, bool zero, bool clear, [[maybe_unused]] bool open) const {
  const std::uint32_t control = registers_.out().control;
  typename Decoder::In d;
  d.polarity = bit(control, D::C::control_encoder_polarity);
  d.set_zero = zero;
  if constexpr (kAbsolute) {
    d.data = in.encoder_data;
    d.sample = clock_ == core_steps::clock_of(T::sample);
    d.gates_enable = open;
    d.clear = clear;
    d.levels = clock_ == core_steps::clock_of(T::levels);
    return d;
  } else {
    d.a = in.encoder.a;
    d.b = in.encoder.b;
    d.z = in.encoder.z;
    d.filter =
        static_cast<std::uint8_t>(field<D::C::control_filter, D::C::control_filter_width>(control));
    d.clear_error = clear;
    if constexpr (D::hall != 0) {
      d.hall = in.hall;
      d.gates_enable = open;
      d.wave_clock = clock_ - Map::first_wave_clock;
      d.word = commutation_word<D>(registers_, d.wave_clock);
    }
    return d;
  }
}

template <class D, bool ReadBack>
auto FeltgateCore<D, ReadBack>::loop_inputs(const In& in, bool clear) const {
  typename CurrentLoop<D>::In l;
  l.data = in.current_data;
  l.driver_fault = in.driver_fault;
  l.gates_enable = supervisor_.out().gates_enable;
  l.direct = mode() == Mode::voltage;
  l.polarity = bit(registers_.out().control, D::C::control_motor_polarity);
  l.beats = clock_ == D::clocks_per_tick - 1 && supervisor_.out().first_fault == 0;
  l.tick_count = out_.tick_count;
  l.clear = clear;
  l.wave_clock = clock_ - Map::first_wave_clock;
  if (l.wave_clock == T::voltage) {
    l.reference = out_.current_ref;
    l.forwarded = wave_.forwarded(mode());
  }
  l.duty_limit = registers_.parameter(D::A::duty_limit);
  if constexpr (D::phases == 3) {
    l.duty = out_.duty;
    turned_by(decoder_, &l);
    l.word = commutation_word<D>(registers_, l.wave_clock);
  }
  return l;
}

/// The duty that the PWM may take.
template <class D, bool ReadBack>
std::int16_t FeltgateCore<D, ReadBack>::bridge_duty() const {
  if constexpr (kLoop && D::phases == 2) {
    if (mode() != Mode::voltage) return loop_.duty();
  }
  return out_.duty;
}

template <class D, bool ReadBack>
auto FeltgateCore<D, ReadBack>::bridge_inputs(bool enable,
                                              [[maybe_unused]] std::int16_t duty) const {
  const std::uint32_t control = registers_.out().control;
  typename Bridge::In p;
  p.enable = enable;
  p.polarity = bit(control, D::C::control_motor_polarity);
  if constexpr (kLoop && D::phases == 3) {
    p.on = loop_.on_times();
  } else if constexpr (D::phases == 3) {
    p.amplitude = duty;
    turned_by(decoder_, &p);
    p.wave_clock = clock_ - Map::first_wave_clock;
    p.word = commutation_word<D>(registers_, p.wave_clock);
  } else {
    p.duty = duty;
    p.mode = bit(control, D::C::control_pwm_mode);
  }
  return p;
}

}  // namespace feltgate
