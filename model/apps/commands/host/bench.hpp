// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// A measurement on the bench: the motor in its mode and held armed, what is typed meanwhile, and
// the design that it changes. Documentation: docs/calibration.md
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "apps/commands/host/session.hpp"
#include "files/output_file.hpp"
#include "host/calibrate/report.hpp"

namespace feltgate::host {

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

/// Reads a line that a user types while a motor is held armed; calls `meanwhile` about fifty times
/// a second while it waits. Returns nothing when `go_on` returns false. Throws
/// std::invalid_argument at the end of the input; the message names `what` was expected.
std::optional<std::string> typed_line(const std::string& what, const std::function<bool()>& go_on,
                                      const std::function<void()>& meanwhile);

/// The design for which a measurement is made, and what it writes.
class Bench {
 public:
  /// `verb` names the command in messages. `from`: files with the measurement; if the first is
  /// empty, it is made at the board. With a board: its design, which must be known. PORT "-" means
  /// no board: the design of --design, else lever. Opens the files of --write and --json, which
  /// must not be one of `from`.
  Bench(Session& session, const std::string& verb, const std::vector<std::string>& from,
        const std::string& write, const std::string& json);
  const design::Elaborated& design() const { return design_; }
  files::Outputs& outputs() { return outputs_; }
  /// Says the text and the changes, and writes the design with them and the JSON.
  void finish(const std::string& text, nlohmann::ordered_json result,
              const std::vector<Change>& changes);

 private:
  std::string changes_told(const std::vector<Change>& changes);
  design::Elaborated design_;
  files::Outputs outputs_;
  std::string path_;  ///< of --write
  files::OutputFile *write_, *json_;
};

}  // namespace feltgate::host
