// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The register port, for any traffic: what lands, what is refused, what passes, what is read. The RAMs are taken
// out; of any one word of the parameter RAM the wrapper keeps what was written last.
`default_nettype none

module port_proof (
    input logic        clk_i,
    input logic        rst_ni,
    input logic        tick_i,
    input logic [11:0] reg_addr_i,
    input logic [31:0] reg_wdata_i,
    input logic        reg_write_i,
    input logic        armed_i,
    input logic        polarity_holds_i,
    input logic        set_zero_i,
    input logic [ 5:0] slot_fetch_i,
    input logic        scene_slot_fetch_i,
    input logic [ 3:0] scene_i,
    input logic        region_high_i,
    input logic        at_least_full_i,
    input logic        at_least_hold_i,
    input logic        at_least_test_i,
    input logic        derated_i,
    input logic        testing_i,
    input logic [ 5:0] snap_slot_i,
    input logic        snap_valid_i,
    input logic [31:0] snap_data_i,
    input logic        breaks_i,         // a bit of what the RAM returns is wrong
    input logic [ 5:0] broken_i          // this one
);
  localparam int ControlW = feltgate_map_pkg::W_CONTROL;
  localparam int Held = feltgate_map_pkg::B_CONTROL_MODE;

  logic [31:0] rdata, param;
  logic busy, word_error, set_zero, clear_faults, kick, disarm, stop, restart, refused, saturated;
  logic [ControlW-1:0] control;
  registers u_dut (
      .*,
      .reg_rdata_o(rdata),
      .reg_busy_o(busy),
      .param_o(param),
      .word_error_o(word_error),
      .control_o(control),
      .set_zero_o(set_zero),
      .clear_faults_o(clear_faults),
      .kick_o(kick),
      .disarm_o(disarm),
      .stop_o(stop),
      .restart_o(restart),
      .refused_o(refused),
      .saturated_o(saturated)
  );
  (* hierconn *) wire \u_dut.lands ;
  wire lands = \u_dut.lands ;
  (* hierconn *) wire [35:0] \u_dut.written ;
  (* hierconn *) wire [8:0] \u_dut.address_q ;
  (* hierconn *) wire [31:0] \u_dut.data_q ;
  (* hierconn *) wire \u_dut.to_parameter_q ;
  (* hierconn *) wire \u_dut.to_control_q ;
  (* hierconn *) wire \u_dut.to_command_q ;
  (* hierconn *) wire [35:0] \u_dut.fetch_q ;
  (* hierconn *) wire [35:0] \u_dut.g_read.parameter_q ;
  (* hierconn *) wire [31:0] \u_dut.g_read.snapshot_q ;
  (* hierconn *) wire \u_dut.g_read.write_bank_q ;
  (* hierconn *) wire \u_dut.g_read.read_bank ;
  (* hierconn *) wire \u_dut.g_read.frozen_q ;
  (* hierconn *) wire \u_dut.zero_q ;
  (* hierconn *) wire \u_dut.held_check_q ;

  // Check bit k is the parity of bits k, k + 4, ... of the word, inverted for k = 0 and 2.
  function automatic logic [3:0] check_of(input logic [31:0] word);
    for (int k = 0; k < 4; k++) begin
      check_of[k] = (k % 2 == 0);
      for (int n = k; n < 32; n += 4) check_of[k] = check_of[k] ^ word[n];
    end
  endfunction

  // The nearest value that the format of a parameter holds.
  function automatic logic [31:0] fitted(input logic [11:0] address, input logic [31:0] data);
    logic has_sign;
    logic [31:0] above;
    logic signed [32:0] value, most, least;
    {has_sign, above} = feltgate_pkg::parameter_above(address[8:0]);
    value = 33'($signed(data));
    most  = {1'b0, ~above};
    least = has_sign ? {1'b1, above} : 33'sd0;
    if (address >= 12'h200 || above == 32'd0) fitted = data;
    else if (value > most) fitted = most[31:0];
    else if (value < least) fitted = least[31:0];
    else fitted = data;
  endfunction

  // What limits the torque, as it came by: each limit once, in its order.
  (* hierconn *) wire [5:0] \u_dut.least_at_q ;
  (* hierconn *) wire signed [feltgate_pkg::TORQUE_W-1:0] \u_dut.least_q ;
  wire [5:0] least_at = \u_dut.least_at_q ;
  logic signed [feltgate_pkg::TORQUE_W-1:0] limit, full_q, hold_q, test_q, least;
  logic hold_on_q, test_on_q;
  logic [1:0] next_q;  // the limit to come: 0 torque_limit, 1 hold_limit, 2 self_test_torque
  assign limit = param[feltgate_pkg::TORQUE_W-1:0];
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      full_q <= '0;
      {hold_on_q, test_on_q, next_q} <= '0;
    end else begin
      if (at_least_full_i) begin
        full_q <= limit;
        {hold_on_q, test_on_q} <= 2'b00;
        next_q <= 2'd1;
      end
      if (at_least_hold_i) begin
        hold_q    <= limit;
        hold_on_q <= derated_i;
        next_q    <= 2'd2;
      end
      if (at_least_test_i) begin
        test_q    <= limit;
        test_on_q <= testing_i;
        next_q    <= 2'd0;
      end
    end
  end
  always_comb begin
    assume (3'(at_least_full_i) + 3'(at_least_hold_i) + 3'(at_least_test_i) <= 3'd1);
    assume (!at_least_full_i || next_q == 2'd0);
    assume (!at_least_hold_i || next_q == 2'd1);
    assume (!at_least_test_i || next_q == 2'd2);
    least = full_q;
    if (hold_on_q && hold_q < least) least = hold_q;
    if (test_on_q && test_q < least) least = test_q;
  end

  // The word of an address, whichever that is, as it was written last.
  logic past_ok_q;
  logic [8:0] address_q, wanted_q;
  logic [31:0] word_q, word_then_q, read_word_q;
  logic fetched_q, flipped_q, read_q;
  logic [5:0] flip_q;
  logic [8:0] wanted;
  initial past_ok_q = 1'b0;
  always_comb begin
    if (scene_slot_fetch_i) wanted = {scene_i, slot_fetch_i[4:0]};
    else if (slot_fetch_i == 6'(feltgate_map_pkg::PARAM_AT_VOLTAGE_GAIN) && region_high_i)
      wanted = 9'(feltgate_map_pkg::PARAM_AT_VOLTAGE_GAIN_HIGH);
    else if (slot_fetch_i == 6'(feltgate_map_pkg::EVENT_AT_LEAST_TEST))
      wanted = 9'(feltgate_map_pkg::PARAM_AT_SELF_TEST_TORQUE);
    else if (slot_fetch_i == 6'(feltgate_map_pkg::EVENT_AT_LEAST_HOLD))
      wanted = 9'(feltgate_map_pkg::PARAM_AT_HOLD_LIMIT);
    else if (slot_fetch_i == 6'(feltgate_map_pkg::EVENT_AT_LEAST_FULL))
      wanted = 9'(feltgate_map_pkg::PARAM_AT_TORQUE_LIMIT);
    else if (slot_fetch_i == 6'(feltgate_map_pkg::PARAM_AT_TORQUE_LIMIT)) wanted = {3'd0, \u_dut.least_at_q };
    else wanted = {3'd0, slot_fetch_i};
  end
  (* hierconn *) wire [8:0] \u_dut.fetch_address ;
  always_ff @(posedge clk_i) begin
    past_ok_q   <= 1'b1;
    address_q   <= address_q;
    if (lands && \u_dut.address_q == address_q) word_q <= \u_dut.written [31:0];
    word_then_q <= word_q;
    fetched_q   <= \u_dut.fetch_address == address_q && !lands;
    wanted_q    <= wanted;
    flipped_q   <= breaks_i && !(tick_i && to_parameter);
    flip_q      <= broken_i;
    read_q      <= reg_addr_i[8:0] == address_q && !lands;
    read_word_q <= word_q;
  end

  // A write that was taken and waits.
  logic pending_q, taken, to_parameter, to_control, to_command, refuse, holds, common, scene_word;
  logic [11:0] at_q;
  logic [31:0] data_q;
  assign taken        = reg_write_i && !busy;
  assign to_parameter = pending_q && at_q < 12'h200;
  assign to_control   = pending_q && at_q == feltgate_map_pkg::A_CONTROL;
  assign to_command   = pending_q && at_q == feltgate_map_pkg::A_COMMAND;
  assign common       = at_q[11:6] == 6'd0;
  assign refuse       = armed_i && common && feltgate_map_pkg::REFUSED_WHILE_ARMED[at_q[5:0]];
  assign scene_word   = !common && at_q[8:5] == scene_i && !feltgate_map_pkg::INPUT_SCENES[scene_i];
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) pending_q <= 1'b0;
    else if (taken) begin
      pending_q <= 1'b1;
      at_q      <= reg_addr_i;
      data_q    <= fitted(reg_addr_i, reg_wdata_i);
    end else if (tick_i) pending_q <= 1'b0;
  end

  logic has_sign, saturated_q, saturated_q2;
  logic [31:0] above;  // bits above the format of the word that is written
  assign {has_sign, above} = feltgate_pkg::parameter_above(\u_dut.address_q );
  always_ff @(posedge clk_i) saturated_q2 <= saturated_q;

  // Whether the last parameter that was taken fitted.
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) saturated_q <= 1'b0;
    else if (taken && reg_addr_i < 12'h200) saturated_q <= fitted(reg_addr_i, reg_wdata_i) != reg_wdata_i;
  end

  // A disarm, a stop and a zero that were asked for in this tick, taken or not.
  logic disarm_due_q, stop_due_q, zero_due_q, disarms, stops;
  assign disarms = reg_write_i && reg_addr_i == feltgate_map_pkg::A_CONTROL &&
                   reg_wdata_i[feltgate_map_pkg::B_CONTROL_HOST] && !reg_wdata_i[feltgate_map_pkg::B_CONTROL_ARM];
  assign stops   = reg_write_i && reg_addr_i == feltgate_map_pkg::A_COMMAND &&
                   reg_wdata_i[feltgate_map_pkg::B_COMMAND_STOP];
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) {disarm_due_q, stop_due_q, zero_due_q} <= 3'b000;
    else begin
      disarm_due_q <= disarms || (disarm_due_q && !tick_i);
      stop_due_q   <= stops || (stop_due_q && !tick_i);
      zero_due_q   <= set_zero_i || (zero_due_q && !tick_i);
    end
  end
  assign holds = armed_i && !disarm_due_q;

  // What the last clock had, and whether it was one after the reset.
  logic after_q, tick_q, control_due_q, holds_q, polarity_holds_q, disarmed_q, parameter_due_q, refuse_q, refused_q, bank_q;
  logic frozen_q, command_q;
  logic [ControlW-1:0] control_q;
  logic [31:0] data_then_q;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) after_q <= 1'b0;
    else after_q <= 1'b1;
  end
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) frozen_q <= 1'b0;
    else if (tick_i && to_command)
      frozen_q <= data_q[feltgate_map_pkg::B_COMMAND_FREEZE] || (frozen_q && !data_q[feltgate_map_pkg::B_COMMAND_THAW]);
  end
  logic frozen_then_q;
  always_ff @(posedge clk_i) begin
    tick_q          <= tick_i;
    control_due_q   <= tick_i && to_control;
    parameter_due_q <= tick_i && to_parameter;
    refuse_q        <= refuse;
    refused_q       <= refused;
    holds_q         <= holds;
    polarity_holds_q <= polarity_holds_i;
    disarmed_q      <= tick_i && disarm_due_q;
    control_q       <= control;
    data_then_q     <= data_q;
    bank_q          <= \u_dut.g_read.write_bank_q ;
    frozen_then_q   <= frozen_q;
  end
  logic [ControlW-1:0] wanted_control;
  always_comb begin
    wanted_control = control_q;
    if (control_due_q) begin
      wanted_control[Held-1:0] = data_then_q[Held-1:0];
      if (!holds_q) wanted_control[ControlW-1:Held] = data_then_q[ControlW-1:Held];
      if (polarity_holds_q)
        wanted_control[feltgate_map_pkg::B_CONTROL_ENCODER_POLARITY] = control_q[feltgate_map_pkg::B_CONTROL_ENCODER_POLARITY];
    end
    if (disarmed_q) begin
      wanted_control[feltgate_map_pkg::B_CONTROL_HOST] = 1'b1;
      wanted_control[feltgate_map_pkg::B_CONTROL_ARM]  = 1'b0;
    end
  end

  // Reads: three clocks from the address, the last two here.
  logic [11:0] read_at_q, read_at_q2, read_at_q3;
  logic [31:0] read_q2_word, read_q3_word, snapshot_q2, snapshot_q3;
  logic [ControlW-1:0] control_q2;
  logic read_q2, read_q3;
  logic [3:0] clocks_q;  // since the reset, up to 15
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) clocks_q <= '0;
    else if (clocks_q != '1) clocks_q <= clocks_q + 4'd1;
  end
  always_ff @(posedge clk_i) begin
    read_at_q    <= reg_addr_i;
    read_at_q2   <= read_at_q;
    read_at_q3   <= read_at_q2;
    read_q2      <= read_q;
    read_q3      <= read_q2;
    read_q2_word <= read_word_q;
    read_q3_word <= read_q2_word;
    snapshot_q2  <= \u_dut.g_read.snapshot_q ;
    snapshot_q3  <= snapshot_q2;
  end

  // The parameter bus: two clocks from the slot; its error one later.
  logic fetched_q2, flipped_q2, flipped_q3, lands_q, lands_q2, lands_q3;
  logic [31:0] word_q2;
  always_ff @(posedge clk_i) begin
    fetched_q2 <= fetched_q && !flipped_q;
    word_q2    <= word_then_q;
    flipped_q2 <= flipped_q;
    flipped_q3 <= flipped_q2;
    lands_q    <= tick_i && \u_dut.to_parameter_q ;
    lands_q2   <= lands_q;
    lands_q3   <= lands_q2;
  end

  logic [35:0] returned;
  assign returned = \u_dut.fetch_q ^ (flipped_q ? 36'd1 << flip_q : 36'd0);
  always_comb begin
    if (!past_ok_q) assume (!rst_ni);
    assume (broken_i < 6'd36);
    // What the RAM returns: the word that was written last, whose check fits but for a bit that breaks.
    if (past_ok_q && !lands_q) assume (returned[35:32] == check_of(returned[31:0]));
    if (past_ok_q && fetched_q) assume (returned[31:0] == word_then_q);
    if (past_ok_q && read_q) assume (\u_dut.g_read.parameter_q [31:0] == read_word_q);
  end

  always_comb begin
    if (past_ok_q) begin
      written_word_fits: assert (!lands || \u_dut.written == {check_of(data_q), data_q});
      slot_is_its_word: assert (\u_dut.fetch_address == wanted);
    end
    if (past_ok_q && rst_ni) begin
      lands_once: assert (lands == (tick_i && to_parameter && !refuse));
      lands_as_taken: assert (!lands || (\u_dut.address_q == at_q[8:0] && \u_dut.written [31:0] == data_q));
      busy_while_it_waits: assert (busy == (to_parameter || to_control || to_command));
      disarm_passes: assert (disarm == disarm_due_q);
      stop_passes: assert (stop == stop_due_q);
      commands_once: assert (clear_faults == (tick_i && to_command &&
          data_q[feltgate_map_pkg::B_COMMAND_CLEAR_FAULTS]) &&
                             kick == (tick_i && to_command && data_q[feltgate_map_pkg::B_COMMAND_KICK]));
      zero_once: assert (set_zero == (tick_i && (zero_due_q || (to_command &&
          data_q[feltgate_map_pkg::B_COMMAND_SET_ZERO]))));
      jumps_restart: assert (restart == (tick_i && ((set_zero && !feltgate_map_pkg::INPUT_SCENES[scene_i]) ||
          (to_parameter && (common ? feltgate_map_pkg::RAMPS_WHILE_ARMED[at_q[5:0]] : scene_word)))));
      fits_its_format: assert (!lands || (\u_dut.written [31:0] & above) ==
                               (has_sign && \u_dut.written [31] ? above : 32'd0));
      saturated_is_told: assert (saturated == saturated_q);
      limit_is_the_least: assert (least_at == 6'(feltgate_map_pkg::PARAM_AT_TORQUE_LIMIT) ? full_q == least :
                                  least_at == 6'(feltgate_map_pkg::PARAM_AT_HOLD_LIMIT) ? hold_on_q && hold_q == least :
                                  least_at == 6'(feltgate_map_pkg::PARAM_AT_SELF_TEST_TORQUE) && test_on_q && test_q == least);
      inside_least: assert (\u_dut.least_q == least);
      inside_fits: assert (!to_parameter || fitted(at_q, data_q) == data_q);
      inside_due: assert (next_q == 2'd0 || (!test_on_q && (next_q == 2'd2 || (next_q == 2'd1 && !hold_on_q))));
      banks_apart: assert (\u_dut.g_read.read_bank != \u_dut.g_read.write_bank_q );
      inside_taken: assert (\u_dut.to_parameter_q == to_parameter && \u_dut.to_control_q == to_control &&
                            \u_dut.to_command_q == to_command);
      inside_data: assert (!busy || (\u_dut.address_q == at_q[8:0] && \u_dut.data_q == data_q));
      inside_frozen: assert (\u_dut.g_read.frozen_q == frozen_q);
      inside_zero: assert (\u_dut.zero_q == zero_due_q);
      inside_parity: assert (\u_dut.held_check_q == ^control[ControlW-1:Held]);
      if (after_q) begin
        control_by_writes_only: assert (control == wanted_control);
        disarm_lands: assert (!disarmed_q || (control[feltgate_map_pkg::B_CONTROL_HOST] &&
                                              !control[feltgate_map_pkg::B_CONTROL_ARM]));
        held_while_armed: assert (!holds_q || control[ControlW-1:Held] == control_q[ControlW-1:Held]);
        polarity_holds: assert (!polarity_holds_q || control[feltgate_map_pkg::B_CONTROL_ENCODER_POLARITY] ==
                                control_q[feltgate_map_pkg::B_CONTROL_ENCODER_POLARITY]);
        refused_is_told: assert (refused == (parameter_due_q ? refuse_q : refused_q));
        banks_swap_with_the_tick: assert ((\u_dut.g_read.write_bank_q != bank_q) == (tick_q && !frozen_then_q));
      end
      if (clocks_q >= 4'd3) begin
        param_is_the_word: assert (!fetched_q2 || param == word_q2);
        reads_the_word: assert (!read_q3 || read_at_q3 >= 12'h200 || rdata == read_q3_word);
        reads_the_control_word: assert (read_at_q3 != feltgate_map_pkg::A_CONTROL || rdata == 32'(control_q));
        reads_the_snapshot: assert (read_at_q3[11:6] != feltgate_map_pkg::A_SNAPSHOT[11:6] || rdata == snapshot_q3);
        reads_nothing_else: assert (read_at_q3 < 12'h200 || read_at_q3 == feltgate_map_pkg::A_CONTROL ||
                                    read_at_q3[11:6] == feltgate_map_pkg::A_SNAPSHOT[11:6] || rdata == 32'd0);
        broken_bit_is_seen: assert (!flipped_q3 || word_error);
        whole_words_pass: assert (flipped_q3 || lands_q3 || !word_error);
      end
      saturates: cover (saturated && !saturated_q2);
      least_of_three: cover (hold_on_q && test_on_q && test_q < hold_q && hold_q < full_q &&
                             least_at == 6'(feltgate_map_pkg::PARAM_AT_SELF_TEST_TORQUE));
      lands_armed: cover (lands && armed_i);
      refuses: cover (refused && !refused_q);
      disarms_while_busy: cover (disarmed_q && control_due_q && holds_q == 1'b0);
      fetches: cover (fetched_q2 && clocks_q >= 4'd3 && param != 32'd0);
    end
  end
endmodule

`default_nettype wire
