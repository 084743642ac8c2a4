// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// What the host reads of a tick is of that tick, all of it and nothing else. Of any one place in the RAM,
// which is taken out, the wrapper keeps what was written last.
`default_nettype none

module words_proof (
    input logic           clk_i,
    input logic           rst_ni,
    input logic           begin_i,      // if the tick has time for all words
    input logic           end_i,
    input logic           freeze_i,     // with the last clock of a tick
    input logic           thaw_i,
    input cfg::snapshot_t values_i,
    input logic     [5:0] read_addr_i
);
  `include "reset.svh"
  localparam int N = cfg::CLOCKS_PER_TICK;
  logic [cfg::TICK_W-1:0] clock;
  logic tick, sample;
  logic [31:0] count;
  tick_counter u_tick (.clk_i(clk_i), .rst_ni(rst_ni), .clock_o(clock), .sample_o(sample), .tick_o(tick), .count_o(count));

  // A tick's results come in order and early enough, and hold: tau_ref with begin_i, duty with end_i.
  logic begun_q, ended_q;
  cfg::snapshot_t values_q;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) {begun_q, ended_q} <= '0;
    else begin
      begun_q <= begin_i || (begun_q && !tick);
      ended_q <= end_i || (ended_q && !tick);
    end
  end
  always_ff @(posedge clk_i) values_q <= values_i;
  always_comb begin
    assume (!begin_i || (!begun_q && clock <= cfg::TICK_W'(N - 15)));
    assume (begun_q || begin_i || clock < cfg::TICK_W'(N - 15) || !rst_ni);
    assume (!end_i || (begun_q && !ended_q && clock <= cfg::TICK_W'(N - 5)));
    assume (ended_q || end_i || clock < cfg::TICK_W'(N - 5) || !rst_ni);
  end
  localparam logic [63:0] Late = (64'd1 << map::S_VOLTAGE) | (64'd1 << map::S_DUTY) | (64'd1 << map::S_STATUS);
  localparam logic [63:0] All = Late | (64'd1 << map::S_TICK) | (64'd1 << map::S_POSITION) | (64'd1 << map::S_FAULTS) |
      (64'd1 << map::S_ENCODER) | (64'd1 << map::S_INDEX) | (64'd1 << map::S_VELOCITY) | (64'd1 << map::S_TAU_HAT) |
      (64'd1 << map::S_TAU_REF) | (64'd1 << map::S_CURRENT_REF);

  // In the order of writing.
  localparam logic [12*6-1:0] Order = {map::S_STATUS, map::S_DUTY, map::S_VOLTAGE, map::S_CURRENT_REF, map::S_TAU_REF, map::S_TAU_HAT,
                                       map::S_VELOCITY, map::S_INDEX, map::S_ENCODER, map::S_FAULTS, map::S_POSITION, map::S_TICK};

  logic [31:0] read_data;
  cfg::word_t word;
  snapshot u_dut (.*, .tick_i(tick), .freeze_i(freeze_i && tick), .thaw_i(thaw_i && tick), .read_data_o(read_data), .word_o(word));
  (* hierconn *) wire [3:0] \u_dut.next_q ;
  (* hierconn *) wire \u_dut.done_q ;
  (* hierconn *) wire \u_dut.bank_q ;
  (* hierconn *) wire \u_dut.frozen_q ;
  (* hierconn *) wire [31:0] \u_dut.read_q ;
  wire [3:0] next = \u_dut.next_q ;
  wire bank = \u_dut.bank_q ;

  // Places stored since the tick began, the watched one in both banks, and what the last whole tick had there.
  logic [5:0] place_q;  // the place that is watched
  logic [63:0] stored_q, stored;
  logic [31:0] bank_0_q, bank_1_q, last_q, wanted_q, read_value_q;
  logic whole_q, shown_q, read_q, read_q2, frozen_q;
  logic [31:0] read_value_q2;
  logic [5:0] last_place;  // of the word that went a clock ago
  logic [63:0] gone;  // places of the words that have gone
  always_comb begin
    {gone, last_place} = '0;
    for (int n = 0; n < 12; n++) if (4'(n) < next) {gone[Order[6*n+:6]], last_place} = {1'b1, Order[6*n+:6]};
  end
  initial {read_q, read_q2} = 2'b00;
  assign stored = stored_q | (64'(word.valid) << word.place);
  always_ff @(posedge clk_i) begin
    place_q <= place_q;
    if (word.valid && word.place == place_q && !bank) bank_0_q <= word.data;
    if (word.valid && word.place == place_q && bank) bank_1_q <= word.data;
    if (word.valid && word.place == place_q) wanted_q <= word.data;
    {read_q, read_value_q}   <= {read_addr_i == place_q, bank ? bank_0_q : bank_1_q};
    {read_q2, read_value_q2} <= {read_q, read_value_q};
  end
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) {stored_q, whole_q, shown_q, frozen_q} <= '0;
    else begin
      stored_q <= tick ? '0 : stored;
      if (tick) begin
        whole_q  <= 1'b1;  // a tick began since the reset
        frozen_q <= freeze_i || (frozen_q && !thaw_i);
        if (whole_q && !frozen_q) begin
          shown_q <= 1'b1;
          last_q  <= word.valid && word.place == place_q ? word.data : wanted_q;
        end
      end
    end
  end
  always_comb if (past_ok_q && read_q) assume ( \u_dut.read_q == read_value_q);

  always_comb begin
    if (rst_ni && past_ok_q) begin
      words_of_the_map: assert (!word.valid || All[word.place]);
      each_once: assert (!word.valid || !stored_q[word.place]);
      whole_in_its_tick: assert (!tick || !whole_q || stored == All);
      late_words_are_late: assert (!word.valid || !Late[word.place] || ended_q);
      word_is_its_own: assert (!word.valid || word.data == (
          word.place == map::S_TICK ? values_q.tick : word.place == map::S_POSITION ? values_q.position :
          word.place == map::S_STATUS ? values_q.status : word.place == map::S_FAULTS ? values_q.faults :
          word.place == map::S_ENCODER ? values_q.encoder : word.place == map::S_INDEX ? values_q.index :
          word.place == map::S_VELOCITY ? 32'($signed(values_q.velocity)) : word.place == map::S_TAU_HAT ? 32'($signed(values_q.tau_hat)) :
          word.place == map::S_TAU_REF ? 32'($signed(values_q.tau_ref)) : word.place == map::S_CURRENT_REF ? 32'($signed(values_q.current)) :
          word.place == map::S_VOLTAGE ? 32'($signed(values_q.voltage)) : 32'($signed(values_q.duty))));
      read_is_of_the_last_tick: assert (!shown_q || !All[place_q] || (bank ? bank_0_q : bank_1_q) == last_q);
      reads_what_was_stored: assert (!read_q2 || read_data == read_value_q2);
      inside_clock: assert (clock < cfg::TICK_W'(N) && tick == (clock == cfg::TICK_W'(N - 1)));
      inside_stored: assert (begun_q ? stored == gone && next <= 4'd12 && (!word.valid || (next != '0 && word.place == last_place))
                                     : stored_q == '0 && !word.valid && next == 4'd12 && !ended_q);
      inside_done: assert (!begun_q || \u_dut.done_q == ended_q);
      inside_next: assert (!begun_q || ((next >= 4'd9 || 10'(next) + 10'(N - 14) >= 10'(clock)) &&
                                        (next == 4'd12 || 10'(next) + 10'(N - 13) >= 10'(clock)) && (next <= 4'd9 || ended_q)));
      inside_begun: assert ((begun_q || clock <= cfg::TICK_W'(N - 15)) && (ended_q || clock <= cfg::TICK_W'(N - 5)));
      inside_shown: assert (!shown_q || whole_q);
      inside_frozen: assert ( \u_dut.frozen_q == frozen_q);
      inside_bank: assert (!stored_q[place_q] || (bank ? bank_1_q : bank_0_q) == wanted_q);
      stores: cover (word.valid && word.data != '0);
      reads: cover (read_q2 && read_data == 32'd7);
    end
  end
endmodule

`default_nettype wire
