// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Connects the engine to the axes: its register port, the CRC check of the programs at each arming,
// and the request to ramp when a torque can jump. Timing: reg_rdata_o is valid 33 clocks after the
// address. docs/architecture.md

`default_nettype none

module axes_engine #(
    parameter int AxisCount = 1,
    // A law loaded at configuration, without a host: the files that `feltgate law --memories`
    // writes.
    parameter ProgramContent = "",
    parameter DataContent    = "",
    parameter TableContent   = "",
    parameter logic [feltgate_engine_pkg::RESET_BITS-1:0] Reset = feltgate_engine_pkg::RESET_EMPTY
) (
    input  logic clk_i,
    input  logic rst_ni,

    // Axes: axis n is bit n, or the n-th part from below.
    input  logic [AxisCount-1:0] law_i,          // the axis is in the scene of laws
    input  logic [AxisCount-1:0] arm_request_i,  // requests to arm, or to stay armed
    input  logic [AxisCount-1:0] armed_i,
    input  logic [AxisCount-1:0] zeroed_i,       // one clock: the position becomes 0
    input  logic sample_i,                  // one clock per tick: torque_o and late_o are taken
    input  logic measured_i,                // one clock per tick: the inputs below are new, held
    input  logic last_i,                    // last clock of a tick
    input  logic [31:0] tick_count_i,
    input  logic [32*AxisCount-1:0] position_i,
    input  logic [32*AxisCount-1:0] velocity_i,
    input  logic [32*AxisCount-1:0] tau_hat_i,
    output logic [AxisCount*cfg::TORQUE_W-1:0] torque_o,
    output logic late_o,                    // torque_o is too old or not checked
    output logic restart_o,                 // read in a tick's last clock: ramp from then on
    output logic unchecked_o,               // arming must wait for the CRC
    output logic unfit_o,                   // arming is refused: wrong CRC

    // Register port
    input  logic [15:0] reg_addr_i,
    input  logic [31:0] reg_wdata_i,
    input  logic        reg_write_i,
    input  logic        reg_read_i,         // one clock: the host has taken the word
    output logic        reg_busy_o,         // the engine is addressed and busy
    output logic [31:0] reg_rdata_o,

    // Events of programs
    output logic        event_valid_o,
    output logic [ 8:0] event_number_o,
    output logic [31:0] event_value_o
);
  logic law_any, law_any_q, all_ask, armed, armed_q, fresh, late, changed;
  logic engine_addressed, engine_busy;
  logic check, checks_q, check_of_these_q, checked_q, taken_checked_q, crc_done, crc_good;
  logic [31:0] engine_word;
  assign law_any = |law_i;
  assign all_ask = &arm_request_i;
  assign armed   = |armed_i;
  localparam logic [15:0] First = 16'(feltgate_engine_pkg::PORT_FIRST);
  assign engine_addressed = reg_addr_i[15:12] == First[15:12];

  // Arming waits until the CRC of the programs is computed and the axes have taken late_o, which says
  // whether it fits: unchecked_o acts like an axis that does not request arming, unfit_o then like one
  // that is not ready. Evaluated once per tick, because a request may come from a pin.
  assign check       = last_i && all_ask && !checked_q && !checks_q;
  assign unchecked_o = !taken_checked_q;
  assign unfit_o     = law_any && checked_q && !crc_good;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      checks_q         <= 1'b0;
      check_of_these_q <= 1'b0;
      checked_q        <= 1'b0;
      taken_checked_q  <= 1'b0;
    end else begin
      checks_q <= check || (checks_q && !crc_done);
      if (last_i && !all_ask) begin
        check_of_these_q <= 1'b0;
        checked_q        <= 1'b0;
        taken_checked_q  <= 1'b0;
      end else begin
        if (check) check_of_these_q <= 1'b1;
        if (crc_done && check_of_these_q) checked_q <= 1'b1;
        if (checked_q && sample_i) taken_checked_q <= 1'b1;
      end
    end
  end

  // restart_o is 1 from an event that can make the torque jump until a run that began after it has
  // ended and its torque was taken. A run may be in progress at the event, so the second run's
  // end counts.
  logic [1:0] runs_q;
  logic taken_q, jumps;
  assign jumps     = (law_any && !law_any_q) || (armed && !armed_q) || zeroed_i != '0 || changed;
  assign restart_o = runs_q != 2'd0 || !taken_q;
  assign late_o    = late || !crc_good;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      law_any_q <= 1'b0;
      armed_q   <= 1'b0;
      runs_q    <= '0;
      taken_q   <= 1'b1;
    end else begin
      law_any_q <= law_any;
      armed_q   <= armed;
      if (jumps) runs_q <= 2'd2;
      else if (fresh && runs_q != 2'd0) runs_q <= runs_q - 2'd1;
      taken_q   <= runs_q == 2'd0 && (taken_q || sample_i);
    end
  end

  // The engine's word is registered, so reg_rdata_o is valid 33 clocks after the address.
  assign reg_busy_o = engine_addressed && engine_busy;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) reg_rdata_o <= '0;
    else reg_rdata_o <= engine_addressed ? engine_word : '0;
  end

  localparam int AgeBit = feltgate_engine_pkg::B_RESET_MAX_AGE;
  localparam logic [15:0] MaxAge = Reset[AgeBit+:16] != 16'd0 ? Reset[AgeBit+:16] : 16'(cfg::ENGINE_MAX_AGE);
  engine #(
      .AxisCount(AxisCount),
      .ProgramContent(ProgramContent), .DataContent(DataContent), .TableContent(TableContent),
      .Reset({MaxAge, Reset[AgeBit-1:0]})
  ) u_engine (
      .clk_i(clk_i), .rst_ni(rst_ni),
      .armed_i(armed), .enter_i(law_any && !law_any_q), .locked_i(armed || all_ask || checks_q),
      .tick_i(measured_i), .tick_count_i(tick_count_i),
      .position_i(position_i), .velocity_i(velocity_i), .tau_hat_i(tau_hat_i),
      .torque_o(torque_o), .fresh_o(fresh), .late_o(late), .changed_o(changed),
      .crc_start_i(check), .crc_done_o(crc_done), .crc_good_o(crc_good),
      .event_valid_o(event_valid_o), .event_number_o(event_number_o), .event_value_o(event_value_o),
      .addr_i(reg_addr_i[11:0]), .wdata_i(reg_wdata_i), .write_i(reg_write_i && engine_addressed),
      .read_i(reg_read_i && engine_addressed), .rdata_o(engine_word), .busy_o(engine_busy)
  );
endmodule

`default_nettype wire
