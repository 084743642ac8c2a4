// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Converts the ports of Verilated axes to the twin's types. Documentation:
// docs/architecture.md
#pragma once

#include <cstdint>
#include <type_traits>

#include "feltgate/axes_ports.hpp"
#include "feltgate/generated/map.hpp"
#include "rtl_ports.hpp"

namespace feltgate {

/// Bits [first, first + width) of a port in any storage type of Verilator; width up to 33.
template <class Port>
std::uint64_t bits_of(const Port& port, int first, int width) {
  std::uint64_t word = 0;
  if constexpr (std::is_integral<Port>::value) {
    word = static_cast<std::uint64_t>(port) >> first;
  } else {
    word = std::uint64_t{port[first / 32]} >> first % 32;
    if (first % 32 + width > 32) {
      word |= std::uint64_t{port[first / 32 + 1]} << (32 - first % 32);
    }
  }
  return word & ((std::uint64_t{1} << width) - 1);
}
template <class Port>
void set_bits(Port& port, int first, int width, std::uint64_t value) {
  for (int k = 0; k < width; ++k) {
    const int at = first + k;
    const std::uint64_t bit = value >> k & 1u;
    if constexpr (std::is_integral<Port>::value) {
      const std::uint64_t mask = std::uint64_t{1} << at;
      port = static_cast<Port>((static_cast<std::uint64_t>(port) & ~mask) | bit << at);
    } else {
      const std::uint32_t mask = 1u << at % 32;
      port[at / 32] = (port[at / 32] & ~mask) | static_cast<std::uint32_t>(bit << at % 32);
    }
  }
}

/// Sets every input except clock and reset of N axes; the engine gives the torques.
template <int N, class Rtl>
void drive_axes(Rtl& rtl, const AxesIn<N>& in) {
  unsigned a = 0, b = 0, z = 0, data = 0;
  for (int n = 0; n < N; ++n) {
    const auto& axis = in.axis[static_cast<std::size_t>(n)];
    a |= unsigned{axis.encoder.a} << n;
    b |= unsigned{axis.encoder.b} << n;
    z |= unsigned{axis.encoder.z} << n;
    data |= unsigned{axis.encoder_data} << n;
    set_bits(rtl.set_zero_i, n, 1, axis.set_zero);
    set_bits(rtl.scene_i, 4 * n, 4, axis.scene);
  }
  set_enc_a_i(rtl, a, 0);
  set_enc_b_i(rtl, b, 0);
  set_enc_z_i(rtl, z, 0);
  set_encoder_data_i(rtl, data, 0);
  rtl.arm_i = in.arm;
  rtl.stop_i = in.stop;
  rtl.reg_addr_i = in.reg_addr;
  rtl.reg_wdata_i = in.reg_wdata;
  rtl.reg_write_i = in.reg_write;
  rtl.reg_read_i = in.reg_read;
}

/// Every output of axis n after an edge; read data belong to the device, not the axis.
template <class Rtl>
CoreOut read_axis(const Rtl& rtl, const PortBits& bits, int n) {
  using C = Map::C;
  const auto number = [n](const auto& port, int width) {
    return sign_extend(bits_of(port, n * width, width), width);
  };
  const auto word = [n](const auto& port, int width) {
    return static_cast<std::uint32_t>(bits_of(port, n * width, width));
  };
  CoreOut o;
  o.position = static_cast<std::int32_t>(word(rtl.position_o, 32));
  o.velocity = number(rtl.velocity_o, bits.velocity);
  o.tau_hat = static_cast<std::int32_t>(number(rtl.tau_hat_o, bits.torque));
  o.tau_ref = static_cast<std::int32_t>(number(rtl.tau_ref_o, bits.torque));
  o.current_ref = static_cast<std::int32_t>(number(rtl.current_ref_o, bits.current));
  o.voltage = static_cast<std::int32_t>(number(rtl.voltage_o, bits.voltage));
  o.duty = static_cast<std::int16_t>(number(rtl.duty_o, bits.duty));
  o.duty_active = static_cast<std::int16_t>(number(rtl.duty_active_o, bits.duty));
  o.gates =
      static_cast<std::uint8_t>(word(rtl.gate_a_hi_o, 1) | word(rtl.gate_a_lo_o, 1) << 1 |
                                word(rtl.gate_b_hi_o, 1) << 2 | word(rtl.gate_b_lo_o, 1) << 3);
  o.gates_enable = word(rtl.gates_enable_o, 1) != 0;
  o.armed = word(rtl.armed_o, 1) != 0;
  o.scene = static_cast<std::uint8_t>(word(rtl.scene_o, 4));
  o.limits = static_cast<std::uint16_t>(word(rtl.limits_o, C::status_limits_width));
  o.faults = static_cast<std::uint16_t>(word(rtl.faults_o, C::faults_seen_width));
  o.first_fault = static_cast<std::uint8_t>(word(rtl.first_fault_o, C::faults_first_width));
  o.tick_count = rtl.tick_count_o;
  o.snapshot_valid = rtl.snapshot_valid_o != 0;
  o.word_valid = word(rtl.word_valid_o, 1) != 0;
  o.word_slot = static_cast<std::uint8_t>(word(rtl.word_slot_o, 6));
  o.word_data = word(rtl.word_data_o, 32);
  return o;
}

}  // namespace feltgate
