// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// A motor on the bench: sets its mode, holds it armed, reports its fault. Documentation:
// docs/calibration.md
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "apps/commands/host/session.hpp"

namespace feltgate::host {

/// To stdout, at once.
void say(const std::string& text);

/// control.mode
enum class Mode : std::uint32_t { closed_loop = 0, open_loop = 1, direct_voltage = 2 };

/// Sets the mode during its lifetime; the destructor disarms and restores closed loop.
class BenchMotor {
 public:
  BenchMotor(Device& device, Mode mode);
  ~BenchMotor();
  BenchMotor(const BenchMotor&) = delete;
  BenchMotor& operator=(const BenchMotor&) = delete;

  void arm(const std::string& scene) { hold_.arm(scene); }
  void disarm() { hold_.release(); }
  /// Only feeds the watchdog.
  void feed() { hold_.poll(); }
  /// Feeds the watchdog; call it often. Throws Refused when a fault has disarmed the motor.
  void poll();
  /// Calls poll() for `seconds`.
  void wait(double seconds);
  /// The same for `seconds` of the board's own time: a simulated one may be slower.
  void wait_on_board(double seconds);
  /// Sets a parameter. Throws Refused when the board did not keep the value.
  void set(const std::string& name, double value);
  Device& device() { return device_; }

 private:
  void set_mode(Mode mode);
  Device& device_;
  Hold hold_;
};

/// Parameters that get their values back, once the motor is off.
class KeptWords {
 public:
  KeptWords(BenchMotor& motor, std::vector<std::string> names);
  ~KeptWords();
  KeptWords(const KeptWords&) = delete;
  KeptWords& operator=(const KeptWords&) = delete;

 private:
  BenchMotor& motor_;
  std::vector<std::pair<std::string, double>> values_;
};

}  // namespace feltgate::host
