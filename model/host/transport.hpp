// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Bytes to and from a board: over a serial port, or any stream of the operating system.
// Documentation: docs/host.md
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

namespace feltgate::host {

using HostClock = std::chrono::steady_clock;
using Deadline = HostClock::time_point;

/// The deadline `seconds` from now.
Deadline within(double seconds);

/// The port cannot be opened: missing, no permission, or in use. The text says what to do.
struct PortError : std::invalid_argument {
  using std::invalid_argument::invalid_argument;
};

/// The link broke down while in use: the port disappeared, or the board does not answer.
struct LinkLost : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// A stream of bytes with a time limit for reading.
class Transport {
 public:
  virtual ~Transport() = default;
  /// Writes all bytes. Errors: LinkLost if the port disappeared, or takes nothing for a second.
  virtual void write(const std::uint8_t* data, std::size_t size) = 0;
  /// Returns the bytes that have arrived, at most `size`; waits for the first until `deadline`. 0:
  /// none came. Errors: LinkLost if the port disappeared.
  virtual std::size_t read(std::uint8_t* data, std::size_t size, Deadline deadline) = 0;
  /// Name in messages, such as /dev/ttyUSB0.
  virtual const std::string& name() const = 0;
};

/// Opens the serial port `path` with 8 bits, no parity, one stop bit and no flow control at `baud`
/// bits per second. Access is exclusive: others get "busy". A pseudo-terminal ignores the rate.
/// Errors: PortError for no such port (lists the existing ones), no permission, in use (says by
/// whom), not a serial port, or a rate that the system does not know.
std::unique_ptr<Transport> open_serial(const std::string& path, int baud);

/// A transport over an open descriptor that can be polled, such as one end of a socket pair; it
/// closes the descriptor at the end.
std::unique_ptr<Transport> open_stream(int descriptor, const std::string& name);

/// A serial port of this machine.
struct FoundPort {
  std::string path;   ///< /dev/ttyUSB0
  std::string about;  ///< its name in /dev/serial/by-id; may be empty
};

/// USB serial ports and the UARTs that answer; without pseudo-terminals.
std::vector<FoundPort> found_ports();

/// "name (pid N), ..." for the programs that have `path` open, as far as visible; else empty.
std::string holders_of(const std::string& path);

}  // namespace feltgate::host
