// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// One word of one axis and one place of the view, whichever they are: link_view beside a reader that keeps that
// word of the last whole tick and the choice of that place. For any words, events and writes.
`default_nettype none

module view_proof (
    input logic                             clk_i,
    input logic                             rst_ni,
    input logic                             word_valid_i,
    input logic [                      5:0] word_slot_i,
    input logic [cfg::AXES*32-1:0] word_data_i,
    input logic                             event_valid_i,
    input logic [                      8:0] event_number_i,
    input logic [                     15:0] addr_i,
    input logic [                     31:0] wdata_i,
    input logic                             write_i
);
  localparam int Axes = cfg::AXES;
  localparam int Delay = 13;  // from the last word of a tick to the last of the view
  localparam logic [15:0] Choices = 16'h1030;
  localparam logic [3:0] Tick = 4'd2;
  localparam logic [5:0] FirstSlot = feltgate_link_pkg::FIRST_SLOT;

  `include "reset.svh"

  logic [31:0] rdata, word_data;
  logic word_valid, event_valid;
  logic [5:0] word_slot;
  logic [8:0] event_number;
  link_view #(.AxisCount(Axes)) u_dut (
      .*,
      .rdata_o(rdata),
      .word_valid_o(word_valid), .word_slot_o(word_slot), .word_data_o(word_data),
      .event_valid_o(event_valid), .event_number_o(event_number)
  );
  (* hierconn *) wire \u_dut.half_q ;
  (* hierconn *) wire \u_dut.plays_q ;
  (* hierconn *) wire [3:0] \u_dut.at_q ;
  (* hierconn *) wire [1:0] \u_dut.axis_q ;
  (* hierconn *) wire [3:0] \u_dut.number_q ;
  (* hierconn *) wire [4:0] \u_dut.write_at ;
  (* hierconn *) wire [4:0] \u_dut.read_at ;
  (* hierconn *) wire [5:0] \u_dut.choices_q[0] ;
  (* hierconn *) wire [5:0] \u_dut.choices_q[1] ;
  (* hierconn *) wire [5:0] \u_dut.choices_q[2] ;
  (* hierconn *) wire [5:0] \u_dut.choices_q[3] ;
  (* hierconn *) wire [5:0] \u_dut.choices_q[4] ;
  (* hierconn *) wire [5:0] \u_dut.choices_q[5] ;
  (* hierconn *) wire [5:0] \u_dut.choices_q[6] ;
  (* hierconn *) wire [5:0] \u_dut.choices_q[7] ;
  (* hierconn *) wire [5:0] \u_dut.choices_q[8] ;
  (* hierconn *) wire [5:0] \u_dut.choices_q[9] ;
  (* hierconn *) wire [5:0] \u_dut.choices_q[10] ;
  (* hierconn *) wire [5:0] \u_dut.choices_q[11] ;
  (* hierconn *) wire [15:0] \u_dut.addr_q ;
  (* hierconn *) wire [15:0] \u_dut.addr_q2 ;
  (* hierconn *) wire [Axes*32-1:0] \u_dut.words ;
  (* hierconn *) wire [10*Delay-1:0] \u_dut.events_q ;
  wire [71:0] choices = {\u_dut.choices_q[11] , \u_dut.choices_q[10] , \u_dut.choices_q[9] , \u_dut.choices_q[8] ,
                         \u_dut.choices_q[7] , \u_dut.choices_q[6] , \u_dut.choices_q[5] , \u_dut.choices_q[4] ,
                         \u_dut.choices_q[3] , \u_dut.choices_q[2] , \u_dut.choices_q[1] , \u_dut.choices_q[0] };
  wire half = \u_dut.half_q ;
  wire [4:0] write_at = \u_dut.write_at ;
  wire [4:0] read_at = \u_dut.read_at ;
  wire plays = \u_dut.plays_q ;
  wire [3:0] at = \u_dut.at_q ;

  // What is watched: a word, a place and an event.
  logic [1:0] axis_q;
  logic [3:0] number_q, place_q;
  logic [8:0] event_q;
  always_ff @(posedge clk_i) {axis_q, number_q, place_q, event_q} <= {axis_q, number_q, place_q, event_q};
  always_comb assume (32'(axis_q) < Axes && number_q < 4'd12 && place_q < 4'd12);
  wire [31:0] word = word_data_i[32*axis_q+:32];

  // The tick that comes, by its words from the first slot on, and the watched word of the last whole one.
  logic first, ends, whole_q;
  logic [3:0] place, came_q;  // words that came; 12: the tick is over, 13: so it is, or did not begin, and one came since
  logic [31:0] new_q, shown_q, shown_then_q;
  logic [Delay:1] ends_q;  // the last word came so many clocks ago
  assign first = word_slot_i == FirstSlot;
  assign place = first ? 4'd0 : came_q;
  assign ends  = word_valid_i && place == 4'd11;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      came_q  <= 4'd13;
      ends_q  <= '0;
      whole_q <= 1'b0;
    end else begin
      if (word_valid_i) came_q <= place >= 4'd12 ? 4'd13 : place + 4'd1;
      ends_q  <= {ends_q[Delay-1:1], ends};
      whole_q <= whole_q || ends;
    end
  end
  always_ff @(posedge clk_i) begin
    if (word_valid_i && place == number_q) new_q <= word;
    if (ends) shown_q <= (number_q == 4'd11) ? word : new_q;
    shown_then_q <= shown_q;
  end
  logic [3:0] due;  // the place that comes now
  always_comb begin
    due = 4'd15;
    for (int k = 0; k < 12; k++) if (ends_q[k+2]) due = 4'(k);
  end

  // The choice of the watched place, and what a read asks for.
  logic [5:0] written_q, chosen, chosen_q;
  logic written, any_written_q;
  logic [15:0] addr_q, addr_q2, addr_q3;
  assign written = write_i && addr_i == Choices + 16'(place_q) && place_q != Tick && wdata_i < 32'(16 * Axes) && wdata_i[3:0] < 4'd12;
  assign chosen  = any_written_q ? written_q : 6'(place_q);
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) any_written_q <= 1'b0;
    else any_written_q <= any_written_q || written;
  end
  logic [2:0] reads_q;  // clocks since the reset, up to three
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) reads_q <= '0;
    else reads_q <= {reads_q[1:0], 1'b1};
  end
  always_ff @(posedge clk_i) begin
    if (written) written_q <= wdata_i[5:0];
    chosen_q <= chosen;
    {addr_q3, addr_q2, addr_q} <= {addr_q2, addr_q, addr_i};
  end

  // Clocks ago in which the watched event came, and any.
  logic [Delay:1] event_came_q, any_came_q;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) {event_came_q, any_came_q} <= '0;
    else begin
      event_came_q <= {event_came_q[Delay-1:1], event_valid_i && event_number_i == event_q};
      any_came_q   <= {any_came_q[Delay-1:1], event_valid_i};
    end
  end

  // The RAMs are taken out: of the watched word each half gives what was written to it last.
  logic [31:0] low_q, high_q, read_word_q;
  logic read_q;
  always_ff @(posedge clk_i) begin
    if (word_valid_i && write_at == {1'b0, number_q}) low_q <= word;
    if (word_valid_i && write_at == {1'b1, number_q}) high_q <= word;
    read_q      <= read_at[3:0] == number_q;
    read_word_q <= read_at[4] ? high_q : low_q;
  end
  always_comb if (past_ok_q && read_q) assume (\u_dut.words [32*axis_q+:32] == read_word_q);

  logic mine;  // the watched place comes, with the watched word
  assign mine = word_valid && word_slot == FirstSlot + 6'(place_q) && chosen_q == {axis_q, number_q};
  always_comb begin
    if (past_ok_q && rst_ni) begin
      view_after_its_tick: assert (word_valid == (due != 4'd15) && (!word_valid || word_slot == FirstSlot + 6'(due)));
      word_of_axis_and_tick: assert (!mine || word_data == shown_then_q);
      tick_stays: assert (choices[6*Tick+:6] == 6'(Tick));
      read_is_not_written: assert (!plays || !word_valid_i || read_at != write_at);
      choice_is_read: assert (!reads_q[2] || addr_q3 != Choices + 16'(place_q) || rdata == 32'(chosen_q));
      axes_are_read: assert (!reads_q[2] || addr_q3 != 16'h103f || rdata == 32'(Axes));
      no_word_elsewhere: assert (!reads_q[2] || addr_q3 == 16'h103f || (addr_q3 >= Choices && addr_q3 < Choices + 16'd12) ||
                                 rdata == '0);
      event_with_its_tick: assert (event_valid == any_came_q[Delay] &&
                                   (event_valid && event_number == event_q) == event_came_q[Delay]);
      view_begins: cover (word_valid && due == 4'd0);
      axis_1_chosen: cover (chosen_q[5:4] == 2'd1);
      breaks_off: cover (word_valid_i && first && came_q == 4'd5);
    end
  end

  // What holds of the registers inside.
  logic [3:0] next;  // the place that is read now
  logic apart;       // a tick has twelve clocks at least
  always_comb begin
    next  = 4'd15;
    apart = (ends_q[Delay-1:1] & (ends_q[Delay-1:1] - 1'b1)) == '0 && (ends_q[Delay:2] & (ends_q[Delay:2] - 1'b1)) == '0;
    for (int k = 0; k < 12; k++) if (ends_q[k+1]) next = 4'(k);
    for (int k = 1; k < 12; k++) if (ends_q[k] && came_q < 4'd12 && came_q >= 4'(k)) apart = 1'b0;
  end
  logic [Delay:1] event_there, any_there;
  always_comb begin
    for (int k = 1; k <= Delay; k++) begin
      any_there[k]   = \u_dut.events_q [10*k-1];
      event_there[k] = \u_dut.events_q [10*k-1] && \u_dut.events_q [10*k-10+:9] == event_q;
    end
  end
  always_comb begin
    if (past_ok_q && rst_ni) begin
      inside_number: assert (came_q >= 4'd12 ? \u_dut.number_q >= 4'd12 : \u_dut.number_q == came_q);
      inside_came: assert (came_q != 4'd0 && came_q <= 4'd13);
      inside_apart: assert (apart);
      inside_plays: assert (plays == (next != 4'd15) && at == (plays ? next : 4'd0));
      inside_choice: assert (choices[6*place_q+:6] == chosen);
      inside_axis: assert (!word_valid || word_slot != FirstSlot + 6'(place_q) || \u_dut.axis_q == chosen_q[5:4]);
      inside_asked: assert (!word_valid || word_slot != FirstSlot + 6'(place_q) || read_q == (chosen_q[3:0] == number_q));
      inside_new: assert (came_q > 4'd11 || came_q <= number_q || (half ? high_q : low_q) == new_q);
      inside_shown: assert (!whole_q || (half ? low_q : high_q) == shown_q);
      inside_whole: assert (whole_q || ends_q == '0);
      inside_address: assert ((!reads_q[1] || \u_dut.addr_q2 == addr_q2) && (!reads_q[0] || \u_dut.addr_q == addr_q));
      inside_reads: assert (reads_q == 3'd0 || reads_q == 3'd1 || reads_q == 3'd3 || reads_q == 3'd7);
      inside_events: assert (event_there == event_came_q && any_there == any_came_q);
    end
  end
endmodule

`default_nettype wire
