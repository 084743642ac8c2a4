// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The chip on the simulated board: core and link of one design, as twin or as Verilated RTL.
// Documentation: docs/host.md
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "feltgate/core_ports.hpp"
#include "feltgate/design_info.hpp"
#include "sim/backends/backend.hpp"

namespace feltgate::board {

/// Pins of the board, which hold for a number of clocks.
struct BoardIn {
  std::array<EncoderPins, most_axes> encoder;  ///< of each axis that the board has
  std::uint8_t current_data = 0;               ///< of a current loop: bit n of modulator n
  std::uint8_t hall = 0;                       ///< of a motor with Hall lines; bit n: line n
  bool arm = false, stop = false;
  std::uint8_t scene = 0;  ///< of all axes
};

/// Properties of the simulated board.
struct BoardOptions {
  std::int64_t baud = 1'000'000;
  bool simulated = true;
  int board = 0;             ///< number that the board reports
  std::uint32_t inputs = 1;  ///< bit 0: the encoder's connector is plugged in
};

/// A running sum over all outputs of each tick: equal sums mean equal ticks.
class TickHash {
 public:
  void add(const CoreOut& o) {
    mix(o.tick_count | static_cast<std::uint64_t>(static_cast<std::uint32_t>(o.position)) << 32);
    mix(static_cast<std::uint64_t>(o.velocity));
    mix(pair(o.tau_hat, o.tau_ref));
    mix(pair(o.current_ref, o.voltage));
    mix(pair(o.duty, o.duty_active));
    mix(o.scene | std::uint64_t{o.first_fault} << 8 | std::uint64_t{o.limits} << 16 |
        std::uint64_t{o.faults} << 32 | std::uint64_t{o.armed} << 48 |
        std::uint64_t{o.gates_enable} << 49);
    ++ticks_;
  }
  std::uint64_t value() const { return sum_; }
  std::int64_t ticks() const { return ticks_; }

 private:
  static std::uint64_t pair(std::int32_t low, std::int32_t high) {
    return static_cast<std::uint32_t>(low) |
           static_cast<std::uint64_t>(static_cast<std::uint32_t>(high)) << 32;
  }
  // One round of FNV over a whole word; the high half is folded in.
  void mix(std::uint64_t word) {
    sum_ = (sum_ ^ word) * 0x9e3779b97f4a7c15U;
    sum_ ^= sum_ >> 32;
  }
  std::uint64_t sum_ = 0xcbf29ce484222325U;
  std::int64_t ticks_ = 0;
};

/// Core, or axes, and link of one design behind a serial line.
class Core {
 public:
  virtual ~Core() = default;
  virtual const DesignInfo& design() const = 0;
  /// The kind of core, for messages.
  virtual const char* kind() const = 0;
  /// The shaft of an absolute encoder turns between these angles in the next `clocks`.
  virtual void turn_encoder(double from_rad, double to_rad, Clock clocks) = 0;
  /// Runs `clocks` clocks with these pins held.
  virtual void run(const BoardIn& in, Clock clocks) = 0;
  /// Queues a byte for the board's rx pin.
  virtual void send(std::uint8_t byte) = 0;
  virtual std::size_t unsent() const = 0;
  /// Bytes from the tx pin whose stop bits have ended; empties the list.
  virtual std::vector<std::uint8_t> take_received() = 0;
  virtual std::size_t axes() const { return 1; }
  /// Duty of an axis in force, in clocks of the PWM period, and whether the gates are enabled.
  virtual int duty(std::size_t axis = 0) const = 0;
  /// Of a bridge with three legs: clocks of a leg's high gate in a period, in force.
  virtual int on_time(std::size_t leg) const = 0;
  virtual bool gates_enabled(std::size_t axis = 0) const = 0;
  /// Clocks that each gate was on since the last call. Only a design with a current loop counts
  /// them: its plant is moved by the gates.
  virtual GateClocks take_gates() = 0;
  virtual const TickHash& ticks() const = 0;
};

/// Makes the core "twin" of a design, or "rtl" where the program has its Verilated board. Errors:
/// std::invalid_argument that names the command which builds it.
std::unique_ptr<Core> make_core(const std::string& design, const std::string& kind,
                                const BoardOptions& options);

/// Adds the Verilated board of a design, before main(), as add_rtl().
using RtlCoreMaker = std::unique_ptr<Core> (*)(const DesignInfo&, const BoardOptions&);
bool add_rtl_core(const std::string& design, std::uint32_t design_crc, RtlCoreMaker maker);

}  // namespace feltgate::board
