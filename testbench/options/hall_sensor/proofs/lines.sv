// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Which samples of the lines are taken, and what follows: a sector of each code, faults, and an angle that counts move.
`default_nettype none

module lines_proof (
    input logic        clk_i,
    input logic        rst_ni,
    input logic [ 2:0] hall_i,
    input logic [ 1:0] count_i,
    input logic [31:0] gain_i,
    input logic        gates_enable_i,
    input logic        clear_i
);
  localparam int Glitch = 2;
  localparam int Last = Glitch + 3;  // oldest sample of a row that is taken, seen after that

  `include "reset.svh"

  logic [31:0] angle;
  logic [2:0] faults;
  logic waits;
  hall_sensor #(
      .Glitch(Glitch)
  ) u_dut (
      .*,
      .angle_o(angle),
      .faults_o(faults),
      .waits_o(waits)
  );
  (* hierconn *) wire [2:0] \u_dut.meta_q ;
  (* hierconn *) wire [2:0] \u_dut.sync_q ;
  (* hierconn *) wire [2:0] \u_dut.last_q ;
  (* hierconn *) wire [2:0] \u_dut.code_q ;
  (* hierconn *) wire [1:0] \u_dut.wait_q ;
  (* hierconn *) wire \u_dut.known_q ;
  (* hierconn *) wire \u_dut.exact_q ;
  wire exact = \u_dut.exact_q ;
  (* hierconn *) wire [2:0] \u_dut.sector_q ;
  (* hierconn *) wire [2:0] \u_dut.seen_q ;
  (* hierconn *) wire [1:0] \u_dut.count_q ;
  wire [2:0] code = \u_dut.code_q ;
  wire [2:0] sector = \u_dut.sector_q ;

  // The samples of the last clocks, the newest at 0; before the reset there was none but three of lines that are low.
  logic [2:0] sample_q[0:Last];
  logic [Last:0] there_q;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      for (int k = 0; k <= Last; k++) sample_q[k] <= '0;
      there_q <= (Last + 1)'(7);
    end else begin
      sample_q[0] <= hall_i;
      for (int k = 1; k <= Last; k++) sample_q[k] <= sample_q[k-1];
      there_q <= {there_q[Last-1:0], 1'b1};
    end
  end
  // For how many samples before sample 2 the lines were as in it.
  logic [9:0] row;
  always_comb begin
    row = '0;
    for (int k = 3; k <= Last; k++) if (row == 10'(k - 3) && there_q[k] && sample_q[k] == sample_q[2]) row = 10'(k - 2);
  end
  logic taken;  // a row ended with sample 2
  assign taken = row == 10'(Last - 2);

  // Which lines are high in a sector.
  function automatic logic high(input logic [2:0] sector_i, input logic [2:0] line_i);
    logic [3:0] since;
    since = 4'(sector_i) + 4'd6 - 4'(2 * line_i);
    high = (since >= 4'd6 ? since - 4'd6 : since) < 4'd3;
  endfunction
  logic [2:0] lines;
  assign lines = {high(sector, 3'd2), high(sector, 3'd1), high(sector, 3'd0)};

  logic [31:0] angle_q, gain_q;
  logic [2:0] code_q, faults_q, sector_q;
  logic [1:0] moved_q;
  logic waits_q, exact_q, known_q, clear_q, gates_q, now_q;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      now_q <= 1'b0;
    end else begin
      now_q    <= 1'b1;
      angle_q  <= angle;
      gain_q   <= gain_i;
      code_q   <= code;
      faults_q <= faults;
      sector_q <= sector;
      moved_q  <= count_i - \u_dut.count_q ;
      waits_q  <= waits;
      exact_q  <= exact;
      known_q  <= \u_dut.known_q ;
      clear_q  <= clear_i;
      gates_q  <= gates_enable_i;
    end
  end
  logic alike, was_alike, restarted;
  assign alike     = code == 3'd0 || code == 3'd7;
  assign was_alike = !waits_q && (code_q == 3'd0 || code_q == 3'd7);
  // A clear with a fault begins anew.
  logic [2:0] seen_q;
  always_ff @(posedge clk_i) seen_q <= \u_dut.seen_q ;
  assign restarted = clear_q && seen_q != '0;

  // How far the angle is from the begin of its sector, in twelfths of a turn of 65536 parts: exact to a part.
  logic [19:0] twelfths;
  assign twelfths = 20'(angle_q[31:16]) * 20'd12;
  logic signed [21:0] off;  // from the middle of the sector, within half a turn
  always_comb begin
    off = 22'(twelfths) - 22'(20'(2 * sector_q + 1) * 20'd65536);
    if (off > 22'sd393216) off = off - 22'sd786432;
    if (off < -22'sd393216) off = off + 22'sd786432;
  end
  logic far;
  assign far = off > 22'sd131112 || off < -22'sd131112;  // 60 degrees and a rest of the rounding

  always_comb begin
    if (past_ok_q && rst_ni) begin
      rows_are_taken: assert (!taken || (!waits && code == sample_q[2]));
      others_are_not: assert (!now_q || taken || (code == code_q && waits == waits_q));
      a_code_is_a_sector: assert (!now_q || !\u_dut.known_q || code_q == lines);
      alike_is_a_fault: assert (!taken || (sample_q[2] != 3'd0 && sample_q[2] != 3'd7) || faults[0]);
      alike_is_kept: assert (!now_q || !was_alike || !gates_q || restarted || faults[0]);
      kept_until_a_clear: assert (!now_q || clear_q || (faults & seen_q) == seen_q);
      passed_is_a_fault: assert (!now_q || !known_q || !\u_dut.known_q || restarted || sector == sector_q ||
                                 sector == (sector_q == 3'd5 ? 3'd0 : sector_q + 3'd1) ||
                                 sector_q == (sector == 3'd5 ? 3'd0 : sector + 3'd1) || faults[2]);
      apart_is_a_fault: assert (!now_q || !exact_q || restarted || !far || faults[1]);
      counts_move_it: assert (!now_q || !exact_q || !exact || gain_q == '0 ||
                              angle == angle_q + (moved_q == 2'd1 ? gain_q : moved_q == 2'd3 ? -gain_q : '0));
      nothing_without_a_gain: assert (!now_q || gain_q != '0 || (angle == '0 && !exact));
      an_edge: cover (exact && faults == '0);
      all_of_them: cover (faults == 3'b111);
      inside_samples: assert (\u_dut.meta_q == sample_q[0] && \u_dut.sync_q == sample_q[1] && \u_dut.last_q == sample_q[2]);
      inside_wait: assert (10'(\u_dut.wait_q ) == (row > 10'(Glitch) ? '0 : 10'(Glitch) - row));
      inside_there: assert (there_q[2:0] == 3'b111);
      inside_exact: assert (!exact || \u_dut.known_q );
      inside_sector: assert (sector < 3'd6);
      inside_known: assert (!\u_dut.known_q || !waits);
    end
  end
endmodule

`default_nettype wire
