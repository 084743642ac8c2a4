# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
#
# Timing: one clock of 50 MHz. Documentation: docs/boards/de0_nano.md

create_clock -name CLOCK_50 -period 20.000 [get_ports CLOCK_50]
derive_clock_uncertainty

# Asynchronous to any clock: each passes two flip-flops before the clock uses it. ESTOP also sets a latch and
# clears the gates without one.
set_false_path -from [get_ports {KEY[*] SW[*] ENC_A ENC_B ENC_Z ESTOP}]

# For the eye only.
set_false_path -to [get_ports {LED[*]}]

# The gates leave within one clock, so that the dead time counted in clocks arrives at the bridge.
set_output_delay -clock CLOCK_50 -max 0.0 [get_ports {GATE_*}]
set_output_delay -clock CLOCK_50 -min 0.0 [get_ports {GATE_*}]
