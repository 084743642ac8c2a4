// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// What link_port makes of any requests, whatever core, stream, capture and transmitter do.
`default_nettype none

module requests_proof (
    input logic        clk_i,
    input logic        rst_ni,
    input logic        valid_i,
    input logic        write_i,
    input logic [ 7:0] sequence_i,
    input logic [13+cfg::ENGINE:0] address_i,
    input logic [31:0] data_i,
    input logic        good_i,
    input logic        bad_i,
    input logic        clear_faults_i,
    input logic [ 7:0] inputs_i,
    input logic        tick_i,
    input logic        reg_busy_i,
    input logic [31:0] reg_rdata_i,
    input logic [31:0] rdata_i,
    input logic        ready_i
);
  `include "reset.svh"

  logic taken, reg_write, write, valid, last;
  logic [15:0] reg_addr, addr;
  logic [31:0] reg_wdata, wdata;
  logic [7:0] reply_byte;
  localparam int Axes = cfg::AXES;
  link_port #(.Axes(Axes)) u_dut (
      .clk_i(clk_i), .rst_ni(rst_ni),
      .valid_i(valid_i), .write_i(write_i), .sequence_i(sequence_i), .address_i(address_i), .data_i(data_i),
      .good_i(good_i), .bad_i(bad_i), .taken_o(taken),
      .clear_faults_i(clear_faults_i), .inputs_i(inputs_i), .tick_i(tick_i),
      .reg_addr_o(reg_addr), .reg_wdata_o(reg_wdata), .reg_write_o(reg_write),
      .reg_busy_i(reg_busy_i), .reg_rdata_i(reg_rdata_i),
      .addr_o(addr), .wdata_o(wdata), .write_o(write), .rdata_i(rdata_i),
      .valid_o(valid), .byte_o(reply_byte), .last_o(last), .ready_i(ready_i)
  );
  localparam int AddressW = 14 + cfg::ENGINE;
  localparam logic [15:0] Port = {1'b0, 1'(cfg::ENGINE), 14'hfff};
  localparam logic [15:0] Status = 16'(map::A_SNAPSHOT) + 16'(map::S_STATUS);
  localparam logic [5:0] OnlyClear = 6'd1 << map::B_COMMAND_CLEAR_FAULTS;
  localparam logic [1:0] Idle = 2'd0;
  localparam logic [1:0] Wait = 2'd1;
  localparam logic [1:0] Read = 2'd2;
  localparam logic [1:0] Bytes = 2'd3;
  localparam int ClocksW = 2 + 4 * cfg::ENGINE;
  (* hierconn *) wire [8:0] \u_dut.sequence_q ;
  (* hierconn *) wire \u_dut.done_q ;
  (* hierconn *) wire \u_dut.clear_q ;
  (* hierconn *) wire [1:0] \u_dut.clear_axis_q ;
  (* hierconn *) wire [15:0] \u_dut.good_q ;
  (* hierconn *) wire [15:0] \u_dut.bad_q ;
  (* hierconn *) wire \u_dut.status_q ;
  (* hierconn *) wire [1:0] \u_dut.state_q ;
  (* hierconn *) wire [1:0] \u_dut.ticks_q ;
  (* hierconn *) wire [1:0] \u_dut.byte_q ;
  (* hierconn *) wire [ClocksW-1:0] \u_dut.clocks_q ;
  (* hierconn *) wire [6:0] \u_dut.left_q ;
  (* hierconn *) wire [31:0] \u_dut.word_q ;
  (* hierconn *) wire [AddressW-1:0] \u_dut.address_q ;

  // Writes: what a request still wants of a port, and the panel, which clears axis after axis.
  logic [8:0] last_q;  // sequence of the last that a port took
  logic done_q, repeats, wants, to_core, of_core, of_panel, port_takes;
  logic [Axes-1:0] left_q;  // axes that are still to be cleared
  logic [1:0] next_clear;
  always_comb begin
    next_clear = 2'd0;
    for (int k = Axes - 1; k >= 0; k--) if (left_q[k]) next_clear = 2'(k);
  end
  assign repeats    = last_q == {1'b0, sequence_i};
  assign wants      = valid_i && write_i && !done_q && !repeats;
  assign to_core    = address_i[13:12] == 2'd0;
  assign of_core    = wants && to_core;
  assign of_panel   = left_q != '0 && !of_core;
  assign port_takes = wants && (!to_core || !reg_busy_i);
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      last_q  <= 9'h100;
      done_q  <= 1'b0;
      left_q  <= '0;
    end else begin
      if (port_takes) last_q <= {1'b0, sequence_i};
      done_q  <= valid_i && !taken && (done_q || port_takes || (write_i && repeats));
      if (clear_faults_i) left_q <= '1;
      else if (of_panel && !reg_busy_i) left_q[next_clear] <= 1'b0;
    end
  end

  // The reply: what was taken, how many bytes of it are out, and how long its word's address has been there.
  logic replies_q, of_write_q;
  logic [1:0] ticks_q;
  logic [6:0] words_q;
  logic [8:0] sent_q;
  logic [31:0] head_q, word_q;
  logic [AddressW-1:0] first_q, asked;
  logic [5:0] steady_q;
  logic engines;
  // Of a write the status of the axis that was written, of axis 0 where there is none.
  logic [1:0] axis;
  logic [15:0] status;
  assign axis    = first_q[AddressW-1:12] == '0 && 32'(first_q[11:10]) < Axes ? first_q[11:10] : 2'd0;
  assign status  = Status + {4'd0, axis, 10'd0};
  assign asked   = of_write_q ? AddressW'(status) : first_q + AddressW'(sent_q[8:2]) - AddressW'(1);
  // The link's own words that change.
  logic counted, elsewhere;
  logic [15:0] good_q, bad_q;
  logic [31:0] own;
  assign counted   = 16'(asked) == feltgate_link_pkg::A_FRAMES_GOOD || 16'(asked) == feltgate_link_pkg::A_FRAMES_BAD ||
                     16'(asked) == feltgate_link_pkg::A_INPUTS;
  assign elsewhere = asked[13:12] == 2'd0 || asked[13:0] >= 14'h2000;
  assign own = 16'(asked) == feltgate_link_pkg::A_FRAMES_GOOD ? {16'd0, good_q} :
               16'(asked) == feltgate_link_pkg::A_FRAMES_BAD ? {16'd0, bad_q} :
               16'(asked) == feltgate_link_pkg::A_INPUTS ? {24'd0, inputs_i} : 32'd0;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) {good_q, bad_q} <= '0;
    else {good_q, bad_q} <= {good_q + 16'(good_i), bad_q + 16'(bad_i)};
  end
  assign engines = cfg::ENGINE != 0 && asked[AddressW-1] && asked[13:12] == 2'd0;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      replies_q <= 1'b0;
      sent_q    <= '0;
      ticks_q   <= '0;
    end else begin
      if (taken) begin
        replies_q <= 1'b1;
        sent_q    <= '0;
        ticks_q   <= '0;
      end else begin
        if (valid && ready_i && last) replies_q <= 1'b0;
        if (valid && ready_i) sent_q <= sent_q + 9'd1;
        if (tick_i && ticks_q != 2'd3) ticks_q <= ticks_q + 2'd1;
      end
    end
  end
  always_ff @(posedge clk_i) begin
    if (taken) begin
      of_write_q <= write_i;
      words_q    <= write_i ? 7'd1 : data_i[6:0];
      first_q    <= address_i;
      head_q     <= {16'(address_i), sequence_i, 6'h20, write_i, !write_i};
    end
    // Clocks in a row before this one in which the address was on both ports, and the engine free.
    if (valid || taken || write || reg_write || addr != 16'(asked) || reg_addr != (16'(asked) & Port) ||
        (engines && reg_busy_i)) steady_q <= '0;
    else if (steady_q != 6'd63) steady_q <= steady_q + 6'd1;
    if (!valid) word_q <= asked[13:12] == 2'd0 ? reg_rdata_i : rdata_i | own;
    else if (ready_i) word_q <= word_q >> 8;
  end

  // The clock before.
  logic after_q, valid_q, write_q, taken_q, stood_q, last_then_q;
  logic [7:0] byte_q, sequence_q;
  logic [5:0] steady_then_q;
  logic [AddressW-1:0] address_q;
  logic [31:0] data_q;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      after_q <= 1'b0;
      taken_q <= 1'b0;
      valid_q <= 1'b0;
    end else begin
      after_q <= 1'b1;
      taken_q <= taken;
      valid_q <= valid_i;
    end
  end
  always_ff @(posedge clk_i) begin
    stood_q       <= valid && !ready_i;
    byte_q        <= reply_byte;
    last_then_q   <= last;
    write_q       <= write_i;
    sequence_q    <= sequence_i;
    address_q     <= address_i;
    data_q        <= data_i;
    steady_then_q <= steady_q;
  end

  // A request stands until it is taken, or goes (link_receiver.frames).
  always_comb begin
    if (valid_q && valid_i) begin
      assume (!taken_q);
      assume (write_i == write_q && sequence_i == sequence_q && address_i == address_q && data_i == data_q);
    end
  end

  logic of_a_word, word_begins;
  assign of_a_word   = sent_q >= 9'd4;
  assign word_begins = valid && of_a_word && sent_q[1:0] == 2'd0 && !stood_q;
  always_comb begin
    if (past_ok_q && rst_ni) begin
      write_is_there: assert (!wants || (to_core
          ? reg_write && !write && reg_addr == (16'(address_i) & Port) && reg_wdata == data_i
          : write && addr == 16'(address_i) && wdata == data_i));
      write_of_a_request: assert (!write || (wants && !to_core));
      port_of_request_or_panel: assert (!reg_write || of_core || of_panel);
      clear_is_there: assert (!of_panel || (reg_write && reg_addr[9:0] == 10'(map::A_COMMAND) &&
                                            reg_wdata[5:0] == OnlyClear));
      clear_of_each_axis: assert (!of_panel || reg_addr[15:10] == {4'd0, next_clear});
      taken_when_done: assert (!taken || (valid_i && !replies_q && (!write_i || done_q)));
      reply_of_a_request: assert (!valid || replies_q);
      reply_has_its_length: assert (!valid || last == (sent_q == {words_q, 2'b11}));
      head_says_what: assert (!valid || of_a_word || reply_byte == 8'(head_q >> {sent_q[1:0], 3'd0}));
      status_of_a_later_tick: assert (!(valid && of_write_q) || ticks_q == 2'd3);
      status_of_its_axis: assert (!(replies_q && of_write_q) || reg_write || sent_q > 9'd4 || (valid && of_a_word) ||
                                  reg_addr == status);
      word_after_its_address: assert (!word_begins || steady_then_q >= (engines ? 6'd40 : 6'd3));
      word_of_the_port: assert (!(valid && of_a_word && elsewhere) || reply_byte == word_q[7:0]);
      word_that_counts: assert (!(valid && of_a_word && counted) || reply_byte == word_q[7:0]);
      if (after_q) byte_stands: assert (!stood_q || (valid && reply_byte == byte_q && last == last_then_q));
      inside_writes: assert (\u_dut.sequence_q == last_q && \u_dut.done_q == done_q && \u_dut.clear_q == (left_q != '0));
      inside_clears: assert (left_q == '0 ? \u_dut.clear_axis_q == 2'd0 || (Axes > 1 && 32'(\u_dut.clear_axis_q ) == Axes)
                                          : \u_dut.clear_axis_q == next_clear && left_q == ({Axes{1'b1}} << next_clear));
      inside_idle: assert ((\u_dut.state_q == Idle) == !replies_q);
      inside_byte: assert (\u_dut.byte_q == (valid ? sent_q[1:0] : 2'd0) && (valid || !replies_q || sent_q[1:0] == 2'd0));
      inside_begin: assert (!replies_q || \u_dut.state_q != Wait || (sent_q == 9'd0 && of_write_q));
      inside_read: assert (\u_dut.state_q != Read || sent_q >= 9'd4);
      inside_left: assert (!replies_q || {1'b0, \u_dut.left_q } + {1'b0, sent_q[8:2]} ==
                           {1'b0, words_q} + (\u_dut.state_q == Read ? 8'd1 : 8'd0));
      inside_words: assert (!replies_q || sent_q <= {words_q, 2'b11});
      inside_status: assert (!replies_q || (\u_dut.status_q == of_write_q && (!of_write_q || words_q == 7'd1)));
      inside_address: assert (!replies_q || \u_dut.address_q == first_q + AddressW'(sent_q[8:2]) -
                              (\u_dut.state_q == Read ? AddressW'(1) : AddressW'(0)));
      inside_head: assert (!replies_q || of_a_word || \u_dut.word_q == head_q >> {sent_q[1:0], 3'd0});
      inside_ticks: assert (\u_dut.state_q != Wait || \u_dut.ticks_q == 2'd3 - ticks_q);
      inside_waited: assert (!(\u_dut.state_q == Read || \u_dut.state_q == Bytes) || !of_write_q || ticks_q == 2'd3);
      inside_steady: assert (\u_dut.state_q != Read || \u_dut.clocks_q == ClocksW'(steady_q));
      inside_clocks: assert (\u_dut.state_q == Read ? \u_dut.clocks_q <= (engines ? ClocksW'(40) : ClocksW'(3))
                                                   : \u_dut.clocks_q == '0);
      inside_word: assert (!(valid && of_a_word && (elsewhere || counted)) || \u_dut.word_q == word_q);
      inside_counts: assert (\u_dut.good_q == good_q && \u_dut.bad_q == bad_q);
      writes: cover (port_takes && to_core);
      answers: cover (valid && last && ready_i && of_write_q);
      reads_two: cover (valid && last && ready_i && !of_write_q && words_q == 7'd2);
      clears: cover (of_panel && !reg_busy_i && 32'(next_clear) == Axes - 1);
    end
  end
endmodule

`default_nettype wire
