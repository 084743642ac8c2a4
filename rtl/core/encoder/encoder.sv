// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Room: encoder pins to position, with the checks of the encoder. With the option ABSOLUTE_ENCODER the position is that of
// an absolute encoder's serial lines (docs/blocks/absolute_encoder.md), and A, B and Z are not used. With the option HALL
// three lines of the motor say where its electrical angle begins (docs/blocks/three_phase.md).
// Timing: the wave samples the position in EVENT_AT_SAMPLE; an absolute encoder's reading begins there. docs/architecture.md

`default_nettype none

module encoder (
    input  logic                                             clk_i,
    input  logic                                             rst_ni,
    input  logic        [ feltgate_map_pkg::WAVE_LENGTH-1:0] wave_i,
    input  logic        [                              31:0] tick_count_i,
    input  logic        [                              31:0] param_i,
    input  logic                                             enc_a_i,
    input  logic                                             enc_b_i,
    input  logic                                             enc_z_i,
    input  logic                                             encoder_data_i,   // of an absolute encoder
    input  logic        [                               2:0] hall_i,           // Hall lines of the motor
    output logic                                             encoder_select_no,
    output logic                                             encoder_clock_o,
    output logic                                             encoder_command_o,
    input  logic        [   feltgate_map_pkg::W_CONTROL-1:0] control_i,
    input  logic                                             set_zero_i,        // the position becomes 0
    input  logic                                             clear_i,           // clears errors and index evidence
    output logic signed [                              31:0] position_o,        // counts; sampled, wraps
    output logic signed [feltgate_pkg::SCENE_POSITION_W-1:0] scene_position_o,  // the same, saturated
    output logic signed [     feltgate_pkg::TRAVEL_BITS-1:0] travel_o,          // counts, live: its readers sample it; never zeroed, wraps
    output logic signed [                              31:0] count_o,           // counts, live, whatever the zero; an absolute encoder's angle, plus turns
    output logic                                             moved_o,           // an edge since the tick before
    output logic                                             chatters_o,        // edges on one channel only
    output logic                                             illegal_o,         // one clock: both channels changed
    output logic                                             error_o,           // sticky: an illegal edge was seen
    output logic        [                              15:0] error_count_o,
    output logic        [                              15:0] rejected_count_o,
    output logic signed [                              31:0] index_position_o,  // counts at the last index
    output logic        [feltgate_map_pkg::W_STATUS_LIMITS-1:0] limits_o,        // bit n: limit n acted
    input  logic                                             gates_enable_i,
    output logic                                             polarity_holds_o,  // an absolute encoder has given its first reading
    output logic        [feltgate_map_pkg::W_FAULTS_ABSOLUTE-1:0] absolute_state_o,  // why an absolute encoder or Hall lines are not to be relied on
    output logic        [                              31:0] hall_angle_o,      // electrical, 2^-32 turn, with Hall lines
    output logic        [feltgate_map_pkg::W_FAULTS_SEEN-1:0] trips_o            // bit n: cause n
);
  localparam int SceneW = feltgate_pkg::SCENE_POSITION_W;
  localparam int FaultsW = feltgate_map_pkg::W_FAULTS_SEEN;

  localparam bit Edges = feltgate_pkg::ABSOLUTE_ENCODER == 0;  // the encoder is incremental

  logic polarity;
  assign polarity = control_i[feltgate_map_pkg::B_CONTROL_ENCODER_POLARITY];
  logic signed [31:0] position, decoded, count, zero;
  logic [15:0] travel;
  logic signed [1:0] step;
  logic [1:0] levels;
  logic unused_index_seen, index_wrong, channel_trip, index_trip, flip_trip, position_over, edge_moved;

  quad_decoder #(.IndexCounts(feltgate_pkg::INDEX_COUNTS)) u_quad_decoder (
      .clk_i(clk_i), .rst_ni(rst_ni),
      .a_i(Edges && enc_a_i), .b_i(Edges && enc_b_i), .z_i(Edges && enc_z_i),
      .filter_i(control_i[feltgate_map_pkg::B_CONTROL_FILTER+:feltgate_map_pkg::W_CONTROL_FILTER]),
      .polarity_i(polarity),
      .set_zero_i(set_zero_i),
      .clear_error_i(clear_i),
      .position_o(decoded), .travel_o(travel),
      .step_o(step), .count_o(count), .zero_o(zero),
      .levels_o(levels), .illegal_o(illegal_o),
      .error_o(error_o),
      .error_count_o(error_count_o), .rejected_count_o(rejected_count_o),
      .index_position_o(index_position_o),
      .index_seen_o(unused_index_seen), .index_wrong_o(index_wrong)
  );

  encoder_monitor #(.EdgeBits(feltgate_pkg::EDGE_UNIT_BITS), .Fast(feltgate_pkg::FAST_EDGES)) u_encoder_monitor (
      .clk_i(clk_i), .rst_ni(rst_ni),
      .at_levels_i(wave_i[feltgate_map_pkg::EVENT_AT_LEVELS]), .tick_count_i(tick_count_i),
      .levels_i(levels), .index_wrong_i(index_wrong),
      .count_i(count), .zero_i(zero), .step_i(step), .set_zero_i(set_zero_i),
      .moved_o(edge_moved), .chatters_o(chatters_o),
      .trip_o(channel_trip), .index_trip_o(index_trip), .flip_trip_o(flip_trip)
  );

  generate
  if (Edges) begin : g_edges
    assign position          = decoded;
    assign travel_o          = travel;
    assign count_o           = count;
    assign moved_o           = edge_moved;
    assign encoder_select_no = 1'b1;
    assign polarity_holds_o  = 1'b0;
    assign encoder_clock_o   = 1'b0;
    assign encoder_command_o = 1'b0;
    logic unused_serial;
    assign unused_serial = encoder_data_i;
    if (feltgate_pkg::HALL == 0) begin : g_no_hall
      assign absolute_state_o = '0;
      assign hall_angle_o     = '0;
      logic unused_hall;
      assign unused_hall = ^{hall_i, param_i};
    end else begin : g_hall
      logic [31:0] gain_q;  // of the angle
      logic [2:0] faults;
      logic waits, unused_exact;
      always_ff @(posedge clk_i or negedge rst_ni) begin
        if (!rst_ni) gain_q <= '0;
        else if (wave_i[feltgate_map_pkg::PARAM_AT_COMMUTATION_GAIN]) gain_q <= param_i;
      end
      hall_sensor u_hall_sensor (
          .clk_i(clk_i), .rst_ni(rst_ni), .hall_i(hall_i), .count_i(count[1:0]), .gain_i(gain_q),
          .gates_enable_i(gates_enable_i), .clear_i(clear_i), .angle_o(hall_angle_o), .exact_o(unused_exact),
          .faults_o(faults), .waits_o(waits)
      );
      assign absolute_state_o = {waits, 1'b0, faults[2], 1'b0, faults[1:0]};
    end
  end else begin : g_absolute
    localparam int PeriodW = $clog2(feltgate_pkg::ABSOLUTE_PERIOD + 1);
    logic [PeriodW-1:0] wait_q;  // ticks to the next reading
    logic [4:0] faults, faults_q, seen_q;
    logic signed [31:0] angle, last_q, count_q, zero_q, change;
    logic begins, valid, unused_busy, unblemished, starts, changed_q, waits_q;

    assign begins = wave_i[feltgate_map_pkg::EVENT_AT_SAMPLE] && wait_q == '0;
    absolute_encoder #(
        .Framing(feltgate_pkg::ABSOLUTE_FRAMING), .Bits(feltgate_pkg::ABSOLUTE_BITS),
        .HalfClocks(feltgate_pkg::ABSOLUTE_HALF_CLOCKS), .GapClocks(feltgate_pkg::ABSOLUTE_GAP_CLOCKS),
        .JumpStep(feltgate_pkg::ABSOLUTE_JUMP_STEP), .DiagAddress(feltgate_pkg::ABSOLUTE_DIAGNOSIS)
    ) u_absolute_encoder (
        .clk_i(clk_i), .rst_ni(rst_ni), .sample_i(begins), .data_i(encoder_data_i),
        .select_no(encoder_select_no), .serial_clock_o(encoder_clock_o), .command_o(encoder_command_o),
        .position_o(angle), .valid_o(valid), .busy_o(unused_busy), .starts_o(unblemished), .faults_o(faults)
    );
    // What a reading says. found: it ends a fault.
    logic signed [31:0] reading;
    logic reads, found;
    if (feltgate_pkg::ABSOLUTE_TABLE == 0) begin : g_as_read
      assign reading = angle;
      assign reads   = valid;
      assign found   = faults_q != '0;
    end else begin : g_corrected
      // Interpolates between two corrections c of the table, bit by bit of the part p of n bits between them:
      // c0 (2^n - p) + c1 p = c0 + the sum of 2^k c(bit k of p). It begins with half a count, so the sum's top bits are rounded.
      localparam int SegmentW = feltgate_map_pkg::ABSOLUTE_SEGMENT_BITS;
      localparam int BelowW = feltgate_map_pkg::ABSOLUTE_ENTRY_BITS - SegmentW;  // bits below a count
      localparam int PartW = feltgate_pkg::ABSOLUTE_BITS - SegmentW;
      localparam int SumW = 17 + PartW;
      localparam int StepW = $clog2(PartW + 5);
      logic [15:0] corrections [0:(1<<SegmentW)-1];
      initial for (int i = 0; i < (1 << SegmentW); i++) corrections[i] = feltgate_pkg::absolute_correction(SegmentW'(i));
      logic [StepW-1:0] step_q;  // 0: rests
      logic [PartW-1:0] part_q;
      logic [SegmentW-1:0] segment_q;
      logic signed [15:0] entry_q;
      logic signed [SumW-1:0] sum_q;
      logic found_q;
      always_ff @(posedge clk_i) entry_q <= corrections[segment_q + SegmentW'(part_q[PartW-1])];
      always_ff @(posedge clk_i or negedge rst_ni) begin
        if (!rst_ni) begin
          step_q    <= '0;
          part_q    <= '0;
          segment_q <= '0;
          sum_q     <= '0;
          found_q   <= 1'b0;
          reading   <= '0;
          reads     <= 1'b0;
        end else begin
          reads <= step_q == StepW'(1);
          if (valid) begin
            step_q    <= StepW'(PartW + 3);
            segment_q <= angle[feltgate_pkg::ABSOLUTE_BITS-1-:SegmentW];
            part_q    <= angle[PartW-1:0];
            found_q   <= faults_q != '0;
          end else if (step_q != '0) begin
            step_q <= step_q - 1'b1;
            part_q <= part_q << 1;  // at the end zeros: c0 alone
          end
          if (step_q == StepW'(PartW + 3)) sum_q <= SumW'(1) <<< (BelowW - 1 - PartW);
          else if (step_q > StepW'(2)) sum_q <= (sum_q <<< 1) + SumW'(entry_q);
          else if (step_q == StepW'(2)) sum_q <= sum_q + SumW'(entry_q);
          reading <= angle + 32'($signed(sum_q[SumW-1:BelowW]));
        end
      end
      assign found = found_q;
    end

    // waits_q: no reading yet. starts: nor a wrong one; else the sensor is missing. seen_q: what closed the gates, until
    // the faults are cleared; a jump also while they are closed, since the angle may be wrong for ever after it.
    assign polarity_holds_o = !waits_q;
    localparam logic [4:0] Jump = 5'(1 << feltgate_map_pkg::ABSOLUTE_JUMP_BIT);
    assign starts = waits_q && unblemished;
    logic [4:0] told;
    assign told = ((faults | seen_q) & {4'b1111, !starts}) | {4'b0000, waits_q && !starts};
    assign absolute_state_o = {starts, told};

    assign count_o = count_q;

    // The count follows every good reading. The travel does not follow one that ends a fault: an angle that was found
    // again is no motion. moved_o: a reading since the tick before differs.
    assign change = polarity ? last_q - reading : reading - last_q;
    always_ff @(posedge clk_i or negedge rst_ni) begin
      if (!rst_ni) begin
        wait_q    <= '0;
        faults_q  <= '1;
        seen_q    <= '0;
        last_q    <= '0;
        count_q   <= '0;
        zero_q    <= '0;
        position  <= '0;
        travel_o  <= '0;
        changed_q <= 1'b0;
        moved_o   <= 1'b0;
        waits_q   <= 1'b1;
      end else begin
        if (wave_i[feltgate_map_pkg::EVENT_AT_SAMPLE])
          wait_q <= begins ? PeriodW'(feltgate_pkg::ABSOLUTE_PERIOD - 1) : wait_q - 1'b1;
        faults_q <= faults;
        if (clear_i) seen_q <= '0;
        else seen_q <= seen_q | (gates_enable_i ? faults : faults & Jump);
        position <= count_q - zero_q;
        if (set_zero_i) zero_q <= count_q;
        if (wave_i[feltgate_map_pkg::EVENT_AT_LEVELS]) begin
          moved_o   <= changed_q;
          changed_q <= 1'b0;
        end
        if (reads) begin
          last_q  <= reading;
          waits_q <= 1'b0;
          count_q <= count_q + change;
          if (!found) travel_o <= travel_o + feltgate_pkg::TRAVEL_BITS'(change);
          if (change != '0) changed_q <= 1'b1;
        end
      end
    end
    assign hall_angle_o = '0;
    logic unused_edges;
    assign unused_edges = ^{decoded, travel, edge_moved, hall_i, param_i};
  end
  endgenerate

  assign position_over = position[31:SceneW-1] != {(33 - SceneW) {position[31]}};
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      position_o       <= '0;
      scene_position_o <= '0;
    end else if (wave_i[feltgate_map_pkg::EVENT_AT_SAMPLE]) begin
      position_o       <= position;
      scene_position_o <= position_over ? {position[31], {(SceneW - 1) {~position[31]}}} : position[SceneW-1:0];
    end
  end

  assign limits_o = feltgate_map_pkg::W_STATUS_LIMITS'(chatters_o) << feltgate_map_pkg::L_CHATTER;
  assign trips_o = (FaultsW'(channel_trip) << feltgate_map_pkg::FAULT_CHANNEL) |
                   (FaultsW'(index_trip) << feltgate_map_pkg::FAULT_INDEX) |
                   (FaultsW'(gates_enable_i && absolute_state_o != '0) << feltgate_map_pkg::FAULT_ENCODER) |
                   (FaultsW'(flip_trip) << feltgate_map_pkg::FAULT_WORD);

  logic unused;
  assign unused = ^{wave_i, control_i};  // a room takes its own clocks of the wave and its own fields of the control word
endmodule

`default_nettype wire
