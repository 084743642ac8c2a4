# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
#
# The programs of feltgate coverage: each block test again, on RTL with coverage counters. docs/testing.md
include_guard(GLOBAL)

add_custom_target(coverage_programs)
set(FELTGATE_COVERAGE_PROGRAMS "${PROJECT_BINARY_DIR}/coverage/programs.txt")
file(WRITE "${FELTGATE_COVERAGE_PROGRAMS}" "")

# feltgate_cover_program(<test> <block> <sources> [LIBRARIES l...] [PARAMS p...]): <test>_cover, the objects of
# <test> with a model of the block that counts, and the cover points of all that it is made of.
function(feltgate_cover_program test block sources)
  cmake_parse_arguments(PARSE_ARGV 3 arg "" "" "LIBRARIES;PARAMS")
  set(folder "${FELTGATE_ROOT}/testbench/campaigns/coverage")
  set(points "")
  foreach(source IN LISTS sources)
    get_filename_component(name "${source}" NAME_WE)
    list(APPEND points -DCOVER_${name})
  endforeach()
  # A cover point samples a reset that its block takes between the clocks, and looks at some bits of a signal.
  feltgate_verilate(${test}_cover_rtl ${block} "${folder}/coverage.vlt;${sources};${folder}/points_core.sv" COVERAGE
    ${points} --flatten -Wno-SYNCASYNCNET -Wno-UNUSEDSIGNAL ${arg_PARAMS})
  target_compile_options(${test}_cover_rtl PRIVATE -O1)
  add_executable(${test}_cover EXCLUDE_FROM_ALL $<TARGET_OBJECTS:${test}_object>)
  target_link_libraries(${test}_cover PRIVATE feltgate_catch_main ${arg_LIBRARIES} ${test}_cover_rtl)
  if(TARGET feltgate_model)
    target_link_libraries(${test}_cover PRIVATE feltgate_model)
  endif()
  feltgate_same_class(${test}_cover ${block} ${test}_rtl ${test}_cover_rtl)
  add_dependencies(coverage_programs ${test}_cover)
  file(APPEND "${FELTGATE_COVERAGE_PROGRAMS}" "${test} ${block} ${CMAKE_CURRENT_BINARY_DIR}/${test}_cover\n")
endfunction()
