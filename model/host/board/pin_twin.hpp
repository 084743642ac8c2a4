// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The twin of feltgate_linked on the board: core and link clock by clock, with a serial line at the
// UART's pins. Documentation: docs/board.md, docs/blocks/feltgate_linked.md
#pragma once

#include "feltgate/linked_core.hpp"
#include "host/board/core.hpp"

namespace feltgate::board {

template <class D>
class PinTwin : public Core {
 public:
  explicit PinTwin(const BoardOptions& o)
      : info_(design_info<D>()),
        core_(std::make_unique<LinkedCore<D>>(LinkedOptions{o.baud, o.simulated, o.board})),
        inputs_(static_cast<std::uint8_t>(o.inputs)) {}

  const DesignInfo& design() const override { return info_; }
  const char* kind() const override { return "twin"; }
  void run(const BoardIn& in, Clock clocks) override {
    LinkedIn pins;
    pins.encoder = in.encoder;
    pins.arm = in.arm;
    pins.stop = in.stop;
    pins.set_zero = in.set_zero;
    pins.scene = in.scene;
    pins.inputs = inputs_;
    core_->run(pins, clocks, [this] { hash_.add(core_->out().core); });
  }
  void send(std::uint8_t byte) override { core_->send(byte); }
  std::size_t unsent() const override { return core_->unsent(); }
  std::vector<std::uint8_t> take_received() override { return core_->take_received(); }
  int duty() const override { return core_->out().core.duty_active; }
  bool gates_enabled() const override { return core_->out().core.gates_enable; }
  const TickHash& ticks() const override { return hash_; }

 private:
  DesignInfo info_;
  std::unique_ptr<LinkedCore<D>> core_;
  std::uint8_t inputs_;
  TickHash hash_;
};

}  // namespace feltgate::board
