// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The words that the blocks and the host get, for any writes. The RAM is taken out; of any one word the
// wrapper keeps what was written last.
`default_nettype none

module words_proof (
    input logic        clk_i,
    input logic        rst_ni,
    input logic [ 3:0] next_scene_i,
    input logic        lands_i,      // a write, if it is the last clock of a tick
    input logic [ 8:0] address_i,
    input logic [31:0] data_i,
    input logic [ 8:0] read_addr_i,
    input logic        breaks_i,     // a bit of what the RAM returns is wrong
    input logic [ 1:0] broken_i      // one that this bit of the check sees
);
  `include "reset.svh"

  // The real clocks; a scene is of a tick.
  logic [cfg::TICK_W-1:0] clock;
  logic tick, sample, lands;
  logic [31:0] count;
  logic [3:0] scene;
  tick_counter u_tick (.clk_i(clk_i), .rst_ni(rst_ni), .clock_o(clock), .sample_o(sample), .tick_o(tick), .count_o(count));
  always_ff @(posedge clk_i) if (tick) scene <= next_scene_i;
  assign lands = lands_i && tick;

  logic [31:0] read_data;
  cfg::params_t p;
  logic word_error;
  params #(.ParameterFile("parameters.mem")) u_dut (
      .*,
      .clock_i(clock),
      .scene_i(scene),
      .write_i(lands),
      .read_data_o(read_data),
      .p_o(p),
      .word_error_o(word_error)
  );
  (* hierconn *) wire [35:0] \u_dut.fetch_q ;
  (* hierconn *) wire [35:0] \u_dut.read_q ;
  (* hierconn *) wire [8:0] \u_dut.address ;
  (* hierconn *) wire [8:0] \u_dut.place ;
  logic [8:0] place_q, place_q2;  // of the word that was fetched, and of the one before
  always_ff @(posedge clk_i) {place_q2, place_q} <= {place_q, \u_dut.place };
  (* hierconn *) wire \u_dut.fetched_q ;
  (* hierconn *) wire \u_dut.good_q ;
  (* hierconn *) wire [31:0] \u_dut.fetched_word_q ;

  // Check bit k is the parity of bits k, k + 4, ... of the word, inverted for k = 0 and 2.
  function automatic logic [3:0] check_of(input logic [31:0] data);
    for (int k = 0; k < 4; k++) begin
      check_of[k] = (k % 2 == 0);
      for (int n = k; n < 32; n += 4) check_of[k] = check_of[k] ^ data[n];
    end
  endfunction
  // One word, whichever it is, as it was written last; the register that has it.
  logic [8:0] word_q;  // the word that is watched
  logic [31:0] value_q;
  logic common_stale, scene_stale, broke_q;
  always_comb begin  // three of the common words, and those of the scene
    case (word_q)
      9'd24:   common_stale = p.torque_limit != value_q[19:0];
      9'd33:   common_stale = p.current_limit != value_q[20:0];
      9'd45:   common_stale = p.duty_limit != value_q[11:0];
      default: common_stale = 1'b0;
    endcase
    case (word_q[4:0])
      5'd1:    scene_stale = p.scene_1 != value_q[25:0];
      5'd2:    scene_stale = p.scene_2 != value_q;
      5'd3:    scene_stale = p.scene_3 != value_q[16:0];
      5'd6:    scene_stale = p.scene_6 != value_q[17:0];
      5'd10:   scene_stale = p.scene_10 != value_q[20:0];
      default: scene_stale = 1'b0;
    endcase
    if (word_q[8:5] != scene) scene_stale = 1'b0;
  end
  // What the RAM returns.
  logic fetched_q, flipped_q, seen_q, read_q, read_q2, whole_q, lands_q;
  logic [1:0] flip_q;
  logic [8:0] fetch_q, fetch_q2;
  logic [31:0] read_value_q, read_value_q2, fetch_value_q;
  wire [35:0] fetched = \u_dut.fetch_q ;
  initial {broke_q, read_q, read_q2} = 3'b000;
  always_ff @(posedge clk_i) begin
    word_q <= word_q;
    if (lands && address_i == word_q) value_q <= data_i;
    fetched_q     <= \u_dut.address == word_q && !lands;
    {fetch_q2, fetch_q} <= {fetch_q, \u_dut.address };
    fetch_value_q <= value_q;
    flipped_q     <= breaks_i && !lands;
    flip_q        <= broken_i;
    broke_q       <= broke_q || breaks_i;
    read_q        <= read_addr_i == word_q && !lands;
    read_value_q  <= value_q;
    lands_q       <= lands;
    {read_q2, read_value_q2} <= {read_q, read_value_q};
  end
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) {seen_q, whole_q} <= '0;
    else begin
      seen_q <= \u_dut.fetched_q && flipped_q;
      if (tick) whole_q <= 1'b1;  // a tick began since the reset
    end
  end
  always_comb begin
    assume (past_ok_q || !common_stale);  // configuration loads RAM and registers
    // The RAM returns the word that was written last, and its check fits but for a bit that breaks.
    if (past_ok_q && !lands_q) assume ((fetched[35:32] ^ check_of(fetched[31:0])) == (flipped_q ? 4'd1 << flip_q : 4'd0));
    if (past_ok_q && fetched_q && !flipped_q) assume (fetched[31:0] == fetch_value_q);
    if (past_ok_q && read_q) assume ( \u_dut.read_q [31:0] == read_value_q);
  end
  // Place of the word that is fetched for the scene in each clock of a tick.
  function automatic logic [4:0] scene_place(input logic [cfg::TICK_W-1:0] at);
    case (at)
      6'd0:    scene_place = 5'd1;
      6'd1:    scene_place = 5'd2;
      6'd2:    scene_place = 5'd3;
      6'd3:    scene_place = 5'd6;
      default: scene_place = 5'd10;
    endcase
  endfunction
  logic [4:0] place, place2;  // of the clock before, and of the one before that
  assign place  = scene_place(clock - 6'd1);
  assign place2 = scene_place(clock - 6'd2);
  always_comb begin
    if (past_ok_q) begin
      blocks_get_the_word: assert (broke_q || !common_stale);
    end
    if (past_ok_q && rst_ni) begin
      scene_gets_the_word: assert (broke_q || !whole_q || clock < cfg::TICK_W'(7) || !scene_stale);
      inside_place: assert (!whole_q || clock == '0 || clock > cfg::TICK_W'(5) ||
                            (place_q == {4'd15, place} && \u_dut.fetched_q && fetch_q == {scene, place}));
      inside_good: assert (broke_q || !whole_q || clock < 6'd2 || clock > 6'd6 ||
                           (place_q2 == {4'd15, place2} && \u_dut.good_q && fetch_q2 == {scene, place2}));
      inside_word: assert (broke_q || !\u_dut.good_q || fetch_q2 != word_q || \u_dut.fetched_word_q == value_q);
      inside_loaded: assert (broke_q || !whole_q || clock == '0 || !scene_stale ||
          !((word_q[4:0] == 5'd1 && clock > 2) || (word_q[4:0] == 5'd2 && clock > 3) || (word_q[4:0] == 5'd3 && clock > 4) ||
            (word_q[4:0] == 5'd6 && clock > 5)));
      inside_clock: assert (clock < cfg::TICK_W'(cfg::CLOCKS_PER_TICK) && tick == (clock == cfg::TICK_W'(cfg::CLOCKS_PER_TICK - 1)));
      broken_bit_is_seen: assert (word_error == seen_q);
      reads_the_word: assert (!read_q2 || read_data == read_value_q2);
      loads: cover (clock == 6'd7 && p.scene_10 == 21'd5);
    end
  end
endmodule

`default_nettype wire
