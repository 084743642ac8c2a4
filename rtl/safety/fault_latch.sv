// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Causes of fault stay until they are cleared. Of several in one clock the lowest number is the
// first. docs/blocks/safety.md

`default_nettype none

module fault_latch (
    input  logic        clk_i,
    input  logic        rst_ni,
    input  logic        clear_i,
    input  logic [15:0] trips_i,   // by number of the cause
    output logic [15:0] faults_o,  // seen
    output logic [ 4:0] first_o    // number of the first, 0: none
);
  function automatic logic [4:0] lowest(input logic [15:0] causes);
    lowest = 5'd0;
    for (int n = 15; n > 0; n--) if (causes[n]) lowest = 5'(n);
  endfunction
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      {faults_o, first_o} <= '0;
    end else begin
      faults_o <= (clear_i ? '0 : faults_o) | trips_i;
      if (clear_i || first_o == 5'd0) first_o <= lowest(trips_i);
    end
  end
endmodule

`default_nettype wire
