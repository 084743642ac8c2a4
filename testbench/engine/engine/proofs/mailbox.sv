// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Whatever host and programs do: without a commit that comes into force a mailbox is late in its time, and no
// torque comes or goes with it without a ramp.
`default_nettype none

module mailbox_proof (
    input logic clk_i,
    input logic rst_ni,
    input logic tick_i,
    input logic step_i,
    input logic taken_i,
    input logic differs_i,
    input logic [15:0] max_age_i
);
  `include "reset.svh"
  (* anyconst *) logic watched_i;
  logic late, jumps, late_q, taken_q, differs_q;
  engine_mailbox u_dut (
      .*,
      .late_o(late),
      .jumps_o(jumps)
  );
  (* hierconn *) wire [15:0] \u_dut.age_q ;
  (* hierconn *) wire \u_dut.late_q ;

  // Steps since the last commit; what max_age was with the last step.
  logic [16:0] quiet_q;
  logic [15:0] allowed_q;
  logic stepped_q;
  always_ff @(posedge clk_i) begin
    allowed_q <= max_age_i;
    stepped_q <= tick_i && step_i;
  end
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      quiet_q   <= '0;
      late_q    <= watched_i;
      taken_q   <= 1'b0;
      differs_q <= 1'b0;
    end else begin
      if (taken_i) quiet_q <= '0;
      else if (tick_i && step_i && !quiet_q[16]) quiet_q <= quiet_q + 17'd1;
      late_q    <= late;
      taken_q   <= taken_i;
      differs_q <= taken_i && differs_i;
    end
  end

  always_comb begin
    if (rst_ni && past_ok_q) begin
      late_in_time: assert (!watched_i || !stepped_q || late || quiet_q <= {1'b0, allowed_q});
      late_stays: assert (!late_q || late || taken_q);
      ramps: assert (jumps || (late == late_q && !differs_q));
      mailbox_alone: assert (!jumps || late != late_q || differs_q);
      inside_age: assert (\u_dut.late_q || quiet_q == {1'b0, \u_dut.age_q });
      becomes_late: cover (late && !late_q && max_age_i == 16'd1);
      is_fed_again: cover (late_q && !late && jumps);
    end
  end
endmodule

`default_nettype wire
