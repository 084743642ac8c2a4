// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Executes a request of the host. It writes at once, but not again with the sequence number of the
// last write; it reads each word while the reply is being sent. Words belong to the core, the engine, the link itself,
// the stream or the capture. Documentation: docs/link.md
`default_nettype none

module link_port #(
    parameter int Simulated = 0,
    parameter int Board = 0,
    parameter int Features = 0,  // more bits of the word FEATURES
    parameter int Engine = cfg::ENGINE,  // 1: the port also has the engine's words
    parameter int Axes = 1       // at the register port, axis n at n * 0x400
) (
    input  logic        clk_i,
    input  logic        rst_ni,

    // Request of link_receiver
    input  logic        valid_i,
    input  logic        write_i,
    input  logic [ 7:0] sequence_i,
    input  logic [13+Engine:0] address_i,
    input  logic [31:0] data_i,
    input  logic        good_i,
    input  logic        bad_i,
    output logic        taken_o,

    input  logic        clear_faults_i,  // from the panel, one clock
    input  logic [ 7:0] inputs_i,        // from the board
    input  logic        tick_i,          // one clock per tick, any clock of it

    // Register port of the core and of the engine
    output logic [15:0] reg_addr_o,
    output logic [31:0] reg_wdata_o,
    output logic        reg_write_o,
    input  logic        reg_busy_i,
    input  logic [31:0] reg_rdata_i,     // 3 clocks after the address; engine: 33, not busy

    // Stream and capture: rdata_i is 0 for an address of another block
    output logic [15:0] addr_o,
    output logic [31:0] wdata_o,
    output logic        write_o,
    input  logic [31:0] rdata_i,         // 3 clocks after the address

    // Reply
    output logic        valid_o,
    output logic [ 7:0] byte_o,
    output logic        last_o,
    input  logic        ready_i
);
  localparam int AddressW = 14 + Engine;
  localparam logic [AddressW-1:0] STATUS =
      AddressW'(map::A_SNAPSHOT) + AddressW'(map::S_STATUS);
  // The engine's words have the core's addresses with one more bit on top.
  localparam logic [15:0] OF_PORT = {1'b0, 1'(Engine), 2'd0, 12'hfff};

  // Writes. A repeated write, with the sequence number of the last one, is not executed again.
  logic [8:0] sequence_q;  // of the last write; 0x100: none
  logic       done_q;      // the current write is executed, now or earlier
  logic       clear_q;
  logic [1:0] clear_axis_q;  // the panel's clear goes to each axis in turn
  logic       fresh, to_core, repeats, writes;
  assign fresh   = valid_i && write_i && !done_q;
  assign to_core = address_i[13:12] == 2'd0;
  assign repeats = sequence_q == {1'b0, sequence_i};
  assign writes  = fresh && !repeats;

  logic host_write, panel_write;
  assign host_write  = writes && to_core;
  assign panel_write = clear_q && !host_write;
  assign write_o     = writes && !to_core;
  assign reg_write_o = host_write || panel_write;
  assign wdata_o     = data_i;
  // A separate signal, because Yosys (0.23, 0.70) took it for 32 bits inside a concatenation.
  logic [map::W_COMMAND-1:0] clear_faults;
  assign clear_faults = map::W_COMMAND'(1) << map::B_COMMAND_CLEAR_FAULTS;
  assign reg_wdata_o  = {data_i[31:map::W_COMMAND],
      host_write ? data_i[map::W_COMMAND-1:0] : clear_faults};

  // Reply: the head and each word pass through one register, four bytes each.
  localparam logic [1:0] IDLE = 2'd0;
  localparam logic [1:0] WAIT = 2'd1;   // waits for a status that includes the write
  localparam logic [1:0] READ = 2'd2;   // waits for a word
  localparam logic [1:0] BYTES = 2'd3;  // sends four bytes
  localparam int ENGINE_CLOCKS = 40;  // read time of an engine word
  localparam int ClocksW = 2 + 4 * Engine;
  logic [ 1:0] state_q, ticks_q, byte_q;
  logic [ClocksW-1:0] clocks_q, last_clock;
  logic        status_q;  // the reply answers a write
  logic [ 1:0] status_axis;  // axis of the write; 0 for a write to something else
  logic [AddressW-1:0] address_q;
  logic [ 6:0] left_q;    // words still to read
  logic [31:0] word_q;

  logic [AddressW-1:0] read_address;
  logic of_engine;  // the word being read is the engine's
  assign status_axis  = (Axes > 1 && address_q[AddressW-1:12] == '0 && 32'(address_q[11:10]) < Axes) ? address_q[11:10] : 2'd0;
  assign read_address = status_q ? STATUS | AddressW'({status_axis, 10'd0}) : address_q;
  assign of_engine    = Engine != 0 && read_address[AddressW-1] && read_address[13:12] == 2'd0;
  assign last_clock   = of_engine ? ClocksW'(ENGINE_CLOCKS) : ClocksW'(3);
  assign addr_o       = write_o ? 16'(address_i) : 16'(read_address);
  assign reg_addr_o   = OF_PORT & (host_write ? 16'(address_i)
                      : panel_write ? 16'(map::A_COMMAND) | 16'({clear_axis_q, 10'd0}) : 16'(read_address));

  // The link's own words.
  logic [15:0] good_q, bad_q;
  logic [31:0] own, word;
  always_comb begin
    case (16'(read_address))
      feltgate_link_pkg::A_IDENTITY:        own = 32'(feltgate_link_pkg::IDENTITY);
      feltgate_link_pkg::A_VERSION:         own = 32'(feltgate_link_pkg::VERSION);
      feltgate_link_pkg::A_DESIGN_CRC:      own = cfg::DESIGN_CRC;
      feltgate_link_pkg::A_CLOCK_HZ:        own = 32'(cfg::CLOCK_HZ);
      feltgate_link_pkg::A_CLOCKS_PER_TICK: own = 32'(cfg::CLOCKS_PER_TICK);
      feltgate_link_pkg::A_FEATURES:
          own = 32'(Features) | (32'(Simulated) << feltgate_link_pkg::B_FEATURES_SIMULATED);
      feltgate_link_pkg::A_FRAMES_GOOD:     own = {16'd0, good_q};
      feltgate_link_pkg::A_FRAMES_BAD:      own = {16'd0, bad_q};
      feltgate_link_pkg::A_LAST_WRITE_SEQUENCE: own = {23'd0, sequence_q};
      feltgate_link_pkg::A_BOARD:           own = 32'(Board);
      feltgate_link_pkg::A_INPUTS:          own = {24'd0, inputs_i};
      default:                              own = 32'd0;
    endcase
  end
  assign word = (read_address[13:12] == 2'd0) ? reg_rdata_i : own | rdata_i;

  // A separate signal, because Yosys (0.23, 0.70) took it for 32 bits in a concatenation.
  logic [7:0] kind;
  assign kind = 8'(feltgate_link_pkg::KIND_REPLY) |
                8'(write_i ? feltgate_link_pkg::KIND_WRITE : feltgate_link_pkg::KIND_READ);
  assign taken_o = state_q == IDLE && valid_i && (!write_i || done_q);
  assign valid_o = state_q == BYTES;
  assign byte_o  = word_q[7:0];
  assign last_o  = byte_q == 2'd3 && left_q == 7'd0;

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      sequence_q <= 9'(feltgate_link_pkg::NO_SEQUENCE);
      done_q     <= 1'b0;
      clear_q    <= 1'b0;
      clear_axis_q <= 2'd0;
      good_q     <= 16'd0;
      bad_q      <= 16'd0;
      state_q    <= IDLE;
      ticks_q    <= 2'd0;
      clocks_q   <= '0;
      byte_q     <= 2'd0;
      status_q   <= 1'b0;
      address_q  <= '0;
      left_q     <= 7'd0;
      word_q     <= 32'd0;
    end else begin
      if (good_i) good_q <= good_q + 16'd1;
      if (bad_i) bad_q <= bad_q + 16'd1;
      done_q <= valid_i && !taken_o && (done_q || (fresh && (repeats || !to_core || !reg_busy_i)));
      if (writes && (!to_core || !reg_busy_i)) sequence_q <= {1'b0, sequence_i};
      clear_q <= clear_faults_i || (clear_q && (!panel_write || reg_busy_i || 32'(clear_axis_q) != Axes - 1));
      if (clear_faults_i || Axes == 1) clear_axis_q <= 2'd0;
      else if (panel_write && !reg_busy_i) clear_axis_q <= clear_axis_q + 2'd1;

      case (state_q)
        IDLE: begin
          status_q  <= write_i;
          address_q <= address_i;
          left_q    <= write_i ? 7'd1 : data_i[6:0];
          word_q    <= {16'(address_i), sequence_i, kind};
          ticks_q   <= 2'd3;
          if (taken_o) state_q <= write_i ? WAIT : BYTES;
        end
        WAIT: begin
          if (tick_i) ticks_q <= ticks_q - 2'd1;
          if (ticks_q == 2'd0) state_q <= BYTES;
        end
        READ: begin
          clocks_q <= (reg_write_o || write_o || (of_engine && reg_busy_i)) ? '0 : clocks_q + ClocksW'(1);
          word_q   <= word;
          if (clocks_q == last_clock) begin
            state_q   <= BYTES;
            clocks_q  <= '0;
            address_q <= address_q + AddressW'(1);
            left_q    <= left_q - 7'd1;
          end
        end
        default: begin
          if (ready_i) begin
            byte_q <= byte_q + 2'd1;
            word_q <= {8'd0, word_q[31:8]};
            if (byte_q == 2'd3) state_q <= (left_q == 7'd0) ? IDLE : READ;
          end
        end
      endcase
    end
  end
endmodule

`default_nettype wire
