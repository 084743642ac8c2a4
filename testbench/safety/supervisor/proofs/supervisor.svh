// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The supervisor among signals of the names of its inputs, and what it trips by.

  localparam int FaultsW = feltgate_map_pkg::W_FAULTS_SEEN;
  localparam int FirstW = feltgate_map_pkg::W_FAULTS_FIRST;
  logic signed [feltgate_pkg::CURRENT_ESTIMATE_W-1:0] estimate;
  logic armed, gates, gates_clear, unkicked, arm_request_o, arms_o, ready_o, clear_o;
  logic [FaultsW-1:0] faults;
  logic [ FirstW-1:0] first;
  supervisor u_dut (
      .*,
      .current_estimate_o(estimate),
      .armed_o(armed),
      .gates_enable_o(gates),
      .gates_clear_o(gates_clear),
      .unkicked_o(unkicked),
      .faults_o(faults),
      .first_fault_o(first)
  );
  (* hierconn *) wire [FaultsW-1:0] \u_dut.trip ;
  wire [FaultsW-1:0] trip = \u_dut.trip ;
