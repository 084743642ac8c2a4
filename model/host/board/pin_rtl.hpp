// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The Verilated feltgate_linked on the board, with a serial line at the UART's pins.
// Documentation: docs/board.md
#pragma once

#include <stdexcept>

#include "feltgate/generated/link.hpp"
#include "feltgate/uart_line.hpp"
#include "host/board/core.hpp"
#include "sim/backends/rtl_model.hpp"
#include "sim/backends/rtl_ports.hpp"

namespace feltgate::board {

/// Rtl is Verilator's class of board_pins for design D.
template <class Rtl, class D>
class PinRtl : public Core {
 public:
  explicit PinRtl(const BoardOptions& o)
      : info_(design_info<D>()),
        rtl_(1),
        line_(D::clock_hz, o.baud),
        inputs_(static_cast<std::uint8_t>(o.inputs)) {
    if (o.baud != LinkMap::baud) {
      throw std::invalid_argument(
          "--rtl: its link was built for 1000000 baud; leave --baud out, or take the twin");
    }
    drive({});
    rtl_->uart_rx_i = 1;
    rtl_.reset(4);
  }

  const DesignInfo& design() const override { return info_; }
  const char* kind() const override { return "rtl"; }
  void turn_encoder(double, double, Clock) override {}  // board_pins has no such pins
  void run(const BoardIn& in, Clock clocks) override {
    drive(in);
    for (; clocks > 0; --clocks) {
      const bool tx = rtl_->uart_tx_o != 0;
      rtl_->uart_rx_i = line_.level();
      line_.clock(tx);
      // The stop was active since the last clock edge, and is not in the next clock.
      rtl_->stop_i = in.stop;
      rtl_.low();
      rtl_->stop_i = false;
      rtl_.high();
      if (rtl_->snapshot_valid_o != 0) hash_.add(read_outputs<D>(*rtl_));
    }
    out_ = read_outputs<D>(*rtl_);
  }
  void send(std::uint8_t byte) override { line_.send(byte); }
  std::size_t unsent() const override { return line_.unsent(); }
  std::vector<std::uint8_t> take_received() override { return line_.take_received(); }
  int duty(std::size_t) const override { return out_.duty_active; }
  int on_time(std::size_t) const override { return 0; }
  bool gates_enabled(std::size_t) const override { return out_.gates_enable; }
  const TickHash& ticks() const override { return hash_; }

 private:
  void drive(const BoardIn& in) {
    rtl_->enc_a_i = in.encoder[0].a;
    rtl_->enc_b_i = in.encoder[0].b;
    rtl_->enc_z_i = in.encoder[0].z;
    rtl_->arm_i = in.arm;
    rtl_->set_zero_i = false;
    rtl_->scene_i = in.scene;
    rtl_->inputs_i = inputs_;
  }

  DesignInfo info_;
  RtlModel<Rtl> rtl_;
  UartLine line_;
  std::uint8_t inputs_;
  CoreOut out_;
  TickHash hash_;
};

}  // namespace feltgate::board
