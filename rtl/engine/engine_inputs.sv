// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Starts the engine's threads and writes their inputs. A thread is due every divider ticks. When
// its previous run has ended, the block writes the inputs of one tick into the thread's private
// words, one word per free clock, and then requests the start. docs/blocks/engine.md

`default_nettype none

module engine_inputs #(
    parameter int AxisCount = 1,
    parameter logic [47:0] Dividers = '0  // of the threads, 12 bits each, after configuration
) (
    input  logic                     clk_i,
    input  logic                     rst_ni,
    input  logic [              3:0] run_i,
    input  logic                     tick_i,        // one clock; inputs of this tick, held
    input  logic [             31:0] tick_count_i,
    input  logic [32*AxisCount-1:0] position_i,
    input  logic [32*AxisCount-1:0] velocity_i,
    input  logic [32*AxisCount-1:0] tau_hat_i,
    input  logic                     divide_i,      // write divider_i
    input  logic [              1:0] divided_i,     // thread of divider_i
    input  logic [             11:0] divider_i,
    input  logic                     started_i,     // from the barrel: a run of thread_i started
    input  logic                     ended_i,
    input  logic [              1:0] thread_i,
    output logic [              3:0] request_o,     // per thread: start a run
    output logic [              3:0] running_o,     // per thread: about to start, or in a run
    output logic                     overrun_o,     // due again while the last start still waits
    output logic                     wanted_o,      // word_o is to be written
    input  logic                     taken_i,       // it is written in this clock
    output logic [              8:0] address_o,
    output logic [             31:0] word_o
);
  // Ticks to the next start, one thread per clock. At 1 or 0 the thread is due.
  logic [11:0] dividers[0:3];
  logic [11:0] counts[0:3];
  initial begin
    for (int k = 0; k < 4; k = k + 1) begin
      dividers[k] = Dividers[12*k+:12];
      counts[k]   = '0;
    end
  end
  logic [11:0] count;
  logic [1:0] counted_q;
  logic counting_q, due;
  assign count = counts[counted_q];
  assign due   = counting_q && count[11:1] == 11'd0 && run_i[counted_q];
  always @(posedge clk_i) begin  // not always_ff: the initial block writes it too
    if (divide_i) dividers[divided_i] <= divider_i;
    if (counting_q) begin
      if (!run_i[counted_q]) counts[counted_q] <= 12'd0;
      else counts[counted_q] <= count[11:1] == 11'd0 ? dividers[counted_q] : count - 12'd1;
    end
  end
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      counting_q <= 1'b0;
      counted_q  <= 2'd0;
    end else begin
      if (tick_i) counting_q <= 1'b1;
      else if (counted_q == 2'd3) counting_q <= 1'b0;
      if (counting_q) counted_q <= counted_q + 2'd1;
    end
  end

  // A due thread waits until its run has ended, then until its inputs are written.
  localparam logic [3:0] Words = 4'(feltgate_engine_pkg::INPUT_AXIS_WORDS * AxisCount + 1);
  localparam logic [5:0] First = 6'(feltgate_engine_pkg::INPUT_FIRST);
  localparam logic [3:0] Tick  = 4'(feltgate_engine_pkg::INPUT_TICK - feltgate_engine_pkg::INPUT_FIRST);
  logic [3:0] due_q, ready;
  logic [1:0] loaded_q;
  logic [3:0] word_q;
  logic loading_q, written_q, gray_q;  // gray_q: word_q[1] != word_q[0]
  assign overrun_o = due && due_q[counted_q];
  assign ready     = due_q & ~running_o;
  assign wanted_o  = loading_q && word_q != Words;
  logic all_written;
  assign all_written = loading_q && word_q == Words && !tick_i;
  always_ff @(posedge clk_i) begin
    if (tick_i || !loading_q) {word_q, gray_q} <= '0;  // all words belong to one tick
    else if (taken_i) begin
      word_q <= word_q + 4'd1;
      gray_q <= !word_q[1];
    end
  end
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      due_q     <= '0;
      loading_q <= 1'b0;
      loaded_q  <= 2'd0;
      written_q <= 1'b0;
      request_o <= '0;
      running_o <= '0;
    end else begin
      written_q <= all_written && run_i[loaded_q];
      if (!loading_q) begin
        loading_q <= ready != '0;
        loaded_q  <= ready[0] ? 2'd0 : ready[1] ? 2'd1 : ready[2] ? 2'd2 : 2'd3;
      end else if (all_written) loading_q <= 1'b0;
      for (int t = 0; t < 4; t = t + 1) begin
        due_q[t] <= run_i[t] && ((due && counted_q == 2'(t)) ||
                                 (due_q[t] && !(all_written && loaded_q == 2'(t))));
        running_o[t] <= run_i[t] && !(ended_i && thread_i == 2'(t)) &&
                        (running_o[t] || (all_written && loaded_q == 2'(t)));
        request_o[t] <= run_i[t] && !(started_i && thread_i == 2'(t)) &&
                        (request_o[t] || (written_q && loaded_q == 2'(t)));
      end
    end
  end

  // Input words: position, velocity, tau_hat of each axis, then the tick count.
  localparam int Fours = (3 * AxisCount + 4) / 4;
  logic [128*Fours-1:0] words;
  logic [32*Fours-1:0] chosen;  // of each four words
  genvar n;
  generate
    for (n = 0; n < AxisCount; n = n + 1) begin : g_axis
      assign words[96*n+:32]    = position_i[32*n+:32];
      assign words[96*n+32+:32] = velocity_i[32*n+:32];
      assign words[96*n+64+:32] = tau_hat_i[32*n+:32];
    end
  endgenerate
  assign words[128*Fours-1:96*AxisCount] = (128 * Fours - 96 * AxisCount)'(tick_count_i);
  // One of four words takes two LUT4 per bit: lesser is one of the lower two, or which of the upper
  // two it is.
  generate
    for (n = 0; n < Fours; n = n + 1) begin : g_four
      logic [31:0] lesser;
      assign lesser = gray_q != word_q[0] ? {32{word_q[0]}} : word_q[0] ? words[128*n+32+:32] : words[128*n+:32];
      assign chosen[32*n+:32] = word_q[1] ? (lesser & words[128*n+96+:32]) | (~lesser & words[128*n+64+:32]) : lesser;
    end
  endgenerate
  assign word_o    = chosen[32*word_q[3:2]+:32];
  assign address_o = {1'b0, loaded_q, First[5:4], word_q == Words - 4'd1 ? Tick : word_q};
endmodule

`default_nettype wire
