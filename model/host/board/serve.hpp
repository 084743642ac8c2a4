// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Runs a board behind a pseudo-terminal in step with the wall clock, or feeds it from a recording.
// Documentation: docs/host.md
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "host/board/board.hpp"

namespace feltgate::board {

// The board's end of a pseudo-terminal; a program opens the other end like a serial port.

/// One pseudo-terminal in raw mode.
class PseudoTerminal {
 public:
  /// `link`: a symbolic link to it, which exists as long as this object; empty: none. Errors:
  /// std::invalid_argument with advice if the link cannot be made, std::runtime_error if the system
  /// gives no terminal.
  explicit PseudoTerminal(const std::string& link);
  ~PseudoTerminal();
  PseudoTerminal(const PseudoTerminal&) = delete;
  PseudoTerminal& operator=(const PseudoTerminal&) = delete;

  /// Path of the other end, such as /dev/pts/7.
  const std::string& name() const { return name_; }
  /// Returns the bytes that have arrived, at most `most`; does not wait.
  std::vector<std::uint8_t> read(std::size_t most);
  /// Like a serial line: bytes are lost if nobody reads, or too slowly.
  void write(const std::vector<std::uint8_t>& bytes);
  /// Whether a program has opened the other end.
  bool connected() const;
  /// Number of bytes that were lost because nobody read them.
  std::uint64_t lost() const { return lost_; }

 private:
  int master_ = -1;
  std::string name_, link_;
  std::uint64_t lost_ = 0;
};

/// Speed of a run.
struct Pace {
  double simulated_s = 0, wall_s = 0;
  double busy_s = 0;    ///< processor time spent in the simulation
  double behind_s = 0;  ///< simulated time that was too late and was given up
  /// Simulated seconds per busy second.
  double factor() const { return busy_s > 0 ? simulated_s / busy_s : 0; }
  /// Whether it kept up, except for 1 %.
  bool real_time() const { return behind_s <= 0.01 * simulated_s; }
};

/// Options of serve().
struct ServeOptions {
  double for_s = 0;  ///< simulated; 0: until `go_on` returns false
  bool paced = true;
  RecordingWriter* record = nullptr;
  std::function<bool()> go_on;
  std::function<void(const Pace&)> tell;  ///< called about once per second; may be empty
};

/// Runs the board behind the terminal until `for_s` has passed or `go_on` returns false.
Pace serve(Board& board, PseudoTerminal& terminal, const ServeOptions& options);

/// Feeds the same bytes at the same clocks, at full speed. `go_on` = false ends it early.
Pace replay(Board& board, const Recording& recording, const std::function<bool()>& go_on,
            const std::function<void(double done)>& progress);

}  // namespace feltgate::board
