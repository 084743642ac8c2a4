// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The ring of rows: which are written, which can be read, what a row holds; for any words and writes.
`default_nettype none

module ring_proof (
    input logic        clk_i,
    input logic        rst_ni,
    input logic        word_valid_i,
    input logic [ 3:0] word_number_i,
    input logic [31:0] word_data_i,
    input logic        event_valid_i,
    input logic [ 8:0] event_number_i,
    input logic [15:0] addr_i,
    input logic [31:0] wdata_i,
    input logic        write_i
);
  localparam int RowBits = 10;
  localparam int Rows = 1 << RowBits;
  localparam int Words = feltgate_link_pkg::SNAPSHOT_WORDS;

  logic past_ok_q;
  initial past_ok_q = 1'b0;
  always_ff @(posedge clk_i) past_ok_q <= 1'b1;
  always_comb if (!past_ok_q) assume (!rst_ni);

  logic [31:0] rdata;
  link_capture #(.Events(1)) u_dut (
      .clk_i(clk_i),
      .rst_ni(rst_ni),
      .word_valid_i(word_valid_i),
      .word_number_i(word_number_i),
      .word_data_i(word_data_i),
      .event_valid_i(event_valid_i),
      .event_number_i(event_number_i),
      .addr_i(addr_i),
      .wdata_i(wdata_i),
      .write_i(write_i),
      .rdata_o(rdata)
  );
  (* hierconn *) wire [2:0] \u_dut.state_q ;
  (* hierconn *) wire \u_dut.stores ;
  (* hierconn *) wire \u_dut.whole ;
  (* hierconn *) wire \u_dut.fires ;
  (* hierconn *) wire \u_dut.starts ;
  (* hierconn *) wire \u_dut.taking_q ;
  (* hierconn *) wire \u_dut.ends_q ;
  (* hierconn *) wire \u_dut.hit_q ;
  (* hierconn *) wire \u_dut.hand_q ;
  (* hierconn *) wire \u_dut.event_q ;
  (* hierconn *) wire \u_dut.configures ;
  (* hierconn *) wire [2:0] \u_dut.trigger_mode_q ;
  (* hierconn *) wire [31:0] \u_dut.level_q ;
  (* hierconn *) wire \u_dut.seen_q ;
  (* hierconn *) wire \u_dut.holds_q ;
  (* hierconn *) wire [3:0] \u_dut.columns ;
  (* hierconn *) wire \u_dut.within_q ;
  (* hierconn *) wire [11:0] \u_dut.words_q ;
  (* hierconn *) wire [RowBits-1:0] \u_dut.row_q ;
  (* hierconn *) wire [RowBits-1:0] \u_dut.pre_q ;
  (* hierconn *) wire [RowBits-1:0] \u_dut.first_row ;
  (* hierconn *) wire [RowBits:0] \u_dut.rows_q ;
  (* hierconn *) wire [RowBits:0] \u_dut.left_q ;
  wire [2:0] state = \u_dut.state_q ;
  wire stores = \u_dut.stores ;
  wire whole = \u_dut.whole ;
  wire fires = \u_dut.fires ;
  wire starts = \u_dut.starts ;
  wire taking = \u_dut.taking_q ;
  wire [11:0] words = \u_dut.words_q ;
  wire full = \u_dut.columns [3];  // eight words
  wire [RowBits-1:0] row = \u_dut.row_q ;
  wire [RowBits-1:0] pre = \u_dut.pre_q ;
  wire [RowBits-1:0] first_row = \u_dut.first_row ;
  wire [RowBits:0] rows = \u_dut.rows_q ;
  wire [RowBits:0] left = \u_dut.left_q ;
  localparam logic [3:0] Status = 4'(feltgate_link_pkg::N_STATUS);
  localparam logic [11:0] All = 12'hfff;
  logic [11:0] came_q;  // words of the tick, by number
  wire first = word_valid_i && came_q == '0;
  wire runs = state == 3'd1 || state == 3'd2 || state == 3'd3;
  // A tick is over a clock before the next begins; each word of it comes once, the status at the end.
  always_comb begin
    assume (!( \u_dut.ends_q && first));
    assume (!word_valid_i || (word_number_i < 4'd12 && !came_q[word_number_i]));
    assume (!word_valid_i || word_number_i != Status || (came_q | 12'd1 << Status) == All);
  end

  // The rows before the last trigger.
  logic [RowBits-1:0] low_q, before_q;
  always_ff @(posedge clk_i) begin
    if (fires) begin
      low_q    <= row - pre;
      before_q <= pre;
    end
  end
  logic [RowBits-1:0] since;
  assign since = row - low_q;

  // A row, whichever it is: written to since it was whole.
  logic [RowBits-1:0] any_q, from_first;
  logic torn_q;
  initial torn_q = 1'b0;
  always_ff @(posedge clk_i) begin
    any_q <= any_q;
    if (stores && row == any_q) torn_q <= 1'b1;
    else if (whole && row == any_q) torn_q <= 1'b0;
  end
  assign from_first = any_q - first_row;

  // Words of the tick that were stored.
  logic [11:0] stored_q;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) {came_q, stored_q} <= '0;
    else if (word_valid_i) begin
      came_q   <= word_number_i == Status ? '0 : came_q | 12'd1 << word_number_i;
      stored_q <= (first ? '0 : stored_q) | 12'(stores) << word_number_i;
    end
  end

  // The event asked for has come since the last tick ended, and was asked for before it came.
  logic asked, event_came_q;
  assign asked = \u_dut.trigger_mode_q == 3'(feltgate_link_pkg::TRIGGER_EVENT) &&
                 ((\u_dut.level_q & 32'(feltgate_link_pkg::ANY_EVENT)) != '0 ||
                  event_number_i == \u_dut.level_q [8:0]);
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) event_came_q <= 1'b0;
    else if (\u_dut.configures || starts) event_came_q <= 1'b0;
    else event_came_q <= (event_valid_i && asked) || (event_came_q && !\u_dut.ends_q );
  end

  logic [2:0] state_then_q;
  logic fired_q, started_q, after_q, runs_q;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) after_q <= 1'b0;
    else after_q <= 1'b1;
  end
  always_ff @(posedge clk_i) begin
    state_then_q <= state;
    fired_q      <= fires;
    started_q    <= starts;
    runs_q       <= runs;
  end

  always_comb begin
    if (rst_ni && past_ok_q) begin
      rows_before_stay: assert (!stores || state != 3'd3 || since >= before_q);
      done_is_full: assert (state != 3'd4 || (rows == (RowBits + 1)'(Rows) && first_row == low_q));
      row_is_one_tick: assert (!whole || (came_q == '0 && (stored_q == words || full)));
      torn_is_no_row: assert (!torn_q || {1'b0, from_first} >= rows);
      counts_in_range: assert (rows <= (RowBits + 1)'(Rows) && (!taking || !runs || rows < (RowBits + 1)'(Rows)) &&
                               (state != 3'd1 || (left != '0 && left <= {1'b0, pre} && rows + left == {1'b0, pre})) &&
                               (state != 3'd3 || left != '0));
      rest_by_a_trigger: assert (!after_q || state != 3'd3 || state_then_q == 3'd3 || (state_then_q == 3'd2 && fired_q));
      trigger_in_wait: assert (!fires || (state == 3'd2 && rows + (RowBits + 1)'(taking) >= {1'b0, pre} &&
                                          \u_dut.seen_q && (\u_dut.hit_q || \u_dut.hand_q || \u_dut.event_q )));
      no_row_while_it_runs: assert (!after_q || !\u_dut.holds_q || !runs_q);
      stores_in_a_run: assert (!stores || runs);
      event_of_its_tick: assert (\u_dut.event_q == event_came_q);
      inside_state: assert (state <= 3'd4);
      inside_rest: assert (state != 3'd3 || ({1'b0, since} + left == (RowBits + 1)'(Rows) && since >= before_q &&
                                             rows >= {1'b0, since}));
      inside_wait: assert (state != 3'd2 || rows >= {1'b0, pre});
      inside_within: assert ( \u_dut.within_q == (came_q != '0) && !came_q[Status]);
      inside_ends: assert (!\u_dut.ends_q || came_q == '0);
      inside_stored: assert (!taking || !runs || full || stored_q == (words & (came_q == '0 ? All : came_q)));
      triggers: cover (fires && taking);
      triggers_by_event: cover (fires && taking && \u_dut.event_q );
      fills: cover (state == 3'd1 && rows != '0);
    end
  end
endmodule

`default_nettype wire
