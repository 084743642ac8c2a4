// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// AXI4-Lite slave on the core's register port; every bus output comes from a register. A read uses
// the port for one clock; a write that still waits for the core leaves the port in that clock. Read
// data comes three clocks after the address. Documentation: docs/other-tools.md
`default_nettype none

module axi_lite_port (
  input  logic        clk_i,
  input  logic        rst_ni,

  input  logic        awvalid_i,
  output logic        awready_o,
  input  logic [13:0] awaddr_i,     // byte address
  input  logic        wvalid_i,
  output logic        wready_o,
  input  logic [31:0] wdata_i,
  input  logic [ 3:0] wstrb_i,
  output logic        bvalid_o,
  input  logic        bready_i,
  output logic [ 1:0] bresp_o,      // 0 OKAY, 2 SLVERR: no effect

  input  logic        arvalid_i,
  output logic        arready_o,
  input  logic [13:0] araddr_i,
  output logic        rvalid_o,
  input  logic        rready_i,
  output logic [31:0] rdata_o,
  output logic [ 1:0] rresp_o,

  output logic [11:0] reg_addr_o,
  output logic [31:0] reg_wdata_o,
  output logic        reg_write_o,
  input  logic [31:0] reg_rdata_i,  // three clocks after the address
  input  logic        reg_busy_i
);

  // 1: an existing word that can be written, at a word-aligned address.
  function automatic logic is_word(input logic [13:0] addr);
    is_word = addr[1:0] == 2'd0 && (addr[13:11] == 3'd0 || addr[13:2] == map::A_CONTROL ||
                                    addr[13:2] == map::A_COMMAND);
  endfunction

  // aw_q, w_q, ar_q: requests that wait for the port. b_q, r_q: responses that wait for the master.
  logic aw_q, aw_good_q, w_q, w_good_q, b_q, b_good_q, ar_q, ar_good_q, r_q, r_good_q;
  logic [11:0] aw_addr_q, ar_addr_q;
  logic [2:0]  reading_q;
  logic whole, offers, ends, asks, fetches;

  assign awready_o = !aw_q;
  assign wready_o  = !w_q;
  assign arready_o = !ar_q;
  assign bvalid_o  = b_q;
  assign bresp_o   = {!b_good_q, 1'b0};
  assign rvalid_o  = r_q;
  assign rresp_o   = {!r_good_q, 1'b0};

  assign whole   = aw_q && w_q && !b_q;
  assign offers  = whole && aw_good_q && w_good_q;
  assign ends    = whole && (!offers || (!reg_busy_i && !fetches));
  assign asks    = ar_q && !r_q && reading_q == 3'd0;
  assign fetches = asks && ar_good_q && !(offers && !reg_busy_i);

  assign reg_write_o = offers && !fetches;
  assign reg_addr_o  = reg_write_o ? aw_addr_q : ar_addr_q;

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      aw_q        <= 1'b0;
      aw_good_q   <= 1'b0;
      aw_addr_q   <= 12'd0;
      w_q         <= 1'b0;
      w_good_q    <= 1'b0;
      reg_wdata_o <= 32'd0;
      b_q         <= 1'b0;
      b_good_q    <= 1'b0;
    end else begin
      if (!aw_q) begin
        aw_q      <= awvalid_i;
        aw_addr_q <= awaddr_i[13:2];
        aw_good_q <= is_word(awaddr_i);
      end else if (ends) aw_q <= 1'b0;
      if (!w_q) begin
        w_q         <= wvalid_i;
        reg_wdata_o <= wdata_i;
        w_good_q    <= wstrb_i == 4'hf;
      end else if (ends) w_q <= 1'b0;
      if (ends) begin
        b_q      <= 1'b1;
        b_good_q <= offers;
      end else if (bready_i) b_q <= 1'b0;
    end
  end

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      ar_q      <= 1'b0;
      ar_good_q <= 1'b0;
      ar_addr_q <= 12'd0;
      reading_q <= 3'd0;
      r_q       <= 1'b0;
      r_good_q  <= 1'b0;
      rdata_o   <= 32'd0;
    end else begin
      if (!ar_q) begin
        ar_q      <= arvalid_i;
        ar_addr_q <= araddr_i[13:2];
        ar_good_q <= is_word(araddr_i) || (araddr_i[1:0] == 2'd0 &&
                                           araddr_i[13:8] == map::A_SNAPSHOT[11:6]);
      end else if (fetches || (asks && !ar_good_q)) ar_q <= 1'b0;
      reading_q <= {reading_q[1:0], fetches};
      if (reading_q[2] || (asks && !ar_good_q)) begin
        r_q      <= 1'b1;
        r_good_q <= reading_q[2];
        rdata_o  <= reading_q[2] ? reg_rdata_i : 32'd0;
      end else if (rready_i) r_q <= 1'b0;
    end
  end

endmodule

`default_nettype wire
