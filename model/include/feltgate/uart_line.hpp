// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The host's end of the serial line: converts bytes to levels at the pin and levels to bytes, at an
// exact baud rate. Documentation: docs/link.md
#pragma once

#include <algorithm>
#include <cstdint>
#include <deque>
#include <utility>
#include <vector>

#include "feltgate/uart_rx.hpp"
#include "feltgate/uart_tx.hpp"

namespace feltgate {

/// A transmitter and a receiver with queues, clock by clock.
class UartLine {
 public:
  UartLine(std::int64_t clock_hz, std::int64_t baud)
      : to_board_(uart_step(clock_hz, baud)), from_board_(uart_step(clock_hz, baud)) {}

  /// Queues a byte for the board, after all bytes sent before.
  void send(std::uint8_t byte) { unsent_.push_back(byte); }
  /// Number of bytes that are not sent completely yet.
  std::size_t unsent() const { return unsent_.size() + (to_board_.busy() ? 1 : 0); }
  /// Bytes from the board whose stop bits have ended, also those with a wrong stop bit; empties the
  /// list.
  std::vector<std::uint8_t> take_received() { return std::exchange(received_, {}); }
  /// Number of stop bits that were low.
  std::int64_t errors() const { return errors_; }

  /// The level at the board's rx pin in the next clock.
  bool level() const { return to_board_.out().tx; }

  /// One clock, in which the board's tx pin had level `tx`.
  void clock(bool tx) {
    const bool taken = to_board_.out().ready && !unsent_.empty();
    to_board_.clock({taken ? unsent_.front() : std::uint8_t{0}, taken});
    if (taken) unsent_.pop_front();
    from_board_.clock({tx});
    if (from_board_.out().valid || from_board_.out().error) {
      received_.push_back(from_board_.out().byte);
    }
    errors_ += from_board_.out().error ? 1 : 0;
  }

  /// Number of clocks, with `tx` held, in which no level changes and no byte arrives: skip() may
  /// pass up to so many.
  std::int64_t quiet(bool tx) const {
    if (to_board_.out().ready && !unsent_.empty()) return 0;
    return std::min(to_board_.quiet(), from_board_.quiet(tx));
  }
  /// Equals `clocks` calls of clock() with the level held; `clocks` must not exceed quiet().
  void skip(std::int64_t clocks) {
    to_board_.skip(clocks);
    from_board_.skip(clocks);
  }

 private:
  UartTx to_board_;
  UartRx from_board_;
  std::deque<std::uint8_t> unsent_;
  std::vector<std::uint8_t> received_;
  std::int64_t errors_ = 0;
};

}  // namespace feltgate
