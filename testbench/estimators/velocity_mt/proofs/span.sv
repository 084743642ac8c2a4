// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Which two edges a span lies between, what the division gives, what is held between edges and at rest, and when
// the velocity moves. The memory of the stamps is taken out: of any one count the wrapper keeps its last edge.
`default_nettype none

module span_proof (
    input logic                                             clk_i,
    input logic                                             rst_ni,
    input logic        [                               8:0] start_i,  // where in a tick a reset ends
    input logic signed [ feltgate_pkg::TRAVEL_BITS-1:0] travel_i,
    input logic signed [feltgate_pkg::PRODUCT_BITS-1:0] product_i
);
  localparam int W = feltgate_pkg::VELOCITY_W;
  localparam int StampW = 26;
  localparam int Doublings = 4;
  localparam int PlaceW = Doublings + 3;
  localparam logic [PlaceW-1:0] Longest = PlaceW'(4 << Doublings);
  localparam logic [StampW-1:0] Rest = StampW'(1) << (StampW - 3);  // clocks
  localparam logic [8:0] Enough = 9'd127;  // clocks of rest after which all divisions are of rest

  `include "wave.svh"

  logic signed [feltgate_pkg::VELOCITY_DIFFERENCE_W-1:0] operand;
  logic signed [W-1:0] velocity;
  logic saturated;
  velocity_mt #(.Window(19300), .Doublings(Doublings), .StampW(StampW)) u_dut (
      .*,
      .at_sample_i(wave[feltgate_map_pkg::EVENT_AT_SAMPLE]),
      .at_velocity_raw_i(wave[feltgate_map_pkg::EVENT_AT_VELOCITY_RAW]),
      .at_velocity_difference_i(wave[feltgate_map_pkg::EVENT_AT_VELOCITY_DIFFERENCE]),
      .at_velocity_i(wave[feltgate_map_pkg::EVENT_AT_VELOCITY]),
      .operand_o(operand),
      .velocity_o(velocity),
      .saturated_o(saturated)
  );
  (* hierconn *) wire [PlaceW-1:0] \u_dut.travel_q ;
  (* hierconn *) wire [PlaceW-1:0] \u_dut.run_q ;
  (* hierconn *) wire [PlaceW-1:0] \u_dut.counts ;
  (* hierconn *) wire [PlaceW-1:0] \u_dut.oldest ;
  (* hierconn *) wire [2:0] \u_dut.doublings_q ;
  (* hierconn *) wire \u_dut.up_q ;
  (* hierconn *) wire \u_dut.resting_q ;
  (* hierconn *) wire \u_dut.still_q ;
  (* hierconn *) wire \u_dut.fresh_q ;
  (* hierconn *) wire \u_dut.value_q ;
  (* hierconn *) wire \u_dut.zero_q ;
  (* hierconn *) wire \u_dut.begun_q ;
  (* hierconn *) wire \u_dut.negative_next_q ;
  (* hierconn *) wire \u_dut.ended_q ;
  (* hierconn *) wire \u_dut.over_q ;
  (* hierconn *) wire \u_dut.limited_q ;
  (* hierconn *) wire \u_dut.negative_q ;
  (* hierconn *) wire \u_dut.follow_q ;
  (* hierconn *) wire [4:0] \u_dut.left_q ;
  (* hierconn *) wire [StampW-1:0] \u_dut.now_q ;
  (* hierconn *) wire [StampW-1:0] \u_dut.newest_q ;
  (* hierconn *) wire [StampW-1:0] \u_dut.stamp_q ;
  (* hierconn *) wire [StampW-1:0] \u_dut.divisor_q ;
  (* hierconn *) wire [StampW-1:0] \u_dut.remainder_q ;
  (* hierconn *) wire [StampW:0] \u_dut.doubled ;
  (* hierconn *) wire [W-2:0] \u_dut.quotient_q ;
  (* hierconn *) wire [W-2:0] \u_dut.magnitude_q ;
  (* hierconn *) wire signed [W-1:0] \u_dut.raw_q ;
  wire [W-2:0] quotient = \u_dut.quotient_q ;
  wire [PlaceW-1:0] run = \u_dut.run_q ;
  wire [W-2:0] magnitude = \u_dut.magnitude_q ;
  wire [StampW-1:0] age = \u_dut.now_q - \u_dut.newest_q ;
  wire at_sample = wave[feltgate_map_pkg::EVENT_AT_SAMPLE];

  // Edges: a decoder's count moves by one, or it has jumped.
  logic [PlaceW-1:0] moved_by;
  logic step, jump;
  assign moved_by = travel_i[PlaceW-1:0] - \u_dut.travel_q ;
  assign step = moved_by == PlaceW'(1) || moved_by == '1;
  assign jump = moved_by[1:0] == 2'd2;

  // Counts in one direction since an edge from which can be counted; one count, whichever: its last edge.
  logic up_q, known_q, fresh_q, at_place_q;
  logic [31:0] counted_q, quiet_q;
  logic [PlaceW-1:0] place_q, edges_q;
  logic [StampW-1:0] kept_q, kept_before_q;
  logic [8:0] rested_q;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      known_q   <= 1'b0;
      up_q      <= 1'b0;
      fresh_q   <= 1'b0;
      counted_q <= '0;
      quiet_q   <= '0;
      edges_q   <= '1;
      rested_q  <= '0;
    end else begin
      fresh_q  <= step || (fresh_q && !at_sample && !jump);
      quiet_q  <= step ? 32'd1 : quiet_q + 32'(quiet_q != '1);
      rested_q <= (!\u_dut.resting_q || step) ? 9'd0 : rested_q + 9'(rested_q != Enough);
      if (step) begin
        known_q   <= 1'b1;
        up_q      <= !moved_by[1];
        counted_q <= (known_q && up_q == !moved_by[1]) ? counted_q + 32'(counted_q != '1) : '0;
        edges_q   <= (travel_i[PlaceW-1:0] == place_q) ? '0 : edges_q + PlaceW'(edges_q != '1);
      end else if (jump || (at_sample && !fresh_q && age >= Rest)) begin
        known_q <= 1'b0;
      end
    end
  end
  always_ff @(posedge clk_i) begin
    place_q       <= place_q;
    at_place_q    <= \u_dut.oldest == place_q;
    kept_before_q <= kept_q;
    if (step && travel_i[PlaceW-1:0] == place_q) kept_q <= \u_dut.now_q ;
  end

  // What the clock before was, and what the last sample has taken.
  logic after_q, whole_q, update_q, raw_now_q, ended_q, divides_q, negative_q, follow_q, limited_q;
  logic sample_fresh_q, sample_zero_q, sample_up_q, sample_at_place_q, begun_q;
  logic [StampW-1:0] sample_newest_q, sample_age_q, sample_kept_q;
  logic [StampW:0] doubled_q;
  logic [W-2:0] magnitude_q;
  logic signed [W-1:0] velocity_q;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      after_q <= 1'b0;
      whole_q <= 1'b0;
    end else begin
      after_q <= 1'b1;
      if (at_sample) whole_q <= 1'b1;
    end
  end
  always_ff @(posedge clk_i) begin
    update_q    <= wave[feltgate_map_pkg::EVENT_AT_VELOCITY];
    raw_now_q   <= wave[feltgate_map_pkg::EVENT_AT_VELOCITY_RAW];
    velocity_q  <= velocity;
    magnitude_q <= magnitude;
    negative_q  <= \u_dut.negative_q ;
    limited_q   <= \u_dut.limited_q ;
    follow_q    <= \u_dut.follow_q ;
    ended_q     <= \u_dut.ended_q ;
    begun_q     <= \u_dut.begun_q ;
    divides_q   <= \u_dut.left_q != '0 && !at_sample;
    doubled_q   <= \u_dut.doubled ;
    if (at_sample) begin
      sample_fresh_q    <= fresh_q;
      sample_zero_q     <= fresh_q ? counted_q == '0 : !known_q || age >= Rest;
      sample_newest_q   <= \u_dut.newest_q ;
      sample_age_q      <= age;
      sample_up_q       <= up_q;
      sample_at_place_q <= \u_dut.oldest == place_q;
      sample_kept_q     <= kept_q;
    end
  end
  always_comb begin
    assume (step || jump || moved_by == '0);
    // What the memory returns.
    if (past_ok_q && at_place_q) assume (\u_dut.stamp_q == kept_before_q);
    // A reset ends where the sequencer begins.
    assume (rst_ni || start_i == 9'(Clocks - feltgate_map_pkg::FIRST_WAVE_CLOCK));
  end

  logic [PlaceW-1:0] distance;  // counts from the one that is kept to the newest
  assign distance = up_q ? \u_dut.travel_q - place_q : place_q - \u_dut.travel_q ;
  logic [8:0] since;  // clocks of the last sample
  logic at_rest_long;
  assign since = (phase_q == 9'd0) ? 9'(Clocks) : phase_q;
  assign at_rest_long = (rested_q > phase_q && phase_q >= 9'd34) || rested_q > phase_q + 9'd50;
  always_comb begin
    if (past_ok_q && rst_ni) begin
      run_of_one_direction: assert (!known_q || run == (counted_q > 32'(Longest) ? Longest : PlaceW'(counted_q)));
      span_within_the_run: assert (!known_q || \u_dut.counts <= run);
      edge_of_the_span: assert (!(at_sample && fresh_q && known_q && \u_dut.oldest == place_q) ||
                                edges_q == \u_dut.counts );
      if (begun_q && whole_q) begin
        span_of_two_edges: assert (!sample_fresh_q || sample_zero_q || !sample_at_place_q ||
                                   \u_dut.divisor_q == sample_newest_q - sample_kept_q);
        age_between_edges: assert (sample_fresh_q || \u_dut.divisor_q == sample_age_q);
      end
      division_in_its_clocks: assert (!whole_q || ((\u_dut.left_q != '0) == (phase_q >= 9'd2 && phase_q <= 9'd32) &&
          (\u_dut.left_q == '0 || phase_q + 9'(\u_dut.left_q ) == 9'd33) && \u_dut.ended_q == (phase_q == 9'd33)));
      remainder_below_the_divisor: assert (\u_dut.left_q == '0 || \u_dut.left_q == 5'd31 || \u_dut.over_q ||
                                           \u_dut.remainder_q < \u_dut.divisor_q );
      step_is_exact: assert (!divides_q || \u_dut.over_q || doubled_q == (quotient[0] ? (StampW + 1)'(\u_dut.divisor_q ) : '0) +
                                                        (StampW + 1)'(\u_dut.remainder_q ));
      if (ended_q && whole_q) begin
        turn_and_rest_are_zero: assert (!sample_zero_q || magnitude == '0);
        never_grows_between_edges: assert (sample_fresh_q || magnitude <= magnitude_q);
        sign_of_the_newest_edge: assert (!sample_fresh_q || \u_dut.negative_q == !sample_up_q);
      end
      held: assert (!after_q || ended_q || (magnitude == magnitude_q && \u_dut.negative_q == negative_q));
      if (raw_now_q && after_q) begin
        raw_has_its_sign: assert (\u_dut.raw_q == (negative_q ? -$signed({1'b0, magnitude_q}) : $signed({1'b0, magnitude_q})));
        saturated_is_told: assert (saturated == limited_q && (!saturated || magnitude_q == '1));
      end
      standstill_is_zero: assert (!after_q || !(update_q && follow_q) || velocity == '0);
      filtered_unless_still: assert (!\u_dut.still_q || quiet_q >= 32'(8'd4) * 32'(Rest));
      velocity_in_its_clock: assert (!after_q || update_q || velocity == velocity_q);
      operand_in_its_clock: assert (!whole_q || wave[feltgate_map_pkg::PARAM_AT_VELOCITY_A1] || operand == '0);
      inside_known: assert (known_q == !\u_dut.resting_q && fresh_q == \u_dut.fresh_q && up_q == \u_dut.up_q );
      inside_fresh: assert (!fresh_q || known_q);
      inside_cycles: assert (!known_q || (\u_dut.doublings_q <= 3'd4 && (\u_dut.doublings_q == '0 ||
                             run >= (PlaceW'(4) << \u_dut.doublings_q ))));
      inside_place: assert (!known_q || distance > run || edges_q == distance);
      inside_age: assert (32'(age) <= quiet_q || !after_q);
      inside_taken: assert (!whole_q || (\u_dut.value_q == sample_fresh_q && \u_dut.zero_q == sample_zero_q &&
                            (sample_fresh_q || phase_q == 9'd1 || \u_dut.divisor_q == sample_age_q)));
      inside_up: assert (!whole_q || \u_dut.negative_next_q == !sample_up_q);
      inside_begun: assert (\u_dut.begun_q == (whole_q && phase_q == 9'd1));
      inside_first: assert (!whole_q || phase_q != 9'd1 || (sample_fresh_q ? \u_dut.divisor_q == sample_newest_q
                                                                          : \u_dut.divisor_q == sample_age_q));
      inside_memory: assert (!whole_q || phase_q != 9'd1 || !sample_at_place_q || \u_dut.stamp_q == sample_kept_q);
      inside_begin: assert (whole_q || ((phase_q >= 9'(Clocks - feltgate_map_pkg::FIRST_WAVE_CLOCK) ||
          phase_q == '0) && \u_dut.left_q == '0 && !\u_dut.ended_q && magnitude == '0 && rested_q <= 9'd3));
      inside_limited: assert (!\u_dut.limited_q || magnitude == '1);
      inside_awake: assert (!known_q || age <= (fresh_q ? StampW'(since) : Rest + StampW'(since)));
      inside_resting: assert (known_q || rested_q == Enough || age < Rest + StampW'(64) + StampW'(rested_q));
      inside_zero: assert (!whole_q || known_q || rested_q <= since || (sample_zero_q && !sample_fresh_q));
      inside_rest: assert (!at_rest_long || known_q || magnitude == '0);
      inside_rested: assert (rested_q <= Enough && (!known_q || rested_q == '0));
      inside_still: assert (!\u_dut.still_q || (!known_q && rested_q == Enough));
      inside_follow: assert (!\u_dut.follow_q || \u_dut.raw_q == '0);
      a_cycle: cover (ended_q && sample_fresh_q && !sample_zero_q && \u_dut.negative_q && !limited_q);
      saturates: cover (\u_dut.over_q && \u_dut.ended_q );
    end
  end
endmodule

`default_nettype wire
