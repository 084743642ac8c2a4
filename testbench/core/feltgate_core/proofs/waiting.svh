// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// What the register port was asked for, by its pins alone: the write that waits, how long the port has been
// busy, and a disarm, a stop and a zero of this tick, taken or not. For a wrapper with core.svh.

  logic pending_q, taken, to_parameter, to_control, to_command;
  logic [11:0] at_q;
  logic [31:0] data_q;
  logic [9:0] busy_q;  // clocks, up to this one
  assign taken        = reg_write_i && !busy;
  assign to_parameter = pending_q && at_q < 12'h200;
  assign to_control   = pending_q && at_q == feltgate_map_pkg::A_CONTROL;
  assign to_command   = pending_q && at_q == feltgate_map_pkg::A_COMMAND;
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
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) pending_q <= 1'b0;
    else if (taken) begin
      pending_q <= 1'b1;
      at_q      <= reg_addr_i;
      data_q    <= fitted(reg_addr_i, reg_wdata_i);
    end else if (last) pending_q <= 1'b0;
  end
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) busy_q <= 10'd0;
    else busy_q <= busy ? busy_q + 10'd1 : 10'd0;
  end

  logic disarms, stops, disarm_due_q, stop_due_q, zero_due_q;
  assign disarms = reg_write_i && reg_addr_i == feltgate_map_pkg::A_CONTROL &&
                   reg_wdata_i[feltgate_map_pkg::B_CONTROL_HOST] && !reg_wdata_i[feltgate_map_pkg::B_CONTROL_ARM];
  assign stops   = reg_write_i && reg_addr_i == feltgate_map_pkg::A_COMMAND &&
                   reg_wdata_i[feltgate_map_pkg::B_COMMAND_STOP];
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) {disarm_due_q, stop_due_q, zero_due_q} <= 3'b000;
    else begin
      disarm_due_q <= disarms || (disarm_due_q && !last);
      stop_due_q   <= stops || (stop_due_q && !last);
      zero_due_q   <= set_zero_i || (zero_due_q && !last);
    end
  end
