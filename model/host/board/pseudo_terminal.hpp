// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The board's end of a pseudo-terminal; a program opens the other end like a serial port.
// Documentation: docs/host.md
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace feltgate::board {

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

}  // namespace feltgate::board
