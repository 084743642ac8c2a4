// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The parameters: a RAM of 512 words with check bits, and a register for each word of p_o. The first
// clocks of a tick load the words of its scene, the others go round the common words, so that a
// register is never older than three ticks. A word that is written lands in RAM and register at once.
// A word whose check is wrong is a fault and is not loaded. A reset changes neither; configuration
// loads the design's values.
// docs/blocks/host.md

`default_nettype none

module params #(
    parameter ParameterFile = ""  // $readmemh file of the RAM; "": values of the package
) (
    input  logic         clk_i,
    input  logic         rst_ni,
    input  logic [cfg::TICK_W-1:0] clock_i,  // of the tick
    input  logic [ 3:0] scene_i,       // of the tick
    input  logic         write_i,       // last clock of a tick
    input  logic [ 8:0] address_i,
    input  logic [31:0] data_i,
    input  logic [ 8:0] read_addr_i,   // of the host
    output logic [31:0] read_data_o,   // two clocks later
    output cfg::params_t p_o,
    output logic         word_error_o  // one clock: a word has changed by itself
);
  // Bit k of the check is the parity of every fourth bit from bit k on, two of them inverted: it
  // detects a flipped bit, and a memory that reads all 0 or all 1.
  function automatic logic [3:0] check_of(input logic [31:0] value);
    logic [15:0] half;
    logic [7:0] quarter;
    half     = value[31:16] ^ value[15:0];
    quarter  = half[15:8] ^ half[7:0];
    check_of = quarter[7:4] ^ quarter[3:0] ^ 4'b0101;
  endfunction

  (* no_rw_check, ram_style = "block", ramstyle = "no_rw_check" *)
  logic [35:0] ram[0:511];
  generate
  if (ParameterFile != "") begin : g_file
    initial $readmemh(ParameterFile, ram);
  end else begin : g_package
    initial begin
      for (int i = 0; i < 512; i++) ram[i] = {check_of(cfg::parameter_reset(9'(i))), cfg::parameter_reset(9'(i))};
    end
  end
  endgenerate
  always @(posedge clk_i) begin  // not always_ff: the initial block writes it too
    if (write_i) ram[address_i] <= {check_of(data_i), data_i};
  end

  // The word that is fetched. Bank 15, which no scene has, stands for the scene of the tick.
  localparam logic [4*5-1:0] ScenePlaces = {5'd10, 5'd6, 5'd3, 5'd2};  // after place 1
  logic [8:0] address, place, place_q;
  logic [5:0] next_q;
  logic [35:0] fetch_q;
  logic of_scene, fetched_q, wrong, warm_q, good_q;
  logic [4:0] of_bank;
  assign of_scene = clock_i < cfg::TICK_W'(5);
  always_comb begin
    case (clock_i[2:0])
      3'd0:    of_bank = 5'd1;
      3'd1:    of_bank = ScenePlaces[4:0];
      3'd2:    of_bank = ScenePlaces[9:5];
      3'd3:    of_bank = ScenePlaces[14:10];
      default: of_bank = ScenePlaces[19:15];
    endcase
  end
  assign address = of_scene ? {scene_i, of_bank} : {3'd0, next_q};
  assign place   = of_scene ? {4'd15, of_bank} : address;  // of its register
  always_ff @(posedge clk_i) {fetch_q, place_q} <= {ram[address], place};
  assign wrong = fetch_q[35:32] != check_of(fetch_q[31:0]);
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      {next_q, fetched_q, warm_q, good_q, word_error_o} <= '0;
    end else begin
      warm_q       <= 1'b1;
      if (!of_scene) next_q <= next_q + 1'b1;
      fetched_q    <= warm_q && !write_i;  // a word fetched during a write may be anything
      good_q       <= fetched_q && !wrong && !write_i;  // it may be the word that is written
      word_error_o <= fetched_q && wrong;
    end
  end

  // Into its register, three clocks after its fetch, or when it is written.
  logic [31:0] word, fetched_word_q;
  always_ff @(posedge clk_i) fetched_word_q <= fetch_q[31:0];
  assign word = write_i ? data_i : fetched_word_q;
  logic [cfg::PARAMS_W-1:0] p_q = cfg::PARAMS_RESET;
  assign p_o = p_q;
  generate
  genvar n;
  for (n = 0; n < cfg::WORDS; n = n + 1) begin : g_word
    localparam int Low = 32'(cfg::WORD_LOW[16*n+:16]);
    localparam int Bits = 32'(cfg::WORD_BITS[16*n+:16]);
    localparam logic [8:0] At = 9'(cfg::WORD_ADDRESS[16*n+:16]);
    logic fetched_here_q;
    always_ff @(posedge clk_i) fetched_here_q <= place_q == At;
    always @(posedge clk_i) if (write_i ? address_i == At : good_q && fetched_here_q) p_q[Low+:Bits] <= word[Bits-1:0];
  end
  endgenerate

  // For the host.
  logic [35:0] read_q;
  always_ff @(posedge clk_i) read_q <= ram[read_addr_i];
  always_ff @(posedge clk_i) read_data_o <= read_q[31:0];
endmodule

`default_nettype wire
