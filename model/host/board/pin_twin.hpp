// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The twin of feltgate_linked on the board: core and link clock by clock, with a serial line at the
// UART's pins. Documentation: docs/host.md, docs/link.md
#pragma once

#include <optional>
#include <utility>

#include "feltgate/linked_core.hpp"
#include "host/board/core.hpp"
#include "sim/backends/absolute_sensor.hpp"

namespace feltgate::board {

/// Of N axes, with an engine or without.
template <int N, bool WithEngine>
class PinTwin : public Core {
 public:
  PinTwin(const DesignInfo& design, const BoardOptions& o)
      : info_(design),
        core_(std::make_unique<Linked>(design.data, LinkedOptions{o.baud, o.simulated, o.board})),
        inputs_(static_cast<std::uint8_t>(o.inputs)),
        looped_(info_.current_full_scale_a > 0) {
    if (info_.absolute) sensor_.emplace(*info_.absolute);
  }

  const DesignInfo& design() const override { return info_; }
  const char* kind() const override { return "twin"; }
  std::size_t axes() const override { return N; }
  void turn_encoder(double from_rad, double to_rad, Clock clocks) override {
    if (sensor_) sensor_->turn(from_rad, to_rad, now_, clocks);
  }
  void run(const BoardIn& in, Clock clocks) override {
    typename Linked::In pins;
    if constexpr (N == 1) {
      pins.encoder = in.encoder[0];
      pins.scene = in.scene;
    } else {
      for (std::size_t n = 0; n < N; ++n) {
        pins.axis[n].encoder = in.encoder[n];
        pins.axis[n].scene = in.scene;
      }
    }
    pins.arm = in.arm;
    pins.stop = in.stop;
    pins.inputs = inputs_;
    if constexpr (N == 1) pins.current_data = in.current_data;
    if constexpr (N == 1) pins.hall = in.hall;
    const auto tell = [this] {
      for (std::size_t n = 0; n < N; ++n) hash_.add(of_axis(n));
    };
    const Clock end = now_ + clocks;
    if constexpr (N == 1) {
      // A sensor's data and a gate may change in any clock.
      for (; (sensor_ || looped_) && now_ < end; ++now_) {
        if (sensor_) pins.encoder_data = sensor_->pin(now_, of_axis(0).serial);
        core_->run(pins, 1, tell);
        if (looped_) gates_.add(of_axis(0).gates);
      }
    }
    if (now_ < end) core_->run(pins, end - now_, tell);
    now_ = end;
  }
  void send(std::uint8_t byte) override { core_->send(byte); }
  std::size_t unsent() const override { return core_->unsent(); }
  std::vector<std::uint8_t> take_received() override { return core_->take_received(); }
  int duty(std::size_t axis) const override { return of_axis(axis).duty_active; }
  int on_time(std::size_t leg) const override {
    if constexpr (N == 1) return core_->core().on_time(leg);
    return 0;
  }
  bool gates_enabled(std::size_t axis) const override { return of_axis(axis).gates_enable; }
  GateClocks take_gates() override { return std::exchange(gates_, {}); }
  const TickHash& ticks() const override { return hash_; }

 private:
  using Linked = LinkedCore<N, WithEngine>;
  const CoreOut& of_axis(std::size_t n) const { return linked::axis(core_->out(), n); }

  DesignInfo info_;
  std::unique_ptr<Linked> core_;
  std::uint8_t inputs_;
  bool looped_;  ///< a current loop
  GateClocks gates_;
  std::optional<AbsoluteSensor> sensor_;
  Clock now_ = 0;
  TickHash hash_;
};

}  // namespace feltgate::board
