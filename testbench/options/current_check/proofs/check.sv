// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The law of a result and its clocks: the product as a sum of shifted currents, both borders, and the row of 16.
`default_nettype none

module check_proof (
    input logic               clk_i,
    input logic               rst_ni,
    input logic               armed_i,
    input logic               valid_i,
    input logic signed [18:0] resistive_i,
    input logic signed [18:0] across_i,
    input logic signed [20:0] current_i,
    input logic        [16:0] resistance_i,
    input logic        [16:0] margin_i
);
  localparam int Busy = 18;
  localparam int Bits = 17;  // of the resistance

  `include "reset.svh"

  logic missing;
  current_check u_dut (
      .*,
      .missing_o(missing)
  );
  (* hierconn *) wire [4:0] \u_dut.step_q ;
  (* hierconn *) wire [3:0] \u_dut.count_q ;
  (* hierconn *) wire [Bits-1:0] \u_dut.u_serial_multiplier.low_q ;
  (* hierconn *) wire [20:0] \u_dut.u_serial_multiplier.high_q ;
  (* hierconn *) wire [20:0] \u_dut.u_serial_multiplier.factor_q ;
  (* hierconn *) wire [18:0] \u_dut.resistive_q ;
  (* hierconn *) wire [18:0] \u_dut.across_q ;
  wire signed [20:0] high = $signed(\u_dut.u_serial_multiplier.high_q );
  wire signed [20:0] factor = $signed(\u_dut.u_serial_multiplier.factor_q );
  wire signed [37:0] product = $signed({\u_dut.u_serial_multiplier.high_q , \u_dut.u_serial_multiplier.low_q });

  // The clocks since a current was taken.
  logic [Busy:1] since_q;
  logic take;
  assign take = armed_i && valid_i && since_q == '0;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) since_q <= '0;
    else since_q <= armed_i ? {since_q[Busy-1:1], take} : '0;
  end

  // The product: the current, moved up by a bit in each clock, summed where the resistance has a one.
  logic signed [39:0] moved_q, sum_q;
  logic signed [29:0] resistive_q, across_q;
  logic [Bits-1:0] word_q;
  logic [4:0] moves_q;  // bits of the resistance that are summed
  always_ff @(posedge clk_i) begin
    if (take) begin
      moved_q     <= 40'(current_i);
      word_q      <= resistance_i;
      sum_q       <= '0;
      moves_q     <= '0;
      resistive_q <= 30'(resistive_i);
      across_q    <= 30'(across_i);
    end else if (moves_q != 5'(Bits)) begin
      moved_q <= moved_q <<< 1;
      word_q  <= word_q >> 1;
      sum_q   <= sum_q + (word_q[0] ? moved_q : '0);
      moves_q <= moves_q + 5'd1;
    end
  end

  // Sizes without a sign, and the results astray in a row.
  function automatic logic [29:0] size(input logic signed [29:0] value);
    size = value < 0 ? 30'(-value) : 30'(value);
  endfunction
  logic [29:0] apart, far, margin;
  logic        astray, too_far;
  logic [4:0]  row_q;  // 16: as many or more
  assign apart   = size(resistive_q - 30'(sum_q >>> 13));
  assign margin  = 30'(margin_i);
  assign far     = margin_i > 17'd65535 ? 30'd262143 : 30'(margin_i) << 2;
  assign astray  = apart > margin || size(across_q) > margin;
  assign too_far = size(resistive_q) > far || size(across_q) > far;
  logic wanted_q, armed_q, missing_q;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      row_q    <= '0;
      wanted_q <= 1'b0;
    end else if (!armed_i) begin
      row_q    <= '0;
      wanted_q <= 1'b0;
    end else if (since_q[Busy]) begin
      row_q    <= !astray ? '0 : row_q == 5'd16 ? row_q : row_q + 5'd1;
      wanted_q <= wanted_q || too_far || (astray && row_q >= 5'd15);
    end
  end
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      armed_q   <= 1'b0;
      missing_q <= 1'b0;
    end else begin
      armed_q   <= armed_i;
      missing_q <= missing;
    end
  end
  logic done_q;  // a result came in the last clock
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) done_q <= 1'b0;
    else done_q <= armed_i && since_q[Busy];
  end

  logic [4:0] place;
  always_comb begin
    place = 5'd0;
    for (int k = 1; k <= Busy; k++) if (since_q[k]) place = 5'(k);
  end
  always_comb begin
    if (past_ok_q && rst_ni) begin
      missing_by_the_law: assert (missing == wanted_q);
      disarmed_is_none: assert (armed_q || !missing);
      held_while_armed: assert (!missing_q || !armed_q || missing);
      new_in_its_clock: assert (done_q || !armed_q || missing == missing_q);
      product_is_a_sum: assert (!since_q[Busy] || 40'(product) == sum_q);
      at_once: cover (missing && row_q < 5'd16);
      counted: cover (row_q == 5'd1 && !missing);
    end
  end

  logic multiplies;
  assign multiplies = since_q != '0;
  always_comb begin
    if (past_ok_q && rst_ni) begin
      inside_since: assert ((since_q & (since_q - 1'b1)) == '0 && \u_dut.step_q == place);
      inside_moves: assert (place == '0 || moves_q == place - 5'd1);
      inside_factor: assert (!multiplies || (40'(factor) <<< moves_q) == moved_q);
      inside_word: assert (!multiplies || (\u_dut.u_serial_multiplier.low_q & ~({Bits{1'b1}} << (5'(Bits) - moves_q))) == word_q);
      inside_sum: assert (!multiplies || (40'(product) >>> (5'(Bits) - moves_q)) == sum_q);
      inside_bound: assert (!multiplies || (factor > 0 ? high >= 0 && high < factor :
                            factor < 0 ? high <= 0 && high >= factor : high == 0));
      inside_voltages: assert (!multiplies || (30'($signed(\u_dut.resistive_q )) == resistive_q &&
                                              30'($signed(\u_dut.across_q )) == across_q));
      inside_count: assert (\u_dut.count_q == (row_q[4] ? 4'd15 : row_q[3:0]));
      inside_row: assert (row_q <= 5'd16);
    end
  end
endmodule

`default_nettype wire
