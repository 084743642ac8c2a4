// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// All words of a tick for the host, in two banks: the running tick writes one, the host reads the other.
// A freeze keeps the bank that is read. One word a clock is written and shown at word_o, for a stream or a
// capture; the last words come after the end of the chain. docs/blocks/host.md

`default_nettype none

module snapshot (
    input  logic              clk_i,
    input  logic              rst_ni,
    input  logic              tick_i,       // last clock of a tick
    input  logic              begin_i,      // tau_ref is new
    input  logic              end_i,        // duty is new, later
    input  logic              freeze_i,     // with tick_i
    input  logic              thaw_i,
    input  cfg::snapshot_t    values_i,
    input  logic        [5:0] read_addr_i,
    output logic       [31:0] read_data_o,  // two clocks later
    output cfg::word_t        word_o
);
  // In the order of writing; the last three are new with end_i.
  localparam int Words = 12, Early = 9;
  logic [3:0] next_q;
  logic done_q, goes;
  logic [5:0] place;
  logic [31:0] word;
  assign goes = next_q < 4'(Words) && (next_q < 4'(Early) || done_q);
  always_comb begin
    case (next_q)
      4'd0:    {place, word} = {map::S_TICK, values_i.tick};
      4'd1:    {place, word} = {map::S_POSITION, values_i.position};
      4'd2:    {place, word} = {map::S_FAULTS, values_i.faults};
      4'd3:    {place, word} = {map::S_ENCODER, values_i.encoder};
      4'd4:    {place, word} = {map::S_INDEX, values_i.index};
      4'd5:    {place, word} = {map::S_VELOCITY, 32'($signed(values_i.velocity))};
      4'd6:    {place, word} = {map::S_TAU_HAT, 32'($signed(values_i.tau_hat))};
      4'd7:    {place, word} = {map::S_TAU_REF, 32'($signed(values_i.tau_ref))};
      4'd8:    {place, word} = {map::S_CURRENT_REF, 32'($signed(values_i.current))};
      4'd9:    {place, word} = {map::S_VOLTAGE, 32'($signed(values_i.voltage))};
      4'd10:   {place, word} = {map::S_DUTY, 32'($signed(values_i.duty))};
      default: {place, word} = {map::S_STATUS, values_i.status};
    endcase
  end
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      next_q <= 4'(Words);
      {done_q, word_o} <= '0;
    end else begin
      if (begin_i) next_q <= '0;
      else if (goes) next_q <= next_q + 1'b1;
      done_q       <= end_i || (done_q && !begin_i);
      word_o.valid <= goes;
      if (goes) {word_o.place, word_o.data} <= {place, word};
    end
  end

  (* no_rw_check, ram_style = "block", ramstyle = "no_rw_check" *)
  logic [31:0] ram[0:127];
  initial for (int i = 0; i < 128; i++) ram[i] = 32'd0;
  logic bank_q, frozen_q;
  logic [31:0] read_q;
  always @(posedge clk_i) if (word_o.valid) ram[{bank_q, word_o.place}] <= word_o.data;
  always_ff @(posedge clk_i) read_q <= ram[{!bank_q, read_addr_i}];
  always_ff @(posedge clk_i) read_data_o <= read_q;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      {bank_q, frozen_q} <= '0;
    end else begin
      if (tick_i && !frozen_q) bank_q <= !bank_q;
      if (freeze_i) frozen_q <= 1'b1;
      else if (thaw_i) frozen_q <= 1'b0;
    end
  end
endmodule

`default_nettype wire
