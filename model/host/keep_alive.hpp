// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The watchdog of a motor that the host has armed. Documentation: docs/host.md
#pragma once

#include <functional>
#include <string>

#include "host/device.hpp"

namespace feltgate::host {

/// Arms a motor, or takes one over, and kicks its watchdog four times as often as it must be. What
/// ends it is release(); its owner calls that on every way out.
class KeepAlive {
 public:
  explicit KeepAlive(Device& device) : device_(device) {}

  /// Arms with the watchdog awake; `go_on` as of Device::arm(). Errors: those of Device::arm(); the
  /// motor is then disarmed, or release() is still to be called where the link broke down.
  void arm(
      const std::string& scene, const std::function<bool()>& go_on = [] { return true; });
  /// Takes over a motor that the host armed before; not one that the panel has armed.
  void take_over();
  bool holds() const { return holds_; }
  /// Kicks when it is time; to be called at least every next_in_s() seconds.
  void poll();
  /// Until the next kick, s, at most `idle_s`.
  double next_in_s() const;
  /// Disarms what it holds. Throws LinkLost where that does not reach the board.
  void release();

  static constexpr double idle_s = 0.1;

 private:
  Device& device_;
  bool holds_ = false;
  Deadline next_{};
};

}  // namespace feltgate::host
