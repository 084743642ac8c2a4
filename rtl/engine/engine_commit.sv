// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Commit of the parameters: checks each word of the idle bank against its range and swaps the banks
// at the next tick if all pass. It also reports whether a parameter (a word below the mailbox)
// changes. The barrel subtracts in the system's turns: eight beats per word. docs/blocks/engine.md

`default_nettype none

module engine_commit (
    input  logic       clk_i,
    input  logic       rst_ni,
    input  logic       commit_i,
    input  logic       wait_i,           // another reader uses the barrel: do not begin
    input  logic       tick_i,           // one clock: the banks may swap
    input  logic       beat_i,           // this beat's word is read, the previous one is there
    input  logic       negative_i,       // sign of the difference, one beat later
    input  logic [3:0] running_i,
    input  logic [5:0] mailbox_first_i,  // words from here on are the mailbox, not parameters
    output logic       bank_o,           // the bank in force
    output logic       taken_o,          // the banks swap with the next clock
    output logic       differs_o,        // a parameter differs from the one in force
    output logic       checking_o,
    output logic       committing_o,     // from the commit until no run uses the old bank
    output logic       refused_o,
    output logic [4:0] refused_word_o,
    output logic       minus_o,          // difference: previous beat's word minus this one
    output logic [8:0] address_o
);
  // Eight beats per word, in four pairs. The first beat of a pair reads a word, the second
  // subtracts another: word - lower bound, upper bound - word, word - word in force, word in force
  // - word. The sign of a difference is valid in the next beat.
  logic [8:0] beat_q;
  logic [3:0] old_q;  // one bit per thread: its run began with the old bank
  logic wanted_q, passed_q, negative, range, parameter_word;
  assign negative       = negative_i && !beat_q[0] && beat_q[8:1] != '0;
  assign range          = beat_q[2] != beat_q[1];
  assign parameter_word = beat_q <= {mailbox_first_i, 3'd0};
  assign minus_o        = checking_o && beat_q[0];
  localparam logic [2:0] Ranges = feltgate_engine_pkg::D_PARAMETER[8:6] ^ feltgate_engine_pkg::D_LOWER[8:6];
  assign address_o      = {feltgate_engine_pkg::D_PARAMETER[8:6], !bank_o, beat_q[7:3]} ^
                          (beat_q[0] == beat_q[1] ? 9'd0
                               : beat_q[2] ? 9'(feltgate_engine_pkg::PARAMETER_WORDS)
                               : {Ranges, !bank_o ^ beat_q[1], 5'd0});
  assign committing_o   = wanted_q || checking_o || passed_q || old_q != '0;
  assign taken_o        = passed_q && tick_i;
  always_ff @(posedge clk_i) begin
    if (!checking_o) beat_q <= '0;
    else if (beat_i) beat_q <= beat_q + 9'd1;
  end
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      old_q          <= '0;
      wanted_q       <= 1'b0;
      passed_q       <= 1'b0;
      bank_o         <= 1'b0;
      differs_o      <= 1'b0;
      checking_o     <= 1'b0;
      refused_o      <= 1'b0;
      refused_word_o <= '0;
    end else begin
      if (commit_i && !committing_o) wanted_q <= 1'b1;
      old_q <= old_q & running_i;
      if (wanted_q && !wait_i) begin
        wanted_q   <= 1'b0;
        checking_o <= 1'b1;
        refused_o  <= 1'b0;
        differs_o  <= 1'b0;
      end
      if (checking_o && beat_i) begin
        if (negative && range && !refused_o) begin
          refused_o      <= 1'b1;
          refused_word_o <= beat_q[7:3];
        end
        if (negative && !range && parameter_word) differs_o <= 1'b1;
        if (beat_q[8]) begin
          checking_o <= 1'b0;
          passed_q   <= !refused_o;
        end
      end
      // The banks swap with a tick, so that a jump is reported before the next torque is sampled.
      if (taken_o) begin
        passed_q <= 1'b0;
        bank_o   <= !bank_o;
        old_q    <= running_i;
      end
    end
  end
endmodule

`default_nettype wire
