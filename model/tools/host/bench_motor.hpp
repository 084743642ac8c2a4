// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// A motor on the bench: its mode, held armed, its fault told. Documentation: docs/calibration.md
#pragma once

#include <string>

#include "tools/host/session.hpp"

namespace feltgate::host {

/// control.mode
enum class Mode : std::uint32_t { closed_loop = 0, open_loop = 1, direct_voltage = 2 };

/// Holds the mode while it lives; at the end it is closed loop again, disarmed.
class BenchMotor {
 public:
  BenchMotor(Device& device, Mode mode);
  ~BenchMotor();
  BenchMotor(const BenchMotor&) = delete;
  BenchMotor& operator=(const BenchMotor&) = delete;

  void arm(const std::string& scene) { hold_.arm(scene); }
  void disarm() { hold_.release(); }
  /// Feeds the watchdog alone.
  void feed() { hold_.poll(); }
  /// To be called often: feeds the watchdog. Throws Refused where a fault has ended it.
  void poll();
  /// poll() for so long.
  void wait(double seconds);
  /// Throws Refused where the board did not keep it.
  void set(const std::string& name, double value);
  Device& device() { return device_; }

 private:
  void set_mode(Mode mode);
  Device& device_;
  Hold hold_;
};

}  // namespace feltgate::host
