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
      .at_estimate_part_i(wave_i[feltgate_map_pkg::EVENT_AT_ESTIMATE_PART]),
      .at_current_estimate_i(wave_i[feltgate_map_pkg::EVENT_AT_CURRENT_ESTIMATE]),
      .at_speed_size_i(wave_i[feltgate_map_pkg::EVENT_AT_SPEED_SIZE]),
      .param_is_overspeed_i(wave_i[feltgate_map_pkg::PARAM_AT_OVERSPEED]),
      .at_current_squared_i(wave_i[feltgate_map_pkg::EVENT_AT_CURRENT_SQUARED]),
      .at_nominal_i(wave_i[feltgate_map_pkg::EVENT_AT_NOMINAL]),
      .at_speed_i(wave_i[feltgate_map_pkg::EVENT_AT_SPEED]),
      .at_growth_size_i(wave_i[feltgate_map_pkg::EVENT_AT_GROWTH_SIZE]),
      .param_is_i2t_budget_i(wave_i[feltgate_map_pkg::PARAM_AT_I2T_BUDGET]),
      .at_heat_i(wave_i[feltgate_map_pkg::EVENT_AT_HEAT]),
      .at_strong_size_i(wave_i[feltgate_map_pkg::EVENT_AT_STRONG_SIZE]),
      .param_is_polarity_speed_i(wave_i[feltgate_map_pkg::PARAM_AT_POLARITY_SPEED]),
      .param_is_polarity_current_i(wave_i[feltgate_map_pkg::PARAM_AT_POLARITY_CURRENT]),
      .param_is_polarity_ticks_i(wave_i[feltgate_map_pkg::PARAM_AT_POLARITY_TICKS]),
      .at_polarity_i(wave_i[feltgate_map_pkg::EVENT_AT_POLARITY]),
      .param_is_watchdog_ticks_i(wave_i[feltgate_map_pkg::PARAM_AT_WATCHDOG_TICKS]),
      .at_watchdog_i(wave_i[feltgate_map_pkg::EVENT_AT_WATCHDOG]),
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
