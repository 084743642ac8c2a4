# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
#
# cmake -DTEST=executable[;argument...] -P expect_failure.cmake: succeeds when the Catch2 executable
# fails by an assertion. A crash, a time-out, an exception or a pass is a failure. Used by block_test.cmake.
execute_process(COMMAND ${TEST} --abort TIMEOUT 3000
  RESULT_VARIABLE code OUTPUT_VARIABLE output ERROR_VARIABLE output)
message("${output}")
if(NOT code MATCHES "^[0-9]+$" OR output MATCHES "fatal error condition")
  message(FATAL_ERROR "the test ended abnormally (${code}) instead of failing an assertion")
elseif(code EQUAL 0)
  message(FATAL_ERROR "the seeded defect was not caught")
elseif(output MATCHES "mismatch (at|with)")
  message("the seeded defect was caught by the lock-step")
elseif(output MATCHES "unexpected exception" OR NOT output MATCHES "FAILED:")
  message(FATAL_ERROR "exit code ${code}, but no failed assertion in the output")
else()
  message("the seeded defect was caught by an assertion")
endif()
