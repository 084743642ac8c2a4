// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The modulators of one motor, the fault line of its bridge's driver, and what is wrong with them. The middle of a
// window is that of a pulse at the terminals. All modulators have one clock. docs/blocks/current.md

`default_nettype none

module current_sensors #(
    parameter int Sensors = 1
) (
    input  logic                      clk_i,
    input  logic                      rst_ni,
    input  cfg::drive_t               drive_i,
    input  logic                      period_start_i,   // of the PWM
    input  logic        [Sensors-1:0] current_data_i,   // asynchronous pins
    output logic                      current_clock_o,
    input  logic                      driver_fault_i,   // asynchronous
    input  logic                      missing_i,        // the current does not follow the voltage
    output logic [  19*Sensors-1:0]  at_shunt_o,       // [1,1,17] of full scale, each
    output logic                      valid_o,          // one clock: at_shunt_o is of a period's window
    output logic                [6:0] why_o             // missing, driver, starts, offset, saturated, stuck, over-current
);
  logic [11:0] since_q;  // clocks since a period began
  logic [Sensors-1:0] clock, aligned, overcurrent, stuck, saturated, offset, calibrated;
  generate
  genvar s;
  for (s = 0; s < Sensors; s = s + 1) begin : g_sense
    current_sense u_current_sense (
        .clk_i(clk_i), .rst_ni(rst_ni), .modulator_clock_o(clock[s]), .data_i(current_data_i[s]),
        .strobe_i(since_q == 12'(cfg::CURRENT_STROBE)), .armed_i(drive_i.gates_enable), .clear_i(drive_i.clear),
        .threshold_i(8'(cfg::CURRENT_OVERCURRENT)), .current_o(at_shunt_o[19*s+:19]), .aligned_o(aligned[s]),
        .overcurrent_o(overcurrent[s]), .calibrated_o(calibrated[s]), .offset_fault_o(offset[s]),
        .stuck_o(stuck[s]), .saturated_o(saturated[s])
    );
  end
  endgenerate
  assign current_clock_o = clock[0];
  assign valid_o         = aligned[0];

  // A missing current is kept until the faults are cleared; a driver's fault, too, if the gates were enabled.
  logic driver_q, driver_q2, driver_seen_q, missing_q;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      {since_q, driver_q, driver_q2, driver_seen_q, missing_q} <= '0;
    end else begin
      since_q               <= period_start_i ? 12'd1 : since_q + 12'd1;
      {driver_q2, driver_q} <= {driver_q, driver_fault_i};
      driver_seen_q         <= (driver_q2 && drive_i.gates_enable) || (driver_seen_q && !drive_i.clear);
      missing_q             <= missing_i || (missing_q && !drive_i.clear);
    end
  end
  assign why_o = {missing_q, driver_q2 || driver_seen_q, calibrated != '1, offset != '0, saturated != '0, stuck != '0,
                  overcurrent != '0};
endmodule

`default_nettype wire
