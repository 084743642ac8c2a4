`default_nettype none
// bench only: the drive's values at the clocks of the old wave
module drive_delay (input logic clk_i, rst_ni, input cfg::drive_t drive_i, output cfg::drive_t drive_o);
  logic [7:0] since_q; logic signed [cfg::DUTY_W-1:0] duty_q;
  always_ff @(posedge clk_i or negedge rst_ni) if (!rst_ni) begin since_q <= 8'd255; duty_q <= 0; end
    else begin since_q <= drive_i.sample ? 8'd1 : since_q == 8'd255 ? since_q : since_q + 1; if (since_q == 46) duty_q <= drive_i.duty; end
  always_comb begin drive_o = drive_i; drive_o.valid = since_q == 40; drive_o.duty = duty_q; end
endmodule
