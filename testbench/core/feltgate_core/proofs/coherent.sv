// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The snapshot through the core: the words that the port gives are all of one tick, and they are what the pins
// show for that tick. Of one slot, whichever it is, the wrapper keeps what was stored; the RAM is taken out.
`default_nettype none

module coherent_proof (
    `include "core_inputs.svh"
);
  `include "reset.svh"
  `include "core.svh"
  `include "waiting.svh"

  (* hierconn *) wire \u_core.word_valid_o ;
  (* hierconn *) wire [5:0] \u_core.word_slot_o ;
  (* hierconn *) wire [31:0] \u_core.word_data_o ;
  (* hierconn *) wire [11:0] \u_core.u_wave.u_registers.reg_addr_i ;
  (* hierconn *) wire \u_core.u_wave.u_registers.to_parameter_q ;
  (* hierconn *) wire \u_core.u_wave.u_registers.to_control_q ;
  (* hierconn *) wire \u_core.u_wave.u_registers.to_command_q ;
  (* hierconn *) wire [31:0] \u_core.u_wave.u_registers.data_q ;
  (* hierconn *) wire \u_core.u_wave.u_registers.warm_q ;
  (* hierconn *) wire \u_core.u_wave.u_registers.snap_valid_i ;
  (* hierconn *) wire [5:0] \u_core.u_wave.u_registers.snap_slot_i ;
  (* hierconn *) wire [31:0] \u_core.u_wave.u_registers.snap_data_i ;
  (* hierconn *) wire \u_core.u_wave.u_registers.g_read.frozen_q ;
  (* hierconn *) wire \u_core.u_wave.u_registers.g_read.write_bank_q ;
  (* hierconn *) wire \u_core.u_wave.u_registers.g_read.read_bank ;
  (* hierconn *) wire [31:0] \u_core.u_wave.u_registers.g_read.snapshot_q ;
  (* hierconn *) wire [feltgate_pkg::VELOCITY_DIFFERENCE_W-1:0] \u_core.velocity_difference ;
  (* hierconn *) wire [feltgate_pkg::OBSERVER_DIFFERENCE_W-1:0] \u_core.observer_difference ;
  (* hierconn *) wire [feltgate_pkg::SCENE_DISTANCE_W-1:0] \u_core.distance ;
  wire valid = \u_core.word_valid_o ;
  wire [31:0] data = \u_core.word_data_o ;
  wire write_bank = \u_core.u_wave.u_registers.g_read.write_bank_q ;
  wire read_bank = \u_core.u_wave.u_registers.g_read.read_bank ;

  // What the blocks that are cut are proven to do.
  logic [L-1:0] wave_q;
  logic after_q;
  logic signed [feltgate_pkg::VELOCITY_W-1:0] velocity_q;
  logic signed [feltgate_pkg::TORQUE_W-1:0] tau_hat_q, tau_ref_q;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) after_q <= 1'b0;
    else after_q <= 1'b1;
  end
  always_ff @(posedge clk_i) begin
    wave_q     <= wave;
    velocity_q <= velocity;
    tau_hat_q  <= tau_hat;
    tau_ref_q  <= tau_ref;
  end
  always_comb begin
    if (rst_ni && (began_q || phase_q > 10'(First))) begin  // from the first sample on
      assume (wave[feltgate_map_pkg::PARAM_AT_VELOCITY_A1] || \u_core.velocity_difference == '0);
      assume (wave[feltgate_map_pkg::PARAM_AT_OBSERVER_A1] || \u_core.observer_difference == '0);
      assume (wave[feltgate_map_pkg::EVENT_AT_SCENE_DISTANCE+1] || wave[feltgate_map_pkg::EVENT_AT_SCENE_DISTANCE+2] ||
              \u_core.distance == '0);
    end
    if (rst_ni && after_q) begin
      assume (velocity == velocity_q || wave_q[feltgate_map_pkg::EVENT_AT_VELOCITY]);
      assume (tau_hat == tau_hat_q || wave_q[feltgate_map_pkg::EVENT_AT_TAU_HAT]);
      assume (tau_ref == tau_ref_q || wave_q[feltgate_map_pkg::EVENT_AT_TAU_REF]);
    end
  end

  // A slot of the snapshot, whichever it is, and its pin, where it has one.
  localparam logic [63:0] All = (64'd1 << feltgate_map_pkg::READ_AT_STATUS) | (64'd1 << feltgate_map_pkg::READ_AT_FAULTS) |
      (64'd1 << feltgate_map_pkg::READ_AT_POSITION) | (64'd1 << feltgate_map_pkg::READ_AT_TICK) |
      (64'd1 << feltgate_map_pkg::READ_AT_INDEX) | (64'd1 << feltgate_map_pkg::READ_AT_ENCODER) |
      (64'd1 << feltgate_map_pkg::READ_AT_VELOCITY) | (64'd1 << feltgate_map_pkg::READ_AT_TAU_HAT) |
      (64'd1 << feltgate_map_pkg::READ_AT_TAU_REF) | (64'd1 << feltgate_map_pkg::READ_AT_CURRENT_REF) |
      (64'd1 << feltgate_map_pkg::READ_AT_VOLTAGE) | (64'd1 << feltgate_map_pkg::READ_AT_DUTY);
  localparam logic signed [feltgate_pkg::VOLTAGE_W-1:0] Top = {1'b0, {(feltgate_pkg::VOLTAGE_W - 1) {1'b1}}};
  logic [5:0] slot_q;
  logic mapped, of_slot, has_pin;
  logic [31:0] pin, pin_q;
  always_ff @(posedge clk_i) slot_q <= slot_q;
  assign mapped  = All[slot_q];
  assign of_slot = valid && \u_core.word_slot_o == slot_q;
  always_comb begin
    has_pin = 1'b1;
    pin     = tick_count;
    case (slot_q)
      6'(feltgate_map_pkg::READ_AT_TICK):        ;
      6'(feltgate_map_pkg::READ_AT_POSITION):    pin = position;
      6'(feltgate_map_pkg::READ_AT_VELOCITY):    pin = 32'(velocity);
      6'(feltgate_map_pkg::READ_AT_TAU_HAT):     pin = 32'(tau_hat);
      6'(feltgate_map_pkg::READ_AT_TAU_REF):     pin = 32'(tau_ref);
      6'(feltgate_map_pkg::READ_AT_CURRENT_REF): pin = 32'(current_ref);
      6'(feltgate_map_pkg::READ_AT_VOLTAGE):     pin = 32'(voltage);
      6'(feltgate_map_pkg::READ_AT_DUTY):        pin = 32'(duty);
      default:                             has_pin = 1'b0;
    endcase
  end
  // A voltage beyond its port's format is at its end there.
  logic at_end;
  assign at_end = slot_q == 6'(feltgate_map_pkg::READ_AT_VOLTAGE) && (voltage == Top || voltage == ~Top);
  // After which clock of the wave it may change.
  logic changes;
  always_comb begin
    case (slot_q)
      6'(feltgate_map_pkg::READ_AT_TICK):        changes = last_q;
      6'(feltgate_map_pkg::READ_AT_POSITION):    changes = wave_q[feltgate_map_pkg::EVENT_AT_SAMPLE];
      6'(feltgate_map_pkg::READ_AT_VELOCITY):    changes = wave_q[feltgate_map_pkg::EVENT_AT_VELOCITY];
      6'(feltgate_map_pkg::READ_AT_TAU_HAT):     changes = wave_q[feltgate_map_pkg::EVENT_AT_TAU_HAT];
      6'(feltgate_map_pkg::READ_AT_TAU_REF):     changes = wave_q[feltgate_map_pkg::EVENT_AT_TAU_REF];
      6'(feltgate_map_pkg::READ_AT_CURRENT_REF): changes = wave_q[feltgate_map_pkg::EVENT_AT_CURRENT];
      6'(feltgate_map_pkg::READ_AT_VOLTAGE):     changes = wave_q[feltgate_map_pkg::EVENT_AT_VOLTAGE];
      default:                             changes = wave_q[feltgate_map_pkg::EVENT_AT_DUTY];
    endcase
  end

  // What was stored of it: in the tick that runs, in the last whole one that was not held off by a freeze, and in
  // the RAM's two banks.
  logic stored_q, shown_ok_q, frozen_q, last_q;
  logic [31:0] word_q, shown_q, bank_0_q, bank_1_q;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      stored_q   <= 1'b0;
      shown_ok_q <= 1'b0;
      frozen_q   <= 1'b0;
    end else begin
      stored_q <= !last && (stored_q || of_slot);
      if (last && !frozen_q) shown_ok_q <= 1'b1;
      if (last && to_command)
        frozen_q <= data_q[feltgate_map_pkg::B_COMMAND_FREEZE] ||
                    (frozen_q && !data_q[feltgate_map_pkg::B_COMMAND_THAW]);
    end
  end
  always_ff @(posedge clk_i) begin
    last_q <= last;
    pin_q  <= pin;
    if (of_slot) word_q <= data;
    if (last && !frozen_q) shown_q <= of_slot ? data : word_q;
    if (\u_core.u_wave.u_registers.snap_valid_i && \u_core.u_wave.u_registers.snap_slot_i == slot_q) begin
      if (write_bank) bank_1_q <= \u_core.u_wave.u_registers.snap_data_i ;
      else bank_0_q <= \u_core.u_wave.u_registers.snap_data_i ;
    end
  end

  // Reads, three clocks from the address.
  logic asked_q, read_q, read_q2, read_q3;
  logic [31:0] returned_q, read_word_q, read_word_q2, read_word_q3;
  logic [1:0] clocks_q;  // since the reset, up to 3
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) clocks_q <= 2'd0;
    else if (clocks_q != 2'd3) clocks_q <= clocks_q + 2'd1;
  end
  always_ff @(posedge clk_i) begin
    asked_q      <= \u_core.u_wave.u_registers.reg_addr_i [5:0] == slot_q;
    returned_q   <= read_bank ? bank_1_q : bank_0_q;
    read_q       <= mapped && shown_ok_q && reg_addr_i == (feltgate_map_pkg::A_SNAPSHOT | 12'(slot_q));
    read_q2      <= read_q;
    read_q3      <= read_q2;
    read_word_q  <= shown_q;
    read_word_q2 <= read_word_q;
    read_word_q3 <= read_word_q2;
  end
  always_comb if (past_ok_q && asked_q) assume (\u_core.u_wave.u_registers.g_read.snapshot_q == returned_q);

  always_comb begin
    if (past_ok_q && rst_ni) begin
      whole_in_its_tick: assert (!last || !mapped || stored_q || of_slot);
      word_is_the_pin: assert (!has_pin || at_end || ((!stored_q || word_q == pin) && (!of_slot || data == pin)));
      if (after_q) pin_in_its_clock: assert (!has_pin || pin == pin_q || changes);
      bank_of_the_last_tick: assert (!mapped || !shown_ok_q || (read_bank ? bank_1_q : bank_0_q) == shown_q);
      if (clocks_q == 2'd3) reads_the_last_tick: assert (!read_q3 || rdata == read_word_q3);
      pins_are_of_one_tick: assert (!snapshot_valid || !has_pin || stored_q || of_slot);
      inside_stored: assert (!mapped || (stored_q == (phase_q > 10'(slot_q) + 10'(First + 1)) &&
                                         of_slot == (phase_q == 10'(slot_q) + 10'(First + 1))));
      inside_bank: assert (!stored_q || (write_bank ? bank_1_q : bank_0_q) == word_q);
      inside_frozen: assert (\u_core.u_wave.u_registers.g_read.frozen_q == frozen_q);
      inside_taken: assert (\u_core.u_wave.u_registers.to_parameter_q == to_parameter &&
                            \u_core.u_wave.u_registers.to_control_q == to_control &&
                            \u_core.u_wave.u_registers.to_command_q == to_command);
      inside_data: assert (!busy || \u_core.u_wave.u_registers.data_q == data_q);
      inside_warm: assert (\u_core.u_wave.u_registers.warm_q == (clocks_q != 2'd0));
      inside_shown: assert (!shown_ok_q || began_q);
      stores_the_position: cover (of_slot && slot_q == 6'(feltgate_map_pkg::READ_AT_POSITION) && data != 32'd0);
      stores_the_velocity: cover (of_slot && slot_q == 6'(feltgate_map_pkg::READ_AT_VELOCITY) && data[31]);
    end
  end
endmodule

`default_nettype wire
