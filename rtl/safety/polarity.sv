// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Cause of fault: the motor or the encoder is connected the wrong way round. In RUNAWAY_WINDOWS
// windows of polarity_ticks on end the speed against the commanded current has grown by more than
// polarity_speed. A window begins again when the speed is not against the current. trip_o a clock
// after start_i. docs/blocks/safety.md

`default_nettype none

module polarity (
    input  logic                              clk_i,
    input  logic                              rst_ni,
    input  cfg::params_t                      p,
    input  logic                              open_i,      // the gates are enabled
    input  logic                              start_i,     // velocity_i is new; all inputs hold for two clocks
    input  logic signed [cfg::VELOCITY_W-1:0] velocity_i,  // rad/s
    input  logic signed [ cfg::CURRENT_W-1:0] current_i,   // A, commanded in the tick before
    output logic                              trip_o       // one clock
);
  localparam int W = cfg::VELOCITY_W;
  localparam int Drop = cfg::VELOCITY_F > map::GROWTH_BITS ? cfg::VELOCITY_F - map::GROWTH_BITS : 0;
  localparam int TicksW = map::RUNAWAY_BITS + 1;
  localparam int Before = map::RUNAWAY_WINDOWS - 1;

  logic signed [W-Drop-1:0] now, begin_q, gained;  // without the lowest bits
  logic [TicksW-1:0] ticks_q;                      // of the window, this one included
  logic [Before-1:0] grown_q;                      // in the windows before
  logic grows_q, strong_q, expired_q, against, at;
  assign now     = velocity_i[W-1:Drop];
  assign gained  = now - begin_q;
  assign against = strong_q && open_i && velocity_i[W-1] != current_i[cfg::CURRENT_W-1];
  assign trip_o  = at && against && expired_q && grows_q && grown_q == '1;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      {begin_q, ticks_q, grown_q, grows_q, strong_q, expired_q, at} <= '0;
    end else begin
      at <= start_i;
      if (start_i) begin
        grows_q   <= fx::beyond(64'(gained) <<< Drop, 32'(p.polarity_speed)) && gained[W-Drop-1] == velocity_i[W-1];
        strong_q  <= fx::beyond(64'(current_i), 32'(p.polarity_current));
        expired_q <= ticks_q >= TicksW'(p.polarity_ticks);
      end
      if (at) begin
        if (against && !expired_q) begin
          ticks_q <= ticks_q + 1'b1;
        end else begin
          ticks_q <= TicksW'(1);
          begin_q <= now;
          grown_q <= against && grows_q ? Before'({grown_q, 1'b1}) : '0;
        end
      end
    end
  end
endmodule

`default_nettype wire
