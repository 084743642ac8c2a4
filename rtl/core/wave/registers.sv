// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Register port, parameter RAM (512 x 32), control word, commands and the double-buffered snapshot.
// A write is accepted in a clock with reg_write_i high and reg_busy_o low, and takes effect at
// tick_i; a parameter saturates to its format. A disarm and a stop do not wait for an earlier write.
// Latency: param_o follows slot_fetch_i by 2 clocks, reg_rdata_o follows reg_addr_i by 3.
// Documentation: docs/architecture.md
`default_nettype none

module registers #(
  parameter int ReadBack = 1,  // 0: no snapshot, reads give 0
  parameter ParameterFile = ""  // $readmemh file of the parameters; "": values of the package
) (
  input  logic        clk_i,
  input  logic        rst_ni,
  input  logic        tick_i,              // last clock of a tick

  input  logic [11:0] reg_addr_i,
  input  logic [31:0] reg_wdata_i,
  input  logic        reg_write_i,         // held with address and data until accepted
  output logic [31:0] reg_rdata_o,
  output logic        reg_busy_o,          // a write waits for tick_i; no other is accepted

  input  logic        armed_i,             // armed, or armed from the next clock on
  input  logic        polarity_holds_i,    // encoder_polarity keeps its value
  input  logic        set_zero_i,          // from the panel, one clock
  input  logic [5:0]  slot_fetch_i,
  input  logic        scene_slot_fetch_i,
  input  logic [3:0]  scene_i,             // bank of the active scene; never 1
  input  logic        region_high_i,       // 1: read voltage_gain_high for voltage_gain
  input  logic        at_least_full_i,     // clocks in which the limits of the torque are on the bus
  input  logic        at_least_hold_i,
  input  logic        at_least_test_i,
  input  logic        derated_i,           // 1: hold_limit limits too
  input  logic        testing_i,           // 1: the self-test's torque limits too
  output logic [31:0] param_o,
  output logic        word_error_o,        // check error of the word on the bus or of the held control bits

  output logic [feltgate_map_pkg::W_CONTROL-1:0] control_o,
  output logic        set_zero_o,          // commands, high with tick_i; also from the panel
  output logic        clear_faults_o,
  output logic        kick_o,
  output logic        disarm_o,            // a disarm was written since the end of the last tick
  output logic        stop_o,              // a stop was written, likewise
  output logic        restart_o,           // in the clock of tick_i: this change starts the ramp
  output logic        refused_o,           // the last parameter write was refused: armed
  output logic        saturated_o,         // the last parameter written did not fit its format

  input  logic [5:0]  snap_slot_i,
  input  logic        snap_valid_i,
  input  logic [31:0] snap_data_i
);

  localparam logic [5:0] LOW  = 6'(feltgate_map_pkg::PARAM_AT_VOLTAGE_GAIN);
  localparam logic [5:0] HIGH = 6'(feltgate_map_pkg::PARAM_AT_VOLTAGE_GAIN_HIGH);
  localparam logic [5:0] FULL = 6'(feltgate_map_pkg::PARAM_AT_TORQUE_LIMIT);
  localparam logic [5:0] HOLD = 6'(feltgate_map_pkg::PARAM_AT_HOLD_LIMIT);
  localparam logic [5:0] TEST = 6'(feltgate_map_pkg::PARAM_AT_SELF_TEST_TORQUE);

  // The waiting write: its target (no bit set: nothing waits), address and data.
  logic        to_parameter_q, to_control_q, to_command_q;
  logic        at_parameter, at_control, at_command, disarms, stops, holds;
  logic        common, refuses, ramps, input_scene, zero_q;
  logic [8:0]  address_q;
  logic [31:0] data_q;

  assign at_parameter = reg_addr_i[11:9] == 3'd0;
  assign at_control   = reg_addr_i == feltgate_map_pkg::A_CONTROL;
  assign at_command   = reg_addr_i == feltgate_map_pkg::A_COMMAND;
  assign reg_busy_o   = to_parameter_q || to_control_q || to_command_q;

  // A disarm and a stop act as soon as they are on the port, also while another write waits.
  assign disarms = reg_write_i && at_control && reg_wdata_i[feltgate_map_pkg::B_CONTROL_HOST] &&
                   !reg_wdata_i[feltgate_map_pkg::B_CONTROL_ARM];
  assign stops   = reg_write_i && at_command && reg_wdata_i[feltgate_map_pkg::B_COMMAND_STOP];

  // A parameter that does not fit its format becomes the nearest value that does. Bits of `above` lie above the
  // format: they equal the sign, or without a sign 0.
  logic        has_sign, negative, misfit;
  logic [31:0] above, fitted;
  assign {has_sign, above} = at_parameter ? feltgate_pkg::parameter_above(reg_addr_i[8:0]) : 33'd0;
  assign negative = has_sign && reg_wdata_i[31];
  assign misfit   = ((reg_wdata_i ^ {32{negative}}) & above) != 32'd0;
  assign fitted   = !misfit ? reg_wdata_i : negative ? above : reg_wdata_i[31] ? 32'd0 : ~above;

  // While armed, the fields of the control word from bit HELD on keep their values, and a parameter
  // that would make the torque jump without the ramp is refused.
  localparam int HELD = feltgate_map_pkg::B_CONTROL_MODE;
  localparam logic [feltgate_map_pkg::W_CONTROL-1:0] CONTROL_RESET =
      feltgate_map_pkg::W_CONTROL'(feltgate_pkg::CONTROL_RESET);
  logic held_check_q;  // parity of the held fields, stored with them
  assign holds   = armed_i && !disarm_o;
  assign common  = address_q[8:6] == 3'd0;
  assign refuses = armed_i && common && feltgate_map_pkg::REFUSED_WHILE_ARMED[address_q[5:0]];
  assign ramps   = common ? feltgate_map_pkg::RAMPS_WHILE_ARMED[address_q[5:0]]
                          : address_q[8:5] == scene_i && !input_scene;
  assign input_scene = feltgate_map_pkg::INPUT_SCENES[scene_i];  // independent of position
  assign restart_o   = (set_zero_o && !input_scene) || (tick_i && to_parameter_q && ramps);

  localparam logic [feltgate_map_pkg::W_CONTROL-1:0] POLARITY =
      feltgate_map_pkg::W_CONTROL'(1) << feltgate_map_pkg::B_CONTROL_ENCODER_POLARITY;
  logic [feltgate_map_pkg::W_CONTROL-1:HELD] held, kept;
  assign kept = POLARITY[feltgate_map_pkg::W_CONTROL-1:HELD] & {$bits(held){polarity_holds_i}};
  assign held = (data_q[feltgate_map_pkg::W_CONTROL-1:HELD] & ~kept) |
                (control_o[feltgate_map_pkg::W_CONTROL-1:HELD] & kept);

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      to_parameter_q <= 1'b0;
      to_control_q   <= 1'b0;
      to_command_q   <= 1'b0;
      address_q      <= 9'd0;
      data_q         <= 32'd0;
      disarm_o       <= 1'b0;
      stop_o         <= 1'b0;
      zero_q         <= 1'b0;
      refused_o      <= 1'b0;
      saturated_o    <= 1'b0;
      control_o      <= CONTROL_RESET;
      held_check_q   <= ^CONTROL_RESET[feltgate_map_pkg::W_CONTROL-1:HELD];
    end else begin
      if (reg_write_i && !reg_busy_o) begin
        to_parameter_q <= at_parameter;
        to_control_q   <= at_control;
        to_command_q   <= at_command;
        address_q      <= reg_addr_i[8:0];
        data_q         <= fitted;
        if (at_parameter) saturated_o <= misfit;
      end else if (tick_i) begin
        to_parameter_q <= 1'b0;
        to_control_q   <= 1'b0;
        to_command_q   <= 1'b0;
      end
      disarm_o <= disarms || (disarm_o && !tick_i);
      zero_q   <= set_zero_i || (zero_q && !tick_i);
      stop_o   <= stops || (stop_o && !tick_i);
      if (tick_i && to_parameter_q) refused_o <= refuses;
      if (tick_i && to_control_q) begin
        control_o[HELD-1:0] <= data_q[HELD-1:0];
        if (!holds) begin
          control_o[feltgate_map_pkg::W_CONTROL-1:HELD] <= held;
          held_check_q <= ^held;
        end
      end
      if (tick_i && disarm_o) begin  // wins over a waiting write that arms
        control_o[feltgate_map_pkg::B_CONTROL_HOST] <= 1'b1;
        control_o[feltgate_map_pkg::B_CONTROL_ARM]  <= 1'b0;
      end
    end
  end

  assign set_zero_o     = tick_i && (zero_q || (to_command_q && data_q[feltgate_map_pkg::B_COMMAND_SET_ZERO]));
  assign clear_faults_o = tick_i && to_command_q && data_q[feltgate_map_pkg::B_COMMAND_CLEAR_FAULTS];
  assign kick_o         = tick_i && to_command_q && data_q[feltgate_map_pkg::B_COMMAND_KICK];

  // Check bits of a word: bit k is the parity of every fourth bit from bit k on, two of them
  // inverted. They detect a single flipped bit of word or check, and a memory that reads all 0 or
  // all 1.
  function automatic logic [3:0] check_of(input logic [31:0] word);
    logic [15:0] half;
    logic [7:0]  quarter;
    half     = word[31:16] ^ word[15:0];
    quarter  = half[15:8] ^ half[7:0];
    check_of = quarter[7:4] ^ quarter[3:0] ^ 4'b0101;
  endfunction

  // Parameter RAM, each word with its check bits. A reset does not change it; only configuration
  // loads the design's values. A word is written in a clock in which no block fetches a word, so
  // the result of a read during the write does not matter.
  (* no_rw_check, ram_style = "block", ramstyle = "no_rw_check" *)
  logic [35:0] parameter_ram [0:511];

  generate
  if (ParameterFile != "") begin : g_values_file
    initial $readmemh(ParameterFile, parameter_ram);
  end else begin : g_values
    initial begin
      for (int i = 0; i < 512; i++) begin
        parameter_ram[i] = {check_of(feltgate_pkg::parameter_reset(9'(i))),
                            feltgate_pkg::parameter_reset(9'(i))};
      end
    end
  end
  endgenerate

  logic        lands;
  logic [35:0] written;
  assign lands   = tick_i && to_parameter_q && !refuses;
  assign written = {check_of(data_q), data_q};
  always @(posedge clk_i) begin  // not always_ff: the initial block writes it too
    if (lands) parameter_ram[address_q] <= written;
  end

  // The limit of the torque is the least of all that limit it. Each comes by once before the limiter takes
  // the limit; the word of the least is fetched for it.
  logic signed [feltgate_pkg::TORQUE_W-1:0] least_q, limit;
  logic [5:0] least_at_q;
  logic       lower;
  assign limit = param_o[feltgate_pkg::TORQUE_W-1:0];
  assign lower = limit < least_q && ((at_least_hold_i && derated_i) || (at_least_test_i && testing_i));
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      least_q    <= '0;
      least_at_q <= FULL;
    end else if (at_least_full_i || lower) begin
      least_q    <= limit;
      least_at_q <= at_least_full_i ? FULL : at_least_hold_i ? HOLD : TEST;
    end
  end

  logic [5:0]  fetch_slot;
  logic [8:0]  fetch_address;
  logic [35:0] fetch_q;
  logic [ 3:0] check_q;                // check bits of the word on the bus
  logic        written_q, written_q2;  // fetched during a write: data undefined, no check
  logic        warm_q;  // 0 for one clock: blocks the RAM's output register, which has no reset

  always_comb begin
    case (slot_fetch_i)
      LOW:     fetch_slot = region_high_i ? HIGH : LOW;
      FULL:    fetch_slot = least_at_q;
      6'(feltgate_map_pkg::EVENT_AT_LEAST_FULL): fetch_slot = FULL;
      6'(feltgate_map_pkg::EVENT_AT_LEAST_HOLD): fetch_slot = HOLD;
      6'(feltgate_map_pkg::EVENT_AT_LEAST_TEST): fetch_slot = TEST;
      default: fetch_slot = slot_fetch_i;
    endcase
  end
  assign fetch_address = scene_slot_fetch_i ? {scene_i, slot_fetch_i[4:0]} : {3'b000, fetch_slot};

  always_ff @(posedge clk_i) fetch_q <= parameter_ram[fetch_address];

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      warm_q       <= 1'b0;
      param_o      <= 32'd0;
      check_q      <= check_of(32'd0);
      written_q    <= 1'b0;
      written_q2   <= 1'b0;
      word_error_o <= 1'b0;
    end else begin
      warm_q <= 1'b1;
      if (warm_q) {check_q, param_o} <= fetch_q;
      written_q    <= tick_i && to_parameter_q;
      written_q2   <= written_q;
      word_error_o <= (check_q != check_of(param_o) && !written_q2) ||
                      held_check_q != ^control_o[feltgate_map_pkg::W_CONTROL-1:HELD];
    end
  end

  generate
  if (ReadBack != 0) begin : g_read
    // The words of the running tick go to bank write_bank_q; the port reads the other bank.
    (* no_rw_check, ram_style = "block", ramstyle = "no_rw_check" *)
    logic [31:0] snapshot_ram [0:127];
    logic        write_bank_q, frozen_q, read_bank;
    logic [35:0] parameter_q;
    logic [31:0] parameter_q2, snapshot_q, snapshot_q2;
    logic        at_snapshot;
    // Source of the addressed word: 1 parameter, 2 snapshot, 3 control, 0 none (reads 0).
    logic [1:0]  source_q, source_q2;

    initial begin
      for (int i = 0; i < 128; i++) snapshot_ram[i] = 32'd0;
    end

    assign read_bank   = !write_bank_q;
    assign at_snapshot = reg_addr_i[11:6] == feltgate_map_pkg::A_SNAPSHOT[11:6];

    always @(posedge clk_i) begin
      if (snap_valid_i) snapshot_ram[{write_bank_q, snap_slot_i}] <= snap_data_i;
    end
    always_ff @(posedge clk_i) snapshot_q <= snapshot_ram[{read_bank, reg_addr_i[5:0]}];
    always_ff @(posedge clk_i) parameter_q <= parameter_ram[reg_addr_i[8:0]];
    logic unused;
    assign unused = ^parameter_q;  // the check stays behind

    always_ff @(posedge clk_i or negedge rst_ni) begin
      if (!rst_ni) begin
        write_bank_q <= 1'b0;
        frozen_q     <= 1'b0;
        source_q     <= 2'd0;
        source_q2    <= 2'd0;
        parameter_q2 <= 32'd0;
        snapshot_q2  <= 32'd0;
        reg_rdata_o  <= 32'd0;
      end else begin
        // A freeze holds the snapshot of the tick at whose end it takes effect.
        if (tick_i && !frozen_q) write_bank_q <= !write_bank_q;
        if (tick_i && to_command_q) begin
          frozen_q <= data_q[feltgate_map_pkg::B_COMMAND_FREEZE] ||
                      (frozen_q && !data_q[feltgate_map_pkg::B_COMMAND_THAW]);
        end
        source_q  <= {at_snapshot || at_control, at_parameter || at_control};
        source_q2 <= source_q;
        if (warm_q) begin
          parameter_q2 <= parameter_q[31:0];
          snapshot_q2  <= snapshot_q;
        end
        case (source_q2)
          2'd1:    reg_rdata_o <= parameter_q2;
          2'd2:    reg_rdata_o <= snapshot_q2;
          2'd3:    reg_rdata_o <= 32'(control_o);
          default: reg_rdata_o <= 32'd0;
        endcase
      end
    end
  end else begin : g_write_only
    logic unused;
    assign unused      = ^{snap_slot_i, snap_valid_i, snap_data_i, data_q[31:feltgate_map_pkg::W_CONTROL]};
    assign reg_rdata_o = 32'd0;
  end
  endgenerate

endmodule

`default_nettype wire
