// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The host's end of the wire: bytes into levels at the pin, levels into bytes, at an exact baud
// rate. Documentation: docs/link.md
#pragma once

#include <algorithm>
#include <cstdint>
#include <deque>
#include <utility>
#include <vector>

#include "feltgate/uart_rx.hpp"
#include "feltgate/uart_tx.hpp"

namespace feltgate {

class UartLine {
 public:
  UartLine(std::int64_t clock_hz, std::int64_t baud)
      : to_board_(uart_step(clock_hz, baud)), from_board_(uart_step(clock_hz, baud)) {}

  /// To the board, after all that was sent before.
  void send(std::uint8_t byte) { unsent_.push_back(byte); }
  std::size_t unsent() const { return unsent_.size() + (to_board_.busy() ? 1 : 0); }
  /// From the board, as their stop bits end; also those with a wrong one.
  std::vector<std::uint8_t> take_received() { return std::exchange(received_, {}); }
  /// Stop bits that were low.
  std::int64_t errors() const { return errors_; }

  /// The level at the board's rx pin in the clock to come.
  bool level() const { return to_board_.out().tx; }

  /// A clock in which the board's tx pin had this level.
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

  /// So many clocks with this level at tx change no level and bring no byte.
  std::int64_t quiet(bool tx) const {
    if (to_board_.out().ready && !unsent_.empty()) return 0;
    return std::min(to_board_.quiet(), from_board_.quiet(tx));
  }
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
