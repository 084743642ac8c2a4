// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Ticks that stand: the gates are off within their time, and ticks in time never trip.
`default_nettype none

module ticks_proof (
    input logic                                           clk_i,
    input logic                                           rst_ni,
    input logic        [                             11:0] start_i,  // where in a period of the PWM a reset ends
    input logic                                           tick_i,
    input logic                                           host_i,
    input logic                                           host_arm_i,
    input logic                                           arm_i,
    input logic                                           disarm_i,
    input logic                                           stop_i,
    input logic                                           clear_faults_i,
    input logic                                           kick_i,
    input logic                                           encoder_error_i,
    input logic signed [      feltgate_pkg::VELOCITY_W-1:0] velocity_i,
    input logic signed [       feltgate_pkg::CURRENT_W-1:0] current_ref_i,
    input logic        [feltgate_map_pkg::WAVE_LENGTH-1:0] wave_i,
    input logic        [                             31:0] param_i,
    input logic signed [    feltgate_pkg::PRODUCT_BITS-1:0] product_i,
    input logic        [feltgate_map_pkg::W_FAULTS_SEEN-1:0] trips_i,
    input logic                                           axis_silent_i,
    input logic                                           axis_blocked_i
);
  `include "reset.svh"
  localparam int Period = feltgate_pkg::PWM_PERIOD;
  localparam int Periods = (feltgate_pkg::CLOCKS_PER_TICK + Period - 1) / Period;

  // period_start_i as pwm makes it, in every Period-th clock.
  logic period_start_i;
  logic [11:0] carrier_q;  // clocks since the last start
  always_ff @(posedge clk_i) carrier_q <= !rst_ni ? start_i : period_start_i ? 12'd0 : carrier_q + 12'd1;
  assign period_start_i = carrier_q == 12'(Period - 1);
  `include "supervisor.svh"
  always_comb begin
    assume (carrier_q < 12'(Period) && start_i < 12'(Period));
    assume (!trips_i[0] && !trips_i[feltgate_map_pkg::FAULT_TICK]);
  end

  wire trips = trip[feltgate_map_pkg::FAULT_TICK];
  localparam int PeriodsW = $clog2(Periods + 1);
  (* hierconn *) wire [PeriodsW-1:0] \u_dut.tickless_q ;
  (* hierconn *) wire \u_dut.tick_q ;

  // Clocks since tick_i rose, or since the gates opened or the reset ended where that was later.
  logic tick_q, rises, gates_q;
  logic [15:0] open_q, since_q;  // with the gates on; anyhow, up to 2^15
  assign rises = tick_i && !tick_q;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      tick_q  <= 1'b0;
      open_q  <= '0;
      since_q <= '0;
      gates_q <= 1'b0;
    end else begin
      tick_q  <= tick_i;
      gates_q <= gates;
      open_q  <= (rises || !gates) ? 16'd0 : open_q + 16'd1;
      since_q <= rises ? 16'd0 : since_q[15] ? since_q : since_q + 16'd1;
    end
  end

  always_comb begin
    if (rst_ni && past_ok_q) begin
      standing_closes_gates: assert (!gates || open_q <= 16'((Periods + 1) * Period));
      in_time_never_trips: assert (!trips || since_q > 16'(Periods * Period - 1));
      inside_tick: assert (\u_dut.tick_q == tick_q);
      inside_open: assert (!gates || open_q > 16'((Periods + 1) * Period) ||
                           open_q <= 16'(\u_dut.tickless_q ) * 16'(Period) + 16'(carrier_q) + 16'd1);
      inside_since: assert (\u_dut.tickless_q <= PeriodsW'(Periods) &&
                            (\u_dut.tickless_q == '0 || since_q[15] ||
                             since_q + 16'(Period) >= 16'(\u_dut.tickless_q ) * 16'(Period) + 16'(carrier_q) + 16'd1));
      a_period_begins: cover (period_start_i && gates && \u_dut.tickless_q == '0);
    end
  end
endmodule

`default_nettype wire
