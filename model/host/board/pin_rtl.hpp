// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The Verilated feltgate_linked on the board, with a serial line at the UART's pins.
// Documentation: docs/host.md
#pragma once

#include <algorithm>
#include <optional>
#include <stdexcept>
#include <utility>

#include "feltgate/generated/link.hpp"
#include "feltgate/uart_line.hpp"
#include "host/board/core.hpp"
#include "sim/backends/absolute_sensor.hpp"
#include "sim/backends/rtl_axes_ports.hpp"
#include "sim/backends/rtl_model.hpp"

namespace feltgate::board {

/// Rtl is Verilator's class of board_pins for this design.
template <class Rtl>
class PinRtl : public Core {
 public:
  PinRtl(const DesignInfo& design, const BoardOptions& o)
      : info_(design),
        bits_(design.data),
        rtl_(1),
        line_(design.clock_hz, o.baud),
        inputs_(static_cast<std::uint8_t>(o.inputs)),
        looped_(info_.current_full_scale_a > 0) {
    if (o.baud != LinkMap::baud) {
      throw std::invalid_argument(
          "--rtl: its link was built for 1000000 baud; leave --baud out, or take the twin");
    }
    if (info_.absolute) sensor_.emplace(*info_.absolute);
    drive({});
    rtl_->uart_rx_i = 1;
    rtl_.reset(4);
  }

  const DesignInfo& design() const override { return info_; }
  const char* kind() const override { return "rtl"; }
  std::size_t axes() const override { return static_cast<std::size_t>(info_.axes); }
  void turn_encoder(double from_rad, double to_rad, Clock clocks) override {
    if (sensor_) sensor_->turn(from_rad, to_rad, now_, clocks);
  }
  void run(const BoardIn& in, Clock clocks) override {
    drive(in);
    for (const Clock end = now_ + clocks; now_ < end; ++now_) {
      const bool tx = rtl_->uart_tx_o != 0;
      rtl_->uart_rx_i = line_.level();
      line_.clock(tx);
      if (sensor_) set_encoder_data_i(*rtl_, sensor_->pin(now_, serial_lines(*rtl_, bits_)), 0);
      // The stop was active since the last clock edge, and is not in the next clock.
      rtl_->stop_i = in.stop;
      rtl_.low();
      rtl_->stop_i = false;
      rtl_.high();
      if (looped_) gates_.add(gates());
      if (rtl_->snapshot_valid_o == 0) continue;
      for (int n = 0; n < info_.axes; ++n) hash_.add(read_axis(*rtl_, bits_, n));
    }
  }
  void send(std::uint8_t byte) override { line_.send(byte); }
  std::size_t unsent() const override { return line_.unsent(); }
  std::vector<std::uint8_t> take_received() override { return line_.take_received(); }
  int duty(std::size_t axis) const override {
    return read_axis(*rtl_, bits_, static_cast<int>(axis)).duty_active;
  }
  int on_time(std::size_t leg) const override {
    const auto first = static_cast<int>(12 * leg);
    return std::min(static_cast<int>(bits_of(rtl_->on_times_o, first, 12)), info_.pwm_period);
  }
  bool gates_enabled(std::size_t axis) const override {
    return bits_of(rtl_->gates_enable_o, static_cast<int>(axis), 1) != 0;
  }
  GateClocks take_gates() override { return std::exchange(gates_, {}); }
  const TickHash& ticks() const override { return hash_; }

 private:
  void drive(const BoardIn& in) {
    unsigned a = 0, b = 0, z = 0;
    for (int n = 0; n < info_.axes; ++n) {
      const EncoderPins& pins = in.encoder[static_cast<std::size_t>(n)];
      a |= unsigned{pins.a} << n;
      b |= unsigned{pins.b} << n;
      z |= unsigned{pins.z} << n;
      set_bits(rtl_->scene_i, 4 * n, 4, in.scene);
    }
    set_enc_a_i(*rtl_, a, 0);
    set_enc_b_i(*rtl_, b, 0);
    set_enc_z_i(*rtl_, z, 0);
    set_current_data_i(*rtl_, in.current_data, 0);
    set_hall_i(*rtl_, in.hall, 0);
    rtl_->arm_i = in.arm;
    rtl_->inputs_i = inputs_;
  }
  /// As in CoreOut; of the axis where there is one.
  unsigned gates() const {
    return static_cast<unsigned>(rtl_->gate_a_hi_o | rtl_->gate_a_lo_o << 1 |
                                 rtl_->gate_b_hi_o << 2 | rtl_->gate_b_lo_o << 3 |
                                 get_gate_c_hi_o(*rtl_, 0) << 4 | get_gate_c_lo_o(*rtl_, 0) << 5);
  }

  DesignInfo info_;
  PortBits bits_;
  RtlModel<Rtl> rtl_;
  UartLine line_;
  std::uint8_t inputs_;
  bool looped_;  ///< a current loop
  GateClocks gates_;
  std::optional<AbsoluteSensor> sensor_;
  Clock now_ = 0;
  TickHash hash_;
};

}  // namespace feltgate::board
