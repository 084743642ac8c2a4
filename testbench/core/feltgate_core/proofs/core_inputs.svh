// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The inputs of the core, free in every clock: the ports of a wrapper, before its own.

    input logic                                     clk_i,
    input logic                                     rst_ni,
    input logic                                     enc_a_i,
    input logic                                     enc_b_i,
    input logic                                     enc_z_i,
    input logic                                     encoder_data_i,
    input logic                                     current_data_i,
    input logic                                     driver_fault_i,
    input logic                                     arm_i,
    input logic                                     stop_i,
    input logic                                     set_zero_i,
    input logic [                              3:0] scene_i,
    input logic signed [feltgate_pkg::TORQUE_W-1:0] law_torque_i,
    input logic                                     law_late_i,
    input logic                                     law_restart_i,
    input logic                                     axis_fault_i,
    input logic                                     axis_silent_i,
    input logic                                     axis_blocked_i,
    input logic                                     axis_testing_i,
    input logic                                     axis_waits_i,
    input logic [                             11:0] reg_addr_i,
    input logic [                             31:0] reg_wdata_i,
    input logic                                     reg_write_i
