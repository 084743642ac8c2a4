// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The inputs of two axes beside what is written of one word of one thread, whichever they are: a run begins
// with words of one tick, and they stay while it lasts. For any dividers, turns and runs.
`default_nettype none

module inputs_proof (
    input logic              clk_i,
    input logic              rst_ni,
    input logic       [ 3:0] run_i,
    input logic              tick_i,
    input logic       [31:0] tick_count_i,
    input logic       [63:0] position_i,
    input logic       [63:0] velocity_i,
    input logic       [63:0] tau_hat_i,
    input logic              divide_i,
    input logic       [ 1:0] divided_i,
    input logic       [11:0] divider_i,
    input logic              started_i,
    input logic              ended_i,
    input logic       [ 1:0] thread_i,
    input logic              taken_i
);
  localparam logic [3:0] TICK_WORD = 4'd6;  // behind three words of each axis
  `include "reset.svh"
  logic [3:0] request, running;
  logic overrun, wanted;
  logic [8:0] address;
  logic [31:0] word;
  engine_inputs #(.AxisCount(2)) u_dut (
      .*,
      .request_o(request),
      .running_o(running),
      .overrun_o(overrun),
      .wanted_o(wanted),
      .address_o(address),
      .word_o(word)
  );
  (* hierconn *) wire \u_dut.due ;
  (* hierconn *) wire [1:0] \u_dut.counted_q ;
  (* hierconn *) wire [1:0] \u_dut.loaded_q ;
  (* hierconn *) wire [3:0] \u_dut.word_q ;
  (* hierconn *) wire \u_dut.gray_q ;
  (* hierconn *) wire [3:0] \u_dut.due_q ;
  (* hierconn *) wire \u_dut.loading_q ;
  (* hierconn *) wire \u_dut.written_q ;

  // The inputs change with a tick, a turn is given where one is wanted, what runs may end, and a thread that
  // is off when its last word has been written is so in the next clock.
  logic [223:0] inputs, inputs_q;
  assign inputs = {tick_count_i, tau_hat_i[63:32], velocity_i[63:32], position_i[63:32], tau_hat_i[31:0], velocity_i[31:0], position_i[31:0]};
  always_ff @(posedge clk_i) inputs_q <= inputs;
  (* anyconst *) logic [1:0] any_thread;
  logic run_q;
  always_comb begin
    if (!tick_i) assume (inputs == inputs_q);
    if (!wanted) assume (!taken_i);
    if (!running[thread_i]) assume (!ended_i);
  end

  (* anyconst *) logic [3:0] any_word;
  always_comb assume (any_word <= TICK_WORD);
  logic [31:0] input_word, input_word_q, word_q;
  logic [8:0] place;
  logic writes, of_tick_q, runs, runs_q, rose_q, asks, asks_q, starts_q, ends_q, waits_q, waits;
  assign input_word = inputs[32*any_word+:32];
  assign place = {1'b0, any_thread, 6'(feltgate_engine_pkg::INPUT_FIRST)} +
                 (any_word == TICK_WORD ? 9'(feltgate_engine_pkg::INPUT_TICK - feltgate_engine_pkg::INPUT_FIRST) : {5'd0, any_word});
  assign writes = wanted && taken_i && address == place;
  assign runs   = running[any_thread];
  assign asks   = request[any_thread];
  // A start that came and whose words are not all written.
  assign waits = \u_dut.due && \u_dut.counted_q == any_thread;
  always_ff @(posedge clk_i) begin
    input_word_q <= input_word;
    if (writes) word_q <= word;
  end
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) {of_tick_q, runs_q, rose_q, asks_q, run_q, starts_q, ends_q, waits_q} <= '0;
    else begin
      of_tick_q <= writes || (of_tick_q && !tick_i);
      runs_q    <= runs;
      rose_q    <= runs && !runs_q;
      asks_q    <= asks;
      run_q     <= run_i[any_thread];
      starts_q  <= started_i && thread_i == any_thread;
      ends_q    <= ended_i && thread_i == any_thread;
      waits_q   <= run_i[any_thread] && (waits || (waits_q && !(\u_dut.loading_q && \u_dut.loaded_q == any_thread &&
                                                                \u_dut.word_q == TICK_WORD + 4'd1 && !tick_i)));
    end
  end

  logic loads;
  assign loads = \u_dut.loading_q && \u_dut.loaded_q == any_thread;
  always_comb begin
    if (rst_ni && past_ok_q) begin
      words_are_inputs: assert (!writes || word == input_word);
      all_of_one_tick: assert (!runs || runs_q || (of_tick_q && word_q == input_word_q));
      stay_while_it_runs: assert (!runs || !wanted || address[7:6] != any_thread);
      runs_to_its_end: assert (!runs_q || runs || ends_q || !run_q);
      ends_with_it: assert (!runs || (run_q && !(ends_q && runs_q)));
      asked_for_once: assert (asks == (run_q && !starts_q && (asks_q || rose_q)));
      every_start_counts: assert (!asks || asks_q || runs_q);
      overrun_is_told: assert (!waits || overrun == waits_q);
      no_other_overrun: assert (!overrun || \u_dut.due );
      inside_waits: assert (waits_q == \u_dut.due_q [any_thread]);
      inside_loads: assert (!loads || !runs);
      inside_written: assert ((runs && !runs_q) == (\u_dut.written_q && \u_dut.loaded_q == any_thread && run_q));
      inside_words: assert (!loads || \u_dut.word_q <= any_word || (of_tick_q && word_q == input_word_q));
      inside_count: assert (!\u_dut.loading_q || (\u_dut.word_q <= TICK_WORD + 4'd1 &&
                                                 \u_dut.gray_q == (\u_dut.word_q [1] != \u_dut.word_q [0])));
      runs_one: cover (runs && any_thread == 2'd2 && any_word == TICK_WORD);
      asks_one: cover (asks && !asks_q);
    end
  end
endmodule

`default_nettype wire
