# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
#
# quartus_sh -t build.tcl compile | report | program     (no word: compile and report)
# Never run: Quartus was not available when this was written. Documentation: docs/boards/de0_nano.md

load_package flow
load_package report

cd [file dirname [file normalize [info script]]]
set project de0_nano

proc compile {} {
  global project
  project_open $project
  if {[catch {execute_flow -compile} message]} {
    project_close
    puts stderr "build.tcl: the compilation failed: $message"
    puts stderr "build.tcl: the reason is in output_files/*.rpt"
    exit 1
  }
  project_close
}

# Area and worst slack, as Quartus's own panels have them.
proc report {} {
  global project
  project_open $project
  load_report
  set panels {
    "Fitter||Fitter Summary"
    "TimeQuest Timing Analyzer||Multicorner Timing Analysis Summary"
    "Timing Analyzer||Multicorner Timing Analysis Summary"
  }
  foreach panel $panels {
    set id [get_report_panel_id $panel]
    if {$id == -1} continue
    puts "\n$panel"
    for {set row 0} {$row < [get_number_of_rows -id $id]} {incr row} {
      puts "  [join [get_report_panel_row -id $id -row $row] {  }]"
    }
  }
  unload_report
  project_close
}

# Into the FPGA's RAM only: gone with the power, the board's own flash is not touched.
proc program {} {
  global project
  set image output_files/$project.sof
  if {![file exists $image]} {
    puts stderr "build.tcl: no $image; run quartus_sh -t build.tcl compile first"
    exit 1
  }
  exec quartus_pgm -m jtag -o "p;$image" >@stdout 2>@stderr
}

# quartus_sh -t passes the words after the script in $quartus(args).
set words [expr {[info exists quartus(args)] ? $quartus(args) : $argv}]
if {[llength $words] == 0} {set words {compile report}}
foreach word $words {
  switch -- $word {
    compile - report - program {$word}
    default {
      puts stderr "build.tcl: no '$word'; compile, report or program"
      exit 2
    }
  }
}
