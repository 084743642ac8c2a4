// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The CRC-32 of link and images, the proofs' own. Included in a wrapper.

  // So many bits of a byte through the CRC.
  function automatic logic [31:0] crc_after(input logic [31:0] crc, input logic [7:0] bits, input logic [3:0] count);
    crc_after = crc;
    for (int k = 0; k < 8; k++) begin
      if (4'(k) < count) begin
        crc_after = {1'b0, crc_after[31:1]} ^ ((crc_after[0] ^ bits[k]) ? 32'hedb88320 : 32'd0);
      end
    end
  endfunction
