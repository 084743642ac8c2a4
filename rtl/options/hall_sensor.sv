// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Three Hall lines to the electrical angle of a motor whose encoder does not know it at power-up: first the middle of
// the lines' sector, then the angle of the first edge; the encoder's counts carry it, and the lines check it.
// Latency from a line's pin to the angle Glitch + 5 clocks, from a count 1 clock. docs/blocks/three_phase.md

`default_nettype none

module hall_sensor #(
    parameter int Glitch = 50  // clocks for which the lines must stay, 1 to 1023
) (
    input  logic        clk_i,
    input  logic        rst_ni,
    input  logic [ 2:0] hall_i,          // asynchronous; line n is high from n to n + 1.5 thirds of an electrical turn
    input  logic [ 1:0] count_i,         // of the encoder, its lowest bits; moves by one at most in a clock
    input  logic [31:0] gain_i,          // 2^-32 electrical turn per count; 0: the angle is 0, and nothing is compared
    input  logic        gates_enable_i,
    input  logic        clear_i,         // of the faults; ends the angle that they are of
    output logic [31:0] angle_o,         // 2^-32 electrical turn, 0 where line 0 rises
    output logic [ 2:0] faults_o,        // bit 0: all lines alike, 1: angle and sector are apart, 2: a sector was passed over
    output logic        waits_o          // no sector yet
);
  // Lines that stay.
  logic [2:0] meta_q, sync_q, last_q, code_q;
  localparam int WaitW = Glitch > 0 ? $clog2(Glitch + 1) : 1;
  logic [WaitW-1:0] wait_q;
  logic       ready_q;  // code_q is of the lines
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      meta_q  <= '0;
      sync_q  <= '0;
      last_q  <= '0;
      code_q  <= '0;
      wait_q  <= WaitW'(Glitch);
      ready_q <= 1'b0;
    end else begin
      meta_q <= hall_i;
      sync_q <= meta_q;
      last_q <= sync_q;
      if (sync_q != last_q) wait_q <= WaitW'(Glitch);
      else if (wait_q != '0) wait_q <= wait_q - 1'b1;
      else begin
        code_q  <= last_q;
        ready_q <= 1'b1;
      end
    end
  end

  // Sectors of 60 degrees in the order of rising angle.
  function automatic logic [2:0] sector_of(input logic [2:0] code);
    case (code)
      3'b101:  sector_of = 3'd0;
      3'b001:  sector_of = 3'd1;
      3'b011:  sector_of = 3'd2;
      3'b010:  sector_of = 3'd3;
      3'b110:  sector_of = 3'd4;
      default: sector_of = 3'd5;
    endcase
  endfunction
  function automatic logic [2:0] after(input logic [2:0] place);
    after = (place == 3'd5) ? 3'd0 : place + 3'd1;
  endfunction
  // Begin of a sector, 2^-16 turn; its middle is 5461 later.
  function automatic logic [15:0] begin_of(input logic [2:0] place);
    case (place)
      3'd0:    begin_of = 16'd0;
      3'd1:    begin_of = 16'd10923;
      3'd2:    begin_of = 16'd21845;
      3'd3:    begin_of = 16'd32768;
      3'd4:    begin_of = 16'd43691;
      default: begin_of = 16'd54613;
    endcase
  endfunction
  localparam logic [15:0] Middle = 16'd5461;

  logic [2:0] sector, sector_q;  // now, and of the angle
  logic known_q;                 // there is one
  logic exact_q;                 // an edge gave the angle
  logic alike, runs, up, down, first, passed, apart, restarts;
  assign alike  = ready_q && (code_q == 3'b000 || code_q == 3'b111);
  assign sector = sector_of(code_q);
  assign runs   = ready_q && !alike && gain_i != '0;
  assign up     = sector == after(sector_q);
  assign down   = sector_q == after(sector);
  assign first  = runs && !known_q;
  assign passed = runs && known_q && sector != sector_q && !up && !down;

  // Before the first edge the angle may be off by half a sector; later, by how much lines and encoder differ.
  logic signed [15:0] off;
  assign off   = $signed(angle_o[31:16] - begin_of(sector_q) - Middle);
  assign apart = known_q && (exact_q ? off > 16'sd10923 || off < -16'sd10923 : off > 16'sd16384 || off < -16'sd16384);

  // Faults that are kept until they are cleared. Equal lines while the gates are closed are not kept.
  logic [2:0] seen_q;
  assign restarts = clear_i && seen_q != '0;
  assign faults_o = {seen_q[2:1], seen_q[0] || alike};
  assign waits_o  = !ready_q;

  logic [31:0] base, step;
  logic [ 1:0] count_q, change;
  assign change = count_i - count_q;
  assign step   = (change == 2'b01) ? gain_i : (change == 2'b11) ? -gain_i : '0;
  assign base   = first ? {begin_of(sector) + Middle, 16'd0} :
                  (runs && !exact_q && up) ? {begin_of(sector), 16'd0} :
                  (runs && !exact_q && down) ? {begin_of(sector_q), 16'd0} : angle_o;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      count_q  <= '0;
      angle_o  <= '0;
      exact_q  <= 1'b0;
      known_q  <= 1'b0;
      sector_q <= '0;
      seen_q   <= '0;
    end else begin
      count_q <= count_i;
      angle_o <= (gain_i == '0) ? '0 : base + step;
      known_q <= runs && !restarts;
      exact_q <= runs && !restarts && known_q && (exact_q || up || down);
      if (runs) sector_q <= sector;
      seen_q <= (clear_i ? 3'd0 : seen_q) | ({passed, apart, alike && gates_enable_i} & {3{!restarts}});
    end
  end
endmodule

`default_nettype wire
