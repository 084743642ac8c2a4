# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
#
# coverage.share, defined after all block tests, whose programs it runs.
set(share quad_decoder rounding hold_timer)
file(STRINGS "${FELTGATE_COVERAGE_PROGRAMS}" programs)
set(paths "")
set(targets "")
foreach(program IN LISTS programs)
  string(REGEX MATCH "^([^ ]+) ([^ ]+) (.+)$" words "${program}")  # a path may have blanks
  if(CMAKE_MATCH_2 IN_LIST share)
    list(APPEND targets ${CMAKE_MATCH_1}_cover)
    list(APPEND paths "${CMAKE_MATCH_3}")
  endif()
endforeach()
add_custom_target(coverage_share ALL)
add_dependencies(coverage_share ${targets})
add_test(NAME coverage.share
  COMMAND ${Python3_EXECUTABLE} -B "${FELTGATE_ROOT}/scripts/coverage.py" --no-build --jobs 1 ${share})
set_tests_properties(coverage.share PROPERTIES LABELS lockstep TIMEOUT 1200 REQUIRED_FILES "${paths}"
  ENVIRONMENT "FELTGATE_ROOT=${FELTGATE_ROOT};FELTGATE_BUILD=${PROJECT_BINARY_DIR}")
