// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Converts the ports of the Verilated core to the twin's types. Documentation: docs/architecture.md
#pragma once

#include <cstdint>
#include <optional>
#include <type_traits>
#include <utility>

#include "backend.hpp"
#include "feltgate/axis/design.hpp"
#include "feltgate/core_ports.hpp"

namespace feltgate {

/// The low `width` bits of `word` as a signed number.
constexpr std::int64_t sign_extend(std::uint64_t word, int width) {
  const std::uint64_t sign = std::uint64_t{1} << (width - 1);
  const std::uint64_t low = word & ((sign << 1) - 1);
  return static_cast<std::int64_t>(low ^ sign) - static_cast<std::int64_t>(sign);
}

namespace detail {

inline std::int32_t narrow_word(std::uint32_t word, int width) {
  return static_cast<std::int32_t>(sign_extend(word, width));
}

}  // namespace detail

/// Whether Rtl is Verilator's class of feltgate_axes, then with one axis.
template <class Rtl, class = void>
constexpr bool is_axes = false;
template <class Rtl>
constexpr bool is_axes<Rtl, std::void_t<decltype(std::declval<Rtl&>().reg_read_i)>> = true;

/// A port that a device has or not, with its sockets: set_NAME() sets it, NAME() gives its value, 0
/// without it.
#define FELTGATE_SOCKET_PIN(name)                                                \
  template <class Rtl>                                                           \
  auto set_##name(Rtl& rtl, unsigned value, int)->decltype(void(rtl.name = 0)) { \
    rtl.name = static_cast<std::remove_reference_t<decltype(rtl.name)>>(value);  \
  }                                                                              \
  template <class Rtl>                                                           \
  void set_##name(Rtl&, unsigned, long) {}                                       \
  template <class Rtl>                                                           \
  auto get_##name(const Rtl& rtl, int)->decltype(unsigned{rtl.name}) {           \
    return rtl.name;                                                             \
  }                                                                              \
  template <class Rtl>                                                           \
  unsigned get_##name(const Rtl&, long) {                                        \
    return 0;                                                                    \
  }
FELTGATE_SOCKET_PIN(enc_a_i)
FELTGATE_SOCKET_PIN(enc_b_i)
FELTGATE_SOCKET_PIN(enc_z_i)
FELTGATE_SOCKET_PIN(encoder_data_i)
FELTGATE_SOCKET_PIN(encoder_select_no)
FELTGATE_SOCKET_PIN(encoder_clock_o)
FELTGATE_SOCKET_PIN(encoder_command_o)
FELTGATE_SOCKET_PIN(hall_i)
FELTGATE_SOCKET_PIN(gate_c_hi_o)
FELTGATE_SOCKET_PIN(gate_c_lo_o)
FELTGATE_SOCKET_PIN(current_data_i)
FELTGATE_SOCKET_PIN(current_clock_o)
FELTGATE_SOCKET_PIN(driver_fault_i)
FELTGATE_SOCKET_PIN(heartbeat_o)
#undef FELTGATE_SOCKET_PIN

/// Bits of the results at the ports of a design, and whether it has an absolute encoder.
struct PortBits {
  explicit PortBits(const axis::Design& d)
      : velocity(d["VELOCITY_W"]),
        torque(d["TORQUE_W"]),
        current(d["CURRENT_W"]),
        voltage(d["VOLTAGE_W"]),
        duty(d["DUTY_W"]),
        absolute(d["ABSOLUTE_ENCODER"] != 0) {}
  int velocity, torque, current, voltage, duty;
  bool absolute;
};

/// Lines to an absolute encoder, as CoreOut::serial.
template <class Rtl>
std::uint8_t serial_lines(const Rtl& rtl, const PortBits& bits) {
  if (!bits.absolute) return 1;
  return static_cast<std::uint8_t>(get_encoder_select_no(rtl, 0) |
                                   get_encoder_clock_o(rtl, 0) << 1 |
                                   get_encoder_command_o(rtl, 0) << 2);
}

/// Sets every input except clock and reset. The caller must lower the stop with the
/// edge: it was active since the last edge, and is not in the next clock.
template <class Rtl>
void drive_inputs(Rtl& rtl, const PortBits& bits, const CoreIn& in) {
  set_enc_a_i(rtl, in.encoder.a, 0);
  set_enc_b_i(rtl, in.encoder.b, 0);
  set_enc_z_i(rtl, in.encoder.z, 0);
  rtl.arm_i = in.arm;
  rtl.stop_i = in.stop;
  rtl.set_zero_i = in.set_zero;
  rtl.scene_i = in.scene;
  rtl.reg_addr_i = in.reg_addr;
  rtl.reg_wdata_i = in.reg_wdata;
  rtl.reg_write_i = in.reg_write;
  rtl.law_torque_i = static_cast<std::uint32_t>(in.law_torque) & ((1u << bits.torque) - 1);
  rtl.law_late_i = in.law_late;
  rtl.law_restart_i = in.law_restart;
  set_encoder_data_i(rtl, in.encoder_data, 0);
  set_hall_i(rtl, in.hall, 0);
  set_current_data_i(rtl, in.current_data, 0);
  set_driver_fault_i(rtl, in.driver_fault, 0);
  if constexpr (is_axes<Rtl>) {
    rtl.reg_read_i = 0;
  } else {
    rtl.axis_fault_i = in.axis_fault;
    rtl.axis_silent_i = in.axis_silent;
    rtl.axis_blocked_i = in.axis_blocked;
    rtl.axis_testing_i = in.axis_testing;
    rtl.axis_waits_i = in.axis_waits;
  }
}

/// Every output after an edge.
template <class Rtl>
CoreOut read_outputs(const Rtl& rtl, const PortBits& bits) {
  CoreOut o;
  o.velocity = sign_extend(rtl.velocity_o, bits.velocity);
  o.tick_count = rtl.tick_count_o;
  o.reg_rdata = rtl.reg_rdata_o;
  o.position = static_cast<std::int32_t>(rtl.position_o);
  o.tau_hat = detail::narrow_word(rtl.tau_hat_o, bits.torque);
  o.tau_ref = detail::narrow_word(rtl.tau_ref_o, bits.torque);
  o.current_ref = detail::narrow_word(rtl.current_ref_o, bits.current);
  o.voltage = detail::narrow_word(rtl.voltage_o, bits.voltage);
  o.duty = static_cast<std::int16_t>(detail::narrow_word(rtl.duty_o, bits.duty));
  o.duty_active = static_cast<std::int16_t>(detail::narrow_word(rtl.duty_active_o, bits.duty));
  o.gates = static_cast<std::uint8_t>(rtl.gate_a_hi_o | rtl.gate_a_lo_o << 1 |
                                      rtl.gate_b_hi_o << 2 | rtl.gate_b_lo_o << 3 |
                                      get_gate_c_hi_o(rtl, 0) << 4 | get_gate_c_lo_o(rtl, 0) << 5);
  o.serial = serial_lines(rtl, bits);
  o.scene = rtl.scene_o;
  o.limits = rtl.limits_o;
  o.faults = rtl.faults_o;
  o.first_fault = rtl.first_fault_o;
  o.armed = rtl.armed_o != 0;
  o.gates_enable = rtl.gates_enable_o != 0;
  o.snapshot_valid = rtl.snapshot_valid_o != 0;
  o.reg_busy = rtl.reg_busy_o != 0;
  o.word_valid = rtl.word_valid_o != 0;
  o.word_slot = rtl.word_slot_o;
  o.word_data = rtl.word_data_o;
  o.current_clock = get_current_clock_o(rtl, 0) != 0;
  o.heartbeat = get_heartbeat_o(rtl, 0) != 0;
  if constexpr (!is_axes<Rtl>) {
    o.current = detail::narrow_word(rtl.current_o, bits.current);
  }
  return o;
}

/// The event that a core with an engine shows in this clock; its tick stays 0.
template <class Rtl>
std::optional<LawEvent> read_law_event(const Rtl& rtl) {
  if constexpr (is_axes<Rtl>) {
    if (rtl.event_valid_o) {
      return LawEvent{static_cast<int>(rtl.event_number_o),
                      static_cast<std::int32_t>(rtl.event_value_o), 0};
    }
  }
  return std::nullopt;
}

}  // namespace feltgate
