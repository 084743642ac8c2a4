# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
#
# cmake -DTEST=executable[;argument...] [-DCASES=cases] -P expect_quiet.cmake: succeeds when the executable passes and
# runs to its end; a copy that hangs or crashes fails. CASES are all that it runs, but with `./feltgate test --whole`.
# Used by defects.cmake.
if(CASES AND NOT DEFINED ENV{FELTGATE_WHOLE})
  list(APPEND TEST "${CASES}")
endif()
execute_process(COMMAND ${TEST} --abort TIMEOUT 1800
  RESULT_VARIABLE code OUTPUT_VARIABLE output ERROR_VARIABLE output)
message("${output}")
if(NOT code EQUAL 0)
  message(FATAL_ERROR "the copy without a defect fails (${code})")
endif()
