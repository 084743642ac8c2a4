// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Sends frames: appends the CRC-32 and encodes SLIP. It serves two sources, one whole frame at a
// time; if both have a frame, the reply goes first. The CRC takes eight clocks per byte.
// Documentation: docs/link.md
`default_nettype none

module link_transmitter (
    input  logic       clk_i,
    input  logic       rst_ni,
    input  logic       reply_valid_i,   // held with its byte until reply_ready_o
    input  logic [7:0] reply_byte_i,
    input  logic       reply_last_i,    // last byte of the frame
    output logic       reply_ready_o,
    input  logic       stream_valid_i,
    input  logic [7:0] stream_byte_i,
    input  logic       stream_last_i,
    output logic       stream_ready_o,
    output logic       valid_o,         // to the UART
    output logic [7:0] byte_o,
    input  logic       ready_i
);
  localparam logic [7:0] END = 8'(feltgate_link_pkg::FRAME_END);
  localparam logic [7:0] ESCAPE = 8'(feltgate_link_pkg::FRAME_ESCAPE);
  localparam logic [7:0] ESCAPED_END = 8'(feltgate_link_pkg::ESCAPED_END);
  localparam logic [7:0] ESCAPED_ESCAPE = 8'(feltgate_link_pkg::ESCAPED_ESCAPE);

  localparam logic [2:0] IDLE = 3'd0;    // waits for a frame
  localparam logic [2:0] OPEN = 3'd1;    // sends the first END
  localparam logic [2:0] FETCH = 3'd2;   // takes a byte from the source
  localparam logic [2:0] SHIFT = 3'd3;   // shifts the byte into the CRC, or a byte of the CRC out
  localparam logic [2:0] SEND = 3'd4;    // sends the byte, or ESCAPE before a special byte
  localparam logic [2:0] SECOND = 3'd5;  // sends the replacement of a special byte
  localparam logic [2:0] CLOSE = 3'd6;   // sends the last END

  logic [ 2:0] state_q;
  logic        stream_q, last_q, tail_q;  // source is the stream; its last byte; CRC is being sent
  logic [ 1:0] at_q;                      // number of the CRC byte
  logic [ 2:0] bit_q;
  logic [ 7:0] byte_q;
  logic [31:0] crc_q;

  logic is_end, special, feedback, over, source_valid;
  assign is_end         = byte_q == END;
  assign special        = is_end || byte_q == ESCAPE;
  assign feedback       = !tail_q && (crc_q[0] ^ byte_q[0]);
  assign reply_ready_o  = state_q == FETCH && !stream_q;
  assign stream_ready_o = state_q == FETCH && stream_q;
  assign source_valid   = stream_q ? stream_valid_i : reply_valid_i;
  assign valid_o        = state_q == OPEN || state_q == SEND || state_q == SECOND || state_q == CLOSE;
  assign byte_o = (state_q == SEND)   ? (special ? ESCAPE : byte_q)
                : (state_q == SECOND) ? (is_end ? ESCAPED_END : ESCAPED_ESCAPE) : END;
  assign over = ready_i && ((state_q == SEND && !special) || state_q == SECOND);

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      state_q  <= IDLE;
      stream_q <= 1'b0;
      last_q   <= 1'b0;
      tail_q   <= 1'b0;
      at_q     <= 2'd0;
      bit_q    <= 3'd0;
      byte_q   <= 8'd0;
      crc_q    <= '1;
    end else begin
      case (state_q)
        IDLE: begin
          stream_q <= !reply_valid_i;
          tail_q   <= 1'b0;
          at_q     <= 2'd0;
          crc_q    <= '1;
          if (reply_valid_i || stream_valid_i) state_q <= OPEN;
        end
        OPEN: if (ready_i) state_q <= FETCH;
        FETCH: begin
          byte_q <= stream_q ? stream_byte_i : reply_byte_i;
          last_q <= stream_q ? stream_last_i : reply_last_i;
          if (source_valid) state_q <= SHIFT;
        end
        SHIFT: begin
          bit_q  <= bit_q + 3'd1;
          byte_q <= {tail_q ? !crc_q[0] : byte_q[0], byte_q[7:1]};
          crc_q  <= {1'b0, crc_q[31:1]} ^ (feedback ? feltgate_link_pkg::CRC_POLYNOMIAL : 32'd0);
          if (bit_q == 3'd7) state_q <= SEND;
        end
        SEND: if (ready_i && special) state_q <= SECOND;
        CLOSE: if (ready_i) state_q <= IDLE;
        default: ;
      endcase
      if (over) begin
        tail_q  <= last_q;
        at_q    <= at_q + {1'b0, tail_q};
        state_q <= !last_q ? FETCH : tail_q && at_q == 2'd3 ? CLOSE : SHIFT;
      end
    end
  end
endmodule

`default_nettype wire
