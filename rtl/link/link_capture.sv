// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Capture: stores selected snapshot words of consecutive ticks (or of every period-th tick) in a
// ring of rows, one whole tick per row, some rows before a trigger and the rest from it on. The
// host reads the rows through a memory window when the capture has ended.
// Documentation: docs/link.md
`default_nettype none

module link_capture #(
    parameter int Rows = 1 << feltgate_link_pkg::ROWS_LOG2,  // a power of two
    parameter int Events = cfg::ENGINE                       // 1: an event of a law can trigger
) (
    input  logic        clk_i,
    input  logic        rst_ni,

    // Words of the snapshot by number, one at a time; the last one of a tick is the status
    input  logic        word_valid_i,
    input  logic [ 3:0] word_number_i,
    input  logic [31:0] word_data_i,

    // Events of a law, as they enter the engine's queue; not used without Events
    input  logic        event_valid_i,
    input  logic [ 8:0] event_number_i,

    // Registers and memory: rdata_o follows addr_i by 3 clocks, 0 for an address of another block
    input  logic [15:0] addr_i,
    input  logic [31:0] wdata_i,
    input  logic        write_i,
    output logic [31:0] rdata_o
);
  localparam int Words = feltgate_link_pkg::SNAPSHOT_WORDS;
  localparam int RowBits = $clog2(Rows);
  localparam int ColumnBits = $clog2(feltgate_link_pkg::COLUMNS);
  localparam int PeriodBits = 16;
  localparam int ModeBits = feltgate_link_pkg::TRIGGER_MODE_BITS;
  localparam int EventBits = $clog2(feltgate_link_pkg::ANY_EVENT);
  localparam logic [RowBits:0] FULL = (RowBits + 1)'(Rows);

  generate
  if (!(Rows == 1 << RowBits && RowBits >= 2 && RowBits + ColumnBits <= 13)) begin : g_check_rows
    Rows_must_be_a_power_of_two_that_fits_the_window missing ();
  end
  endgenerate

  enum logic [2:0] {
    Idle = 3'd0,
    Fill = 3'd1,  // takes the rows before the trigger
    Wait = 3'd2,  // waits for the trigger; the ring wraps
    Rest = 3'd3,  // takes the rows after the trigger, and its row if Wait did not
    Done = 3'd4
  } state_q;
  logic runs;
  assign runs = state_q == Fill || state_q == Wait || state_q == Rest;

  // First and last word of a tick. ends_q: a tick ends in the clock after its last word.
  logic first, last, within_q, ends_q;
  assign first = word_valid_i && !within_q;
  assign last  = word_valid_i && word_number_i == 4'(feltgate_link_pkg::N_STATUS);

  // Registers. Those that define the rows cannot change while a capture runs.
  logic [     Words-1:0] words_q;
  logic [   RowBits-1:0] pre_q, pre;
  logic [PeriodBits-1:0] period_q, period;
  logic [           3:0] trigger_word_q;
  logic [  ModeBits-1:0] trigger_mode_q, mode;
  logic [          31:0] level_q;
  logic                  control, starts, aborts, triggers, configures;
  assign control    = write_i && addr_i == feltgate_link_pkg::A_CAPTURE_CONTROL;
  assign aborts     = control && wdata_i[feltgate_link_pkg::B_CAPTURE_CONTROL_ABORT];
  assign starts     = control && wdata_i[feltgate_link_pkg::B_CAPTURE_CONTROL_START] && !aborts;
  assign triggers   = control && wdata_i[feltgate_link_pkg::B_CAPTURE_CONTROL_TRIGGER];
  assign pre        = (wdata_i[31:RowBits] != '0) ? '1 : wdata_i[RowBits-1:0];
  assign period     = (wdata_i[31:PeriodBits] != '0) ? '1 : wdata_i[PeriodBits-1:0];
  assign mode       = wdata_i[ModeBits-1:0] & ~((Events != 0) ? '0 : ModeBits'(feltgate_link_pkg::TRIGGER_EVENT));
  assign configures = write_i && (addr_i == feltgate_link_pkg::A_TRIGGER_WORD ||
                                  addr_i == feltgate_link_pkg::A_TRIGGER_MODE ||
                                  addr_i == feltgate_link_pkg::A_TRIGGER_LEVEL);
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      words_q        <= '0;
      pre_q          <= '0;
      period_q       <= '0;
      trigger_word_q <= '0;
      trigger_mode_q <= '0;
      level_q        <= '0;
    end else if (write_i) begin
      case (addr_i)
        feltgate_link_pkg::A_CAPTURE_WORDS:  if (!runs) words_q <= wdata_i[Words-1:0];
        feltgate_link_pkg::A_CAPTURE_PRE:    if (!runs) pre_q <= pre;
        feltgate_link_pkg::A_CAPTURE_PERIOD: if (!runs) period_q <= period;
        feltgate_link_pkg::A_TRIGGER_WORD:   trigger_word_q <= (wdata_i[31:4] != '0) ? '1 : wdata_i[3:0];
        feltgate_link_pkg::A_TRIGGER_MODE:   trigger_mode_q <= mode;
        feltgate_link_pkg::A_TRIGGER_LEVEL:  level_q <= wdata_i;
        default: ;
      endcase
    end
  end

  // Trigger: compares the word with its value of the previous tick, in every tick, captured or not.
  logic        at_trigger, high, high_q, known_q, hit_q, hand_q, fires;
  logic [31:0] before_q;
  assign at_trigger = word_valid_i && word_number_i == trigger_word_q;
  assign high       = $signed(word_data_i) >= $signed(level_q);
  always_ff @(posedge clk_i) begin
    if (at_trigger) begin
      high_q   <= high;
      before_q <= word_data_i;
    end
  end
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      known_q <= 1'b0;
      hit_q   <= 1'b0;
    end else if (configures) begin  // the old result belongs to another condition
      known_q <= 1'b0;
      hit_q   <= 1'b0;
    end else if (at_trigger) begin
      known_q <= 1'b1;
      case (trigger_mode_q)
        ModeBits'(feltgate_link_pkg::TRIGGER_RISES): hit_q <= known_q && high && !high_q;
        ModeBits'(feltgate_link_pkg::TRIGGER_FALLS): hit_q <= known_q && !high && high_q;
        ModeBits'(feltgate_link_pkg::TRIGGER_BIT): hit_q <= known_q && (word_data_i & ~before_q & level_q) != '0;
        default: hit_q <= 1'b0;
      endcase
    end
  end

  // An event since the end of the last tick; it belongs to the tick whose last word is to come.
  logic event_hit, event_q;
  assign event_hit = event_valid_i && Events != 0 && trigger_mode_q == ModeBits'(feltgate_link_pkg::TRIGGER_EVENT) &&
                     ((level_q & 32'(feltgate_link_pkg::ANY_EVENT)) != '0 || event_number_i == level_q[EventBits-1:0]);
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) event_q <= 1'b0;
    else if (configures || starts) event_q <= 1'b0;
    else event_q <= Events != 0 && (event_hit || (event_q && !ends_q));
  end

  // Rows.
  logic                  seen_q;                    // a tick has begun since the start
  logic                  begins, takes, taking_q;   // this tick is a row
  logic [PeriodBits-1:0] ticks_q;
  logic [  ColumnBits:0] column, columns, columns_q;
  logic [   RowBits-1:0] row_q;                     // row to be written next
  logic [     RowBits:0] rows_q, rest, left_q;      // rows_q: whole rows; left_q: rows to take
  logic                  stores, whole;
  assign begins = first && runs && ticks_q == '0;
  assign takes  = first ? begins : taking_q;
  assign stores = word_valid_i && runs && takes && 1'(words_q >> word_number_i) && !column[ColumnBits];
  assign whole  = ends_q && runs && taking_q;
  assign fires  = ends_q && state_q == Wait && seen_q && (hit_q || hand_q || event_q);
  assign rest   = FULL - (RowBits + 1)'(pre_q) - (RowBits + 1)'(taking_q);

  // A row has the chosen words by number, at most as many as it has columns.
  always_comb begin
    column  = '0;
    columns = '0;
    for (int k = 0; k < Words; k++) begin
      if (4'(k) == word_number_i) column = columns;
      columns = columns + (ColumnBits + 1)'(words_q[k]);
    end
  end

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      state_q   <= Idle;
      within_q  <= 1'b0;
      ends_q    <= 1'b0;
      seen_q    <= 1'b0;
      taking_q  <= 1'b0;
      hand_q    <= 1'b0;
      ticks_q   <= '0;
      columns_q <= '0;
      row_q     <= '0;
      rows_q    <= '0;
      left_q    <= '0;
    end else begin
      if (word_valid_i) within_q <= !last;
      ends_q <= last;

      if (triggers) hand_q <= 1'b1;
      if (first) begin
        seen_q   <= 1'b1;
        taking_q <= begins;
        if (begins && rows_q == FULL) rows_q <= FULL - 1'b1;  // the oldest row is overwritten
        if (ticks_q != '0) ticks_q <= ticks_q - 1'b1;
        else if (period_q != '0) ticks_q <= period_q - 1'b1;
      end
      if (whole) begin
        taking_q  <= 1'b0;
        columns_q <= columns[ColumnBits] ? (ColumnBits + 1)'(1 << ColumnBits) : columns;
        row_q     <= row_q + 1'b1;
        rows_q    <= rows_q + 1'b1;
        left_q    <= left_q - 1'b1;
        if (state_q == Fill && left_q == (RowBits + 1)'(1)) state_q <= Wait;
        if (state_q == Rest && left_q == (RowBits + 1)'(1)) state_q <= Done;
      end
      if (fires) begin
        hand_q  <= 1'b0;
        left_q  <= rest;
        state_q <= (rest == '0) ? Done : Rest;
      end

      if (aborts) begin
        if (runs) state_q <= Idle;
        taking_q <= 1'b0;
      end
      if (starts) begin
        state_q  <= (pre_q == '0) ? Wait : Fill;
        seen_q   <= 1'b0;
        taking_q <= 1'b0;
        hand_q   <= triggers;
        ticks_q  <= '0;
        row_q    <= '0;
        rows_q   <= '0;
        left_q   <= (RowBits + 1)'(pre_q);
      end
    end
  end

  // Capture memory: at most one word per clock is written.
  (* no_rw_check, ram_style = "block", ramstyle = "no_rw_check" *)
  logic [31:0] capture_ram [0:Rows*feltgate_link_pkg::COLUMNS-1];
  logic [31:0] memory_q, memory_q2;
  always @(posedge clk_i) begin
    if (stores) capture_ram[{row_q, column[ColumnBits-1:0]}] <= word_data_i;
  end
  always_ff @(posedge clk_i) begin
    memory_q  <= capture_ram[addr_i[RowBits+ColumnBits-1:0]];
    memory_q2 <= memory_q;
  end

  // Read back. The memory shows whole rows only, and only while no capture runs; otherwise 0.
  logic [        15:0] addr_q, addr_q2;
  logic [ RowBits-1:0] first_row, offset;
  logic                holds_q;
  assign first_row = row_q - rows_q[RowBits-1:0];
  assign offset    = addr_q[ColumnBits+:RowBits] - first_row;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      addr_q  <= '0;
      addr_q2 <= '0;
      holds_q <= 1'b0;
      rdata_o <= '0;
    end else begin
      addr_q  <= addr_i;
      addr_q2 <= addr_q;
      holds_q <= addr_q[15:RowBits+ColumnBits] == feltgate_link_pkg::MEMORY[15:RowBits+ColumnBits] && !runs &&
                 {1'b0, offset} < rows_q && {1'b0, addr_q[ColumnBits-1:0]} < columns_q;
      case (addr_q2)
        feltgate_link_pkg::A_CAPTURE_STATE:  rdata_o <= 32'(state_q);
        feltgate_link_pkg::A_CAPTURE_WORDS:  rdata_o <= 32'(words_q);
        feltgate_link_pkg::A_CAPTURE_PRE:    rdata_o <= 32'(pre_q);
        feltgate_link_pkg::A_CAPTURE_PERIOD: rdata_o <= 32'(period_q);
        feltgate_link_pkg::A_TRIGGER_WORD:   rdata_o <= 32'(trigger_word_q);
        feltgate_link_pkg::A_TRIGGER_MODE:   rdata_o <= 32'(trigger_mode_q);
        feltgate_link_pkg::A_TRIGGER_LEVEL:  rdata_o <= level_q;
        feltgate_link_pkg::A_CAPTURE_FIRST:  rdata_o <= 32'(first_row);
        feltgate_link_pkg::A_CAPTURE_ROWS:   rdata_o <= 32'(rows_q);
        default:                             rdata_o <= holds_q ? memory_q2 : '0;
      endcase
    end
  end
endmodule

`default_nettype wire
