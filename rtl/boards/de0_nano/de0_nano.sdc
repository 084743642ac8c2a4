# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
#
# Timing: one clock of 50 MHz. Documentation: docs/boards/de0_nano.md

create_clock -name CLOCK_50 -period 20.000 [get_ports CLOCK_50]
derive_clock_uncertainty

# Asynchronous to any clock, and each passes two flip-flops before the clock uses it:
set_false_path -from [get_ports {enc_loop}]
set_false_path -from [get_ports {SW[*] KEY[1]}]
# the reset, whose release the clock takes over through two flip-flops,
set_false_path -from [get_ports {KEY[0]}]
# the host's line,
set_false_path -from [get_ports {uart_rx}]
# and the stop, which also sets a latch and clears the gates without a clock.
set_false_path -from [get_ports {estop}]

# Nobody outside has this clock, so these delays are a form. The encoder is asynchronous too, and passes two flip-flops.
# What counts is that its channels arrive beside each other: its edges come 2.5 us apart at the highest speed, and the
# wires in here may take 0 to 5 ns.
# A false path and set_max_skew on the same pins would not do: older Quartus then sees no limit at all.
set_input_delay -clock CLOCK_50 0.0 [get_ports {enc_a_i enc_b_i enc_z_i enc_loop uart_rx}]
set_max_delay -from [get_ports {enc_a_i enc_b_i enc_z_i}] 5.0
set_min_delay -from [get_ports {enc_a_i enc_b_i enc_z_i}] 0.0

# For the eye, and for a receiver that finds its bits by itself.
set_false_path -to [get_ports {LED[*]}]
set_output_delay -clock CLOCK_50 0.0 [get_ports {uart_tx}]
set_false_path -to [get_ports {uart_tx}]

# The gates leave within one clock and beside each other, so that the dead time counted in clocks arrives at
# the bridge. 2 ns is 0.4 % of the shipped designs' dead time; registers in the I/O cells differ by far less.
set_output_delay -clock CLOCK_50 -max 0.0 [get_ports {gate_*}]
set_output_delay -clock CLOCK_50 -min 0.0 [get_ports {gate_*}]
set_max_skew -to [get_ports {gate_*}] 2.0
