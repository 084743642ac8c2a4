// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Bytes to and from a board: a serial port, or any stream of the operating system. Documentation:
// docs/host.md
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

/// So many seconds from now.
Deadline within(double seconds);

/// The port cannot be opened: not there, not ours, or somebody else has it. The text says the mend.
struct PortError : std::invalid_argument {
  using std::invalid_argument::invalid_argument;
};

/// The link broke down while it was in use: the port went away, or the board says nothing.
struct LinkLost : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// A stream of bytes with a time limit on reading.
class Transport {
 public:
  virtual ~Transport() = default;
  /// All of them. Throws LinkLost when the port has gone, or takes nothing for a second.
  virtual void write(const std::uint8_t* data, std::size_t size) = 0;
  /// What has arrived, at most `size` bytes; waits for the first until `deadline`. 0: none came.
  /// Throws LinkLost when the port has gone.
  virtual std::size_t read(std::uint8_t* data, std::size_t size, Deadline deadline) = 0;
  /// How messages call it, such as /dev/ttyUSB0.
  virtual const std::string& name() const = 0;
};

/// The serial port `path` with 8 bits, no parity, one stop bit and no flow control at `baud` per
/// second, for us alone: others get "busy". A pseudo-terminal ignores the rate.
/// Throws PortError: no such port (lists those that there are), no permission, in use (says by
/// whom), not a serial port, a rate that the system does not know.
std::unique_ptr<Transport> open_serial(const std::string& path, int baud);

/// An open descriptor that can be polled, such as one end of a socket pair; it is closed at the
/// end.
std::unique_ptr<Transport> open_stream(int descriptor, const std::string& name);

/// A serial port of this machine.
struct FoundPort {
  std::string path;   ///< /dev/ttyUSB0
  std::string about;  ///< what /dev/serial/by-id calls it; may be empty
};

/// USB serial ports and the UARTs that answer; no pseudo-terminals.
std::vector<FoundPort> found_ports();

/// "name (pid N), ..." of the programs that have `path` open, as far as we may see; else nothing.
std::string holders_of(const std::string& path);

}  // namespace feltgate::host
