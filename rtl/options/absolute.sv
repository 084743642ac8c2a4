// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Encoder socket: an absolute encoder, read once in ABSOLUTE_PERIOD ticks. The count follows every
// good reading. The first good reading after a fault moves the count but not the travel, because the
// shaft has not moved by that step. docs/blocks/absolute_encoder.md

`default_nettype none

module absolute (
    input  logic           clk_i,
    input  logic           rst_ni,
    input  logic           data_i,         // asynchronous pin of the sensor
    output logic           select_no,      // pins to it
    output logic           serial_clock_o,
    output logic           command_o,
    input  cfg::encoder_t  encoder_i,
    output cfg::position_t position_o
);
  localparam int PeriodW = $clog2(cfg::ABSOLUTE_PERIOD + 1);
  logic [PeriodW-1:0] wait_q;  // ticks to the next reading
  logic begins, valid, unblemished;
  logic signed [31:0] reading;
  logic [4:0] faults;
  assign begins = encoder_i.sample && wait_q == '0;
  absolute_encoder #(
      .Framing(cfg::ABSOLUTE_FRAMING), .Bits(cfg::ABSOLUTE_BITS), .HalfClocks(cfg::ABSOLUTE_HALF_CLOCKS),
      .GapClocks(cfg::ABSOLUTE_GAP_CLOCKS), .JumpStep(cfg::ABSOLUTE_JUMP_STEP), .DiagAddress(cfg::ABSOLUTE_DIAGNOSIS)
  ) u_absolute_encoder (
      .clk_i(clk_i), .rst_ni(rst_ni), .sample_i(begins), .select_no(select_no), .serial_clock_o(serial_clock_o),
      .command_o(command_o), .data_i(data_i), .position_o(reading), .valid_o(valid), .unblemished_o(unblemished),
      .faults_o(faults)
  );

  logic signed [31:0] last_q, count_q, zero_q, change, place_q;
  logic signed [15:0] travel_q;
  logic known_q;              // there was a reading
  logic found, changed_q, moved_q, starts;
  logic [4:0] faults_q, seen_q, why;
  assign change = encoder_i.polarity ? last_q - reading : reading - last_q;
  assign found  = faults_q != '0;  // this reading ends a fault

  // seen_q keeps the reasons that closed the gates until the faults are cleared. It keeps a jump also while
  // the gates are closed, because the angle may stay wrong after a jump. Before its first good reading a
  // sensor is starting, or is missing.
  localparam logic [4:0] Jump = 5'(1 << map::ABSOLUTE_JUMP_BIT);
  assign starts = !known_q && unblemished;
  always_comb begin
    why = faults | seen_q;
    if (!known_q) why[0] = !starts;
  end

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      {wait_q, seen_q, last_q, count_q, zero_q, place_q, travel_q, changed_q, moved_q, known_q} <= '0;
      faults_q <= '1;
    end else begin
      faults_q <= faults;
      seen_q   <= encoder_i.clear ? '0 : seen_q | (encoder_i.gates_enable ? faults : faults & Jump);
      place_q  <= count_q - zero_q;
      if (encoder_i.set_zero) zero_q <= count_q;
      if (encoder_i.sample) begin
        wait_q    <= begins ? PeriodW'(cfg::ABSOLUTE_PERIOD - 1) : wait_q - 1'b1;
        moved_q   <= changed_q;
        changed_q <= 1'b0;
      end
      if (valid) begin
        known_q <= 1'b1;
        last_q  <= reading;
        count_q <= count_q + change;
        if (!found) travel_q <= travel_q + 16'(change);
        if (change != '0) changed_q <= 1'b1;
      end
    end
  end

  always_comb begin
    position_o = '0;  // it has no edges and no index
    position_o.position       = place_q;
    position_o.count          = count_q;
    position_o.travel         = travel_q;
    position_o.moved          = moved_q;
    position_o.polarity_holds = known_q;  // the count began with a polarity
    position_o.why            = {starts, why};
  end
endmodule

`default_nettype wire
