// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// SPI: the clocks at the pins, the commands, what a frame of the pins means for position and faults, and when a sensor is
// lost or frozen: the pins' bits, edges and commands are collected beside the block.
`default_nettype none

module frame_proof (
    input logic clk_i,
    input logic rst_ni,
    input logic sample_i,
    input logic data_i
);
  localparam int H = 4;
  localparam int G = 4;
  localparam int Frame = 16;
  localparam int Errors = 4;
  localparam int Step = 4;
  localparam int Reads = 16;
  localparam int Fastest = 160;  // counts in a reading
  localparam logic [15:0] Angle = 16'hffff, Flags = 16'h4001, Diagnosis = 16'hfffc;

  `include "reset.svh"

  logic select_n, serial_clock, command, valid, busy, starts;
  logic signed [31:0] position;
  logic [4:0] faults;
  absolute_encoder #(
      .HalfClocks(H),
      .GapClocks(G),
      .AckClocks(16)
  ) u_dut (
      .*,
      .select_no(select_n),
      .serial_clock_o(serial_clock),
      .command_o(command),
      .position_o(position),
      .valid_o(valid),
      .busy_o(busy),
      .starts_o(starts),
      .faults_o(faults)
  );
  (* hierconn *) wire [1:0] \u_dut.state_q ;
  (* hierconn *) wire [3:0] \u_dut.wait_q ;
  (* hierconn *) wire [3:0] \u_dut.take_at_q ;
  (* hierconn *) wire [4:0] \u_dut.period_q ;
  (* hierconn *) wire [4:0] \u_dut.bits_q ;
  (* hierconn *) wire \u_dut.taken_q ;
  (* hierconn *) wire \u_dut.ends_q ;
  (* hierconn *) wire \u_dut.missing_q ;
  (* hierconn *) wire \u_dut.meta_q ;
  (* hierconn *) wire \u_dut.bit_q ;
  (* hierconn *) wire [14:0] \u_dut.frame_q ;
  (* hierconn *) wire \u_dut.parity_q ;
  (* hierconn *) wire [15:0] \u_dut.g_spi.command_q ;
  (* hierconn *) wire [1:0] \u_dut.g_spi.asked_q ;
  (* hierconn *) wire [1:0] \u_dut.g_spi.answer_q ;
  (* hierconn *) wire \u_dut.g_spi.flagged_q ;
  (* hierconn *) wire [1:0] \u_dut.g_spi.ill_q ;
  (* hierconn *) wire [13:0] \u_dut.turn_q ;
  (* hierconn *) wire [2:0] \u_dut.errors_q ;
  (* hierconn *) wire [3:0] \u_dut.kinds_q ;
  (* hierconn *) wire [4:0] \u_dut.equal_q ;
  (* hierconn *) wire \u_dut.moved_q ;
  (* hierconn *) wire [11:0] \u_dut.reach_q ;
  (* hierconn *) wire [7:0] \u_dut.step_q ;
  (* hierconn *) wire [7:0] \u_dut.before_q ;
  wire [1:0] state = \u_dut.state_q ;
  wire [3:0] count = \u_dut.wait_q ;
  wire [4:0] period = \u_dut.period_q ;
  wire ends = \u_dut.ends_q ;
  wire idle = state == 2'd0, leads = state == 2'd1, reads = state == 2'd2, rests = state == 2'd3;

  // Edges at the pins, and clocks since the last of each kind.
  logic high_q, selected_q, sample_q, busy_q, rise, fall, slot, data_q;
  logic [3:0] since_q, lead_q, quiet_q;
  logic [4:0] edges_q;
  assign rise = serial_clock && !high_q;
  assign fall = !serial_clock && high_q;
  // A bit is as its pin was in the last clock before the next rising edge, or where that would be after the last bit.
  assign slot = (rise && edges_q != '0) || (edges_q == 5'(Frame) && !serial_clock && !high_q && since_q == 4'(H));
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      {high_q, selected_q, sample_q, busy_q, data_q} <= '0;
      since_q <= '1;
      lead_q  <= '0;
      quiet_q <= '1;
      edges_q <= '0;
    end else begin
      high_q     <= serial_clock;
      selected_q <= !select_n;
      sample_q   <= sample_i;
      busy_q     <= busy;
      data_q     <= data_i;
      since_q    <= (rise || fall) ? 4'd1 : since_q + 4'(since_q != '1);
      lead_q     <= select_n ? 4'd0 : lead_q + 4'(lead_q != '1);
      quiet_q    <= !select_n ? 4'd0 : quiet_q + 4'(quiet_q != '1);
      if (select_n) edges_q <= '0;
      else if (rise) edges_q <= edges_q + 5'd1;
    end
  end

  // The bits of both pins; the command before this frame's.
  logic [14:0] pins_q;
  logic odd_q;
  logic [15:0] asked_q, answered_q;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      pins_q     <= '0;
      odd_q      <= 1'b0;
      asked_q    <= '0;
      answered_q <= '0;
    end else if (!busy && sample_i) begin
      odd_q      <= 1'b0;
      answered_q <= asked_q;
      asked_q    <= '0;
    end else begin
      if (slot) begin
        pins_q <= {pins_q[13:0], data_q};
        odd_q  <= odd_q ^ data_q;
      end
      if (fall) asked_q <= {asked_q[14:0], command};
    end
  end

  // What a frame means.
  logic lost, flag, far, wrong, good, ends_q, good_q, lost_q, began_q, stained_q;
  logic [13:0] step, step_q;
  logic signed [31:0] position_q;
  logic [2:0] row_q;
  logic [3:0] name, name_q;
  logic moved_q, frozen_q;
  logic [5:0] equal_q;
  logic [31:0] reach, reach_q;
  logic [13:0] moved_by, speed, last_q, before_q, sum_q;
  logic bad_once_q, unwell_q;  // the last diagnosis was bad; and the one before
  assign lost  = row_q == 3'(Errors);
  assign flag  = pins_q[14] && answered_q != Flags;
  assign step  = pins_q[13:0] - position[13:0];
  // Speed of the last two good steps, and a third of the fastest.
  assign moved_by = lost || $signed(step) >= Fastest || $signed(step) <= -Fastest ? 14'(Fastest) : step[13] ? -step : step;
  assign speed    = (last_q > before_q ? last_q : before_q) >= 14'(Fastest - 54) ? 14'(Fastest) : (last_q > before_q ? last_q : before_q) + 14'd54;
  assign reach    = sum_q < 14'd2048 ? 32'(sum_q) : 32'd2048;  // an eighth of a turn
  assign far   = answered_q == Angle && !lost && ($signed(step) > $signed(14'(reach)) || $signed(step) < -$signed(14'(reach)));
  assign wrong = odd_q || flag || far;
  assign good  = !wrong && answered_q == Angle;
  assign name  = odd_q ? 4'b0010 : flag ? 4'b0100 : 4'b1000;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      {ends_q, good_q, lost_q, moved_q, frozen_q, began_q, bad_once_q, unwell_q, stained_q} <= '0;
      row_q      <= 3'(Errors);
      name_q     <= 4'b0001;
      equal_q    <= '0;
      position_q <= '0;
      step_q     <= '0;
      sum_q      <= 14'(2 * Fastest);
      last_q     <= '0;
      before_q   <= '0;
      reach_q    <= '0;
    end else begin
      began_q    <= 1'b1;
      ends_q     <= ends;
      good_q     <= ends && good;
      lost_q     <= lost;
      position_q <= position;
      step_q     <= step;
      reach_q    <= reach;
      if (ends && good) begin
        sum_q      <= 14'(2 * Fastest);
        last_q     <= moved_by;
        before_q   <= last_q;
      end else if (ends && (odd_q || flag || answered_q != Angle)) sum_q <= sum_q < 14'd2048 ? sum_q + speed : sum_q;
      if (ends && !wrong && answered_q == Diagnosis) begin
        bad_once_q <= pins_q[11:8] != 4'b0001;
        unwell_q   <= pins_q[11:8] != 4'b0001 && (bad_once_q || unwell_q);
      end
      if (ends && good) begin
        row_q <= '0;
        if (step != '0 || lost) begin
          moved_q  <= !lost && ($signed(step) >= Step || $signed(step) <= -Step);
          equal_q  <= '0;
          frozen_q <= 1'b0;
        end else begin
          equal_q <= equal_q + 6'(equal_q != '1);
          if (moved_q && equal_q == 6'(Reads - 1)) frozen_q <= 1'b1;
        end
      end else if (ends && wrong) begin
        row_q  <= row_q + 3'(!lost);
        name_q <= name;
        stained_q <= 1'b1;
      end
    end
  end

  always_comb begin
    if (past_ok_q && rst_ni) begin
      begins_with_a_sample: assert (!(busy && !busy_q) || sample_q);
      clocked_while_selected: assert (!serial_clock || !select_n);
      half_clocks: assert (!(rise || fall) || edges_q == '0 || since_q == 4'(H));
      lead_before_the_clock: assert (!(rise && edges_q == '0) || lead_q >= 4'(G));
      gap_between_readings: assert (!(!select_n && !selected_q) || quiet_q >= 4'(G));
      whole_frames: assert (!(select_n && selected_q) || (edges_q == 5'(Frame) && !serial_clock && since_q >= 4'(H)));
      commands_are_known: assert (!(edges_q == 5'(Frame) && !serial_clock && !high_q) || asked_q == Angle || asked_q == Flags || asked_q == Diagnosis);
      flags_after_a_flag: assert (!((!busy || ends_q) && \u_dut.g_spi.flagged_q ) || (pins_q[14] && asked_q != Flags));
      bit_in_its_clock: assert (!(reads && period != '0 && count == 4'd3) || \u_dut.frame_q [0] == pins_q[0]);
      valid_if_good: assert (valid == good_q);
      position_of_the_pins: assert (!valid || position[13:0] == pins_q[13:0]);
      position_by_the_step: assert (!valid || position == position_q + 32'($signed(step_q)));
      position_is_held: assert (!began_q || valid || position == position_q);
      jumps_only_when_lost: assert (!valid || lost_q || (position - position_q <= $signed(reach_q) && position - position_q >= -$signed(reach_q)));
      lost_after_errors: assert ({faults[3], faults[1:0]} == ({3{lost}} & {name_q[3], name_q[1:0]}));
      starts_until_wrong: assert (starts == !stained_q);
      unwell_or_flagged: assert (faults[2] == (unwell_q || (lost && name_q[2])));
      frozen_after_a_motion: assert (faults[4] == frozen_q);
      clocks: cover (rise);
      commands: cover (fall && command);
    end
  end

  // Where the pins are, by the block's counters.
  logic [4:0] shifts, falls, bits;
  logic at_a_bit;  // the pin's bit is collected, and not taken yet
  logic [15:0] word, answer;
  logic [1:0] asked_kind, answer_kind;
  assign asked_kind = \u_dut.g_spi.asked_q ;
  assign answer_kind = \u_dut.g_spi.answer_q ;
  assign word   = asked_kind == 2'd1 ? Angle : asked_kind == 2'd2 ? Diagnosis : asked_kind == 2'd3 ? Flags : 16'd0;
  assign answer = answer_kind == 2'd1 ? Angle : answer_kind == 2'd2 ? Diagnosis : answer_kind == 2'd3 ? Flags : 16'd0;
  assign shifts = period == 5'(Frame) ? 5'd15 : period == '0 ? 5'd0 : period - 5'(count == '0);
  assign falls  = period == 5'(Frame) ? 5'(Frame) : period + 5'(count > 4'(H + 1));
  assign at_a_bit = reads && period != '0 && count == 4'd2;
  assign bits   = period == '0 ? 5'd0 : period - 5'(count <= 4'd2);
  always_comb begin
    if (past_ok_q && rst_ni) begin
      inside_busy: assert (busy == !idle && (began_q || idle));
      inside_counts: assert (reads ? count < 4'(2 * H) : idle ? count <= 4'(G) : count < 4'(G));
      inside_period: assert (!reads || period < 5'(Frame) || (period == 5'(Frame) && count <= 4'd2));
      inside_take_at: assert (\u_dut.take_at_q == 4'd2 && !\u_dut.missing_q );
      inside_bits: assert (!reads || (\u_dut.bits_q == bits && !\u_dut.taken_q ));
      inside_ends: assert (!ends || (rests && count == '0));
      inside_select: assert (select_n == !(reads || (leads && count != '0) || (rests && count == '0)));
      inside_selected: assert (selected_q == (reads || (leads && count > 4'd1) || (rests && count <= 4'd1)) );
      inside_leads: assert ((!leads || lead_q == (count == '0 ? 4'd0 : count - 4'd1)) && (!(reads && period == '0) || lead_q == 4'(G - 1) + count));
      inside_quiet: assert (!idle || (count == '0 || count == 4'(G)) && quiet_q >= 4'(G) - 4'(count != '0));
      inside_quiet_gap: assert (!rests || quiet_q == (count <= 4'd1 ? 4'd0 : count - 4'd1));
      inside_quiet_lead: assert (!(leads && count == '0) || quiet_q >= 4'(G));
      inside_serial: assert (serial_clock == (reads && period < 5'(Frame) && count >= 4'd1 && count <= 4'(H)));
      inside_high: assert (high_q == (reads && period < 5'(Frame) && count >= 4'd2 && count <= 4'(H + 1)));
      inside_edges: assert (edges_q == (reads ? period + 5'(period < 5'(Frame) && count >= 4'd2) :
                                        rests && count <= 4'd1 ? 5'(Frame) : 5'd0));
      inside_since: assert (!reads || (period == '0 && count <= 4'd1) ||
                            since_q == (count <= 4'd1 ? 4'(H - 1) + count :
                                        period == 5'(Frame) ? 4'(H - 1) + count :
                                        count <= 4'(H + 1) ? count - 4'd1 : count - 4'(H + 1)));
      inside_since_gap: assert (!(rests && count <= 4'd1) || since_q == 4'(H + 2) + count);
      inside_frame: assert (!at_a_bit || (((pins_q ^ {\u_dut.frame_q [13:0], \u_dut.bit_q }) & ~(15'h7fff << (bits + 5'd1))) == '0 &&
                            odd_q == (\u_dut.parity_q ^ \u_dut.bit_q )));
      inside_frame_else: assert (at_a_bit || !reads || ((pins_q ^ \u_dut.frame_q ) & ~(15'h7fff << bits)) == '0);
      inside_frame_ended: assert (!(rests || idle) || asked_kind == 2'd0 || pins_q == \u_dut.frame_q );
      inside_parity: assert (!(reads || rests) || at_a_bit || odd_q == \u_dut.parity_q );
      inside_odd: assert (!leads || !odd_q);
      inside_data: assert (!began_q || data_q == \u_dut.meta_q );
      inside_asked: assert (asked_kind != 2'd0 || (idle && answer_kind == 2'd0));
      inside_word: assert (asked_q == (leads ? 16'd0 : reads ? word >> (5'd16 - falls) : word));
      inside_command: assert (!(leads || reads) || \u_dut.g_spi.command_q == (leads ? word : word << shifts));
      inside_answer: assert (idle || answered_q == answer);
      inside_flagged: assert (!(idle || (rests && count != '0)) || asked_kind == 2'd0 ||
                              \u_dut.g_spi.flagged_q == (pins_q[14] && asked_kind != 2'd3));
      inside_none: assert (asked_kind != 2'd0 || !\u_dut.g_spi.flagged_q );
      inside_turn: assert (position[13:0] == \u_dut.turn_q );
      inside_ill: assert (\u_dut.g_spi.ill_q == (unwell_q ? 2'd2 : 2'(bad_once_q)) && (bad_once_q || !unwell_q));
      inside_reach: assert (lost || \u_dut.reach_q == 12'(reach));
      inside_sum: assert (sum_q < 14'd2048 + 14'(Fastest));
      inside_steps: assert (14'(\u_dut.step_q ) == last_q && 14'(\u_dut.before_q ) == before_q && last_q <= 14'(Fastest) && before_q <= 14'(Fastest));
      inside_row: assert (row_q == \u_dut.errors_q && row_q <= 3'(Errors));
      inside_name: assert (name_q == \u_dut.kinds_q );
      inside_moved: assert (\u_dut.moved_q == (moved_q && equal_q < 6'(Reads)));
      inside_frozen: assert (faults[4] == (moved_q && equal_q >= 6'(Reads)));
      inside_equal: assert (!\u_dut.moved_q || {1'b0, \u_dut.equal_q } == equal_q);
      inside_ends_q: assert (!(ends_q || good_q) || (rests && count == 4'd1));
    end
  end
endmodule

`default_nettype wire
