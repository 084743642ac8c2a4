// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Brings the idle bank of parameters into force, if each of its words lies within its range. The barrel
// subtracts, a word a round. docs/blocks/engine.md

`default_nettype none

module engine_commit (
    input  logic       clk_i,
    input  logic       rst_ni,
    input  logic       commit_i,
    input  logic       wait_i,         // another reads
    input  logic       beat_i,         // a word is read, the one before is there
    input  logic       negative_i,     // the sign of that
    input  logic [3:0] running_i,
    output logic       bank_o,         // in force
    output logic       checking_o,
    output logic       committing_o,   // until no run uses the bank that was in force
    output logic       refused_o,
    output logic [4:0] refused_word_o,
    output logic       minus_o,        // the word that was kept minus this one
    output logic [8:0] address_o
);
  // Four beats a word: it, minus lower; upper, minus it. A difference comes with the next beat.
  logic [7:0] beat_q;
  logic [4:0] before_q;
  logic [3:0] old_q;  // runs that began with the other bank
  logic wanted_q, done, bad;
  assign done         = beat_q[7] && beat_i;
  assign bad          = beat_i && !beat_q[0] && beat_q[6:0] != 7'd0 && negative_i;
  assign minus_o      = checking_o && beat_q[0];
  assign address_o    = beat_q[0] == beat_q[1] ? {3'b101, !bank_o, beat_q[6:2]}
                                               : {3'b110, beat_q[1], beat_q[6:2]};
  assign committing_o = wanted_q || checking_o || old_q != '0;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      beat_q         <= '0;
      before_q       <= '0;
      old_q          <= '0;
      wanted_q       <= 1'b0;
      bank_o         <= 1'b0;
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
        beat_q     <= '0;
      end
      if (checking_o && beat_i) begin
        beat_q   <= beat_q + 8'd1;
        before_q <= beat_q[6:2];
        if ((bad || (beat_q[7] && negative_i)) && !refused_o) begin
          refused_o      <= 1'b1;
          refused_word_o <= before_q;
        end
        if (done) begin
          checking_o <= 1'b0;
          if (!refused_o && !negative_i) begin
            bank_o <= !bank_o;
            old_q  <= running_i;
          end
        end
      end
    end
  end
endmodule

`default_nettype wire
