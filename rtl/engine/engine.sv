// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Engine: runs force laws as programs in four threads over program, data and table memory. Ticks
// start the runs; a port serves the host. A law can only request torques, nothing else. Timing: an
// instruction per thread every 6 clocks; a host read 32 clocks. docs/blocks/engine.md

`default_nettype none

module engine #(
    parameter int         AxisCount      = 1,
    parameter             ProgramContent = "",  // $readmemh file, like the other two
    parameter             DataContent    = "",
    parameter             TableContent   = "",
    parameter logic [feltgate_engine_pkg::RESET_BITS-1:0] Reset = feltgate_engine_pkg::RESET_EMPTY
) (
    input  logic                    clk_i,
    input  logic                    rst_ni,
    input  logic                    armed_i,
    input  logic                    enter_i,       // one clock: the first axis entered the law scene
    input  logic                    locked_i,      // 1: only parameters and COMMIT are writable
    input  logic                    tick_i,        // one clock; inputs of this tick, held
    input  logic [            31:0] tick_count_i,
    input  logic [32*AxisCount-1:0] position_i,
    input  logic [32*AxisCount-1:0] velocity_i,
    input  logic [32*AxisCount-1:0] tau_hat_i,
    output logic signed [cfg::TORQUE_W*AxisCount-1:0] torque_o,
    output logic                    fresh_o,
    output logic                    late_o,
    output logic                    changed_o,     // one clock: torques can jump from now on
    input  logic                    crc_start_i,
    output logic                    crc_done_o,    // one clock
    output logic                    crc_good_o,
    output logic                    event_valid_o,
    output logic [             8:0] event_number_o,
    output logic [            31:0] event_value_o,
    // Port of the host.
    input  logic [            11:0] addr_i,
    input  logic [            31:0] wdata_i,
    input  logic                    write_i,       // one clock, while busy_o is 0
    input  logic                    read_i,        // one clock: the host has taken rdata_o
    output logic [            31:0] rdata_o,       // valid: addr_i held 32 clocks, busy_o 0
    output logic                    busy_o
);
  // Host words that are registers.
  logic [3:0] high_q, run_q;
  logic [9:0] line_base_q;
  logic [5:0] mailbox_first_q;
  logic [15:0] max_age_q, mailbox_age_q;
  logic [31:0] crc_q;
  logic overrun_q, dropped_q;

  logic of_register, write_register, open_register, write_run, write_divider, to_commit, commit;
  assign of_register    = addr_i[11:9] == feltgate_engine_pkg::H_HIGH[11:9];
  assign write_register = write_i && !busy_o && of_register;
  assign open_register  = write_register && !locked_i;
  assign write_run      = open_register && addr_i == feltgate_engine_pkg::H_RUN;
  logic [3:0] of_divider;  // the thread whose divider it is; of_register compares the upper bits
  assign of_divider     = {addr_i[8:0] == feltgate_engine_pkg::H_DIVIDER3[8:0],
                           addr_i[8:0] == feltgate_engine_pkg::H_DIVIDER2[8:0],
                           addr_i[8:0] == feltgate_engine_pkg::H_DIVIDER1[8:0],
                           addr_i[8:0] == feltgate_engine_pkg::H_DIVIDER0[8:0]};
  assign write_divider  = open_register && of_divider != '0;
  assign to_commit      = write_register && addr_i == feltgate_engine_pkg::H_COMMIT;
  assign commit         = to_commit && wdata_i[0];

  logic armed_q, young_q, enter, overrun;  // young_q: the first clock after a reset
  logic [3:0] first_q, request, running, run;
  logic started, ended;
  logic [1:0] thread5;
  assign enter = enter_i || (armed_i && !armed_q) || write_run;
  logic clearing;  // the delay lines are being cleared
  assign run = clearing ? 4'd0 : run_q;
  logic bank;
  logic committing, parameter_write, drops, locked_out;
  assign locked_out = locked_i && write_i && !busy_o && !parameter_write && addr_i[11:9] <= 3'd2;
  assign parameter_write = addr_i[11:6] == {3'd0, feltgate_engine_pkg::D_PARAMETER[8:6]};
  assign drops = committing && write_i && !busy_o && (parameter_write || commit);
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      high_q      <= '0;
      run_q       <= Reset[feltgate_engine_pkg::B_RESET_RUN+:4];
      line_base_q <= Reset[feltgate_engine_pkg::B_RESET_LINE_BASE+:10];
      max_age_q   <= Reset[feltgate_engine_pkg::B_RESET_MAX_AGE+:16];
      mailbox_first_q <= Reset[feltgate_engine_pkg::B_RESET_MAILBOX_FIRST+:6];
      mailbox_age_q   <= Reset[feltgate_engine_pkg::B_RESET_MAILBOX_AGE+:16];
      crc_q       <= Reset[feltgate_engine_pkg::B_RESET_CRC+:32];
      overrun_q   <= 1'b0;
      dropped_q   <= 1'b0;
      armed_q     <= 1'b0;
      young_q     <= 1'b1;
      first_q     <= '1;
    end else begin
      armed_q <= armed_i;
      young_q <= 1'b0;
      if (open_register && addr_i == feltgate_engine_pkg::H_HIGH) high_q <= wdata_i[3:0];
      if (write_run) run_q <= wdata_i[3:0];
      if (open_register && addr_i == feltgate_engine_pkg::H_LINE_BASE) line_base_q <= wdata_i[9:0];
      if (open_register && addr_i == feltgate_engine_pkg::H_MAX_AGE) max_age_q <= wdata_i[15:0];
      if (open_register && addr_i == feltgate_engine_pkg::H_MAILBOX_FIRST) mailbox_first_q <= wdata_i[5:0];
      if (open_register && addr_i == feltgate_engine_pkg::H_MAILBOX_AGE) mailbox_age_q <= wdata_i[15:0];
      if (open_register && addr_i == feltgate_engine_pkg::H_CRC) crc_q <= wdata_i;
      overrun_q <= (overrun_q || overrun) && !write_run;
      dropped_q <= drops || locked_out || (dropped_q && !(to_commit && wdata_i[1]));
      if (started) first_q[thread5] <= 1'b0;
      if (enter) first_q <= '1;
    end
  end

  // A host word for a memory waits for a turn without an instruction.
  logic waits_q, waits_program_q, waits_table_q, may_write;
  logic [8:0] address_q;
  logic [31:0] data_q;
  logic [2:0] lands_q;  // shift register: a word is on its way into its memory
  logic free, input_wanted, input_taken, host_taken, line_taken;
  logic checking, minus;
  logic [8:0] commit_address, input_address, line_address;
  logic [31:0] input_word;
  assign may_write = addr_i[11:9] == 3'd0 ? (parameter_write ? !committing
                         : !locked_i && (addr_i[8] || addr_i[5:0] < 6'(feltgate_engine_pkg::INPUT_FIRST)))
                     : !locked_i && addr_i[11:9] <= 3'd2;
  assign host_taken  = waits_q && free && !input_wanted;
  assign input_taken = input_wanted && free;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      waits_q <= 1'b0;
      lands_q <= '0;
    end else begin
      if (host_taken) waits_q <= 1'b0;
      else if (write_i && !busy_o && may_write) waits_q <= 1'b1;
      lands_q <= {lands_q[1:0], host_taken};
    end
  end
  always_ff @(posedge clk_i) begin
    if (write_i && !busy_o) begin
      waits_program_q <= addr_i[9];
      waits_table_q   <= addr_i[10];
      address_q       <= {addr_i[8:6], parameter_write ? !bank : addr_i[5], addr_i[4:0]};
      data_q          <= wdata_i;
    end
  end

  // Writes and reads of the system in the barrel. A program word that is read passes through the
  // adder like a written word.
  localparam logic [8:0] Zero = 9'(feltgate_engine_pkg::PRIVATE_WORDS - 1);  // never written: 0
  logic write_data_q, write_program_q, write_table_q;
  logic [8:0] write_address_q, read_data, read_address;
  logic [31:0] write_input_q, write_host_q, write_read_q;  // all but one are 0
  logic [3:0] write_high_q;
  logic beat, high_turn, read_program, read_table;
  logic [35:0] program_word;
  logic [3:0] table_high, high_read_q, read_op;
  logic [31:0] program_q;
  logic [3:0] program_high_q;
  logic crc_busy, crc_reads, crc_program, crc_table;
  logic [8:0] crc_address;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) {write_data_q, write_program_q, write_table_q} <= '0;
    else begin
      write_data_q    <= input_taken || (host_taken && !waits_program_q && !waits_table_q);
      write_program_q <= host_taken && waits_program_q;
      write_table_q   <= line_taken || (host_taken && waits_table_q);
    end
  end
  always_ff @(posedge clk_i) begin
    write_high_q    <= host_taken && (waits_program_q || waits_table_q) ? high_q : 4'd0;
    write_address_q <= input_wanted ? input_address : clearing && !waits_q ? line_address : address_q;
    write_input_q <= input_taken ? input_word : '0;
    write_host_q  <= host_taken ? data_q : '0;
    write_read_q  <= program_q;
    program_q     <= beat && read_program ? program_word[31:0] : '0;
    if (beat) program_high_q <= program_word[35:32];
    if (high_turn) high_read_q <= table_high;
  end
  assign read_program = !checking && (crc_reads ? crc_program : addr_i[9]);
  assign read_table   = !checking && (crc_reads ? crc_table : addr_i[11:10] != 2'd0 && !addr_i[9]);
  assign read_address = crc_reads ? crc_address : addr_i[8:0];
  assign read_data    = checking ? commit_address : read_table ? Zero : read_address;
  assign read_op      = read_program ? feltgate_engine_pkg::OP_NOP :
                        read_table ? feltgate_engine_pkg::OP_TAB :
                        minus ? feltgate_engine_pkg::OP_SUB : feltgate_engine_pkg::OP_ADD;

  logic signed [31:0] result;
  logic output_valid, event_valid, last;
  logic [1:0] thread7;
  logic [8:0] number;
  engine_barrel #(
      .ProgramContent(ProgramContent),
      .DataContent(DataContent),
      .TableContent(TableContent)
  ) u_barrel (
      .clk_i(clk_i),
      .rst_ni(rst_ni),
      .run_i(run),
      .request_i(request),
      .first_i(first_q),
      .bank_i(bank),
      .started_o(started),
      .ended_o(ended),
      .thread5_o(thread5),
      .result_o(result),
      .output_o(output_valid),
      .event_o(event_valid),
      .last_o(last),
      .thread7_o(thread7),
      .number_o(number),
      .free_o(free),
      .write_data_i(write_data_q),
      .write_program_i(write_program_q),
      .write_table_i(write_table_q),
      .write_address_i(write_address_q),
      .write_word_i(write_input_q | write_host_q | write_read_q),
      .write_high_i(write_high_q),
      .read_op_i(read_op),
      .keeps_i(minus),
      .read_data_i(read_data),
      .read_address_i(read_address),
      .read_o(beat),
      .program_o(program_word),
      .high_read_o(high_turn),
      .table_high_o(table_high),
      .line_base_i(line_base_q)
  );

  engine_inputs #(
      .AxisCount(AxisCount),
      .Dividers(Reset[feltgate_engine_pkg::B_RESET_DIVIDER0+:48])
  ) u_inputs (
      .clk_i(clk_i),
      .rst_ni(rst_ni),
      .run_i(run),
      .tick_i(tick_i),
      .tick_count_i(tick_count_i),
      .position_i(position_i),
      .velocity_i(velocity_i),
      .tau_hat_i(tau_hat_i),
      .divide_i(write_divider),
      .divided_i({of_divider[3:2] != '0, of_divider[3] || of_divider[1]}),
      .divider_i(wdata_i[11:0]),
      .started_i(started),
      .ended_i(ended),
      .thread_i(thread5),
      .request_o(request),
      .running_o(running),
      .overrun_o(overrun),
      .wanted_o(input_wanted),
      .taken_i(input_taken),
      .address_o(input_address),
      .word_o(input_word)
  );

  logic mailbox_late;
  engine_outputs #(.AxisCount(AxisCount)) u_outputs (
      .clk_i(clk_i),
      .rst_ni(rst_ni),
      .clear_i(write_run || clearing),
      .zero_i(mailbox_late),
      .watched_i(run_q != 4'd0),
      .enter_i(enter || clearing || young_q),
      .tick_i(tick_i),
      .max_age_i(max_age_q),
      .result_i(result),
      .output_i(output_valid),
      .last_i(last),
      .thread_i(thread7),
      .number_i(number[1:0]),
      .torque_o(torque_o),
      .fresh_o(fresh_o),
      .late_o(late_o)
  );

  engine_lines u_lines (
      .clk_i(clk_i),
      .rst_ni(rst_ni),
      .enter_i(enter),
      .line_base_i(line_base_q),
      .free_i(free && !input_wanted && !waits_q),
      .clearing_o(clearing),
      .taken_o(line_taken),
      .address_o(line_address)
  );

  logic refused, taken, differs;
  logic [4:0] refused_word;
  engine_commit u_commit (
      .clk_i(clk_i),
      .rst_ni(rst_ni),
      .commit_i(commit),
      .wait_i(crc_busy || lands_q != '0),
      .tick_i(tick_i),
      .beat_i(beat),
      .negative_i(result[31]),
      .running_i(running),
      .mailbox_first_i(mailbox_first_q),
      .bank_o(bank),
      .taken_o(taken),
      .differs_o(differs),
      .checking_o(checking),
      .committing_o(committing),
      .refused_o(refused),
      .refused_word_o(refused_word),
      .minus_o(minus),
      .address_o(commit_address)
  );

  engine_mailbox u_mailbox (
      .clk_i(clk_i),
      .rst_ni(rst_ni),
      .tick_i(tick_i),
      .step_i((tick_count_i & 32'(feltgate_engine_pkg::MAILBOX_STEP - 1)) == '0),
      .watched_i(!mailbox_first_q[5]),
      .max_age_i(mailbox_age_q),
      .taken_i(taken),
      .differs_i(differs),
      .late_o(mailbox_late),
      .jumps_o(changed_o)
  );

  engine_crc u_crc (
      .clk_i(clk_i),
      .rst_ni(rst_ni),
      .start_i(crc_start_i),
      .wait_i(checking || waits_q),  // a waiting word is written first, so the CRC includes it
      .beat_i(beat),
      .word_i({crc_program ? program_high_q : high_read_q, result}),
      .line_base_i(line_base_q),
      .wanted_i(crc_q),
      .busy_o(crc_busy),
      .reads_o(crc_reads),
      .good_o(crc_good_o),
      .done_o(crc_done_o),
      .program_o(crc_program),
      .table_o(crc_table),
      .address_o(crc_address)
  );

  logic [4:0] event_count;
  logic [8:0] event_number;
  logic [31:0] event_value, event_tick;
  logic [7:0] events_lost;
  engine_events u_events (
      .clk_i(clk_i),
      .rst_ni(rst_ni),
      .event_i(event_valid),
      .number_i(number),
      .value_i(result),
      .tick_i(tick_count_i),
      .take_i(read_i && addr_i == feltgate_engine_pkg::H_EVENT_TICK),
      .count_o(event_count),
      .number_o(event_number),
      .value_o(event_value),
      .tick_o(event_tick),
      .lost_o(events_lost)
  );
  assign event_valid_o  = event_valid;
  assign event_number_o = number;
  assign event_value_o  = result;

  // Words that the host reads.
  logic [31:0] read_q, register, status;
  logic [11:0] read_word;
  assign read_word = {feltgate_engine_pkg::H_HIGH[11:5], addr_i[4:0]};
  always_comb begin
    status = '0;
    status[feltgate_engine_pkg::B_STATUS_COMMITTING]   = committing;
    status[feltgate_engine_pkg::B_STATUS_REFUSED]      = refused;
    status[feltgate_engine_pkg::B_STATUS_CRC_BUSY]     = crc_busy;
    status[feltgate_engine_pkg::B_STATUS_CRC_GOOD]     = crc_good_o;
    status[feltgate_engine_pkg::B_STATUS_LATE]         = late_o;
    status[feltgate_engine_pkg::B_STATUS_BANK]         = bank;
    status[feltgate_engine_pkg::B_STATUS_OVERRUN]      = overrun_q;
    status[feltgate_engine_pkg::B_STATUS_MAILBOX_LATE] = mailbox_late;
    status[feltgate_engine_pkg::B_STATUS_RUNNING+:4]   = running;
    status[feltgate_engine_pkg::B_STATUS_DROPPED]      = dropped_q;
  end
  assign busy_o = waits_q || checking || crc_busy || clearing;
  always_ff @(posedge clk_i) begin
    if (beat) read_q <= addr_i[11] || addr_i[10:9] == 2'd3 ? {28'd0, addr_i[11] ? high_read_q : program_high_q}
                                                           : result;
  end
  always_comb begin
    case (read_word)
      feltgate_engine_pkg::H_STATUS:       register = status;
      feltgate_engine_pkg::H_REFUSED_WORD: register = {27'd0, refused_word};
      feltgate_engine_pkg::H_EVENT_COUNT:  register = {27'd0, event_count};
      feltgate_engine_pkg::H_EVENT_NUMBER: register = {23'd0, event_number};
      feltgate_engine_pkg::H_EVENT_VALUE:  register = event_value;
      feltgate_engine_pkg::H_EVENT_TICK:   register = event_tick;
      feltgate_engine_pkg::H_EVENTS_LOST:  register = {24'd0, events_lost};
      default:                                  register = '0;
    endcase
  end
  assign rdata_o = of_register ? register : read_q;
endmodule

`default_nettype wire
