// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// A simulated board as the port of a host in the same program. The board's time goes on while the
// host waits for bytes, and else when it is told to: the load of the machine decides nothing.
// Documentation: docs/host.md
#pragma once

#include <algorithm>
#include <deque>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "host/board/board.hpp"
#include "host/transport.hpp"

namespace feltgate::board {

/// The port.
class BoardWire : public host::Transport {
 public:
  BoardWire(std::unique_ptr<Core> core, const plant::Parameters& plant, const plant::Hand& hand,
            const Setup& setup, std::string name = "simulated board")
      : board_(std::move(core), plant, hand, setup), name_(std::move(name)) {}

  void write(const std::uint8_t* data, std::size_t size) override {
    board_.receive({data, data + size});
    asked_ = true;
    while (board_.core().unsent() > most_unsent) run(slice);
  }
  /// After a request: what comes until the line is quiet, or nothing within 5 ms of the board's
  /// time, whatever the deadline on the wall. A deadline that is over: what has come.
  std::size_t read(std::uint8_t* data, std::size_t size, host::Deadline deadline) override {
    if (asked_ || deadline > host::HostClock::now()) {
      const Clock end = board_.now() + longest;
      while (received_.empty() && board_.now() < end) run(slice);
      for (std::size_t before = 0; before != received_.size() && board_.now() < end; run(slice)) {
        before = received_.size();
      }
    }
    asked_ = false;
    const std::size_t got = std::min(size, received_.size());
    const auto last = received_.begin() + static_cast<std::ptrdiff_t>(got);
    std::copy(received_.begin(), last, data);
    received_.erase(received_.begin(), last);
    return got;
  }
  const std::string& name() const override { return name_; }

  /// Lets the board run to this clock.
  void run_to(Clock clock) {
    board_.run_to(clock);
    for (const std::uint8_t byte : board_.take_sent()) received_.push_back(byte);
  }
  const LeverBoard& board() const { return board_; }

 private:
  static constexpr Clock slice = 1000, longest = 250'000;
  static constexpr std::size_t most_unsent = 64;
  void run(Clock clocks) { run_to(board_.now() + clocks); }

  LeverBoard board_;
  std::string name_;
  std::deque<std::uint8_t> received_;
  bool asked_ = false;  ///< since the last read
};

}  // namespace feltgate::board
