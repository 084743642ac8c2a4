// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The device that feltgate_linked, feltgate_axes and a board contain: a top of this folder. One define
// chooses it, without one it is the lever. `PINS(T) are its pins as ports, of type T where several
// axes may have them; `PINS_OF(n) connects those of axis n; `ENCODER_LINES are what a panel shows of
// the encoder. docs/architecture.md

`ifndef FELTGATE_DEVICE
`define FELTGATE_DEVICE

// Pins of the sockets.
`define QUADRATURE(T) input T enc_a_i, input T enc_b_i, input T enc_z_i
`define QUADRATURE_OF(n) .enc_a_i(enc_a_i[n]), .enc_b_i(enc_b_i[n]), .enc_z_i(enc_z_i[n])
`define ABSOLUTE(T) \
  input T encoder_data_i, output T encoder_select_no, output T encoder_clock_o, output T encoder_command_o
`define ABSOLUTE_OF(n) \
  .encoder_data_i(encoder_data_i[n]), .encoder_select_no(encoder_select_no[n]), \
  .encoder_clock_o(encoder_clock_o[n]), .encoder_command_o(encoder_command_o[n])
`define TWO_LEGS(T) output T gate_a_hi_o, output T gate_a_lo_o, output T gate_b_hi_o, output T gate_b_lo_o
`define TWO_LEGS_OF(n) \
  .gate_a_hi_o(gate_a_hi_o[n]), .gate_a_lo_o(gate_a_lo_o[n]), .gate_b_hi_o(gate_b_hi_o[n]), .gate_b_lo_o(gate_b_lo_o[n])
`define THREE_LEGS(T) `TWO_LEGS(T), output T gate_c_hi_o, output T gate_c_lo_o
`define THREE_LEGS_OF(n) `TWO_LEGS_OF(n), .gate_c_hi_o(gate_c_hi_o[n]), .gate_c_lo_o(gate_c_lo_o[n])
`define CURRENT(D) input D current_data_i, output logic current_clock_o, input logic driver_fault_i, output logic heartbeat_o
`define CURRENT_OF \
  .current_data_i(current_data_i), .current_clock_o(current_clock_o), .driver_fault_i(driver_fault_i), .heartbeat_o(heartbeat_o)

`ifdef FELTGATE_LEVER_CURRENT
`define DEVICE lever_current_top
`define ENCODER_LINES {enc_z_i, enc_b_i, enc_a_i}
`define DRIVER_PIN
`define PINS(T) `QUADRATURE(T), `TWO_LEGS(T), `CURRENT(logic)
`define PINS_OF(n) `QUADRATURE_OF(n), `TWO_LEGS_OF(n), `CURRENT_OF
`elsif FELTGATE_LEVER_ABSOLUTE
`define DEVICE lever_absolute_top
`define ENCODER_LINES 3'b000
`define PINS(T) `ABSOLUTE(T), `TWO_LEGS(T)
`define PINS_OF(n) `ABSOLUTE_OF(n), `TWO_LEGS_OF(n)
`elsif FELTGATE_GIMBAL_MOTOR
`define DEVICE gimbal_motor_top
`define ENCODER_LINES 3'b000
`define PINS(T) `ABSOLUTE(T), `THREE_LEGS(T)
`define PINS_OF(n) `ABSOLUTE_OF(n), `THREE_LEGS_OF(n)
`elsif FELTGATE_GIMBAL_CURRENT
`define DEVICE gimbal_current_top
`define ENCODER_LINES 3'b000
`define DRIVER_PIN
`define PINS(T) `ABSOLUTE(T), `THREE_LEGS(T), `CURRENT(logic [1:0])
`define PINS_OF(n) `ABSOLUTE_OF(n), `THREE_LEGS_OF(n), `CURRENT_OF
`elsif FELTGATE_HALL_MOTOR
`define DEVICE hall_motor_top
`define ENCODER_LINES {enc_z_i, enc_b_i, enc_a_i}
`define PINS(T) `QUADRATURE(T), input logic [2:0] hall_i, `THREE_LEGS(T)
`define PINS_OF(n) `QUADRATURE_OF(n), .hall_i(hall_i), `THREE_LEGS_OF(n)
`else
`define DEVICE lever_top
`define ENCODER_LINES {enc_z_i, enc_b_i, enc_a_i}
`define PINS(T) `QUADRATURE(T), `TWO_LEGS(T)
`define PINS_OF(n) `QUADRATURE_OF(n), `TWO_LEGS_OF(n)
`endif

`endif
