// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Shows twelve words of several axes as those of one core: after a tick it gives the chosen words of
// that tick, one in each clock, to stream and capture. Events follow with the same delay. Documentation: docs/link.md
`default_nettype none

module link_view #(
    parameter int AxisCount = 2
) (
    input  logic        clk_i,
    input  logic        rst_ni,

    // Words of the snapshots by number, of each axis one at a time
    input  logic [   AxisCount-1:0] word_valid_i,
    input  logic [ AxisCount*4-1:0] word_number_i,
    input  logic [AxisCount*32-1:0] word_data_i,
    input  logic                    last_i,  // last clock of a tick: all of its words have come

    // Events of a law
    input  logic        event_valid_i,
    input  logic [ 8:0] event_number_i,

    // Registers: rdata_o follows addr_i by 3 clocks, 0 for an address of another block
    input  logic [15:0] addr_i,
    input  logic [31:0] wdata_i,
    input  logic        write_i,
    output logic [31:0] rdata_o,

    // The chosen words by number, with the status at the end
    output logic        word_valid_o,
    output logic [ 3:0] word_number_o,
    output logic [31:0] word_data_o,     // valid with word_valid_o
    output logic        event_valid_o,
    output logic [ 8:0] event_number_o
);
  localparam int Words = feltgate_link_pkg::SNAPSHOT_WORDS;
  // Word k of the view is chosen at FIRST + k; the number of axes is at AXES. The twin has the same.
  localparam logic [15:0] FIRST = 16'h1030;
  localparam logic [15:0] AXES = 16'h103f;
  localparam int ChoiceBits = 6;  // axis, 2 bits; number of the word, 4 bits
  localparam int Delay = Words + 1;  // from the last clock of a tick to the last word of the view
  localparam logic [3:0] TICK = 4'(feltgate_link_pkg::N_TICK);
  localparam logic [3:0] STATUS = 4'(feltgate_link_pkg::N_STATUS);

  generate
  if (AxisCount < 1 || AxisCount > 3) begin : g_check_axes
    AXES_must_be_1_to_3 missing ();
  end
  endgenerate

  // Choices. The word `tick` is that of axis 0 always: a frame without it says nothing.
  logic [ChoiceBits-1:0] choices_q [0:Words-1];
  logic addressed, fits;
  assign addressed = addr_i[15:4] == FIRST[15:4] && addr_i[3:0] < 4'(Words) && addr_i[3:0] != TICK;
  assign fits      = wdata_i[31:ChoiceBits] == '0 && 32'(wdata_i[5:4]) < AxisCount && wdata_i[3:0] < 4'(Words);
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      for (int k = 0; k < Words; k++) choices_q[k] <= ChoiceBits'(k);
    end else if (write_i && addressed && fits) begin
      choices_q[addr_i[3:0]] <= wdata_i[ChoiceBits-1:0];
    end
  end

  // One half of each RAM takes the words of a tick while the other shows those of the last one.
  logic       half_q, plays_q;
  logic [3:0] at_q;
  logic [1:0] axis_q;
  logic [ChoiceBits-1:0] choice;
  logic [4:0] read_at;
  assign choice   = choices_q[at_q];
  assign read_at  = {!half_q, choice[3:0]};
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      half_q        <= 1'b0;
      plays_q       <= 1'b0;
      at_q          <= '0;
      axis_q        <= '0;
      word_valid_o  <= 1'b0;
      word_number_o <= '0;
    end else begin
      half_q  <= half_q ^ last_i;
      plays_q <= last_i || (plays_q && at_q != STATUS);
      if (last_i) at_q       <= STATUS + 4'd1;
      else if (plays_q) at_q <= (at_q == 4'(Words - 1)) ? 4'd0 : at_q + 4'd1;
      axis_q        <= choice[5:4];
      word_valid_o  <= plays_q;
      word_number_o <= at_q;
    end
  end

  logic [AxisCount*32-1:0] words;
  generate
  genvar n;
  for (n = 0; n < AxisCount; n = n + 1) begin : g_axis
    (* no_rw_check, ramstyle = "no_rw_check" *)
    logic [31:0] ram [0:31];
    logic [31:0] word_q;
    always @(posedge clk_i) begin
      if (word_valid_i[n]) ram[{half_q, word_number_i[4*n+:4]}] <= word_data_i[32*n+:32];
    end
    always_ff @(posedge clk_i) word_q <= ram[read_at];
    assign words[32*n+:32] = word_q;
  end
  endgenerate
  assign word_data_o = words[32*axis_q+:32];

  // An event belongs to the tick whose last word is to come, in front of the view and behind it.
  logic [10*Delay-1:0] events_q;
  assign {event_valid_o, event_number_o} = events_q[10*Delay-1-:10];
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) events_q <= '0;
    else events_q <= {events_q[10*(Delay-1)-1:0], event_valid_i, event_number_i};
  end

  // Read back.
  logic [15:0] addr_q, addr_q2;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      addr_q  <= '0;
      addr_q2 <= '0;
      rdata_o <= '0;
    end else begin
      addr_q  <= addr_i;
      addr_q2 <= addr_q;
      if (addr_q2 == AXES) rdata_o <= 32'(AxisCount);
      else if (addr_q2[15:4] == FIRST[15:4] && addr_q2[3:0] < 4'(Words))
        rdata_o <= 32'(choices_q[addr_q2[3:0]]);
      else rdata_o <= '0;
    end
  end
endmodule

`default_nettype wire
