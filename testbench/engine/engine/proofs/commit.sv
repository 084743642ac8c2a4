// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// A commit beside a count of its beats: which words it reads, what it makes of the differences, when the
// other bank comes into force and until when it is kept. For any differences, ticks and runs.
`default_nettype none

module commit_proof (
    input logic       clk_i,
    input logic       rst_ni,
    input logic       commit_i,
    input logic       wait_i,
    input logic       tick_i,
    input logic       beat_i,
    input logic       negative_i,
    input logic [3:0] running_i
);
  `include "reset.svh"
  (* anyconst *) logic [5:0] mailbox_first_i;
  logic bank, taken, differs, checking, committing, refused, minus;
  logic [4:0] refused_word;
  logic [8:0] address;
  engine_commit u_dut (
      .*,
      .bank_o(bank),
      .taken_o(taken),
      .differs_o(differs),
      .checking_o(checking),
      .committing_o(committing),
      .refused_o(refused),
      .refused_word_o(refused_word),
      .minus_o(minus),
      .address_o(address)
  );
  (* hierconn *) wire [8:0] \u_dut.beat_q ;
  (* hierconn *) wire [3:0] \u_dut.old_q ;
  (* hierconn *) wire \u_dut.wanted_q ;
  (* hierconn *) wire \u_dut.passed_q ;

  // Of each word four differences of two beats; the sign of one is there with the beat behind it.
  logic [8:0] beats_q;  // of this check so far
  logic [7:0] read;     // the beat behind the two of the difference that is there
  logic [4:0] word;     // whose it is
  logic of_range, known;
  assign read     = 8'(beats_q - 9'd2);
  assign known    = checking && beat_i && beats_q >= 9'd2 && !beats_q[0];
  assign word     = read[7:3];
  assign of_range = read[2:1] == 2'd0 || read[2:1] == 2'd1;

  logic wanted_q, checks_q, passed_q, bad_q, other_q, bank_q, taken_q;
  logic [4:0] first_bad_q;
  logic [3:0] old_q;  // runs under way that began with the bank that was in force before
  logic bad, ends;
  assign bad  = known && of_range && negative_i;
  assign ends = checks_q && beat_i && beats_q == 9'd256;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      {wanted_q, checks_q, passed_q, bad_q, other_q, bank_q, taken_q} <= '0;
      {beats_q, first_bad_q, old_q} <= '0;
    end else begin
      bank_q  <= bank;
      taken_q <= taken;
      if (commit_i && !wanted_q && !checks_q && !passed_q && old_q == '0) wanted_q <= 1'b1;
      if (wanted_q && !wait_i) begin
        {wanted_q, checks_q} <= 2'b01;
        {bad_q, other_q}     <= 2'b00;
        beats_q              <= '0;
      end
      if (checks_q && beat_i) beats_q <= beats_q + 9'd1;
      if (bad && !bad_q) first_bad_q <= word;
      if (bad) bad_q <= 1'b1;
      if (known && !of_range && negative_i && {1'b0, word} < mailbox_first_i) other_q <= 1'b1;
      if (ends) {checks_q, passed_q} <= {1'b0, !bad_q && !bad};
      if (passed_q && tick_i) passed_q <= 1'b0;
      for (int t = 0; t < 4; t++) old_q[t] <= running_i[t] && (taken || old_q[t]);
    end
  end

  // What a beat reads: the idle bank's word and, in this order, lower, upper, twice the one in force.
  logic [8:0] base, in_force, idle;
  always_comb begin
    in_force = bank ? feltgate_engine_pkg::D_PARAMETER_BANK : feltgate_engine_pkg::D_PARAMETER;
    idle     = bank ? feltgate_engine_pkg::D_PARAMETER : feltgate_engine_pkg::D_PARAMETER_BANK;
    case (beats_q[2:0])
      3'd1: base = feltgate_engine_pkg::D_LOWER;
      3'd2: base = feltgate_engine_pkg::D_UPPER;
      3'd5, 3'd6: base = in_force;
      default: base = idle;
    endcase
  end

  always_comb begin
    if (rst_ni && past_ok_q) begin
      begins_when_free: assert (checking == checks_q);
      reads_in_order: assert (!checking || beats_q[8] || (address == base + {4'd0, beats_q[7:3]} && minus == beats_q[0]));
      refused_if_beyond: assert (refused == bad_q);
      names_the_first: assert (!refused || refused_word == first_bad_q);
      differs_if_another: assert (differs == other_q);
      with_a_tick: assert (taken == (passed_q && tick_i));
      bank_with_it: assert (bank == (bank_q ^ taken_q));
      kept_while_used: assert (committing == (wanted_q || checks_q || passed_q || old_q != '0));
      inside_beats: assert (beats_q <= 9'd257 && (!checks_q || (\u_dut.beat_q == beats_q && beats_q <= 9'd256)));
      inside_passed: assert (\u_dut.passed_q == passed_q && \u_dut.wanted_q == wanted_q);
      inside_old: assert (\u_dut.old_q == old_q);
      inside_one: assert (!(checks_q && wanted_q) && !(passed_q && (checks_q || wanted_q)));
      checks_one: cover (checking && beats_q == 9'd9 && differs);
      refuses_one: cover (refused && refused_word == 5'd1);
    end
  end
endmodule

`default_nettype wire
