// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The board's end of a pseudo-terminal, whose other end a program opens like a serial port.
// Documentation: docs/board.md
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace feltgate::board {

class PseudoTerminal {
 public:
  /// `link`: a symbolic link that leads to it while this lives; empty: none. Throws
  /// std::invalid_argument with the mend where the link cannot be made, std::runtime_error where
  /// the system gives no terminal.
  explicit PseudoTerminal(const std::string& link);
  ~PseudoTerminal();
  PseudoTerminal(const PseudoTerminal&) = delete;
  PseudoTerminal& operator=(const PseudoTerminal&) = delete;

  /// Such as /dev/pts/7.
  const std::string& name() const { return name_; }
  /// What has arrived, at most `most` bytes; does not wait.
  std::vector<std::uint8_t> read(std::size_t most);
  /// As a wire does it: where nobody listens, or too slowly, bytes are lost.
  void write(const std::vector<std::uint8_t>& bytes);
  /// Whether a program has the other end open.
  bool connected() const;
  /// Bytes that nobody took.
  std::uint64_t lost() const { return lost_; }

 private:
  int master_ = -1;
  std::string name_, link_;
  std::uint64_t lost_ = 0;
};

}  // namespace feltgate::board
