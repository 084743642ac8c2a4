// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Barrel processor of the engine: memories and four threads. A round has six turns of one clock:
// one instruction per thread and two turns of the system; in the second of these the system reads.
// The system writes a word in any turn without an instruction, except that one. Clock n in a
// comment or a name (x2_q) is the clock of the instruction, 0 to 7. docs/blocks/engine.md

`default_nettype none

module engine_barrel #(
    parameter ProgramContent = "",  // for $readmemh
    parameter DataContent    = "",
    parameter TableContent   = ""
) (
    input  logic               clk_i,
    input  logic               rst_ni,
    // Runs, one bit per thread.
    input  logic        [ 3:0] run_i,      // 0 ends a run
    input  logic        [ 3:0] request_i,  // start a run; held until it has started
    input  logic        [ 3:0] first_i,    // flag at the start of a run
    input  logic               bank_i,     // parameter bank of the runs that start
    output logic               started_o,  // thread5_o starts a run
    output logic               ended_o,    // a run of thread5_o has ended or was aborted
    output logic        [ 1:0] thread5_o,
    // Results, valid in clock 7 of their instruction.
    output logic signed [31:0] result_o,
    output logic               output_o,
    output logic               event_o,
    output logic               last_o,
    output logic        [ 1:0] thread7_o,
    output logic        [ 8:0] number_o,
    // The system writes one word, in the clock after free_o.
    output logic               free_o,
    input  logic               write_data_i,
    input  logic               write_program_i,
    input  logic               write_table_i,
    input  logic        [ 8:0] write_address_i,
    input  logic        [31:0] write_word_i,     // 0 if nothing is written
    input  logic        [ 3:0] write_high_i,     // 0 without write_program_i, write_table_i
    // The system reads once per round. With read_o, result_o is the data or table word of the
    // previous read, and program_o is the program word whose address was given one round earlier.
    // The upper bits of the table word are valid with high_read_o.
    input  logic        [ 3:0] read_op_i,        // ADD: data; SUB: kept word minus data;
                                                 // TAB: table; NOP: write_word_i of that turn
    input  logic               keeps_i,          // keep the system's result in clock 6
    input  logic        [ 8:0] read_data_i,      // for TAB: address of a word that is 0
    input  logic        [ 8:0] read_address_i,   // address of program and table
    output logic               read_o,
    output logic        [35:0] program_o,
    output logic               high_read_o,
    output logic        [ 3:0] table_high_o,
    input  logic        [ 9:0] line_base_i
);
  localparam logic [2:0] System = 3'd5;  // the turn in which the system reads

  // Turns: 0, 4, 1, 5, 2, 3; 4 and 5 are the system's. A turn writes its word in the clock in which
  // the turn before it reads. So only thread 3 can collide, with the words of threads 0 and 2.
  logic [2:0] turn0_q, turn1_q, turn2_q, turn3_q, turn4_q, turn5_q, turn6_q;
  logic valid0_q, valid1_q, valid2_q, valid3_q, valid4_q, valid5_q, valid6_q, valid7_q;
  logic last2_q, last3_q, last4_q, last5_q, last6_q, last7_q;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      {turn0_q, turn1_q, turn2_q, turn3_q} <= {3'd0, 3'd3, 3'd2, 3'd5};
      {turn4_q, turn5_q, turn6_q} <= {3'd1, 3'd4, 3'd0};
    end else begin
      turn0_q <= turn5_q;
      {turn1_q, turn2_q, turn3_q, turn4_q} <= {turn0_q, turn1_q, turn2_q, turn3_q};
      {turn5_q, turn6_q}                   <= {turn4_q, turn5_q};
    end
  end

  // Next turn: its thread, and whether its run continues or a run starts.
  logic thread, goes_on, starts;
  assign thread    = !turn5_q[2];
  assign goes_on   = valid5_q && !last5_q && run_i[turn5_q[1:0]];
  assign starts    = thread && !valid5_q && request_i[turn5_q[1:0]];
  assign started_o = starts;
  assign ended_o   = valid5_q && !goes_on;
  assign thread5_o = turn5_q[1:0];
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) {valid0_q, valid1_q, valid2_q, valid3_q, valid4_q, valid5_q, valid6_q, valid7_q} <= '0;
    else begin
      valid0_q <= goes_on || starts;
      {valid1_q, valid2_q, valid3_q, valid4_q} <= {valid0_q, valid1_q, valid2_q, valid3_q};
      {valid5_q, valid6_q, valid7_q}           <= {valid4_q, valid5_q, valid6_q};
    end
  end

  // Flag and bank of each thread travel with its turn.
  logic flag0_q, flag1_q, flag2_q, flag3_q, flag4_q, flag5;
  logic bank0_q, bank1_q, bank2_q, bank3_q, bank4_q, bank5_q;
  always_ff @(posedge clk_i) begin
    flag0_q <= starts ? first_i[turn5_q[1:0]] : flag5;
    {flag1_q, flag2_q, flag3_q, flag4_q} <= {flag0_q, flag1_q, flag2_q, flag3_q};
    bank0_q <= starts ? bank_i : bank5_q;
    {bank1_q, bank2_q, bank3_q, bank4_q, bank5_q} <= {bank0_q, bank1_q, bank2_q, bank3_q, bank4_q};
  end

  // Clock 0: address of the program word; clock 1: the word.
  logic [8:0] pc0_q, pc1_q, pc2_q, pc3_q, pc4_q, pc5_q;
  logic [35:0] word1;
  logic [3:0] op1;
  logic [1:0] mode1, dst1;
  logic [8:0] d1, a1, b1;
  assign op1   = word1[feltgate_engine_pkg::B_OP+:4];
  assign mode1 = word1[feltgate_engine_pkg::B_MODE+:2];
  assign dst1  = word1[feltgate_engine_pkg::B_DST+:2];
  assign d1    = word1[feltgate_engine_pkg::B_D+:9];
  assign a1    = word1[feltgate_engine_pkg::B_A+:9];
  assign b1    = word1[feltgate_engine_pkg::B_B+:9];
  assign program_o = word1;

  // Physical address of a thread's operand: private words by thread, parameters by bank. In turns
  // without a thread, y is not used.
  function automatic logic [8:0] seen(input logic [8:0] address, input logic [1:0] by, input logic bank);
    seen = address;
    if (!address[8]) seen[7:6] = by;
    else if (address[8:6] == feltgate_engine_pkg::D_PARAMETER[8:6]) seen[5] = bank;
  endfunction
  logic [8:0] read_x, read_y;
  logic reads1;
  assign reads1 = turn1_q == System;
  assign read_x = reads1 ? read_data_i : seen(a1, turn1_q[1:0], bank1_q);
  assign read_y = seen(b1, turn1_q[1:0], bank1_q);

  // A turn without an instruction executes NOP; the system's turn adds its word to 0.
  logic [3:0] op2_q, op3_q, op4_q;
  logic [1:0] mode2_q;
  logic mode3_q, mode4_q;  // lower bit of the mode
  logic [1:0] dst2_q, dst3_q, dst4_q, dst5_q, dst6_q, dst7_q;
  logic [8:0] d2_q, d3_q, d4_q, d5_q, d6_q, d7_q, b2_q, b3_q, b4_q;
  logic own2;  // the thread may write to this address
  assign own2 = d2_q[8] ? d2_q[7:6] == 2'd0 && d2_q[5:4] == turn2_q[1:0]
                        : d2_q[5:0] < 6'(feltgate_engine_pkg::INPUT_FIRST);
  always_ff @(posedge clk_i) begin
    if (valid1_q) {op2_q, mode2_q} <= {op1, mode1};
    else {op2_q, mode2_q} <= {reads1 ? read_op_i : feltgate_engine_pkg::OP_NOP, 2'd2};
    {op3_q, op4_q, mode3_q, mode4_q} <= {op2_q, op3_q, mode2_q[0], mode3_q};
    last2_q <= word1[feltgate_engine_pkg::B_LAST];
    {last3_q, last4_q, last5_q, last6_q, last7_q} <= {last2_q, last3_q, last4_q, last5_q, last6_q};
    dst2_q <= dst1;
    dst3_q <= dst2_q == 2'd1 && !own2 ? 2'd0 : dst2_q;
    {dst4_q, dst5_q, dst6_q, dst7_q} <= {dst3_q, dst4_q, dst5_q, dst6_q};
    d2_q <= d1;
    d3_q <= {d2_q[8], d2_q[8] || dst2_q != 2'd1 ? d2_q[7:6] : turn2_q[1:0], d2_q[5:0]};
    d4_q <= write_data_i || write_program_i ? write_address_i : d3_q;
    {d5_q, d6_q, d7_q} <= {d4_q, d5_q, d6_q};
    b2_q <= reads1 ? read_address_i : b1;
    {b3_q, b4_q} <= {b2_q, b3_q};
  end

  // Address of the next instruction. The system's turn reads program and table at the same address.
  logic branches, system4;
  assign branches = op4_q == feltgate_engine_pkg::OP_BRF && flag4_q != mode4_q;
  assign system4  = turn4_q == System;
  always_ff @(posedge clk_i) begin
    if (valid5_q || turn5_q == System) pc0_q <= pc5_q;
    else pc0_q <= {turn5_q[1:0], 7'd0};
    pc1_q <= pc0_q;
    pc2_q <= pc1_q + 9'd1;
    {pc3_q, pc4_q} <= {pc2_q, pc3_q};
    pc5_q <= branches || system4 ? b4_q : pc4_q;
  end

  // Clock 2: operands and address of the table; clock 3: the table's word.
  logic signed [31:0] x2, y2, result6;
  logic [8:0] table2, table3_q, table4_q, table5_q, table6_q;
  logic [35:0] table3;
  logic stores3_q, stores4_q, stores5_q, stores6_q;  // TST writes into a line
  assign table2       = x2[20:12] + b2_q;
  assign table_high_o = table3[35:32];
  assign high_read_o  = turn3_q == System;
  always_ff @(posedge clk_i) begin
    table3_q  <= table2;
    table4_q  <= write_table_i ? write_address_i : table3_q;
    {table5_q, table6_q} <= {table4_q, table5_q};
    stores3_q <= op2_q == feltgate_engine_pkg::OP_TST;
  end

  // Words that the system writes pass through the pipeline like results.
  logic data4_q, data5_q, data6_q, program4_q, program5_q, program6_q;
  logic [3:0] high4_q, high5_q, high6_q;
  assign free_o = !valid2_q && turn2_q != System;
  always_ff @(posedge clk_i) {high4_q, high5_q, high6_q} <= {write_high_i, high4_q, high5_q};
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      {data4_q, data5_q, data6_q}          <= '0;
      {program4_q, program5_q, program6_q} <= '0;
      {stores4_q, stores5_q, stores6_q}    <= '0;
    end else begin
      data4_q    <= write_data_i || (valid3_q && dst3_q == 2'd1);
      program4_q <= write_program_i;
      stores4_q  <= write_table_i || (valid3_q && stores3_q && {1'b0, table3_q} >= line_base_i);
      {data5_q, data6_q, program5_q, program6_q} <= {data4_q, data5_q, program4_q, program5_q};
      {stores5_q, stores6_q}                     <= {stores4_q, stores5_q};
    end
  end

  engine_alu u_alu (
      .clk_i(clk_i),
      .op2_i(op2_q),
      .mode2_i(mode2_q),
      .x2_i(x2),
      .y2_i(y2),
      .table3_i(table3),
      .extra3_i(write_word_i),
      .flag4_i(flag4_q),
      .flag5_o(flag5),
      .keep6_i(turn6_q == System ? keeps_i : valid6_q && !last6_q),
      .result6_o(result6)
  );

  engine_memory #(.Width(36), .Content(ProgramContent)) u_program (
      .clk_i(clk_i),
      .read_address_i(pc0_q),
      .word_o(word1),
      .write_i(program6_q),
      .write_address_i(d6_q),
      .data_i({high6_q, result6})
  );
  engine_memory #(.Width(32), .Content(DataContent)) u_x (
      .clk_i(clk_i),
      .read_address_i(read_x),
      .word_o(x2),
      .write_i(data6_q),
      .write_address_i(d6_q),
      .data_i(result6)
  );
  engine_memory #(.Width(32), .Content(DataContent)) u_y (
      .clk_i(clk_i),
      .read_address_i(read_y),
      .word_o(y2),
      .write_i(data6_q),
      .write_address_i(d6_q),
      .data_i(result6)
  );
  engine_memory #(.Width(36), .Content(TableContent)) u_table (
      .clk_i(clk_i),
      .read_address_i(table2),
      .word_o(table3),
      .write_i(stores6_q),
      .write_address_i(table6_q),
      .data_i({high6_q, result6})
  );

  // Clock 7: outputs of the barrel.
  always_ff @(posedge clk_i) result_o <= result6;
  assign output_o  = valid7_q && dst7_q == 2'd2;
  assign event_o   = valid7_q && dst7_q == 2'd3;
  assign last_o    = valid7_q && last7_q;
  assign thread7_o = turn1_q[1:0];  // clock 7 is clock 1 of the thread's next turn
  assign number_o  = d7_q;
  assign read_o    = reads1;
endmodule

`default_nettype wire
