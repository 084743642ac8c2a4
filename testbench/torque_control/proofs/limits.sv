// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// torque_control with the limiter that serves it: current, voltage and duty against their words, and which
// way they turn, for any products and any words.
`default_nettype none

module limits_proof (
    input logic                                            clk_i,
    input logic                                            rst_ni,
    input logic        [                              8:0] start_i,  // where in a tick a reset ends
    input logic                                            armed_i,
    input logic        [                              1:0] mode_i,
    input logic        [                             31:0] param_i,
    input logic signed [     feltgate_pkg::PRODUCT_BITS-1:0] product_i,
    input logic signed [         feltgate_pkg::TORQUE_W-1:0] tau_ref_i,
    input logic signed [  feltgate_pkg::LIMITER_INPUT_W-1:0] other_ahead_i,  // the scenes'
    input logic signed [  feltgate_pkg::LIMITER_INPUT_W-1:0] other_late_i
);
  localparam int Clocks = feltgate_pkg::CLOCKS_PER_TICK;
  localparam int CurrentW = feltgate_pkg::CURRENT_W;
  localparam int VoltageW = feltgate_pkg::VOLTAGE_W;
  localparam int DutyW = feltgate_pkg::DUTY_W;
  localparam int LimiterW = feltgate_pkg::LIMITER_W;
  localparam int EmfW = feltgate_pkg::EMF_W;
  localparam int EmfDrop = feltgate_pkg::VELOCITY_F + feltgate_pkg::P_EMF_CONSTANT_F - feltgate_pkg::VOLTAGE_F;

  // The wave as the sequencer makes it, from any clock of a tick on.
  logic past_ok_q, tick, tick_q;
  logic [8:0] phase_q;
  logic [feltgate_map_pkg::WAVE_LENGTH-1:0] wave;
  initial past_ok_q = 1'b0;
  always_ff @(posedge clk_i) begin
    past_ok_q <= 1'b1;
    tick_q    <= tick;
    phase_q   <= !rst_ni ? start_i : phase_q == 9'(Clocks - 1) ? 9'd0 : phase_q + 9'd1;
  end
  assign wave = (rst_ni &&
      phase_q < 9'(feltgate_map_pkg::WAVE_LENGTH)) ? feltgate_map_pkg::WAVE_LENGTH'(1) << phase_q : '0;
  assign tick = phase_q == 9'(Clocks - 1 - feltgate_map_pkg::FIRST_WAVE_CLOCK);

  logic armed_q;
  logic [1:0] mode_q;
  always_ff @(posedge clk_i) begin
    armed_q <= armed_i;
    mode_q  <= mode_i;
  end
  always_comb begin
    if (!past_ok_q) assume (!rst_ni);
    assume (phase_q < 9'(Clocks) && start_i < 9'(Clocks));
    assume (tick_q || !rst_ni || (armed_i == armed_q && mode_i == mode_q));
    assume (phase_q <= 9'(feltgate_map_pkg::S_TORQUE_LIMIT) || (other_ahead_i == '0 && other_late_i == '0));
  end

  logic signed [feltgate_pkg::LIMITER_INPUT_W-1:0] ahead, late;
  logic signed [LimiterW-1:0] limited;
  logic signed [feltgate_pkg::WITH_ADDEND_W-1:0] applied;
  logic signed [CurrentW-1:0] current;
  logic signed [VoltageW-1:0] voltage;
  logic signed [DutyW-1:0] duty;
  logic beyond, region_high, limit_current, limit_voltage, limit_duty;
  torque_control u_dut (
      .clk_i(clk_i),
      .rst_ni(rst_ni),
      .armed_i(armed_i),
      .mode_i(mode_i),
      .wave_i(wave),
      .param_i(param_i),
      .product_i(product_i),
      .tau_ref_i(tau_ref_i),
      .ahead_o(ahead),
      .late_o(late),
      .limited_i(limited),
      .beyond_i(beyond),
      .applied_o(applied),
      .region_high_o(region_high),
      .current_ref_o(current),
      .voltage_o(voltage),
      .duty_o(duty),
      .limit_current_o(limit_current),
      .limit_voltage_o(limit_voltage),
      .limit_duty_o(limit_duty)
  );
  // As the core has it.
  limiter u_limiter (
      .clk_i(clk_i),
      .valid_i(wave[feltgate_map_pkg::S_TORQUE_LIMIT-1] || wave[feltgate_map_pkg::S_VOLTAGE_STEP-1] ||
               wave[feltgate_map_pkg::S_CURRENT_LIMIT-1] || wave[feltgate_map_pkg::S_DEAD_VOLTAGE-1] ||
               wave[feltgate_map_pkg::S_VOLTAGE_WINDOW-1] || wave[feltgate_map_pkg::S_DUTY_LIMIT-1]),
      .torque_i(wave[feltgate_map_pkg::S_TORQUE_LIMIT-1]),
      .voltage_i(wave[feltgate_map_pkg::S_VOLTAGE_WINDOW-1]),
      .duty_i(wave[feltgate_map_pkg::S_DUTY_LIMIT-1]),
      .ahead_i(ahead | other_ahead_i),
      .late_i(late | other_late_i),
      .param_i(param_i),
      .limited_o(limited),
      .beyond_o(beyond)
  );
  (* hierconn *) wire signed [feltgate_pkg::VOLTAGE_SUM_W-1:0] \u_dut.fixed_q ;
  (* hierconn *) wire signed [feltgate_pkg::CURRENT_SUM_W-1:0] \u_dut.kept_q ;
  // What no reset clears is 0 once a wave has passed; the first one after a reset is never an armed one.
  always_comb if (!rst_ni) assume (\u_dut.fixed_q == 0 && \u_dut.kept_q == 0);
  (* hierconn *) wire signed [EmfW-1:0] \u_dut.emf_q ;
  wire signed [EmfW-1:0] emf = \u_dut.emf_q ;
  wire signed [feltgate_pkg::CURRENT_SUM_W-1:0] kept = \u_dut.kept_q ;
  localparam logic signed [feltgate_pkg::CURRENT_SUM_W-1:0] Kept = feltgate_pkg::CURRENT_SUM_W'(1) <<
      (feltgate_pkg::TORQUE_W + feltgate_pkg::COEFFICIENT_BITS - 1 -
       (feltgate_pkg::TORQUE_F + feltgate_pkg::P_OBSERVER_GAIN_F - feltgate_pkg::CURRENT_F));

  // A word as a limit: a negative one, or one that the limiter's or the signal's format does not hold, is 0.
  function automatic logic [LimiterW-1:0] as_limit(input logic [31:0] word, input int bits);
    as_limit = ((word[LimiterW-1:0] >> (bits - 1)) != '0) ? '0 : word[LimiterW-1:0];
  endfunction
  function automatic logic within(input logic signed [39:0] x, input logic [LimiterW-1:0] most);
    within = x <= $signed({1'b0, 39'(most)}) && x >= -$signed({1'b0, 39'(most)});
  endfunction

  // Words and products as they came by in this tick.
  logic [LimiterW-1:0] current_limit_q, window_q, duty_limit_q, step_q;
  logic signed [EmfW-1:0] emf_then_q;
  logic all_down_q, all_up_q, law_product;
  logic fits;
  int operand_bits;
  always_comb begin
    operand_bits = feltgate_pkg::TORQUE_W;
    if (wave[feltgate_map_pkg::M_EMF_CONSTANT]) operand_bits = feltgate_pkg::VELOCITY_W;
    if (wave[feltgate_map_pkg::M_VOLTAGE_GAIN]) operand_bits = CurrentW;
    if (wave[feltgate_map_pkg::M_DUTY_GAIN]) operand_bits = feltgate_pkg::APPLIED_W;
    fits = (product_i < 0 ? ~product_i : product_i) >>> (operand_bits + feltgate_pkg::COEFFICIENT_BITS - 1) == 0;
  end
  assign law_product = wave[feltgate_map_pkg::M_OBSERVER_GAIN] || wave[feltgate_map_pkg::M_TORQUE_GAIN] ||
                       wave[feltgate_map_pkg::M_DEAD_VOLTAGE_SLOPE] || wave[feltgate_map_pkg::M_VOLTAGE_GAIN] ||
                       wave[feltgate_map_pkg::M_DUTY_GAIN];
  always_ff @(posedge clk_i) begin
    if (wave[feltgate_map_pkg::S_CURRENT_LIMIT]) current_limit_q <= as_limit(param_i, LimiterW);
    if (wave[feltgate_map_pkg::S_VOLTAGE_WINDOW]) window_q <= as_limit(param_i, VoltageW);
    if (wave[feltgate_map_pkg::S_DUTY_LIMIT]) duty_limit_q <= as_limit(param_i, DutyW);
    if (wave[feltgate_map_pkg::S_VOLTAGE_STEP]) step_q <= as_limit(param_i, LimiterW);
    if (wave[feltgate_map_pkg::M_EMF_CONSTANT]) emf_then_q <= EmfW'(product_i >>> EmfDrop);
    // All products of the law point one way, and are no more than their operands and a word of
    // COEFFICIENT_BITS make; the back-EMF too, or it is 0 where the law does not give it back.
    if (wave[feltgate_map_pkg::M_EMF_CONSTANT]) begin
      all_down_q <= fits && ((feltgate_pkg::EMF_IN_LAW != 0) ? product_i <= 0 : product_i == 0);
      all_up_q   <= fits && ((feltgate_pkg::EMF_IN_LAW != 0) ? product_i >= 0 : product_i == 0);
    end else if (law_product) begin
      all_down_q <= all_down_q && fits && product_i <= 0;
      all_up_q   <= all_up_q && fits && product_i >= 0;
    end
  end
  // Clocks of this tick since its back-EMF, without a reset.
  logic began_q;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) began_q <= 1'b0;
    else if (wave[feltgate_map_pkg::M_EMF_CONSTANT]) began_q <= 1'b1;
    else if (tick_q) began_q <= 1'b0;
  end
  logic new_current, new_voltage, new_duty, law;
  logic new_current_q, new_voltage_q, new_duty_q, was_q;
  assign new_current = began_q && wave[feltgate_map_pkg::T_CURRENT];
  assign new_voltage = began_q && wave[feltgate_map_pkg::T_VOLTAGE];
  assign new_duty    = began_q && wave[feltgate_map_pkg::T_DUTY];
  assign law = mode_q != 2'(feltgate_map_pkg::MODE_VOLTAGE);
  logic signed [CurrentW-1:0] current_was_q;
  logic signed [VoltageW-1:0] voltage_was_q;
  logic signed [DutyW-1:0] duty_was_q;
  logic any_current_q, any_voltage_q, any_duty_q;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) {new_current_q, new_voltage_q, new_duty_q, was_q} <= '0;
    else begin
      {new_current_q, new_voltage_q, new_duty_q} <= {new_current, new_voltage, new_duty};
      was_q <= 1'b1;
    end
  end
  always_ff @(posedge clk_i) begin
    current_was_q <= current;
    voltage_was_q <= voltage;
    duty_was_q    <= duty;
    {any_current_q, any_voltage_q, any_duty_q} <=
        {wave[feltgate_map_pkg::T_CURRENT], wave[feltgate_map_pkg::T_VOLTAGE], wave[feltgate_map_pkg::T_DUTY]};
  end
  localparam logic signed [VoltageW-1:0] Most = {1'b0, {(VoltageW - 1) {1'b1}}};

  logic signed [39:0] between;
  assign between = 40'(voltage) - 40'(emf_then_q);
  always_comb begin
    if (past_ok_q && rst_ni && was_q) begin
      change_in_their_clocks: assert ((any_current_q || current == current_was_q) && (any_voltage_q ||
          voltage == voltage_was_q) &&
                                      (any_duty_q || duty == duty_was_q));
      if (new_current_q) begin
        current_within_limit: assert (within(40'(current), current_limit_q));
        current_turns: assert (!law || !((all_down_q && current > 0) || (all_up_q && current < 0)));
        disarmed_current_is_0: assert (armed_q || current == '0);
        pulls: cover (current < 0 && all_down_q && limit_current);
      end
      if (new_voltage_q) begin
        voltage_within_window: assert (!armed_q || within(between, window_q) ||
                                       (voltage == Most && between < 0) || (voltage == ~Most && between > 0));
        voltage_turns: assert (!law || !((all_down_q && voltage > 0) || (all_up_q && voltage < 0)));
        disarmed_voltage_is_0: assert (armed_q || voltage == '0);
        drives: cover (voltage > 0 && limit_voltage && emf_then_q < 0);
      end
      if (new_duty_q) begin
        duty_within_limit: assert (within(40'(duty), duty_limit_q));
        duty_turns: assert (!((all_down_q && duty > 0) || (all_up_q && duty < 0)));
        turns: cover (duty < 0 && limit_duty);
      end
      inside_emf: assert (!began_q || emf == emf_then_q);
      inside_fixed: assert (\u_dut.fixed_q == 0 || (phase_q > 9'(feltgate_map_pkg::T_DIRECT_VOLTAGE) &&
                            phase_q <= 9'(feltgate_map_pkg::S_VOLTAGE_WINDOW)));
      inside_down: assert (!began_q || !all_down_q || (emf <= 0 &&
          (phase_q <= 9'(feltgate_map_pkg::M_OBSERVER_GAIN) || (kept <= 0 && kept >= -Kept))));
      inside_up: assert (!began_q || !all_up_q || (emf >= 0 &&
          (phase_q <= 9'(feltgate_map_pkg::M_OBSERVER_GAIN) || (kept >= 0 && kept < Kept))));
    end
  end
endmodule

`default_nettype wire
