// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Register port, parameter RAM (512 x 32), control word, commands and the double-buffered snapshot.
// A write is taken in a clock in which reg_write_i is high and reg_busy_o low, and takes effect at
// tick_i; a disarm and a stop pass one that waits. param_o follows slot_fetch_i by 2 clocks,
// reg_rdata_o follows reg_addr_i by 3. Documentation: docs/blocks/registers.md
`default_nettype none

module registers #(
  parameter int ReadBack = 1,  // 0: no snapshot, reads give 0
  parameter ParameterFile = ""  // what $readmemh fills the parameters from; "": the package
) (
  input  logic        clk_i,
  input  logic        rst_ni,
  input  logic        tick_i,              // last clock of a tick

  input  logic [11:0] reg_addr_i,
  input  logic [31:0] reg_wdata_i,
  input  logic        reg_write_i,         // held, with address and data, until it is taken
  output logic [31:0] reg_rdata_o,
  output logic        reg_busy_o,          // a write waits for the end of the tick; none is taken

  input  logic        armed_i,             // or about to be, in the clock of tick_i
  input  logic        set_zero_i,          // the panel's, one clock
  input  logic [5:0]  slot_fetch_i,
  input  logic        scene_slot_fetch_i,
  input  logic [3:0]  scene_i,             // the bank of the scene in force; not 1
  input  logic        region_high_i,       // the voltage gain is that of high torque
  input  logic        eased_i,             // the torque limit is hold_limit
  input  logic        testing_i,           // the torque limit is the self-test's torque
  output logic [31:0] param_o,
  output logic        word_error_o,        // the word on the bus, or a held control bit, has changed by itself

  output logic [feltgate_map_pkg::W_CONTROL-1:0] control_o,
  output logic        set_zero_o,          // commands: high in the clock of tick_i; also the panel's
  output logic        clear_faults_o,
  output logic        kick_o,
  output logic        disarm_o,            // written on the port since the end of the last tick
  output logic        stop_o,              // likewise
  output logic        restart_o,           // in the clock of tick_i: by this the torque may jump
  output logic        refused_o,           // the last parameter was refused, for the core was armed

  input  logic [5:0]  snap_slot_i,
  input  logic        snap_valid_i,
  input  logic [31:0] snap_data_i
);

  localparam logic [5:0] LOW  = 6'(feltgate_map_pkg::S_VOLTAGE_GAIN);
  localparam logic [5:0] HIGH = 6'(feltgate_map_pkg::S_VOLTAGE_GAIN_HIGH);
  localparam logic [5:0] FULL  = 6'(feltgate_map_pkg::S_TORQUE_LIMIT);
  localparam logic [5:0] EASED = 6'(feltgate_map_pkg::S_HOLD_LIMIT);
  localparam logic [5:0] TEST  = 6'(feltgate_map_pkg::S_SELF_TEST_TORQUE);

  // The waiting write: where it goes (none set: nothing waits), and its word.
  logic        to_parameter_q, to_control_q, to_command_q;
  logic        at_parameter, at_control, at_command, disarms, stops, holds;
  logic        common, refuses, ramps, input_scene, zero_q;
  logic [8:0]  address_q;
  logic [31:0] data_q;

  assign at_parameter = reg_addr_i[11:9] == 3'd0;
  assign at_control   = reg_addr_i == feltgate_map_pkg::A_CONTROL;
  assign at_command   = reg_addr_i == feltgate_map_pkg::A_COMMAND;
  assign reg_busy_o   = to_parameter_q || to_control_q || to_command_q;

  // What passes a waiting write acts as soon as it is on the port, taken or not.
  assign disarms = reg_write_i && at_control && reg_wdata_i[feltgate_map_pkg::B_CONTROL_HOST] &&
                   !reg_wdata_i[feltgate_map_pkg::B_CONTROL_ARM];
  assign stops   = reg_write_i && at_command && reg_wdata_i[feltgate_map_pkg::B_COMMAND_STOP];

  // While the motor is armed, the control word's fields from HELD on keep what is in force, and a
  // parameter by which the torque would jump past the ramp is refused.
  localparam int HELD = feltgate_map_pkg::B_CONTROL_MODE;
  localparam logic [feltgate_map_pkg::W_CONTROL-1:0] CONTROL_RESET =
      feltgate_map_pkg::W_CONTROL'(feltgate_pkg::CONTROL_RESET);
  logic held_check_q;  // the parity of the held fields as they were written
  assign holds   = armed_i && !disarm_o;
  assign common  = address_q[8:6] == 3'd0;
  assign refuses = armed_i && common && feltgate_map_pkg::REFUSED_WHILE_ARMED[address_q[5:0]];
  assign ramps   = common ? feltgate_map_pkg::RAMPS_WHILE_ARMED[address_q[5:0]]
                          : address_q[8:5] == scene_i && !input_scene;
  assign input_scene = feltgate_map_pkg::INPUT_SCENES[scene_i];  // it does not ask for the position
  assign restart_o   = (set_zero_o && !input_scene) || (tick_i && to_parameter_q && ramps);

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
      control_o      <= CONTROL_RESET;
      held_check_q   <= ^CONTROL_RESET[feltgate_map_pkg::W_CONTROL-1:HELD];
    end else begin
      if (reg_write_i && !reg_busy_o) begin
        to_parameter_q <= at_parameter;
        to_control_q   <= at_control;
        to_command_q   <= at_command;
        address_q      <= reg_addr_i[8:0];
        data_q         <= reg_wdata_i;
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
          control_o[feltgate_map_pkg::W_CONTROL-1:HELD] <= data_q[feltgate_map_pkg::W_CONTROL-1:HELD];
          held_check_q <= ^data_q[feltgate_map_pkg::W_CONTROL-1:HELD];
        end
      end
      if (tick_i && disarm_o) begin  // also against an arm that waits
        control_o[feltgate_map_pkg::B_CONTROL_HOST] <= 1'b1;
        control_o[feltgate_map_pkg::B_CONTROL_ARM]  <= 1'b0;
      end
    end
  end

  assign set_zero_o     = tick_i && (zero_q || (to_command_q && data_q[feltgate_map_pkg::B_COMMAND_SET_ZERO]));
  assign clear_faults_o = tick_i && to_command_q && data_q[feltgate_map_pkg::B_COMMAND_CLEAR_FAULTS];
  assign kick_o         = tick_i && to_command_q && data_q[feltgate_map_pkg::B_COMMAND_KICK];

  // A word's check: the parity of every fourth bit, from bit k on. A single bit that flips, of word or
  // check, breaks one of them; so does a memory whose bits all read 0, or all 1.
  function automatic logic [3:0] check_of(input logic [31:0] word);
    logic [15:0] half;
    logic [7:0]  quarter;
    half     = word[31:16] ^ word[15:0];
    quarter  = half[15:8] ^ half[7:0];
    check_of = quarter[7:4] ^ quarter[3:0] ^ 4'b0101;
  endfunction

  // Parameter RAM, each word with its check. It keeps what was written through a reset; only
  // configuration loads the values of the design. A word is written in a clock in which no block
  // fetches a word of its own, so what a block RAM returns for a read of it then does not matter.
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
  always @(posedge clk_i) begin  // not always_ff: the values of the design are written by another process
    if (lands) parameter_ram[address_q] <= written;
  end

  logic        high, eased, test;
  logic [8:0]  fetch_address;
  logic [35:0] fetch_q;
  logic [ 3:0] check_q;                // of the word on the bus
  logic        written_q, written_q2;  // fetched while a word was written: it may be any
  logic        warm_q;  // keeps what the RAM's own, unreset output register held off the bus

  assign high = region_high_i && slot_fetch_i == LOW;
  assign eased = eased_i && slot_fetch_i == FULL;
  assign test = testing_i && slot_fetch_i == FULL;
  assign fetch_address = scene_slot_fetch_i ? {scene_i, slot_fetch_i[4:0]}
                       : {3'b000, high ? HIGH : test ? TEST : eased ? EASED : slot_fetch_i};

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
    // Words of the running tick go to bank write_bank_q, the port reads the other bank.
    (* no_rw_check, ram_style = "block", ramstyle = "no_rw_check" *)
    logic [31:0] snapshot_ram [0:127];
    logic        write_bank_q, frozen_q, read_bank;
    /* verilator lint_off UNUSEDSIGNAL */  // the check stays behind
    logic [35:0] parameter_q;
    /* verilator lint_on UNUSEDSIGNAL */
    logic [31:0] parameter_q2, snapshot_q, snapshot_q2;
    logic        at_snapshot;
    // Where the addressed word is: 1 parameter, 2 snapshot, 3 control, 0 nowhere.
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
        // The tick that a freeze ends is the one that is held.
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
