// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// link_stream beside a reader that keeps the mask of a tick and one of its words, whichever it is: which ticks give
// a frame, which are dropped, what the frame says. For any words, writes and takers.
`default_nettype none

module frames_proof (
    input logic        clk_i,
    input logic        rst_ni,
    input logic        word_valid_i,
    input logic [ 3:0] word_number_i,
    input logic [31:0] word_data_i,
    input logic [15:0] addr_i,
    input logic [31:0] wdata_i,
    input logic        write_i,
    input logic        ready_i
);
  localparam int Words = feltgate_link_pkg::SNAPSHOT_WORDS;

`include "reset.svh"

  logic [31:0] rdata;
  logic valid, last;
  logic [7:0] out;
  link_stream u_dut (
      .clk_i(clk_i), .rst_ni(rst_ni),
      .word_valid_i(word_valid_i), .word_number_i(word_number_i), .word_data_i(word_data_i),
      .addr_i(addr_i), .wdata_i(wdata_i), .write_i(write_i), .rdata_o(rdata),
      .valid_o(valid), .byte_o(out), .last_o(last), .ready_i(ready_i)
  );
  (* hierconn *) wire [2:0] \u_dut.state_q ;
  (* hierconn *) wire \u_dut.within_q ;
  (* hierconn *) wire [3:0] \u_dut.at_q ;
  (* hierconn *) wire [1:0] \u_dut.index_q ;
  (* hierconn *) wire [11:0] \u_dut.words_q ;
  (* hierconn *) wire [11:0] \u_dut.left_q ;
  (* hierconn *) wire [23:0] \u_dut.period_q ;
  (* hierconn *) wire [23:0] \u_dut.ticks_q ;
  (* hierconn *) wire [31:0] \u_dut.dropped_q ;
  (* hierconn *) wire [7:0] \u_dut.count_q ;
  (* hierconn *) wire [7:0] \u_dut.frame_q ;
  (* hierconn *) wire [31:0] \u_dut.word_q ;
  (* hierconn *) wire [15:0] \u_dut.addr_q ;
  (* hierconn *) wire [15:0] \u_dut.addr_q2 ;
  wire [2:0] state = \u_dut.state_q ;
  wire [3:0] at = \u_dut.at_q ;
  wire [1:0] index = \u_dut.index_q ;
  wire [11:0] left = \u_dut.left_q ;

  // The snapshot: its words by number; the status is a tick's last, never its only one.
  localparam logic [3:0] Status = 4'(feltgate_link_pkg::N_STATUS);
  logic first, within_q;
  wire [3:0] place = word_number_i;
  assign first = word_valid_i && !within_q;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) within_q <= 1'b0;
    else if (word_valid_i) within_q <= place != Status;
  end
  always_comb assume (!word_valid_i || (place < 4'(Words) && (within_q || place != Status)));

  // The registers, and the ticks that are due, by the page.
  logic [11:0] mask_q;
  logic [23:0] period_q, since_q;  // ticks since the last one that was due
  logic any_q;                     // there was one since the period was written
  logic due, sends_q, begins;
  logic [31:0] dropped_q;
  logic [7:0] counter_q;
  assign due    = first && period_q != '0 && (!any_q || since_q + 24'd1 == period_q);
  assign begins = due && !sends_q;
  // The frame under way.
  logic kept_q;          // its tick is whole
  logic [11:0] asked_q;  // its words
  logic [7:0] frame_counter_q;
  logic [1:0] byte_q;    // of the head, or of a word
  logic head_q;
  logic [11:0] sent_q;   // words that are sent whole
  logic [3:0] word, any_word_q;
  logic [31:0] word_q;   // the word of that place
  logic keeps, taken, word_ends, frame_ends;
  assign keeps      = word_valid_i && (begins || (sends_q && !kept_q));
  assign taken      = valid && ready_i;
  assign word_ends  = taken && !head_q && byte_q == 2'd3;
  assign frame_ends = taken && last;
  always_comb begin
    word = 4'd15;  // the lowest that is to come
    for (int k = Words - 1; k >= 0; k--) if (asked_q[k] && !sent_q[k]) word = 4'(k);
  end
  always_ff @(posedge clk_i) begin
    any_word_q <= any_word_q;
    if (keeps && place == any_word_q) word_q <= word_data_i;
  end
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      {sends_q, kept_q, any_q, head_q} <= 4'b0000;
      {mask_q, period_q, since_q}      <= '0;
      {dropped_q, counter_q}           <= '0;
      {asked_q, sent_q, byte_q, frame_counter_q} <= '0;
    end else begin
      if (first) since_q <= due ? 24'd0 : since_q + 24'd1;
      if (due) begin
        any_q     <= 1'b1;
        counter_q <= counter_q + 8'd1;
        if (sends_q) dropped_q <= dropped_q + 32'd1;
      end
      if (begins) begin
        sends_q         <= 1'b1;
        kept_q          <= 1'b0;
        head_q          <= 1'b1;
        asked_q         <= mask_q | 12'(1 << feltgate_link_pkg::N_TICK);
        sent_q          <= '0;
        byte_q          <= 2'd0;
        frame_counter_q <= counter_q;
      end
      if (sends_q && !kept_q && word_valid_i && place == Status) kept_q <= 1'b1;
      if (taken) byte_q <= byte_q + 2'd1;
      if (taken && byte_q == 2'd3) head_q <= 1'b0;
      if (word_ends) sent_q <= sent_q | (12'd1 << word);
      if (frame_ends) sends_q <= 1'b0;
      if (write_i && addr_i == feltgate_link_pkg::A_STREAM_WORDS) mask_q <= wdata_i[11:0];
      if (write_i && addr_i == feltgate_link_pkg::A_STREAM_PERIOD) begin
        period_q <= wdata_i >= 32'h1000000 ? 24'hffffff : wdata_i[23:0];
        any_q    <= 1'b0;
      end
    end
  end

  // The RAM is taken out: a clock after it was asked for that word it gives what was kept of it last.
  logic [3:0] at_then_q;
  logic [31:0] word_then_q;
  logic written_q;
  always_ff @(posedge clk_i) begin
    at_then_q   <= at;
    word_then_q <= word_q;
    written_q   <= keeps && place == any_word_q;
  end
  always_comb if (past_ok_q && at_then_q == any_word_q && !written_q) assume (\u_dut.word_q == word_then_q);

  // A read: the address two clocks ago, what its word was then.
  logic [15:0] addr_q, addr_q2, addr_q3;
  logic [31:0] mask_then_q, period_then_q, dropped_then_q;
  logic [2:0] since_reset_q;
  logic stood_q, last_then_q;
  logic [7:0] out_q;
  logic [3:0] silent_q, base_q;  // clocks without a byte; the word behind the last one sent
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      {addr_q, addr_q2, addr_q3} <= '0;
      since_reset_q <= '0;
      silent_q      <= '0;
      base_q        <= '0;
      stood_q       <= 1'b0;
    end else begin
      {addr_q, addr_q2, addr_q3} <= {addr_i, addr_q, addr_q2};
      if (since_reset_q != '1) since_reset_q <= since_reset_q + 3'd1;
      silent_q <= (kept_q && sends_q && !valid) ? silent_q + 4'd1 : 4'd0;
      stood_q  <= valid && !ready_i;
      if (begins) base_q <= '0;
      else if (word_ends) base_q <= word + 4'd1;
    end
  end
  always_ff @(posedge clk_i) begin
    out_q          <= out;
    last_then_q    <= last;
    mask_then_q    <= 32'(mask_q);
    period_then_q  <= 32'(period_q);
    dropped_then_q <= dropped_q;
  end
  logic [7:0] head;
  assign head = byte_q == 2'd0 ? 8'h40 : byte_q == 2'd1 ? frame_counter_q : byte_q == 2'd2 ? asked_q[7:0] : {4'd0, asked_q[11:8]};
  logic [11:0] below, under;
  assign below = (12'd1 << at) - 12'd1;
  assign under = (12'd1 << base_q) - 12'd1;

  always_comb begin
    if (past_ok_q && rst_ni) begin
      frame_where_due: assert ((state != 3'd0) == sends_q);
      whole_tick_first: assert (!valid || (sends_q && kept_q));
      head_says: assert (!valid || !head_q || out == head);
      words_in_order: assert (!valid || head_q || (word < 4'd12 && (word != any_word_q || out == word_q[{byte_q, 3'd0}+:8])));
      last_of_the_mask: assert (!valid || last == (!head_q && byte_q == 2'd3 && (sent_q | (12'd1 << word)) == asked_q));
      stands_until_taken: assert (!stood_q || (valid && (out == out_q || (!head_q && word != any_word_q)) && last == last_then_q));
      silent_for_nine_clocks: assert (!sends_q || !kept_q || valid || silent_q < 4'd9);
      drops_are_counted: assert (\u_dut.dropped_q == dropped_q);
      counter_of_all_due: assert (\u_dut.count_q == counter_q);
      if (since_reset_q >= 3'd3) begin
        read_back: assert ((addr_q3 != feltgate_link_pkg::A_STREAM_WORDS || rdata == mask_then_q) &&
                           (addr_q3 != feltgate_link_pkg::A_STREAM_PERIOD || rdata == period_then_q) &&
                           (addr_q3 != feltgate_link_pkg::A_STREAM_DROPPED || rdata == dropped_then_q));
        others_read_0: assert (addr_q3 == feltgate_link_pkg::A_STREAM_WORDS || addr_q3 == feltgate_link_pkg::A_STREAM_PERIOD ||
                               addr_q3 == feltgate_link_pkg::A_STREAM_DROPPED || rdata == '0);
      end

      inside_state: assert (state <= 3'd4 && (!sends_q || ((state == 3'd1) == !kept_q && (!kept_q || (state == 3'd2) == head_q))));
      inside_within: assert ( \u_dut.within_q == within_q);
      inside_index: assert (index == byte_q && (state == 3'd2 || state == 3'd4 || index == 2'd0));
      inside_registers: assert (\u_dut.words_q == mask_q && \u_dut.period_q == period_q);
      inside_ticks: assert (period_q == '0 || (any_q ? since_q < period_q && \u_dut.ticks_q == period_q - 24'd1 - since_q
                                                     : \u_dut.ticks_q == '0));
      inside_frame: assert (!sends_q || \u_dut.frame_q == frame_counter_q);
      inside_asked: assert (!sends_q || asked_q[feltgate_link_pkg::N_TICK]);
      inside_left: assert (!sends_q || (left != '0 && left == asked_q >> at && sent_q == (asked_q & below) && at <= 4'd11));
      inside_head: assert (!sends_q || (kept_q && !head_q) || (at == '0 && head_q));
      inside_body: assert (state != 3'd4 || (left[0] && at_then_q == at && word_then_q == word_q));
      inside_seek: assert (!sends_q || state == 3'd3 ? !sends_q || silent_q == at - base_q : silent_q <= 4'd9);
      inside_base: assert (!sends_q || (base_q <= at && (asked_q & below & ~under) == '0));
      inside_read: assert (\u_dut.addr_q == addr_q && \u_dut.addr_q2 == addr_q2);
      drops: cover (due && sends_q && kept_q);
      sends_a_word: cover (taken && !head_q);
    end
  end
endmodule

`default_nettype wire
