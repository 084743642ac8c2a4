// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Twin of rtl/host/registers.sv, the host's register port. A write is accepted in a clock in which
// busy is false, and takes effect in the last clock of the tick. docs/blocks/host.md
#pragma once

#include "feltgate/axis/signals.hpp"
#include "feltgate/axis/words.hpp"

namespace feltgate::axis {

class Registers {
 public:
  struct In {
    bool tick = false;
    const Pins& pins;
    bool armed = false;  ///< or armed from the next clock on
    bool polarity_holds = false;
  };
  Control control;

  /// A field that holds while armed has changed by itself.
  bool error() const { return flipped_; }
  void flip(int bit) {
    control.word ^= 1U << bit;
    if (bit >= Map::C::control_mode) flipped_ = !flipped_;
  }
  bool busy() const { return to_parameter_ || to_control_ || to_command_; }
  bool disarm() const { return disarm_; }
  bool stop() const { return stop_; }
  bool refused() const { return refused_; }
  bool saturated() const { return saturated_; }
  int address() const { return address_; }
  std::uint32_t data() const { return data_; }

  /// Commands, in the last clock of a tick.
  bool command(bool tick, int bit) const { return tick && to_command_ && (data_ >> bit & 1) != 0; }
  bool set_zero(bool tick) const {
    return (tick && zero_) || command(tick, Map::C::command_set_zero);
  }
  bool refuses(bool armed) const {
    return armed && address_ < 64 && (Map::refused_while_armed >> address_ & 1) != 0;
  }
  bool write(bool tick, bool armed) const { return tick && to_parameter_ && !refuses(armed); }
  /// This change starts the ramp.
  bool restart(bool tick, int scene) const {
    const bool input_scene = (Map::input_scenes >> scene & 1) != 0;
    const bool ramps = address_ < 64 ? (Map::ramps_while_armed >> address_ & 1) != 0
                                     : address_ >> 5 == scene && !input_scene;
    return (set_zero(tick) && !input_scene) || (tick && to_parameter_ && ramps);
  }
  /// Nothing waits, and nothing comes with these inputs.
  bool rests(bool write, bool set_zero) const {
    return !busy() && !write && !set_zero && !zero_ && !disarm_ && !stop_ && !flipped_;
  }

  void clock(const WordFormats& formats, const In& in) {
    using C = Map::C;
    const bool at_parameter = in.pins.reg_addr >> 9 == 0,
               at_control = in.pins.reg_addr == C::control,
               at_command = in.pins.reg_addr == C::command;
    const auto wdata = [&in](int bit) { return (in.pins.reg_wdata >> bit & 1) != 0; };
    const bool disarms =
        in.pins.reg_write && at_control && wdata(C::control_host) && !wdata(C::control_arm);
    const bool stops = in.pins.reg_write && at_command && wdata(C::command_stop);
    if (in.tick && to_parameter_) refused_ = refuses(in.armed);
    if (in.tick && to_control_) {
      // Mode, polarities and filter hold while armed.
      constexpr std::uint32_t always = (1U << C::control_mode) - 1,
                              all = (1U << C::control_width) - 1;
      const bool holds = in.armed && !disarm_;
      std::uint32_t takes = holds ? always : all;
      flipped_ = flipped_ && holds;
      if (in.polarity_holds) takes &= ~(1U << C::control_encoder_polarity);
      control.word = (control.word & ~takes) | (data_ & takes);
    }
    if (in.tick && disarm_) {  // wins over a waiting write that arms
      control.word = (control.word | 1U << C::control_host) & ~(1U << C::control_arm);
    }
    if (in.pins.reg_write && !busy()) {
      to_parameter_ = at_parameter;
      to_control_ = at_control;
      to_command_ = at_command;
      address_ = in.pins.reg_addr & 511;
      data_ = fitted(formats, in.pins);
      if (at_parameter) saturated_ = data_ != in.pins.reg_wdata;
    } else if (in.tick) {
      to_parameter_ = to_control_ = to_command_ = false;
    }
    disarm_ = disarms || (disarm_ && !in.tick);
    stop_ = stops || (stop_ && !in.tick);
    zero_ = in.pins.set_zero || (zero_ && !in.tick);
  }

 private:
  /// What is written, within its format.
  static std::uint32_t fitted(const WordFormats& formats, const Pins& in) {
    if (in.reg_addr >> 9 != 0) return in.reg_wdata;
    const WordFormats::Format& f = formats.at[static_cast<std::size_t>(in.reg_addr)];
    const bool top = in.reg_wdata >> 31 != 0, negative = f.has_sign && top;
    const bool misfit = ((negative ? ~in.reg_wdata : in.reg_wdata) & f.above) != 0;
    return !misfit ? in.reg_wdata : negative ? f.above : top ? 0 : ~f.above;
  }

  bool to_parameter_ = false, to_control_ = false, to_command_ = false, zero_ = false,
       disarm_ = false, stop_ = false, refused_ = false, saturated_ = false, flipped_ = false;
  int address_ = 0;
  std::uint32_t data_ = 0;
};

}  // namespace feltgate::axis
