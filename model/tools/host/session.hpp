// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// What the verbs of feltgate host share: the port, the board behind it, its design, and holding an
// armed motor. Documentation: docs/host.md
#pragma once

#include <CLI/CLI.hpp>
#include <atomic>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "host/device.hpp"
#include "host/keep_alive.hpp"
#include "host/law_engine.hpp"

namespace feltgate::host {

/// Exit codes beside those of all commands: 0 done, 1 the board refused, 2 unusable input.
constexpr int exit_link = 3;  ///< the link broke down, or nothing answers

/// The words before the verb.
struct SessionOptions {
  std::string port, design, law;
  int baud = 0;
  double patience_s = 0;
};

/// One port, opened when it is first asked for.
class Session {
 public:
  SessionOptions options;

  Link& link();
  /// Asked for once.
  const BoardInfo& board();
  /// The board's design: the one given, which must be the board's, or the one of rtl/designs that
  /// has its CRC. Throws std::invalid_argument that says how to give it.
  const KnownDesign& design();
  /// The design if it is known.
  const KnownDesign* design_if_known();
  Device& device();
  /// The engine of the board's laws. Its law is known where --law gives it or this computer loaded
  /// it. Throws Refused where the board has none, or runs another law than --law.
  LawEngine& laws();
  /// nullptr where the board has no engine.
  LawEngine* laws_if_any();
  /// The image of a law file, compiled for the board's design, or of an image. Throws with line,
  /// reason and mend.
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

/// A verb of feltgate host. To add one: write its add function, put it into verbs().
struct Verb {
  const char* name;
  const char* about;
  /// Adds options to `sub`; returns what runs it and gives the exit code.
  std::function<int(Session&)> (*add)(CLI::App& sub);
};
/// In the order in which help shows them.
const std::vector<Verb>& verbs();

/// While this lives, Ctrl-C, SIGTERM and SIGHUP only set a flag.
class Interruptible {
 public:
  Interruptible();
  ~Interruptible();
  Interruptible(const Interruptible&) = delete;
  Interruptible& operator=(const Interruptible&) = delete;
  static bool interrupted();
};

/// A KeepAlive that disarms on every way out, and says so where that fails.
class Hold {
 public:
  explicit Hold(Device& device) : keep_(device) {}
  ~Hold();
  Hold(const Hold&) = delete;
  Hold& operator=(const Hold&) = delete;

  /// Arms, with the watchdog awake; Ctrl-C ends the wait for it.
  void arm(const std::string& scene);
  void take_over() { keep_.take_over(); }
  bool holds() const { return keep_.holds(); }
  void poll() { keep_.poll(); }
  double next_in_s() const { return keep_.next_in_s(); }
  void release() { keep_.release(); }

 private:
  KeepAlive keep_;
};

/// What to print first wherever values of a simulated board are shown; nothing for a real one.
std::string simulated_banner(const BoardInfo& board);

/// A line about where the link stands, for the end of a verb; nothing when all went well.
std::string link_troubles(const LinkCounts& counts);

}  // namespace feltgate::host
