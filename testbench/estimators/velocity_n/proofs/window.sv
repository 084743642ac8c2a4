// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The counts of the last m1 ticks, their saturation, and when the velocity moves. The line is taken out: of any
// one of its entries the wrapper keeps what was written last.
`default_nettype none

module window_proof (
    input logic                                            clk_i,
    input logic                                            rst_ni,
    input logic        [                              8:0] start_i,  // where in a tick a reset ends
    input logic signed [      feltgate_pkg::TRAVEL_BITS-1:0] travel_i,
    input logic signed [     feltgate_pkg::PRODUCT_BITS-1:0] product_i
);
  localparam int T = feltgate_pkg::TRAVEL_BITS;
  localparam int W = feltgate_pkg::VELOCITY_W;
  localparam int M1 = feltgate_pkg::M1;
  localparam int AddressW = $clog2(M1 + 1);

  `include "wave.svh"

  logic signed [feltgate_pkg::VELOCITY_DIFFERENCE_W-1:0] operand;
  logic signed [W-1:0] velocity;
  logic saturated;
  velocity_n u_dut (
      .*,
      .at_sample_i(wave[feltgate_map_pkg::EVENT_AT_SAMPLE]),
      .at_travel_i(wave[feltgate_map_pkg::EVENT_AT_TRAVEL]),
      .at_velocity_raw_i(wave[feltgate_map_pkg::EVENT_AT_VELOCITY_RAW]),
      .at_velocity_difference_i(wave[feltgate_map_pkg::EVENT_AT_VELOCITY_DIFFERENCE]),
      .at_velocity_i(wave[feltgate_map_pkg::EVENT_AT_VELOCITY]),
      .operand_o(operand),
      .velocity_o(velocity),
      .saturated_o(saturated)
  );
  (* hierconn *) wire [AddressW-1:0] \u_dut.pointer_q ;
  wire [AddressW-1:0] pointer = \u_dut.pointer_q ;
  (* hierconn *) wire \u_dut.filled_q ;
  (* hierconn *) wire \u_dut.begun_q ;
  wire filled = \u_dut.filled_q ;
  (* hierconn *) wire [T-1:0] \u_dut.line_q ;
  (* hierconn *) wire signed [T-1:0] \u_dut.travel_q ;
  (* hierconn *) wire signed [T-1:0] \u_dut.difference_q ;
  (* hierconn *) wire signed [W-1:0] \u_dut.raw_q ;
  wire signed [W-1:0] raw = \u_dut.raw_q ;

  // One entry, whichever: what was written last, and how many samples ago.
  logic [AddressW-1:0] entry_q;
  logic signed [T-1:0] kept_q;
  logic [15:0] age_q;
  logic at_entry_q, written_q, now, now_q;
  logic signed [T-1:0] travel_q, oldest_q;
  assign now = pointer == entry_q;
  always_ff @(posedge clk_i) begin
    entry_q    <= entry_q;
    at_entry_q <= now && !wave[feltgate_map_pkg::EVENT_AT_VELOCITY_RAW];
    if (wave[feltgate_map_pkg::EVENT_AT_VELOCITY_RAW] && now) kept_q <= travel_q;
    if (wave[feltgate_map_pkg::EVENT_AT_SAMPLE]) begin
      travel_q <= travel_i;
      oldest_q <= filled ? kept_q : '0;
      now_q    <= now;
    end
  end
  // Samples of whole waves since the reset.
  logic whole_q, sampled_q, difference_now_q, raw_now_q, after_q;
  logic [31:0] samples_q;
  logic signed [W-1:0] velocity_q;
  logic update_q;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      written_q <= 1'b0;
      age_q     <= '0;
      whole_q   <= 1'b0;
      after_q   <= 1'b0;
      samples_q <= '0;
    end else begin
      after_q <= 1'b1;
      if (wave[feltgate_map_pkg::EVENT_AT_SAMPLE]) begin
        whole_q <= 1'b1;
        if (age_q != '1) age_q <= age_q + 16'd1;
        if (samples_q != '1) samples_q <= samples_q + 32'd1;
      end
      if (wave[feltgate_map_pkg::EVENT_AT_VELOCITY_RAW] && now) begin
        written_q <= whole_q;
        age_q     <= 16'd0;
      end
    end
  end
  always_ff @(posedge clk_i) begin
    difference_now_q <= whole_q && wave[feltgate_map_pkg::EVENT_AT_TRAVEL];
    raw_now_q        <= whole_q && wave[feltgate_map_pkg::EVENT_AT_VELOCITY_RAW];
    velocity_q       <= velocity;
    update_q         <= wave[feltgate_map_pkg::EVENT_AT_VELOCITY];
  end
  always_comb begin
    assume (entry_q < AddressW'(M1));
    // What the line returns.
    if (past_ok_q && at_entry_q) assume ($signed(\u_dut.line_q ) == kept_q);
    // A reset ends where the sequencer begins.
    assume (rst_ni || start_i == 9'(Clocks - feltgate_map_pkg::FIRST_WAVE_CLOCK));
  end

  // The counts as a velocity, in wide numbers.
  localparam int Shift = feltgate_pkg::VELOCITY_F + feltgate_pkg::VELOCITY_SHIFT;
  logic signed [T-1:0] difference_q;
  always_ff @(posedge clk_i) difference_q <= \u_dut.difference_q ;
  logic signed [T+Shift:0] exact;
  assign exact = (T + Shift + 1)'(difference_q) <<< Shift;
  localparam logic signed [W-1:0] Most = {1'b0, {(W - 1) {1'b1}}};

  // The pointer moves after EVENT_AT_VELOCITY_DIFFERENCE; between the sample and that it is the tick's own.
  logic own;
  logic [15:0] distance;  // entries from this one to the pointer
  assign own      = phase_q > 9'(feltgate_map_pkg::EVENT_AT_SAMPLE) && phase_q <= 9'(feltgate_map_pkg::EVENT_AT_VELOCITY_DIFFERENCE);
  assign distance = (pointer >= entry_q) ? 16'(pointer) - 16'(entry_q) : 16'(pointer) + 16'(M1) - 16'(entry_q);
  always_comb begin
    if (past_ok_q && rst_ni) begin
      if (difference_now_q && now_q) begin
        counts_of_the_window: assert (\u_dut.difference_q == T'(travel_q - oldest_q));
      end
      if (raw_now_q) begin
        raw_is_the_counts: assert (saturated ? (raw == Most ? exact > (T + Shift + 1)'(Most)
                                                            : raw == ~Most && exact < (T + Shift + 1)'($signed(~Most)))
                                             : (T + Shift + 1)'(raw) == exact);
      end
      velocity_in_its_clock: assert (!after_q || update_q || velocity == velocity_q);
      operand_in_its_clock: assert (!whole_q || wave[feltgate_map_pkg::PARAM_AT_VELOCITY_A1] || operand == '0);
      inside_pointer: assert (pointer < AddressW'(M1) && (whole_q || (!filled && pointer == '0 && samples_q == '0 &&
          !written_q)));
      filled_after_m1: assert (filled ? samples_q >= 32'(M1) + 32'(own) : 32'(pointer) + 32'(own &&
          whole_q) == samples_q);
      inside_written: assert (written_q || (!filled && pointer <= entry_q));
      window_is_m1_ticks: assert (!written_q || (own ? 32'(age_q) == ((distance != '0) ? 32'(distance) :
                                                phase_q == 9'(feltgate_map_pkg::EVENT_AT_VELOCITY_DIFFERENCE) ? 32'd0 :
                                                    32'(M1))
                                             : 32'(age_q) + 32'd1 == ((distance != '0) ? 32'(distance) : 32'(M1))));
      inside_begin: assert (whole_q || phase_q >= 9'(Clocks - feltgate_map_pkg::FIRST_WAVE_CLOCK) || phase_q == '0);
      inside_begun: assert (\u_dut.begun_q == whole_q);
      inside_travel: assert (!whole_q || \u_dut.travel_q == travel_q);
      starts: cover (raw_now_q && raw < 0);
      saturates: cover (raw_now_q && saturated);
    end
  end
endmodule

`default_nettype wire
