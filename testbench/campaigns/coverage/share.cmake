# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
#
# coverage.share and coverage.share.whole, defined after all block tests, whose programs they run.

# feltgate_coverage_share(<name> <target> <blocks> [add_test arguments...])
function(feltgate_coverage_share name target blocks)
  file(STRINGS "${FELTGATE_COVERAGE_PROGRAMS}" programs)
  set(paths "")
  set(targets "")
  foreach(program IN LISTS programs)
    string(REGEX MATCH "^([^ ]+) ([^ ]+) (.+)$" words "${program}")  # a path may have blanks
    if(CMAKE_MATCH_2 IN_LIST blocks)
      list(APPEND targets ${CMAKE_MATCH_1}_cover)
      list(APPEND paths "${CMAKE_MATCH_3}")
    endif()
  endforeach()
  add_dependencies(${target} ${targets})
  add_test(NAME ${name} COMMAND ${Python3_EXECUTABLE} -B "${FELTGATE_ROOT}/scripts/coverage.py"
    --no-build --jobs 1 ${blocks} ${ARGN})
  set_tests_properties(${name} PROPERTIES LABELS lockstep TIMEOUT 1200 REQUIRED_FILES "${paths}"
    ENVIRONMENT "FELTGATE_ROOT=${FELTGATE_ROOT};FELTGATE_BUILD=${PROJECT_BINARY_DIR}")
endfunction()

add_custom_target(coverage_share ALL)
feltgate_coverage_share(coverage.share coverage_share "encoder_monitor")
feltgate_coverage_share(coverage.share.whole whole "quad_decoder;pwm" ${FELTGATE_WHOLE})
