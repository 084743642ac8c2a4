// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The twin of feltgate_linked on the board: core and link clock by clock, with a serial line at the
// UART's pins. Documentation: docs/board.md, docs/blocks/feltgate_linked.md
#pragma once

#include <optional>

#include "feltgate/linked_core.hpp"
#include "host/board/core.hpp"
#include "sim/backends/absolute_sensor.hpp"

namespace feltgate::board {

template <class D>
class PinTwin : public Core {
 public:
  explicit PinTwin(const BoardOptions& o)
      : info_(design_info<D>()),
        core_(std::make_unique<LinkedCore<D>>(LinkedOptions{o.baud, o.simulated, o.board})),
        inputs_(static_cast<std::uint8_t>(o.inputs)) {
    if (info_.absolute) sensor_.emplace(*info_.absolute);
  }

  const DesignInfo& design() const override { return info_; }
  const char* kind() const override { return "twin"; }
  void turn_encoder(double from_rad, double to_rad, Clock clocks) override {
    if (sensor_) sensor_->turn(from_rad, to_rad, now_, clocks);
  }
  void run(const BoardIn& in, Clock clocks) override {
    LinkedIn pins;
    pins.encoder = in.encoder;
    pins.arm = in.arm;
    pins.stop = in.stop;
    pins.set_zero = in.set_zero;
    pins.scene = in.scene;
    pins.inputs = inputs_;
    const auto tell = [this] { hash_.add(core_->out().core); };
    const Clock end = now_ + clocks;
    // The sensor's data may change in any clock.
    for (; sensor_ && now_ < end; ++now_) {
      pins.encoder_data = sensor_->pin(now_, core_->out().core.serial);
      core_->run(pins, 1, tell);
      pins.set_zero = false;
    }
    if (now_ < end) core_->run(pins, clocks, tell);
    now_ = end;
  }
  void send(std::uint8_t byte) override { core_->send(byte); }
  std::size_t unsent() const override { return core_->unsent(); }
  std::vector<std::uint8_t> take_received() override { return core_->take_received(); }
  int duty() const override { return core_->out().core.duty_active; }
  int on_time(std::size_t leg) const override { return core_->core().on_time(leg); }
  bool gates_enabled() const override { return core_->out().core.gates_enable; }
  const TickHash& ticks() const override { return hash_; }

 private:
  DesignInfo info_;
  std::unique_ptr<LinkedCore<D>> core_;
  std::uint8_t inputs_;
  std::optional<AbsoluteSensor> sensor_;
  Clock now_ = 0;
  TickHash hash_;
};

}  // namespace feltgate::board
