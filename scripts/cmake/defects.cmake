# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
#
# Seeded defects: patches in testbench/<block>/defects. All patches of a block are in one model,
# all patches of a test's headers in one program.
# docs/testing.md
include_guard(GLOBAL)
find_package(Python3 3.11 COMPONENTS Interpreter REQUIRED)

set(FELTGATE_DEFECTS "${FELTGATE_ROOT}/scripts/defects.py")
file(GLOB FELTGATE_SEEDING CONFIGURE_DEPENDS "${FELTGATE_ROOT}/scripts/seeding/*.py")
list(APPEND FELTGATE_SEEDING "${FELTGATE_DEFECTS}")
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

# feltgate_patched_files(<variable> <patches>...): what they change, relative to the repository.
function(feltgate_patched_files variable)
  set(all "")
  foreach(patch IN LISTS ARGN)
    file(STRINGS "${patch}" files REGEX "^\\+\\+\\+ b/")
    list(TRANSFORM files REPLACE "^\\+\\+\\+ b/([^ \t]+).*" "\\1")
    list(APPEND all ${files})
  endforeach()
  list(REMOVE_DUPLICATES all)
  set(${variable} "${all}" PARENT_SCOPE)
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
    DEPENDS ${patches} ${sources} ${FELTGATE_SEEDING}
    COMMENT "Seeding defects into ${block}" VERBATIM)
  list(FILTER sources EXCLUDE REGEX "/${block}\\.sv$")
  # A defect may leave signals unused; what does not elaborate is an error. Flat: modules that stay are
  # members of the class.
  feltgate_verilate(${target} ${block} "${package};${sources};${copies}"
    -Wno-fatal -Wno-lint -Wno-style --trace-depth 1 --flatten ${ARGN})
  target_compile_options(${target} PRIVATE -O1)
  target_link_libraries(${target} PUBLIC feltgate_chosen_defect)
endfunction()

# feltgate_same_class(<target> <block> <library> <other>): the target, compiled with V<block> of one library,
# is linked with that of another; the build fails where the two are not laid out alike.
function(feltgate_same_class target block library other)
  set(stamp "${CMAKE_CURRENT_BINARY_DIR}/${target}.${block}.same_class")
  set(headers "$<TARGET_PROPERTY:${library},BINARY_DIR>/${library}.verilated/V${block}.h"
    "$<TARGET_PROPERTY:${other},BINARY_DIR>/${other}.verilated/V${block}.h")
  add_custom_command(OUTPUT "${stamp}"
    COMMAND ${Python3_EXECUTABLE} -B "${FELTGATE_DEFECTS}" same-class ${headers} --output "${stamp}"
    DEPENDS ${headers} ${FELTGATE_SEEDING} VERBATIM)
  target_sources(${target} PRIVATE "${stamp}")
  set_property(TARGET ${target} APPEND PROPERTY LINK_DEPENDS "${stamp}")  # it compiles nothing itself
endfunction()

# feltgate_seeded_sources(<variable> <part>...): files that compile model/law/<part>.cpp from the copy that holds
# the defects. The linker takes these before those of the library, which therefore are objects of their own.
function(feltgate_seeded_sources variable)
  set(seeded "")
  foreach(part IN LISTS ARGN)
    file(CONFIGURE OUTPUT "seeded_${part}.cpp" CONTENT "#include \"law/${part}.cpp\"\n")
    list(APPEND seeded "${CMAKE_CURRENT_BINARY_DIR}/seeded_${part}.cpp")
    set_source_files_properties("${CMAKE_CURRENT_BINARY_DIR}/seeded_${part}.cpp" PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
    set_source_files_properties("${FELTGATE_ROOT}/model/law/${part}.cpp" TARGET_DIRECTORY feltgate_law
      PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
  endforeach()
  set(${variable} "${seeded}" PARENT_SCOPE)
endfunction()

# feltgate_defect_program(<target> PATCHES p... SOURCES s... [LIBRARIES l...]): a Catch2 program of these
# sources on headers that hold the statements of all patches; FELTGATE_DEFECT says which are executed.
function(feltgate_defect_program target)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "" "PATCHES;SOURCES;LIBRARIES")
  set(copies "${CMAKE_CURRENT_BINARY_DIR}/${target}.headers")
  feltgate_patched_files(changed ${arg_PATCHES})
  list(TRANSFORM changed PREPEND "${FELTGATE_ROOT}/")
  add_custom_command(OUTPUT "${copies}/seeded_choice.hpp"
    COMMAND ${CMAKE_COMMAND} -E rm -rf "${copies}"
    COMMAND ${Python3_EXECUTABLE} -B "${FELTGATE_DEFECTS}" headers ${arg_PATCHES}
            --root "${FELTGATE_ROOT}" --output "${copies}"
    DEPENDS ${arg_PATCHES} ${changed} ${FELTGATE_SEEDING}
    COMMENT "Seeding defects for ${target}" VERBATIM)
  add_executable(${target} ${arg_SOURCES} "${copies}/seeded_choice.hpp")
  target_include_directories(${target} BEFORE PRIVATE "${copies}/model/include" "${copies}/model")
  # As quick to compile as -O0, nearly, and several times as quick to run.
  target_compile_options(${target} PRIVATE -w -O1)
  target_precompile_headers(${target} REUSE_FROM feltgate_catch_main)
  feltgate_unity(${target})
  target_link_libraries(${target} PRIVATE
    feltgate_catch_main feltgate_model feltgate_chosen_defect ${arg_LIBRARIES})
endfunction()

# feltgate_defect_tests(<test> <program> PATCHES p... [CASES tag]): <test>.<patch> passes when an assertion
# fails, <test>.none when the same program finds nothing in the copy without a defect; in a usual run without
# cases tagged [endurance]. A patch whose second line is "Caught by: CASE" is tried with that case alone.
function(feltgate_defect_tests test program)
  cmake_parse_arguments(PARSE_ARGV 2 arg "" "CASES" "PATCHES")
  set(command "-DTEST=${CMAKE_CROSSCOMPILING_EMULATOR};$<TARGET_FILE:${program}>;${arg_CASES}")
  foreach(patch IN LISTS arg_PATCHES)
    get_filename_component(name "${patch}" NAME_WE)
    file(STRINGS "${patch}" case LIMIT_COUNT 1 REGEX "^Caught by: ")
    string(REGEX REPLACE "^Caught by: " "" case "${case}")
    set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS "${patch}")
    add_test(NAME ${test}.${name}
      COMMAND ${CMAKE_COMMAND} "${command};${case}" -P "${FELTGATE_EXPECT_FAILURE}")
    set_tests_properties(${test}.${name} PROPERTIES LABELS mutation TIMEOUT 3600
      ENVIRONMENT "FELTGATE_LONG=1;FELTGATE_DEFECT=${name};FELTGATE_MISMATCH_DIR=${PROJECT_BINARY_DIR}/mismatch/${name}")
  endforeach()
  add_test(NAME ${test}.none COMMAND ${CMAKE_COMMAND} "${command}" -P "${FELTGATE_EXPECT_QUIET}")
  set_tests_properties(${test}.none PROPERTIES LABELS mutation TIMEOUT 3600
    ENVIRONMENT "FELTGATE_LONG=1;FELTGATE_DEFECT=none")
endfunction()
