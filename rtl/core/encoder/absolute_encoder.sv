// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Reads an absolute encoder over its serial lines: SPI with parity (AS5048A, AS5047), SSI with CRC-6 (MT6701) or BiSS-C.
// It checks each reading, counts whole turns, and names what is wrong. Timing: valid_o comes 2 clocks after the frame's last bit;
// SPI and SSI: 2 * HalfClocks * frame + GapClocks + 5 clocks after sample_i. Format: position in counts of 2^-Bits turn.
// docs/blocks/absolute_encoder.md

`default_nettype none

module absolute_encoder #(
    parameter int Framing     = 0,      // 0 SPI with parity, 1 SSI with CRC-6, 2 BiSS-C
    parameter int Bits        = 14,     // of a turn; SPI: 14
    parameter int HalfClocks  = 5,      // half a serial clock
    parameter int GapClocks   = 20,     // from the select to the serial clock, and between two readings at least
    parameter int AckClocks   = 64,     // BiSS-C: serial clocks in which the data must begin
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
    output logic               select_no,       // SPI, SSI: of the sensor, active low
    output logic               serial_clock_o,
    output logic               command_o,       // SPI: data to the sensor
    input  logic               data_i,          // of the sensor
    output logic signed [31:0] position_o,      // counts; wraps
    output logic               valid_o,         // one clock: position_o is of a new reading
    output logic               busy_o,
  output logic               starts_o,        // no reading was wrong since the reset
    output logic        [ 4:0] faults_o         // 0 missing, 1 check, 2 sensor, 3 jump, 4 frozen
);
  localparam bit Spi = Framing == 0;
  localparam bit Biss = Framing == 2;
  localparam int FrameBits = Spi ? 16 : Biss ? Bits + 9 : Bits + 10;
  localparam int FrameW = Framing == 1 ? FrameBits : FrameBits - 1;  // the first bit is a parity, or says nothing
  localparam int Below = Spi ? 0 : Biss ? 8 : 10;  // bits after the position
  localparam int WaitW = $clog2((GapClocks > 2 * HalfClocks ? GapClocks : 2 * HalfClocks) + 1);
  localparam int PeriodW = $clog2((AckClocks > FrameBits ? AckClocks : FrameBits) + 1);
  localparam int BitW = $clog2(FrameBits + 1);
  localparam int ErrorW = $clog2(Errors + 1);
  localparam int FrozenW = $clog2(FrozenReads + 1);
  localparam int Eighth = 2 ** (Bits - 3);  // of a turn
  localparam int ReachW = Bits - 2;

  generate
  if (!(Framing >= 0 && Framing <= 2 && Bits >= 12 && Bits <= 24 && (!Spi || Bits == 14) && HalfClocks >= 4 && GapClocks >= 4 &&
        AckClocks >= 4 && Errors >= 1 && FrozenStep >= 1 && FrozenStep < 2 ** (Bits - 3) && FrozenReads >= 2 &&
        JumpStep >= 1 && JumpStep <= Eighth && DiagLog2 >= 1)) begin : g_check
    a_parameter_is_out_of_its_range missing ();
  end
  endgenerate

  typedef enum logic [1:0] {
    Idle = 2'd0,
    Lead = 2'd1,  // selected, before the first serial clock
    Read = 2'd2,
    Gap  = 2'd3   // not selected
  } state_e;
  typedef enum logic [1:0] {
    Nothing   = 2'd0,  // SPI: what a frame answers
    Angle     = 2'd1,
    Diagnosis = 2'd2,
    Flags     = 2'd3   // reading them clears them
  } kind_e;

  logic meta_q, bit_q;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      meta_q <= 1'b0;
      bit_q  <= 1'b0;
    end else begin
      meta_q <= data_i;
      bit_q  <= meta_q;
    end
  end

  // Clocks of a reading. wait_q counts the clocks of Lead and Gap, and those of a serial clock in Read.
  state_e               state_q;
  logic [    WaitW-1:0] wait_q, take_at_q;
  logic [  PeriodW-1:0] period_q;           // serial clocks so far
  logic [     BitW-1:0] bits_q;             // taken so far
  logic                 ack_q, start_q;     // BiSS-C: seen
  logic                 taken_q;            // the last bit
  logic                 period_ends, take, last, late, line_low, ends_q, missing_q, clocks;
  assign period_ends = wait_q == WaitW'(2 * HalfClocks - 1);
  // A bit is taken as its pin was in the last clock before the next launching edge; in BiSS-C half a serial clock after the
  // place at which the acknowledge came, so that the delay of the line does not matter.
  assign take        = state_q == Read && wait_q == take_at_q && !taken_q && (Biss ? start_q : period_q != '0);
  assign last        = take && bits_q == BitW'(FrameBits - 1);
  assign late        = Biss && state_q == Read && period_ends && !start_q && period_q == PeriodW'(AckClocks - 1);
  assign line_low    = Biss && state_q == Lead && wait_q == WaitW'(GapClocks - 1) && !bit_q;
  assign clocks      = state_q == Read && (Biss || period_q < PeriodW'(FrameBits));
  assign busy_o      = state_q != Idle;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      state_q        <= Idle;
      wait_q         <= '0;
      take_at_q      <= WaitW'(2);
      period_q       <= '0;
      bits_q         <= '0;
      ack_q          <= 1'b0;
      start_q        <= 1'b0;
      taken_q        <= 1'b0;
      ends_q         <= 1'b0;
      missing_q      <= 1'b0;
      select_no      <= 1'b1;
      serial_clock_o <= Biss;
    end else begin
      ends_q         <= last || late || line_low;
      missing_q      <= late || line_low;
      select_no      <= Biss || !(state_q == Lead || state_q == Read);
      serial_clock_o <= clocks ? (wait_q < WaitW'(HalfClocks)) != Biss : Biss;
      wait_q         <= wait_q + 1'b1;
      case (state_q)
        Idle: begin
          wait_q <= '0;
          if (sample_i) state_q <= Lead;
        end
        Lead: begin
          period_q <= '0;
          bits_q   <= '0;
          ack_q    <= 1'b0;
          start_q  <= 1'b0;
          taken_q  <= 1'b0;
          if (wait_q == WaitW'(GapClocks - 1)) begin
            wait_q  <= '0;
            state_q <= line_low ? Gap : Read;
          end
        end
        Read: begin
          if (period_ends) begin
            wait_q   <= '0;
            period_q <= period_q + 1'b1;
          end
          if (take) bits_q <= bits_q + 1'b1;
          if (Biss && !ack_q && !bit_q) begin
            ack_q     <= 1'b1;
            take_at_q <= wait_q < WaitW'(HalfClocks) ? wait_q + WaitW'(HalfClocks) : wait_q - WaitW'(HalfClocks);
          end
          if (Biss && ack_q && wait_q == take_at_q && bit_q) start_q <= 1'b1;
          if (last) taken_q <= 1'b1;
          if (late || (Biss ? (taken_q || last) && period_ends : last)) begin  // BiSS-C: with a whole serial clock
            wait_q  <= '0;
            state_q <= Gap;
          end
        end
        default: begin
          if (wait_q == WaitW'(GapClocks - 1)) state_q <= Idle;
        end
      endcase
    end
  end

  // The frame. The CRC, x^6 + x + 1, ends at 0; in BiSS-C its bits come inverted, and the first bit is not in it.
  logic [FrameW-1:0] frame_q;
  logic [5:0] crc_q;
  logic parity_q, crc_bit;
  assign crc_bit = crc_q[5] ^ bit_q ^ (Biss && bits_q >= BitW'(FrameBits - 6));
  always_ff @(posedge clk_i) begin
    if (state_q == Lead) begin
      crc_q    <= '0;
      parity_q <= 1'b0;
    end else if (take) begin
      frame_q  <= {frame_q[FrameW-2:0], bit_q};
      parity_q <= parity_q ^ bit_q;
      if (!Biss || bits_q != '0) crc_q <= {crc_q[4:1], crc_q[0] ^ crc_bit, crc_bit};
    end
  end

  // What a frame says.
  logic wrong, bad, unwell, is_angle, jumps, is_wrong, good, is_lost;
  logic [Bits-1:0] angle, turn_q, step, size;
  logic [ReachW-1:0] reach_q;  // counts by which the next good reading may differ from the last one
  assign angle = frame_q[Below+:Bits];
  generate
  if (Spi) begin : g_spi
    // Commands: even parity, read, address.
    localparam logic [15:0] ReadAngle = {1'b1, 1'b1, 14'h3fff};
    localparam logic [15:0] ReadFlags = {1'b0, 1'b1, 14'h0001};
    localparam logic [13:0] DiagRegister = 14'(DiagAddress);
    localparam logic [15:0] ReadDiagnosis = {~^DiagRegister, 1'b1, DiagRegister};
    logic [15:0] command_q;
    logic [DiagLog2-1:0] readings_q;
    logic flagged_q;            // the last frame had the error flag
    logic [1:0] ill_q;          // diagnoses in a row that say the angle cannot be trusted
    logic diagnose;
    kind_e asked_q, answer_q;   // in this frame; by the frame before, so answered in this one
    assign command_o = command_q[15];
    assign wrong     = parity_q;
    assign bad       = frame_q[14] && answer_q != Flags;
    assign unwell    = ill_q == 2'd2;
    assign diagnose  = readings_q == '0 || ill_q == 2'd1;  // a bad one is asked for again
    assign is_angle  = answer_q == Angle;
    always_ff @(posedge clk_i or negedge rst_ni) begin
      if (!rst_ni) begin
        command_q  <= '0;
        readings_q <= '0;
        flagged_q  <= 1'b0;
        ill_q      <= 2'd0;
        asked_q    <= Nothing;
        answer_q   <= Nothing;
      end else begin
        if (ends_q) flagged_q <= frame_q[14] && asked_q != Flags;
        // Bit 8: the offset is compensated. Bits 9 to 11: overflow, field too strong, too weak.
        if (ends_q && !is_wrong && answer_q == Diagnosis) begin
          if (frame_q[11:8] == 4'b0001) ill_q <= 2'd0;
          else if (!unwell) ill_q <= ill_q + 1'b1;
        end
        if (state_q == Idle && sample_i) begin
          command_q  <= flagged_q ? ReadFlags : diagnose ? ReadDiagnosis : ReadAngle;
          readings_q <= readings_q + 1'b1;
          answer_q   <= asked_q;
          asked_q    <= flagged_q ? Flags : diagnose ? Diagnosis : Angle;
        end else if (clocks && wait_q == '0 && period_q != '0) begin
          command_q <= {command_q[14:0], 1'b0};
        end
      end
    end
  end else if (Biss) begin : g_biss
    assign command_o = 1'b0;
    assign wrong     = crc_q != '0;
    assign bad       = !frame_q[7];  // the error, active low; the warning is left to the host
    assign unwell    = 1'b0;
    assign is_angle  = 1'b1;
  end else begin : g_ssi
    assign command_o = 1'b0;
    assign wrong     = crc_q != '0;
    assign bad       = frame_q[9] || frame_q[7:6] != 2'd0;  // track lost; field too strong or too weak
    assign unwell    = 1'b0;
    assign is_angle  = 1'b1;
  end
  endgenerate
  assign step = angle - turn_q;
  assign size = step[Bits-1] ? -step : step;
  assign jumps = is_angle && size > Bits'(reach_q) && !is_lost;
  assign is_wrong = missing_q || (ends_q && (wrong || bad || jumps));
  assign good = ends_q && is_angle && !is_wrong;

  logic [ErrorW-1:0] errors_q;
  logic [3:0] kinds_q;
  logic [FrozenW-1:0] equal_q;
  logic moved_q, frozen_q;
  assign is_lost = errors_q == ErrorW'(Errors);
  assign faults_o = {frozen_q, (is_lost ? kinds_q : 4'd0) | {1'b0, unwell, 2'b00}};
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      position_o <= '0;
      valid_o    <= 1'b0;
      turn_q     <= '0;
      errors_q   <= ErrorW'(Errors);  // nothing is known before the first reading
      kinds_q    <= 4'b0001;
      starts_o   <= 1'b1;
      moved_q    <= 1'b0;
      equal_q    <= '0;
      frozen_q   <= 1'b0;
    end else begin
      valid_o <= good;
      if (is_wrong) starts_o <= 1'b0;
      if (good) begin
        position_o <= position_o + 32'($signed(step));
        turn_q     <= angle;
        errors_q   <= '0;
        if (step != '0 || is_lost) begin
          moved_q  <= !is_lost && size >= Bits'(FrozenStep);
          equal_q  <= '0;
          frozen_q <= 1'b0;
        end else if (moved_q) begin
          equal_q <= equal_q + 1'b1;
          if (equal_q == FrozenW'(FrozenReads - 1)) begin
            moved_q  <= 1'b0;
            frozen_q <= 1'b1;
          end
        end
      end else if (is_wrong) begin
        kinds_q <= missing_q ? 4'b0001 : wrong ? 4'b0010 : bad ? 4'b0100 : 4'b1000;
        if (!is_lost) errors_q <= errors_q + 1'b1;
      end
    end
  end

  // The reach is that of two readings, for a sensor that samples by itself gives an angle up to a reading old. Each left out
  // since, because it was wrong or no angle, adds the larger of the last two steps and a third of the fastest, which is more
  // than a shaft gains in a reading. A jump adds nothing, so an angle that stays where it leapt is a fault.
  localparam int Gain = (JumpStep + 2) / 3;
  localparam int StepW = $clog2(JumpStep + 1);
  logic [StepW-1:0] step_q, before_q, larger, pace;
  assign larger = step_q > before_q ? step_q : before_q;
  assign pace   = larger > StepW'(JumpStep - Gain) ? StepW'(JumpStep) : larger + StepW'(Gain);
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      reach_q  <= '0;  // the first reading is any
      step_q   <= '0;
      before_q <= '0;
    end else if (good) begin
      reach_q  <= 2 * JumpStep < Eighth ? ReachW'(2 * JumpStep) : ReachW'(Eighth);
      step_q   <= is_lost || size > Bits'(JumpStep) ? StepW'(JumpStep) : StepW'(size);
      before_q <= step_q;
    end else if (ends_q && (missing_q || wrong || bad || !is_angle)) begin
      reach_q <= reach_q > ReachW'(Eighth) - ReachW'(pace) ? ReachW'(Eighth) : reach_q + ReachW'(pace);
    end
  end
endmodule

`default_nettype wire
