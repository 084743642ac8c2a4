// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The five channels for any manager, even one that keeps no rule, whatever the core does.
`default_nettype none

module channels_proof (
    input logic        clk_i,
    input logic        rst_ni,
    input logic        awvalid_i,
    input logic [13:0] awaddr_i,
    input logic        wvalid_i,
    input logic [31:0] wdata_i,
    input logic [ 3:0] wstrb_i,
    input logic        bready_i,
    input logic        arvalid_i,
    input logic [13:0] araddr_i,
    input logic        rready_i,
    input logic [31:0] reg_rdata_i,
    input logic        reg_busy_i
);
  `include "reset.svh"

  logic awready, wready, bvalid, arready, rvalid, reg_write;
  logic [1:0] bresp, rresp;
  logic [31:0] rdata, reg_wdata;
  logic [11:0] reg_addr;
  axi_lite_port u_dut (
      .clk_i(clk_i),
      .rst_ni(rst_ni),
      .awvalid_i(awvalid_i),
      .awready_o(awready),
      .awaddr_i(awaddr_i),
      .wvalid_i(wvalid_i),
      .wready_o(wready),
      .wdata_i(wdata_i),
      .wstrb_i(wstrb_i),
      .bvalid_o(bvalid),
      .bready_i(bready_i),
      .bresp_o(bresp),
      .arvalid_i(arvalid_i),
      .arready_o(arready),
      .araddr_i(araddr_i),
      .rvalid_o(rvalid),
      .rready_i(rready_i),
      .rdata_o(rdata),
      .rresp_o(rresp),
      .reg_addr_o(reg_addr),
      .reg_wdata_o(reg_wdata),
      .reg_write_o(reg_write),
      .reg_rdata_i(reg_rdata_i),
      .reg_busy_i(reg_busy_i)
  );
  (* hierconn *) wire \u_dut.aw_good_q ;
  (* hierconn *) wire \u_dut.w_good_q ;
  (* hierconn *) wire \u_dut.ar_good_q ;
  (* hierconn *) wire [11:0] \u_dut.aw_addr_q ;
  (* hierconn *) wire [11:0] \u_dut.ar_addr_q ;
  (* hierconn *) wire [2:0] \u_dut.reading_q ;

  function automatic logic writable(input logic [13:0] addr);
    writable = addr[1:0] == 2'd0 && (addr < 14'h800 || addr[13:2] == map::A_CONTROL ||
                                     addr[13:2] == map::A_COMMAND);
  endfunction
  function automatic logic only_readable(input logic [13:0] addr);
    only_readable = addr[1:0] == 2'd0 && addr[13:2] >= map::A_SNAPSHOT &&
                    addr[13:2] < map::A_SNAPSHOT + 12'd64;
  endfunction

  // What was handed over and not answered: one of each at most.
  logic aw_q, w_q, ar_q, r_asked_q, write_fits, read_fits, taken, refused, fetched;
  logic [13:0] awaddr_q, araddr_q;
  logic [31:0] wdata_q;
  logic [3:0] wstrb_q;
  logic [2:0] age_q;    // up to 7
  logic [1:0] since_q;  // clocks since its address was on the port, 0 before
  logic due_q;          // it has had its word's clock
  logic [31:0] word_q;
  logic read_fits_q;
  assign write_fits = writable(awaddr_q) && wstrb_q == 4'b1111;
  assign read_fits  = writable(araddr_q) || only_readable(araddr_q);
  assign taken      = reg_write && !reg_busy_i;
  assign refused    = aw_q && w_q && !bvalid && !write_fits;
  // A read's address is on the port in a clock without a write, when no read is under way.
  assign fetched    = ar_q && !r_asked_q && !rvalid && read_fits && !reg_write;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      {aw_q, w_q, ar_q, r_asked_q, due_q, read_fits_q} <= '0;
      age_q   <= '0;
      since_q <= '0;
    end else begin
      if (awvalid_i && awready) begin
        aw_q     <= 1'b1;
        awaddr_q <= awaddr_i;
      end else if (taken || refused) aw_q <= 1'b0;
      if (wvalid_i && wready) begin
        w_q     <= 1'b1;
        wdata_q <= wdata_i;
        wstrb_q <= wstrb_i;
      end else if (taken || refused) w_q <= 1'b0;
      if (arvalid_i && arready) begin
        ar_q     <= 1'b1;
        araddr_q <= araddr_i;
      end else if (fetched || (ar_q && !r_asked_q && !rvalid && !read_fits)) ar_q <= 1'b0;
      // Under way: from the clock on the port to the answer.
      if (fetched) begin
        r_asked_q <= 1'b1;
        since_q   <= 2'd1;
      end else if (r_asked_q && since_q == 2'd3) begin
        r_asked_q <= 1'b0;
        since_q   <= 2'd0;
      end else if (r_asked_q) since_q <= since_q + 2'd1;
      // For how many clocks it is kept off the port while no read stands in its way.
      if (!ar_q || rvalid || r_asked_q || !read_fits || fetched) age_q <= '0;
      else if (age_q != 3'd7) age_q <= age_q + 3'd1;
    end
  end

  // The clock before.
  logic after_q, b_q, b_ready_q, taken_q, refused_q, r_q, r_ready_q, r_ends_q, no_word_q, disarm_q;
  logic [1:0] bresp_q, rresp_q;
  logic [31:0] rdata_q;
  logic disarm;
  assign disarm = aw_q && w_q && !bvalid && write_fits && !reg_write;  // a write, a disarm among them, is kept off
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) after_q <= 1'b0;
    else after_q <= 1'b1;
  end
  always_ff @(posedge clk_i) begin
    b_q       <= bvalid;
    b_ready_q <= bready_i;
    bresp_q   <= bresp;
    taken_q   <= taken;
    refused_q <= refused;
    r_q       <= rvalid;
    r_ready_q <= rready_i;
    rresp_q   <= rresp;
    rdata_q   <= rdata;
    r_ends_q  <= r_asked_q && since_q == 2'd3;
    no_word_q <= ar_q && !r_asked_q && !rvalid && !read_fits;
    word_q    <= reg_rdata_i;
    disarm_q  <= disarm;
  end

  always_comb begin
    if (past_ok_q && !rst_ni) begin
      reset_is_silent: assert (!bvalid && !rvalid && !reg_write);
    end
    if (past_ok_q && rst_ni) begin
      write_as_asked: assert (!reg_write || (aw_q && w_q && write_fits && reg_addr == awaddr_q[13:2] &&
                                             reg_wdata == wdata_q));
      ready_while_empty: assert (awready == !aw_q && wready == !w_q && arready == !ar_q);
      write_kept_off_by_a_fetch: assert (!(aw_q && w_q && write_fits && !bvalid) || reg_write || fetched);
      fetch_has_the_port: assert (!fetched || reg_addr == araddr_q[13:2]);
      read_waits_one_clock: assert (age_q < 3'd2);
      inside_aw: assert (!aw_q || (\u_dut.aw_addr_q == awaddr_q[13:2] && \u_dut.aw_good_q == writable(awaddr_q)));
      inside_w: assert (!w_q || (\u_dut.w_good_q == (wstrb_q == 4'b1111) && reg_wdata == wdata_q));
      inside_ar: assert (!ar_q || (\u_dut.ar_addr_q == araddr_q[13:2] && \u_dut.ar_good_q == read_fits));
      inside_reading: assert (\u_dut.reading_q == (since_q == 2'd0 ? 3'd0 : 3'd1 << (since_q - 2'd1)));
      inside_asked: assert (r_asked_q == (since_q != 2'd0) && !(r_asked_q && rvalid));
      if (after_q) begin
        answer_stands: assert (!b_q || b_ready_q || (bvalid && bresp == bresp_q));
        word_stands: assert (!r_q || r_ready_q || (rvalid && rresp == rresp_q && rdata == rdata_q));
        no_spurious_answer: assert (!bvalid || (b_q && !b_ready_q) || taken_q || refused_q);
        no_write_unanswered: assert (!(taken_q || refused_q) || bvalid);
        answer_tells: assert (!(taken_q || refused_q) || bresp == (taken_q ? 2'b00 : 2'b10));
        no_spurious_word: assert (!rvalid || (r_q && !r_ready_q) || r_ends_q || no_word_q);
        no_read_unanswered: assert (!(r_ends_q || no_word_q) || rvalid);
        word_of_the_port: assert (!r_ends_q || (rdata == word_q && rresp == 2'b00));
        word_of_nobody: assert (!no_word_q || (rdata == 32'd0 && rresp == 2'b10));
        disarm_waits_one_clock: assert (!(disarm_q && disarm));
        inside_after: assert (!(b_q && taken_q) && !(r_q && (r_ends_q || no_word_q)));
        inside_disarm: assert (!disarm_q || (r_asked_q && since_q == 2'd1));
      end
      inside_age: assert (age_q == 3'd0 || (age_q == 3'd1 && bvalid));
      writes: cover (taken && awaddr_q[13:2] == map::A_CONTROL);
      reads: cover (rvalid && rresp == 2'b00 && r_ready_q);
      refuses: cover (bvalid && bresp == 2'b10);
      steps_aside: cover (disarm && fetched);
    end
  end
endmodule

`default_nettype wire
