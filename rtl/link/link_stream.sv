// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Stream: every period ticks it sends selected snapshot words of one tick as a frame without a
// request: kind, counter, mask, words. It first stores all words of the tick, so a frame belongs to
// one tick. While a frame is stored or sent, frames that fall due are dropped whole and counted.
// Documentation: docs/link.md
`default_nettype none

module link_stream (
    input  logic        clk_i,
    input  logic        rst_ni,

    // Words of the snapshot by number, one at a time; the last one of a tick is the status
    input  logic        word_valid_i,
    input  logic [ 3:0] word_number_i,
    input  logic [31:0] word_data_i,

    // Registers: rdata_o follows addr_i by 3 clocks, 0 for an address of another block
    input  logic [15:0] addr_i,
    input  logic [31:0] wdata_i,
    input  logic        write_i,
    output logic [31:0] rdata_o,

    // The frame without its CRC; a byte transfers in each clock with valid_o and ready_i
    output logic        valid_o,
    output logic [ 7:0] byte_o,
    output logic        last_o,
    input  logic        ready_i
);
  localparam int Words = feltgate_link_pkg::SNAPSHOT_WORDS;
  localparam int PeriodBits = 24;
  localparam logic [Words-1:0] ALWAYS = Words'(1) << feltgate_link_pkg::N_TICK;

  // First and last word of a tick.
  logic first, last, within_q;
  assign first = word_valid_i && !within_q;
  assign last  = word_valid_i && word_number_i == 4'(feltgate_link_pkg::N_STATUS);
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) within_q <= 1'b0;
    else if (word_valid_i) within_q <= !last;
  end

  // Registers.
  logic [     Words-1:0] words_q;
  logic [PeriodBits-1:0] period_q, period, ticks_q;
  logic [          31:0] dropped_q;
  logic                  at_words, at_period, begins, due;
  assign at_words  = write_i && addr_i == feltgate_link_pkg::A_STREAM_WORDS;
  assign at_period = write_i && addr_i == feltgate_link_pkg::A_STREAM_PERIOD;
  assign period    = (wdata_i[31:PeriodBits] != '0) ? '1 : wdata_i[PeriodBits-1:0];
  assign due       = first && period_q != '0 && ticks_q == '0;

  enum logic [2:0] {
    Idle = 3'd0,  // waits for a tick that is due
    Take = 3'd1,  // stores the words of the tick
    Head = 3'd2,  // sends the four bytes of the head
    Seek = 3'd3,  // looks for the next word of the mask
    Body = 3'd4   // sends its four bytes
  } state_q;
  logic [      7:0] count_q, frame_q;
  logic [Words-1:0] left_q;  // mask of the words to send, from word at_q on
  logic [      3:0] at_q;
  logic [      1:0] index_q;
  assign begins = due && state_q == Idle;

  // Words of one tick.
  (* no_rw_check, ramstyle = "no_rw_check" *)
  logic [31:0] tick_ram [0:15];
  logic [31:0] word_q;
  always @(posedge clk_i) begin
    if (word_valid_i && (begins || state_q == Take)) tick_ram[word_number_i] <= word_data_i;
  end
  always_ff @(posedge clk_i) word_q <= tick_ram[at_q];

  assign valid_o = state_q == Head || state_q == Body;
  assign last_o  = state_q == Body && index_q == 2'd3 && left_q[Words-1:1] == '0;
  always_comb begin
    case ({state_q == Body, index_q})
      3'd0:    byte_o = feltgate_link_pkg::KIND_STREAM[7:0];
      3'd1:    byte_o = frame_q;
      3'd2:    byte_o = left_q[7:0];
      3'd3:    byte_o = 8'(left_q[Words-1:8]);
      3'd4:    byte_o = word_q[7:0];
      3'd5:    byte_o = word_q[15:8];
      3'd6:    byte_o = word_q[23:16];
      default: byte_o = word_q[31:24];
    endcase
  end

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      words_q   <= '0;
      period_q  <= '0;
      ticks_q   <= '0;
      dropped_q <= '0;
      state_q   <= Idle;
      count_q   <= '0;
      frame_q   <= '0;
      left_q    <= '0;
      at_q      <= '0;
      index_q   <= '0;
    end else begin
      if (first) ticks_q <= (due ? period_q : ticks_q) - 1'b1;  // not used if the period is 0
      if (due) begin
        count_q <= count_q + 8'd1;
        if (!begins) dropped_q <= dropped_q + 32'd1;
      end
      if (at_words) words_q <= wdata_i[Words-1:0];
      if (at_period) begin
        period_q <= period;
        ticks_q  <= '0;
      end

      case (state_q)
        Idle: begin
          at_q    <= '0;
          index_q <= '0;
          left_q  <= words_q | ALWAYS;
          frame_q <= count_q;
          if (begins) state_q <= last ? Head : Take;
        end
        Take: if (last) state_q <= Head;
        Head, Body: begin
          if (ready_i) begin
            index_q <= index_q + 2'd1;
            if (index_q == 2'd3) state_q <= last_o ? Idle : Seek;
            if (index_q == 2'd3 && state_q == Body) begin
              at_q   <= at_q + 4'd1;
              left_q <= left_q >> 1;
            end
          end
        end
        default: begin  // Seek; the RAM reads word at_q in the meantime
          if (left_q[0]) state_q <= Body;
          else begin
            at_q   <= at_q + 4'd1;
            left_q <= left_q >> 1;
          end
        end
      endcase
    end
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
      case (addr_q2)
        feltgate_link_pkg::A_STREAM_WORDS:   rdata_o <= 32'(words_q);
        feltgate_link_pkg::A_STREAM_PERIOD:  rdata_o <= 32'(period_q);
        feltgate_link_pkg::A_STREAM_DROPPED: rdata_o <= dropped_q;
        default:                             rdata_o <= '0;
      endcase
    end
  end
endmodule

`default_nettype wire
