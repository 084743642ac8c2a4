// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Keeps a motor armed that the host has armed, by kicking its watchdog. Documentation: docs/host.md
#pragma once

#include <functional>
#include <string>

#include "host/host_device.hpp"

namespace feltgate::host {

/// Arms a motor, or takes over an armed one, and kicks its watchdog four times as often as
/// necessary. Its owner must call release() on every way out.
class KeepAlive {
 public:
  explicit KeepAlive(Device& device) : device_(device) {}

  /// Arms with the watchdog enabled; `go_on` as in Device::arm(). Errors: those of Device::arm().
  /// After an error the motor is disarmed; only if the link broke down, release() must still be
  /// called.
  void arm(
      const std::string& scene, const std::function<bool()>& go_on = [] { return true; });
  /// Takes over a motor that the host has armed before, not one that the panel has armed.
  void take_over();
  bool holds() const { return holds_; }
  /// Kicks if it is time; call it at least every next_in_s() seconds.
  void poll();
  /// Time to the next kick, s, at most `idle_s`.
  double next_in_s() const;
  /// Disarms the motor that it holds. Errors: LinkLost if the request does not reach the board.
  void release();

  static constexpr double idle_s = 0.1;

 private:
  Device& device_;
  bool holds_ = false;
  Deadline next_{};
};

}  // namespace feltgate::host
