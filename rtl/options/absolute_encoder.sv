// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Reads an absolute encoder: SPI with parity (AS5048A, AS5047) or SSI with CRC-6 (MT6701). It checks
// each reading, counts whole turns, and names what is wrong. valid_o one clock after that of
// serial_frame. docs/blocks/absolute_encoder.md

`default_nettype none

module absolute_encoder #(
    parameter int Framing     = 0,      // 0 SPI with parity, 1 SSI with CRC-6
    parameter int Bits        = 14,     // of a turn; SPI: 14
    parameter int HalfClocks  = 5,      // half a serial clock
    parameter int GapClocks   = 20,     // from the select to the serial clock, and between two readings at least
    parameter int Errors      = 4,      // wrong readings in a row that are a fault
    parameter int FrozenStep  = 4,      // counts between two readings that are a motion
    parameter int FrozenReads = 16,     // equal readings after a motion that are a fault
    parameter int JumpStep    = 160,    // counts of the fastest motion from one reading to the next
    parameter int DiagAddress = 'h3ffc, // SPI: register of the diagnosis
    parameter int DiagLog2    = 4       // SPI: it is read once in 2^DiagLog2 readings
) (
    input  logic               clk_i,
    input  logic               rst_ni,
    input  logic               sample_i,        // begins a reading; ignored in one
    output logic               select_no,
    output logic               serial_clock_o,
    output logic               command_o,       // SPI
    input  logic               data_i,
    output logic signed [31:0] position_o,      // counts of 2^-Bits turn; wraps
    output logic               valid_o,         // one clock: position_o is of a new reading
    output logic               unblemished_o,   // no reading was wrong since the reset
    output logic        [ 4:0] faults_o         // 0 missing, 1 check, 2 sensor, 3 jump, 4 frozen
);
  localparam bit Spi = Framing == 0;
  localparam int FrameBits = Spi ? 16 : Bits + 10;
  localparam int Eighth = 2 ** (Bits - 3);  // of a turn
  typedef enum logic [1:0] {Nothing, Angle, Diagnosis, Flags} kind_t;  // SPI: of a frame; reading flags clears them
  generate
  if (!((Framing == 0 || Framing == 1) && Bits >= 12 && Bits <= 22 && (!Spi || Bits == 14) && HalfClocks >= 4 && GapClocks >= 4 &&
        JumpStep >= 1 && JumpStep <= Eighth)) begin : g_check
    a_parameter_is_out_of_its_range missing ();
  end
  endgenerate

  logic [FrameBits-1:0] frame, command;
  logic idle, begins, ends, odd, crc_wrong;
  assign begins = sample_i && idle;
  serial_frame #(.FrameBits(FrameBits), .HalfClocks(HalfClocks), .GapClocks(GapClocks)) u_serial_frame (
      .clk_i(clk_i), .rst_ni(rst_ni), .start_i(sample_i), .idle_o(idle), .command_i(command), .select_no(select_no),
      .serial_clock_o(serial_clock_o), .command_o(command_o), .data_i(data_i), .frame_o(frame), .odd_o(odd),
      .crc_wrong_o(crc_wrong), .valid_o(ends)
  );

  // What a frame says.
  logic wrong, bad, unwell, is_angle;
  logic [Bits-1:0] angle;
  generate
  if (Spi) begin : g_spi
    // A frame answers the command of the one before. Commands: even parity, read, address.
    localparam logic [13:0] DiagRegister = 14'(DiagAddress);
    kind_t asked_q, answer_q, asks;  // in this frame; by the frame before
    logic [DiagLog2-1:0] readings_q;
    logic flagged_q;                 // the last frame had the error flag
    logic [1:0] ill_q;               // diagnoses in a row that say the angle cannot be trusted
    assign angle    = frame[13:0];
    assign wrong    = odd;
    assign bad      = frame[14] && answer_q != Flags;
    assign unwell   = ill_q == 2'd2;
    assign is_angle = answer_q == Angle;
    always_comb begin
      asks    = Angle;
      command = {1'b1, 1'b1, 14'h3fff};
      if (flagged_q) begin
        asks    = Flags;
        command = {1'b0, 1'b1, 14'h0001};
      end else if (readings_q == '0 || ill_q == 2'd1) begin  // a bad one is asked for again
        asks    = Diagnosis;
        command = {~^DiagRegister, 1'b1, DiagRegister};
      end
    end
    always_ff @(posedge clk_i or negedge rst_ni) begin
      if (!rst_ni) begin
        {readings_q, flagged_q, ill_q} <= '0;
        asked_q  <= Nothing;
        answer_q <= Nothing;
      end else begin
        if (begins) begin
          readings_q <= readings_q + 1'b1;
          answer_q   <= asked_q;
          asked_q    <= asks;
        end
        if (ends) flagged_q <= frame[14] && asked_q != Flags;
        // Bit 8: the offset is compensated. Bits 9 to 11: overflow, field too strong, too weak.
        if (ends && !wrong && !bad && answer_q == Diagnosis)
          ill_q <= frame[11:8] == 4'b0001 ? 2'd0 : unwell ? ill_q : ill_q + 1'b1;
      end
    end
  end else begin : g_ssi
    assign command  = '0;
    assign angle    = frame[10+:Bits];
    assign wrong    = crc_wrong;
    assign bad      = frame[9] || frame[7:6] != 2'd0;  // track lost; field too strong or too weak
    assign unwell   = 1'b0;
    assign is_angle = 1'b1;
  end
  endgenerate

  // Each good angle moves the position by what it differs from the last one.
  localparam int ReachW = Bits - 2;
  localparam int ErrorW = $clog2(Errors + 1);
  localparam int FrozenW = $clog2(FrozenReads + 1);
  logic [Bits-1:0] turn_q, step, size;
  logic [ReachW-1:0] reach_q;  // counts by which the next good angle may differ
  logic [ErrorW-1:0] errors_q;
  logic [3:0] kinds_q;
  logic [FrozenW-1:0] equal_q;
  logic moved_q, frozen_q, jumps, fails, good, lost;
  assign step     = angle - turn_q;
  assign size     = step[Bits-1] ? -step : step;
  assign lost     = errors_q == ErrorW'(Errors);
  assign jumps    = is_angle && size > Bits'(reach_q) && !lost;
  assign fails    = ends && (wrong || bad || jumps);
  assign good     = ends && is_angle && !fails;
  assign faults_o = {frozen_q, (lost ? kinds_q : 4'd0) | {1'b0, unwell, 2'b00}};
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      {position_o, valid_o, turn_q, moved_q, equal_q, frozen_q} <= '0;
      errors_q      <= ErrorW'(Errors);  // nothing is known before the first reading
      kinds_q       <= 4'b0001;
      unblemished_o <= 1'b1;
    end else begin
      valid_o <= good;
      if (fails) begin
        unblemished_o <= 1'b0;
        kinds_q       <= wrong ? 4'b0010 : bad ? 4'b0100 : 4'b1000;
        if (!lost) errors_q <= errors_q + 1'b1;
      end
      if (good) begin
        position_o <= position_o + 32'($signed(step));
        turn_q     <= angle;
        errors_q   <= '0;
        if (step != '0 || lost) begin
          moved_q  <= !lost && size >= Bits'(FrozenStep);
          equal_q  <= '0;
          frozen_q <= 1'b0;
        end else if (moved_q) begin
          equal_q <= equal_q + 1'b1;
          if (equal_q == FrozenW'(FrozenReads - 1)) begin
            moved_q  <= 1'b0;
            frozen_q <= 1'b1;
          end
        end
      end
    end
  end

  // The reach is the largest step that a shaft can make since the last good reading. It is that of two readings at least,
  // because the angle of a sensor that samples by itself may be one reading old. Each reading left out since then adds the
  // larger of the last two steps and a third of the fastest, more than a shaft can accelerate in a reading. A reading that
  // jumped adds nothing, so an angle that stays where it jumped to is a fault.
  localparam int Gain = (JumpStep + 2) / 3;
  localparam int StepW = $clog2(JumpStep + 1);
  logic [StepW-1:0] step_q, before_q, larger, pace;
  assign larger = step_q > before_q ? step_q : before_q;
  assign pace   = larger > StepW'(JumpStep - Gain) ? StepW'(JumpStep) : larger + StepW'(Gain);
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      {reach_q, step_q, before_q} <= '0;  // the first reading is any
    end else if (good) begin
      reach_q  <= 2 * JumpStep < Eighth ? ReachW'(2 * JumpStep) : ReachW'(Eighth);
      step_q   <= lost || size > Bits'(JumpStep) ? StepW'(JumpStep) : StepW'(size);
      before_q <= step_q;
    end else if (ends && (wrong || bad || !is_angle)) begin
      reach_q <= reach_q > ReachW'(Eighth) - ReachW'(pace) ? ReachW'(Eighth) : reach_q + ReachW'(pace);
    end
  end
endmodule

`default_nettype wire
