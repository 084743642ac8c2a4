// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The ports of the core, or of several axes, with the link. Documentation:
// docs/link.md
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "feltgate/axes_ports.hpp"
#include "feltgate/core_ports.hpp"
#include "feltgate/generated/link.hpp"

namespace feltgate {

/// Inputs in one clock.
struct LinkedIn {
  EncoderPins encoder;
  /// Of a design with these options, as in CoreIn; in others they are not used.
  bool encoder_data = false, driver_fault = false;
  std::uint8_t current_data = 0;  ///< bit n: of modulator n
  std::uint8_t hall = 0;          ///< bit n: line n
  bool arm = false, stop = false, set_zero = false;
  bool clear_faults = false;  ///< one clock, like set_zero
  std::uint8_t scene = 0;
  std::uint8_t inputs = 0;
  bool uart_rx = true;
};
/// Outputs after one clock.
struct LinkedOut {
  CoreOut core;
  bool uart_tx = true;
};
/// The same of N axes, each with its own pins.
template <int N>
struct LinkedAxesIn {
  struct Axis {
    EncoderPins encoder;
    bool set_zero = false;
    std::uint8_t scene = 0;
  };
  std::array<Axis, N> axis;
  bool arm = false, stop = false;
  bool clear_faults = false;  ///< one clock, like set_zero; of all axes
  std::uint8_t inputs = 0;
  bool uart_rx = true;
};
template <int N>
struct LinkedAxesOut {
  std::array<CoreOut, N> axis;
  bool uart_tx = true;
};
/// Parameters of the RTL, and the simulated line's baud rate.
struct LinkedOptions {
  std::int64_t baud = LinkMap::baud;
  bool simulated = false;
  int board = 0;
};

/// What several axes have as one core has it.
namespace linked {

/// Number of the snapshot's word at a slot.
constexpr std::uint8_t number_of(int slot) {
  std::uint8_t n = 0;
  while (n + 1 < LinkMap::snapshot_words && LinkMap::slots[n] != slot) ++n;
  return n;
}

inline const CoreOut& axis(const LinkedOut& out, std::size_t) { return out.core; }
template <int N>
const CoreOut& axis(const LinkedAxesOut<N>& out, std::size_t n) {
  return out.axis[n];
}

/// Whether an input is high that lasts one clock.
inline bool pulses(const LinkedIn& in) { return in.set_zero || in.clear_faults; }
template <int N>
bool pulses(const LinkedAxesIn<N>& in) {
  bool any = in.clear_faults;
  for (const auto& axis : in.axis) any |= axis.set_zero;
  return any;
}
inline void end_pulses(LinkedIn& in) { in.set_zero = in.clear_faults = false; }
template <int N>
void end_pulses(LinkedAxesIn<N>& in) {
  in.clear_faults = false;
  for (auto& axis : in.axis) axis.set_zero = false;
}

/// The pins of encoder and panel as the core or the axes have them.
inline void to_device(const LinkedIn& in, CoreIn& to) {
  to.encoder = in.encoder;
  to.encoder_data = in.encoder_data;
  to.current_data = in.current_data;
  to.driver_fault = in.driver_fault;
  to.hall = in.hall;
  to.arm = in.arm;
  to.stop = in.stop;
  to.set_zero = in.set_zero;
  to.scene = in.scene;
}
inline void to_device(const LinkedIn& in, AxesIn<1>& to) {
  CoreIn one;
  to_device(in, one);
  to = single_axis(one);
}
template <int N>
void to_device(const LinkedAxesIn<N>& in, AxesIn<N>& to) {
  for (std::size_t n = 0; n < N; ++n) {
    to.axis[n].encoder = in.axis[n].encoder;
    to.axis[n].set_zero = in.axis[n].set_zero;
    to.axis[n].scene = in.axis[n].scene;
  }
  to.arm = in.arm;
  to.stop = in.stop;
}

}  // namespace linked

}  // namespace feltgate
