# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
#
# Seeded defects of the RTL: patches in testbench/<block>/defects, all in one model of the block.
# docs/testing.md
include_guard(GLOBAL)
find_package(Python3 3.11 COMPONENTS Interpreter REQUIRED)

set(FELTGATE_DEFECTS "${FELTGATE_ROOT}/scripts/defects.py")
set(FELTGATE_EXPECT_FAILURE "${CMAKE_CURRENT_LIST_DIR}/expect_failure.cmake")
set(FELTGATE_EXPECT_QUIET "${CMAKE_CURRENT_LIST_DIR}/expect_quiet.cmake")

add_library(feltgate_chosen_defect STATIC ${FELTGATE_ROOT}/testbench/common/chosen_defect.cpp)
target_compile_options(feltgate_chosen_defect PRIVATE ${FELTGATE_WARNINGS})

# feltgate_patches(<variable> <block>): the patches of a block, of which there must be one.
function(feltgate_patches variable block)
  file(GLOB patches CONFIGURE_DEPENDS "${FELTGATE_ROOT}/testbench/${block}/defects/*.patch")
  if(NOT patches)
    message(FATAL_ERROR "testbench/${block}/defects: no patch there; docs/testing.md says how")
  endif()
  set(${variable} "${patches}" PARENT_SCOPE)
endfunction()

# feltgate_verilate_defects(<target> <block> <package> <sources> [verilator arguments...]): a library
# with the class V<block>, which is what the environment variable FELTGATE_DEFECT names: the block with
# the defect of a patch, or with none. Copies of the block side by side, of which one has a clock.
function(feltgate_verilate_defects target block package sources)
  feltgate_patches(patches ${block})
  set(copies "${CMAKE_CURRENT_BINARY_DIR}/${target}.sv")
  add_custom_command(OUTPUT "${copies}"
    COMMAND ${Python3_EXECUTABLE} -B "${FELTGATE_DEFECTS}" block ${block} --root "${FELTGATE_ROOT}"
            --output "${copies}" --patches ${patches} --sources ${sources}
    DEPENDS ${patches} ${sources} "${FELTGATE_DEFECTS}"
    COMMENT "Seeding defects into ${block}" VERBATIM)
  list(FILTER sources EXCLUDE REGEX "/${block}\\.sv$")
  # A defect may leave signals unused; what does not elaborate is an error.
  feltgate_verilate(${target} ${block} "${package};${sources};${copies}"
    -Wno-fatal -Wno-lint -Wno-style --trace-depth 1 ${ARGN})
  target_compile_options(${target} PRIVATE -O1)
  target_link_libraries(${target} PUBLIC feltgate_chosen_defect)
endfunction()

# feltgate_same_class(<target> <block> <library> <other>): the target, compiled with V<block> of one library,
# is linked with that of another; the build fails where the two are not laid out alike.
function(feltgate_same_class target block library other)
  set(stamp "${CMAKE_CURRENT_BINARY_DIR}/${target}.same_class")
  set(headers "${CMAKE_CURRENT_BINARY_DIR}/${library}.verilated/V${block}.h"
    "${CMAKE_CURRENT_BINARY_DIR}/${other}.verilated/V${block}.h")
  add_custom_command(OUTPUT "${stamp}"
    COMMAND ${Python3_EXECUTABLE} -B "${FELTGATE_DEFECTS}" same-class ${headers} --output "${stamp}"
    DEPENDS ${headers} "${FELTGATE_DEFECTS}" VERBATIM)
  target_sources(${target} PRIVATE "${stamp}")
endfunction()

# feltgate_defect_tests(<test> <program> <block>): <test>.<patch> passes when an assertion fails,
# <test>.none when the same program finds nothing in the copy without a defect.
function(feltgate_defect_tests test program block)
  feltgate_patches(patches ${block})
  foreach(patch IN LISTS patches)
    get_filename_component(name "${patch}" NAME_WE)
    add_test(NAME ${test}.${name}
      COMMAND ${CMAKE_COMMAND} -DTEST=$<TARGET_FILE:${program}> -P "${FELTGATE_EXPECT_FAILURE}")
    set_tests_properties(${test}.${name} PROPERTIES LABELS mutation TIMEOUT 3600
      ENVIRONMENT "FELTGATE_DEFECT=${name};FELTGATE_MISMATCH_DIR=${PROJECT_BINARY_DIR}/mismatch/${name}")
  endforeach()
  add_test(NAME ${test}.none
    COMMAND ${CMAKE_COMMAND} -DTEST=$<TARGET_FILE:${program}> -P "${FELTGATE_EXPECT_QUIET}")
  set_tests_properties(${test}.none PROPERTIES LABELS mutation TIMEOUT 3600
    ENVIRONMENT "FELTGATE_DEFECT=none")
endfunction()
