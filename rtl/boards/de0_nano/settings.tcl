# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
#
# Pins and settings of de0_nano.qsf for a project whose files FuseSoC lists. Never run by Quartus.
set qsf [open [file join [file dirname [info script]] de0_nano.qsf]]
foreach line [split [read $qsf] "\n"] {
  if {![regexp {_FILE |TOP_LEVEL_ENTITY|PROJECT_OUTPUT|VERILOG_MACRO} $line]} {
    # A name such as KEY[0] is no command here.
    eval [string map {[ \\[ ] \\]} $line]
  }
}
close $qsf
