// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Room: what every tick shares. The sequencer's wave is the time; registers bring one parameter in
// each clock; operand bus and multipliers give each room its products; the snapshot keeps the
// results of the tick for the host. docs/architecture.md, docs/architecture.md

`default_nettype none

module wave #(
    parameter int ReadBack = 1,  // 0: no snapshot RAM, the host can only write
    parameter ParameterFile = ""  // parameters.mem of the design; "": none
) (
    input  logic                                             clk_i,
    input  logic                                             rst_ni,
    output logic                                             tick_o,              // last clock of a tick
    output logic        [                              31:0] tick_count_o,
    output logic        [ feltgate_map_pkg::WAVE_LENGTH-1:0] wave_o,              // bit t: clock t of the wave
    output logic        [                              31:0] param_o,             // the word of this clock
    // Host and panel
    input  logic        [                              11:0] reg_addr_i,
    input  logic        [                              31:0] reg_wdata_i,
    input  logic                                             reg_write_i,
    output logic                                             reg_busy_o,
    output logic        [                              31:0] reg_rdata_o,
    input  logic                                             set_zero_i,          // one clock
    input  logic        [                               3:0] scene_i,             // of the panel
    output logic        [                               3:0] scene_o,             // in force in this tick
    output logic        [   feltgate_map_pkg::W_CONTROL-1:0] control_o,           // control word
    output logic                                             set_zero_o,          // one clock
    output logic                                             clear_faults_o,
    output logic                                             kick_o,
    output logic                                             disarm_o,
    output logic                                             stop_o,
    output logic                                             restart_o,           // ramp from the next tick on
    output logic        [feltgate_map_pkg::W_FAULTS_SEEN-1:0] trips_o,            // bit n: cause n, one clock
    // Choice of words, and the words of the snapshot that are no operands
    input  logic                                             locked_i,            // armed, or in the clock that arms: some words cannot change
    input  logic                                             region_high_i,
    input  logic                                             derated_i,
    input  logic                                             testing_i,
    input  logic                                             armed_i,
    input  logic                                             paused_i,
    input  logic                                             unkicked_i,
    input  logic [feltgate_map_pkg::W_STATUS_SELF_TEST-1:0]  test_result_i,
    input  logic        [feltgate_map_pkg::W_STATUS_LIMITS-1:0] limits_i,
    input  logic        [feltgate_map_pkg::W_FAULTS_SEEN-1:0] faults_i,
    input  logic        [feltgate_map_pkg::W_FAULTS_FIRST-1:0] first_fault_i,
    input  logic        [feltgate_map_pkg::W_FAULTS_CURRENT+1:0] current_state_i,  // of a current loop: faults.current, driver, missing
    input  logic                                              polarity_holds_i,  // an absolute encoder has given its first reading
    input  logic        [feltgate_map_pkg::W_FAULTS_ABSOLUTE-1:0] absolute_state_i,  // of an absolute encoder
    input  logic                                             encoder_error_i,
    input  logic        [                              15:0] error_count_i,
    input  logic        [                              15:0] rejected_count_i,
    input  logic signed [                              31:0] position_i,
    input  logic signed [                              31:0] index_position_i,
    output logic                                             word_valid_o,        // a word of the snapshot
    output logic        [                               5:0] word_slot_o,
    output logic        [                              31:0] word_data_o,
    // Operands, and the products of each room
    input  logic signed [feltgate_pkg::VELOCITY_DIFFERENCE_W-1:0] velocity_difference_i,
    input  logic signed [feltgate_pkg::OBSERVER_DIFFERENCE_W-1:0] observer_difference_i,
    input  logic signed [feltgate_pkg::SCENE_DISTANCE_W-1:0] distance_i,
    input  logic                                             square_i,            // the distance is squared
    input  logic signed [   feltgate_pkg::WITH_ADDEND_W-1:0] applied_i,
    input  logic signed [      feltgate_pkg::VELOCITY_W-1:0] velocity_i,
    input  logic signed [        feltgate_pkg::TORQUE_W-1:0] tau_hat_i,
    input  logic signed [        feltgate_pkg::TORQUE_W-1:0] tau_ref_i,
    input  logic signed [       feltgate_pkg::CURRENT_W-1:0] motor_current_i,
    input  logic signed [       feltgate_pkg::VOLTAGE_W-1:0] voltage_i,
    input  logic signed [feltgate_pkg::CURRENT_ESTIMATE_W-1:0] current_estimate_i,
    output logic signed [    feltgate_pkg::PRODUCT_BITS-1:0] velocity_product_o,
    output logic signed [    feltgate_pkg::PRODUCT_BITS-1:0] dob_product_o,
    output logic signed [    feltgate_pkg::PRODUCT_BITS-1:0] scene_product_o,
    output logic signed [    feltgate_pkg::PRODUCT_BITS-1:0] control_product_o,
    output logic signed [    feltgate_pkg::PRODUCT_BITS-1:0] supervisor_product_o
);
  localparam int OperandW = feltgate_pkg::MULTIPLIER_A_BITS;
  localparam int EstimateW = feltgate_pkg::CURRENT_ESTIMATE_W;
  localparam int HeatDrop = (feltgate_pkg::CURRENT_LOOP == 0) ? 0 : feltgate_pkg::CURRENT_F - feltgate_pkg::CURRENT_ESTIMATE_F;
  logic [3:0] scene_wanted;
  logic [5:0] slot_fetch;
  logic scene_slot_fetch, refused, saturated, word_error, signed_word, square_distance_q, square_estimate, direct_q;
  logic [31:0] status, faults;
  logic signed [OperandW-1:0] operand, dob_operand, scene_operand, control_operand, supervisor_operand;
  logic signed [EstimateW-1:0] heat_current, estimate_operand;

  sequencer u_sequencer (
      .clk_i(clk_i), .rst_ni(rst_ni),
      .tick_o(tick_o), .tick_count_o(tick_count_o), .wave_o(wave_o),
      .slot_fetch_o(slot_fetch), .scene_slot_fetch_o(scene_slot_fetch)
  );

  registers #(.ReadBack(ReadBack), .ParameterFile(ParameterFile)) u_registers (
      .clk_i(clk_i), .rst_ni(rst_ni),
      .tick_i(tick_o),
      .reg_addr_i(reg_addr_i), .reg_wdata_i(reg_wdata_i), .reg_write_i(reg_write_i),
      .reg_rdata_o(reg_rdata_o), .reg_busy_o(reg_busy_o),
      .armed_i(locked_i), .set_zero_i(set_zero_i),
      // The count of an absolute encoder began with a polarity.
      .polarity_holds_i(polarity_holds_i),
      .slot_fetch_i(slot_fetch), .scene_slot_fetch_i(scene_slot_fetch),
      .scene_i(scene_o),
      .region_high_i(region_high_i), .derated_i(derated_i), .testing_i(testing_i),
      .at_least_full_i(wave_o[feltgate_map_pkg::EVENT_AT_LEAST_FULL]),
      .at_least_hold_i(wave_o[feltgate_map_pkg::EVENT_AT_LEAST_HOLD]),
      .at_least_test_i(wave_o[feltgate_map_pkg::EVENT_AT_LEAST_TEST]),
      .param_o(param_o),
      .word_error_o(word_error),
      .control_o(control_o), .set_zero_o(set_zero_o),
      .clear_faults_o(clear_faults_o), .kick_o(kick_o),
      .disarm_o(disarm_o), .stop_o(stop_o),
      .restart_o(restart_o),
      .refused_o(refused), .saturated_o(saturated),
      .snap_slot_i(word_slot_o), .snap_valid_i(word_valid_o), .snap_data_i(word_data_o)
  );
  assign trips_o = feltgate_map_pkg::W_FAULTS_SEEN'(word_error) << feltgate_map_pkg::FAULT_WORD;

  // The scene of a tick: the host's, where it has control.
  assign scene_wanted = control_o[feltgate_map_pkg::B_CONTROL_HOST]
                        ? control_o[feltgate_map_pkg::B_CONTROL_SCENE+:feltgate_map_pkg::W_CONTROL_SCENE] : scene_i;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) scene_o <= '0;
    else if (tick_o) scene_o <= scene_wanted;
  end

  assign faults = (32'(faults_i) << feltgate_map_pkg::B_FAULTS_SEEN) |
                  (32'(first_fault_i) << feltgate_map_pkg::B_FAULTS_FIRST) |
                  (32'(current_state_i[feltgate_map_pkg::W_FAULTS_CURRENT-1:0]) << feltgate_map_pkg::B_FAULTS_CURRENT) |
                  (32'(absolute_state_i) << feltgate_map_pkg::B_FAULTS_ABSOLUTE);
  assign status = (32'(limits_i) << feltgate_map_pkg::B_STATUS_LIMITS) |
                  (32'(scene_o) << feltgate_map_pkg::B_STATUS_SCENE) |
                  (32'(armed_i) << feltgate_map_pkg::B_STATUS_ARMED) |
                  (32'(control_o[feltgate_map_pkg::B_CONTROL_MODE+:feltgate_map_pkg::W_CONTROL_MODE])
                   << feltgate_map_pkg::B_STATUS_MODE) |
                  (32'(test_result_i) << feltgate_map_pkg::B_STATUS_SELF_TEST) |
                  (32'(paused_i) << feltgate_map_pkg::B_STATUS_TESTING) |
                  (32'(current_state_i[feltgate_map_pkg::W_FAULTS_CURRENT]) << feltgate_map_pkg::B_STATUS_DRIVER_FAULT) |
                  (32'(current_state_i[feltgate_map_pkg::W_FAULTS_CURRENT+1]) << feltgate_map_pkg::B_STATUS_CURRENT_MISSING) |
                  (32'(encoder_error_i) << feltgate_map_pkg::B_STATUS_ENCODER_ERROR) |
                  (32'(refused) << feltgate_map_pkg::B_STATUS_REFUSED) |
                  (32'(saturated) << feltgate_map_pkg::B_STATUS_SATURATED) |
                  (32'(unkicked_i) << feltgate_map_pkg::B_STATUS_UNKICKED);
  snapshot #(.ReadBack(ReadBack)) u_snapshot (
      .clk_i(clk_i), .rst_ni(rst_ni),
      .slot_fetch_i(slot_fetch),
      .read_status_i(wave_o[feltgate_map_pkg::READ_AT_STATUS]),
      .read_position_i(wave_o[feltgate_map_pkg::READ_AT_POSITION]),
      .read_tick_i(wave_o[feltgate_map_pkg::READ_AT_TICK]),
      .read_velocity_i(wave_o[feltgate_map_pkg::READ_AT_VELOCITY]),
      .read_index_i(wave_o[feltgate_map_pkg::READ_AT_INDEX]),
      .read_encoder_i(wave_o[feltgate_map_pkg::READ_AT_ENCODER]),
      .read_tau_hat_i(wave_o[feltgate_map_pkg::READ_AT_TAU_HAT]),
      .read_faults_i(wave_o[feltgate_map_pkg::READ_AT_FAULTS]),
      .read_tau_ref_i(wave_o[feltgate_map_pkg::READ_AT_TAU_REF]),
      .read_current_ref_i(wave_o[feltgate_map_pkg::READ_AT_CURRENT_REF]),
      .read_voltage_i(wave_o[feltgate_map_pkg::READ_AT_VOLTAGE]),
      .read_duty_i(wave_o[feltgate_map_pkg::READ_AT_DUTY]),
      .status_i(status), .faults_i(faults),
      .position_i(position_i),
      .tick_count_i(tick_count_o),
      .index_position_i(index_position_i),
      .error_count_i(error_count_i), .rejected_count_i(rejected_count_i),
      .operand_i(operand[31:0]),
      .valid_o(word_valid_o), .slot_o(word_slot_o), .data_o(word_data_o)
  );

  // I2t takes a measured current, if there is one.
  assign heat_current = (feltgate_pkg::CURRENT_LOOP == 0)
                        ? current_estimate_i
                        : EstimateW'(motor_current_i >>> HeatDrop);
  operand_bus u_operand_bus (
      .clk_i(clk_i),
      .param_next_inverse_resistance_i(wave_o[feltgate_map_pkg::PARAM_AT_INVERSE_RESISTANCE-1]),
      .param_next_emf_over_resistance_i(wave_o[feltgate_map_pkg::PARAM_AT_EMF_OVER_RESISTANCE-1]),
      .param_next_torque_constant_i(wave_o[feltgate_map_pkg::PARAM_AT_TORQUE_CONSTANT-1]),
      .param_next_inertia_gain_i(wave_o[feltgate_map_pkg::PARAM_AT_INERTIA_GAIN-1]),
      .param_next_damper_damping_i(wave_o[feltgate_map_pkg::PARAM_AT_DAMPER_DAMPING-1]),
      .param_next_current_square_i(wave_o[feltgate_map_pkg::PARAM_AT_CURRENT_SQUARE-1]),
      .param_next_emf_constant_i(wave_o[feltgate_map_pkg::PARAM_AT_EMF_CONSTANT-1]),
      .param_next_observer_gain_i(wave_o[feltgate_map_pkg::PARAM_AT_OBSERVER_GAIN-1]),
      .param_next_voltage_to_current_i(wave_o[feltgate_map_pkg::PARAM_AT_VOLTAGE_TO_CURRENT-1]),
      .param_next_torque_gain_i(wave_o[feltgate_map_pkg::PARAM_AT_TORQUE_GAIN-1]),
      .param_next_dead_voltage_slope_i(wave_o[feltgate_map_pkg::PARAM_AT_DEAD_VOLTAGE_SLOPE-1]),
      .velocity_difference_i(velocity_difference_i),
      .observer_difference_i(observer_difference_i),
      .distance_i(distance_i),
      .limited_i(applied_i),
      .velocity_i(velocity_i),
      .tau_hat_i(tau_hat_i), .tau_ref_i(tau_ref_i),
      .current_ref_i(motor_current_i), .voltage_i(voltage_i),
      .current_estimate_i(heat_current),
      .operand_o(operand),
      .dob_o(dob_operand), .scene_o(scene_operand),
      .control_o(control_operand), .supervisor_o(supervisor_operand),
      .signed_o(signed_word),
      .estimate_o(estimate_operand),
      .square_estimate_o(square_estimate)
  );

  // A direct voltage is no product of the voltage gain.
  always_ff @(posedge clk_i) begin
    square_distance_q <= square_i && wave_o[feltgate_map_pkg::PARAM_AT_CHARGE_SQUARE-1];
    direct_q <= wave_o[feltgate_map_pkg::PARAM_AT_VOLTAGE_GAIN-1] &&
                control_o[feltgate_map_pkg::B_CONTROL_MODE+:feltgate_map_pkg::W_CONTROL_MODE] ==
                feltgate_map_pkg::W_CONTROL_MODE'(feltgate_map_pkg::MODE_VOLTAGE);
  end
  multipliers u_multipliers (
      .clk_i(clk_i),
      .operand_i(operand),
      .velocity_i(velocity_difference_i),
      .dob_i(dob_operand), .scene_i(scene_operand),
      .control_i(control_operand), .supervisor_i(supervisor_operand),
      .signed_i(signed_word),
      .param_i(param_o),
      .square_distance_i(square_distance_q),
      .distance_i(distance_i[feltgate_pkg::SCENE_DISTANCE_F+:18]),
      .square_estimate_i(square_estimate),
      .estimate_i(estimate_operand), .zero_control_i(direct_q),
      .velocity_product_o(velocity_product_o),
      .dob_product_o(dob_product_o),
      .scene_product_o(scene_product_o),
      .control_product_o(control_product_o),
      .supervisor_product_o(supervisor_product_o)
  );
endmodule

`default_nettype wire
