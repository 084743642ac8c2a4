// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// For a wrapper with clk_i and rst_ni: the first clock is one of a reset, others come at any time.

  logic past_ok_q;  // a clock was before this one
  initial past_ok_q = 1'b0;
  always_ff @(posedge clk_i) past_ok_q <= 1'b1;
  always_comb if (!past_ok_q) assume (!rst_ni);
