// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Shared parts of the verbs of feltgate host: the port, its board, the board's design, and holding
// a motor armed. Documentation: docs/host.md
#pragma once

#include <CLI/CLI.hpp>
#include <atomic>
#include <memory>
#include <optional>
#include <string>

#include "host/host_device.hpp"
#include "host/law_engine.hpp"

namespace feltgate::host {

/// Exit codes, with the codes of all commands: 0 done, 1 the board refused, 2 unusable input.
constexpr int exit_link = 3;  ///< the link failed, or nothing answers

/// The options before the verb.
struct SessionOptions {
  std::string port, design, law;
  int baud = 0;
  double patience_s = 0;
};

/// One port, opened at its first use.
class Session {
 public:
  SessionOptions options;

  Link& link();
  /// The board's data, requested once.
  const BoardInfo& board();
  /// The board's design: the given one, which must match the board, or the one in rtl/designs with
  /// the same CRC. Throws std::invalid_argument, which explains how to give it.
  const KnownDesign& design();
  /// The design, or nullptr if it is not known.
  const KnownDesign* design_if_known();
  Device& device();
  /// The engine of the board's laws. Its law is known if --law gives it or this computer loaded it.
  /// Throws Refused when the board has no engine, or runs another law than --law.
  LawEngine& laws();
  /// The same, or nullptr when the board has no engine.
  LawEngine* laws_if_any();
  /// The image of a law file, compiled for the board's design, or of an image file. Throws with
  /// line, reason and mend.
  law::Image image_of(const std::string& law);

 private:
  std::unique_ptr<Transport> transport_;
  std::optional<Link> link_;
  std::optional<BoardInfo> board_;
  std::optional<KnownDesign> design_;
  std::optional<Device> device_;
  std::optional<LawEngine> laws_;
  bool looked_ = false;
};

/// During its lifetime, Ctrl-C, SIGTERM and SIGHUP only set a flag.
class Interruptible {
 public:
  Interruptible();
  ~Interruptible();
  Interruptible(const Interruptible&) = delete;
  Interruptible& operator=(const Interruptible&) = delete;
  static bool interrupted();
};

/// A KeepAlive that disarms on every exit path, and reports a failure to do so.
class Hold {
 public:
  explicit Hold(Device& device) : keep_(device) {}
  ~Hold();
  Hold(const Hold&) = delete;
  Hold& operator=(const Hold&) = delete;

  /// Arms the motor with the watchdog enabled; Ctrl-C ends the wait.
  void arm(const std::string& scene);
  void take_over() { keep_.take_over(); }
  /// Arms, or without a scene takes over what the host has armed.
  void begin(const std::string& scene) { scene.empty() ? take_over() : arm(scene); }
  bool holds() const { return keep_.holds(); }
  void poll() { keep_.poll(); }
  double next_in_s() const { return keep_.next_in_s(); }
  void release() { keep_.release(); }

 private:
  KeepAlive keep_;
};

/// The faults of a tick, each in a line of its own after "\n  ".
std::string fault_lines(const Device& device, const Tick& tick);

/// To stdout, at once.
void say(const std::string& text);

/// The banner above values of a simulated board; empty for a real one.
std::string simulated_banner(const BoardInfo& board);

/// A line about link errors, for the end of a verb; empty when there were none.
std::string link_troubles(const LinkCounts& counts);

}  // namespace feltgate::host
