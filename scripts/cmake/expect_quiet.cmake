# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
#
# cmake -DTEST=executable -P expect_quiet.cmake: succeeds when the executable passes and runs to its
# end; a copy that hangs or crashes fails. Cases tagged [endurance] run only with `./feltgate test
# --whole`, or if TEST chooses its cases itself. Used by defects.cmake.
list(LENGTH TEST words)
if(words EQUAL 1 AND NOT DEFINED ENV{FELTGATE_WHOLE})
  list(APPEND TEST "~[endurance]")
endif()
execute_process(COMMAND ${TEST} --abort TIMEOUT 1800
  RESULT_VARIABLE code OUTPUT_VARIABLE output ERROR_VARIABLE output)
message("${output}")
if(NOT code EQUAL 0)
  message(FATAL_ERROR "the copy without a defect fails (${code})")
endif()
