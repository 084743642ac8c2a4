# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
#
# Mutants of the RTL: a block's test program linked with a netlist of the block with all its mutants.
# docs/testing.md
include_guard(GLOBAL)

set(FELTGATE_MUTANTS 400 CACHE STRING "mutants of each block")
set(FELTGATE_MUTANTS_SHARE 20 CACHE STRING "mutants that every test run tries of each")
# Blocks of which these are tried; of the others with --whole.
set(FELTGATE_MUTANT_BLOCKS arming link_receiver observer ramp registers scene torque_law)
# Blocks whose children have mutants of their own: only their own cells and the children's pins change.
set(FELTGATE_MUTANT_TOPS feltgate_core feltgate_linked axes_engine)
set(FELTGATE_MUTANT_SEED 1 CACHE STRING "which mutants these are")
set(FELTGATE_WRITE_MUTANTS "${FELTGATE_ROOT}/scripts/mutants.py")
find_program(FELTGATE_MUTANT_YOSYS yosys)
if(NOT FELTGATE_MUTANT_YOSYS)
  message(STATUS "no yosys: the mutants of the RTL are left out")
endif()

# feltgate_mutants(<test> <block> <sources> <libraries> [-GName=value...]): <test>_mutants is the test's object
# with the class V<block> of a netlist; the environment variable FELTGATE_MUTANT is the number of one. The CTest
# mutate.<test> tries a share of them: in a usual run of some blocks, with --whole of all.
function(feltgate_mutants test block sources libraries)
  # Axes are cores, whose mutants are the core's.
  if(NOT FELTGATE_MUTANT_YOSYS OR block STREQUAL feltgate_axes)
    return()
  endif()
  set(target ${test}_mutants)
  set(folder "${CMAKE_CURRENT_BINARY_DIR}/${target}.netlist")
  file(CONFIGURE OUTPUT "${folder}/test.json" CONTENT "{\"test\": \"${test}\", \"block\": \"${block}\"}\n")
  set(parameters ${ARGN})
  list(TRANSFORM parameters REPLACE "^-G" "--parameter=")
  if(block IN_LIST FELTGATE_MUTANT_TOPS)
    list(APPEND parameters --own)
  endif()
  add_custom_command(OUTPUT "${folder}/${block}.sv" "${folder}/mutants.json"
    COMMAND ${Python3_EXECUTABLE} -B "${FELTGATE_WRITE_MUTANTS}" ${block} --root "${FELTGATE_ROOT}"
            --sources ${sources} ${parameters} --count ${FELTGATE_MUTANTS} --seed ${FELTGATE_MUTANT_SEED}
            --output "${folder}/${block}.sv"
    DEPENDS ${sources} "${FELTGATE_WRITE_MUTANTS}" "${FELTGATE_ROOT}/scripts/mutation/netlist.py"
            "${FELTGATE_ROOT}/scripts/rtl_sources.py" "${FELTGATE_ROOT}/scripts/seeded_defects/block.py"
    COMMENT "Making mutants of ${test}" VERBATIM)
  # Packages for the types of the ports. Yosys' Verilog is not written to please a linter.
  set(packages ${sources})
  list(FILTER packages INCLUDE REGEX "(_pkg|/cfg|/map)\\.sv$")
  feltgate_verilate(${target}_rtl ${block} "${packages};${folder}/${block}.sv"
    -Wno-fatal -Wno-lint -Wno-style -Wno-UNOPTFLAT --trace-depth 1 --flatten ${ARGN})
  target_compile_options(${target}_rtl PRIVATE -O1)
  target_link_libraries(${target}_rtl PUBLIC feltgate_chosen_defect)
  add_executable(${target} $<TARGET_OBJECTS:${test}_object>)
  target_link_libraries(${target} PRIVATE feltgate_catch_main ${libraries} ${target}_rtl)
  feltgate_same_class(${target} ${block} ${test}_rtl ${target}_rtl)

  # A usual run: of a share of the blocks the first test.
  get_property(known GLOBAL PROPERTY FELTGATE_BLOCKS_WITH_MUTANTS)
  set_property(GLOBAL APPEND PROPERTY FELTGATE_BLOCKS_WITH_MUTANTS ${block})
  feltgate_weekly(when mutate.${test} 3)
  if(block IN_LIST known OR NOT block IN_LIST FELTGATE_MUTANT_BLOCKS)
    set(when ${FELTGATE_WHOLE})
  endif()
  if(when)
    feltgate_only_whole(${target} ${target}_rtl)
  endif()
  set(script "${FELTGATE_ROOT}/scripts/mutate.py")
  add_test(NAME mutate.${test} COMMAND ${Python3_EXECUTABLE} -B "${script}" ${block}.${test} --no-build --jobs 1
    --count ${FELTGATE_MUTANTS_SHARE} ${when})
  set_tests_properties(mutate.${test} PROPERTIES LABELS mutation TIMEOUT 3600
    REQUIRED_FILES "${script};${CMAKE_CURRENT_BINARY_DIR}/${target};${folder}/mutants.json"
    ENVIRONMENT "FELTGATE_ROOT=${FELTGATE_ROOT};FELTGATE_BUILD=${PROJECT_BINARY_DIR}")
endfunction()
