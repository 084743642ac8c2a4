// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The ports of a device with several axes. Documentation: docs/architecture.md
#pragma once

#include <array>
#include <cstdint>

#include "feltgate/core_ports.hpp"
#include "feltgate/generated/engine.hpp"

namespace feltgate {

/// Inputs of N axes in one clock.
template <int N>
struct AxesIn {
  struct Axis {
    EncoderPins encoder;
    bool encoder_data = false;  ///< of an absolute encoder, as in CoreIn
    bool set_zero = false;
    std::uint8_t scene = 0;
    std::int32_t law_torque = 0;  ///< raw, in the format of the torque
  };
  std::array<Axis, N> axis;
  bool arm = false;
  bool stop = false;  ///< the stop input was active since the last clock, however shortly
  bool law_late = false, law_restart = false;  ///< as in CoreIn
  std::uint16_t reg_addr = 0;  ///< axis n begins at n * axes_stride, the engine at axes_engine
  std::uint32_t reg_wdata = 0;
  bool reg_write = false;
  bool reg_read = false;  ///< one clock: the read word was taken; matters for the engine's events
};

/// The inputs of a core as the inputs of a device with one axis.
inline AxesIn<1> single_axis(const CoreIn& in) {
  AxesIn<1> to;
  to.axis[0].encoder = in.encoder;
  to.axis[0].encoder_data = in.encoder_data;
  to.axis[0].set_zero = in.set_zero;
  to.axis[0].scene = in.scene;
  to.arm = in.arm;
  to.stop = in.stop;
  to.reg_addr = in.reg_addr;
  to.reg_wdata = in.reg_wdata;
  to.reg_write = in.reg_write;
  return to;
}

/// Address distance from one axis to the next.
constexpr int axes_stride = 0x400;
/// First address of the engine, which occupies 0x1000 addresses.
constexpr int axes_engine = EngineMap::port_first;

/// Outputs of N axes after one clock.
template <int N>
struct AxesOut {
  std::array<CoreOut, N> axis;  ///< reg_rdata and reg_busy of each axis are its own
  std::uint32_t reg_rdata = 0;
  bool reg_busy = false;    ///< of the addressed axis or engine
  bool rdata_known = true;  ///< false up to 40 clocks after a reset, while rdata is arbitrary
  bool event_valid = false;
  int event_number = 0;          ///< valid with event_valid
  std::int32_t event_value = 0;  ///< valid with event_valid
};

}  // namespace feltgate
