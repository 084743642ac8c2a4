# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
#
# Seeded defects: patches in testbench/<room>/<block>/defects.diff. All defects of a block are in one model,
# all defects of a test's headers in one program. FILE is relative to the room, without DEFECTS all defects of the
# file are taken.
# docs/testing.md
include_guard(GLOBAL)
find_package(Python3 3.11 COMPONENTS Interpreter REQUIRED)

set(FELTGATE_DEFECTS "${FELTGATE_ROOT}/scripts/defects.py")
file(GLOB FELTGATE_SEEDING CONFIGURE_DEPENDS "${FELTGATE_ROOT}/scripts/seeded_defects/*.py")
list(APPEND FELTGATE_SEEDING "${FELTGATE_DEFECTS}")
set(FELTGATE_EXPECT_FAILURE "${CMAKE_CURRENT_LIST_DIR}/expect_failure.cmake")
set(FELTGATE_EXPECT_QUIET "${CMAKE_CURRENT_LIST_DIR}/expect_quiet.cmake")

add_library(feltgate_chosen_defect STATIC ${FELTGATE_ROOT}/testbench/common/chosen_defect.cpp)
target_compile_options(feltgate_chosen_defect PRIVATE ${FELTGATE_WARNINGS})

# feltgate_defect_names(<variable> <file>): the defects of a file for tests, of which there must be one.
function(feltgate_defect_names variable file)
  set(names "")
  if(EXISTS "${file}")
    file(STRINGS "${file}" names REGEX "^== [^ ]+$")
    list(TRANSFORM names REPLACE "^== " "")
    list(REMOVE_DUPLICATES names)  # defects.py refuses them, and says where
  endif()
  if(NOT names)
    message(FATAL_ERROR "${file}: no defect there; docs/testing.md says how")
  endif()
  set(${variable} "${names}" PARENT_SCOPE)
endfunction()

# feltgate_defect_lines(<variable> <file> <name> <begin>): the rest of the lines of a defect that begin so.
function(feltgate_defect_lines variable file name begin)
  set(found "")
  set(here "")
  file(STRINGS "${file}" lines REGEX "^(== |${begin})")
  foreach(line IN LISTS lines)
    if(line MATCHES "^== (.*)")
      set(here "${CMAKE_MATCH_1}")
    elseif(here STREQUAL name)
      string(REGEX REPLACE "^${begin}" "" line "${line}")
      list(APPEND found "${line}")
    endif()
  endforeach()
  if(NOT "== ${name}" IN_LIST lines)
    message(FATAL_ERROR "${file}: no defect ${name}")
  endif()
  set(${variable} "${found}" PARENT_SCOPE)
endfunction()

# feltgate_patched_files(<variable> <file> <name>...): what these defects change, relative to the repository.
function(feltgate_patched_files variable file)
  set(all "")
  foreach(name IN LISTS ARGN)
    feltgate_defect_lines(files "${file}" ${name} "\\+\\+\\+ b/")
    list(APPEND all ${files})
  endforeach()
  list(TRANSFORM all REPLACE "[ \t].*" "")
  list(REMOVE_DUPLICATES all)
  set(${variable} "${all}" PARENT_SCOPE)
endfunction()

# arg_FILE absolute, and arg_DEFECTS where they are not given.
macro(feltgate_default_defects)
  get_filename_component(arg_FILE "${arg_FILE}" ABSOLUTE)
  if(NOT arg_DEFECTS)
    feltgate_defect_names(arg_DEFECTS "${arg_FILE}")
  endif()
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS "${arg_FILE}")
endmacro()

# feltgate_tests_of(<variable> <block>): testbench/<room>/<block>.
function(feltgate_tests_of variable block)
  file(GLOB folder "${FELTGATE_ROOT}/testbench/*/${block}")
  list(LENGTH folder count)
  if(NOT count EQUAL 1)
    message(FATAL_ERROR "${block}: ${count} folders testbench/*/${block}")
  endif()
  set(${variable} "${folder}" PARENT_SCOPE)
endfunction()

# feltgate_verilate_defects(<target> <block> <package> <sources> [FILE f] [verilator arguments...]): a library
# with the class V<block>, which is what the environment variable FELTGATE_DEFECT names: the block with
# one of its defects, or with none. Copies of the block side by side, of which one has a clock.
function(feltgate_verilate_defects target block package sources)
  cmake_parse_arguments(PARSE_ARGV 4 arg "" "FILE" "")
  feltgate_tests_of(folder ${block})
  set(file "${folder}/defects.diff")
  if(arg_FILE)
    set(file "${arg_FILE}")
  endif()
  feltgate_defect_names(names "${file}")
  set(copies "${CMAKE_CURRENT_BINARY_DIR}/${target}.sv")
  add_custom_command(OUTPUT "${copies}"
    COMMAND ${Python3_EXECUTABLE} -B "${FELTGATE_DEFECTS}" block ${block} --root "${FELTGATE_ROOT}"
            --output "${copies}" --defects "${file}" --sources ${sources}
    DEPENDS "${file}" ${sources} ${FELTGATE_SEEDING}
    COMMENT "Seeding defects into ${block}" VERBATIM)
  list(FILTER sources EXCLUDE REGEX "/${block}\\.sv$")
  # A defect may leave signals unused; what does not elaborate is an error. Flat: modules that stay are
  # members of the class.
  feltgate_verilate(${target} ${block} "${package};${sources};${copies}"
    -Wno-fatal -Wno-lint -Wno-style --trace-depth 1 --flatten ${arg_UNPARSED_ARGUMENTS})
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

# feltgate_defect_program(<target> FILE f [DEFECTS names...] SOURCES s... [LIBRARIES l...]): a Catch2 program of
# these sources on headers that hold the statements of all defects; FELTGATE_DEFECT says which are executed.
function(feltgate_defect_program target)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "FILE" "DEFECTS;SOURCES;LIBRARIES")
  feltgate_default_defects()
  set(copies "${CMAKE_CURRENT_BINARY_DIR}/${target}.headers")
  feltgate_patched_files(changed "${arg_FILE}" ${arg_DEFECTS})
  list(TRANSFORM changed PREPEND "${FELTGATE_ROOT}/")
  add_custom_command(OUTPUT "${copies}/seeded_choice.hpp"
    COMMAND ${CMAKE_COMMAND} -E rm -rf "${copies}"
    COMMAND ${Python3_EXECUTABLE} -B "${FELTGATE_DEFECTS}" headers "${arg_FILE}" ${arg_DEFECTS}
            --root "${FELTGATE_ROOT}" --output "${copies}"
    DEPENDS "${arg_FILE}" ${changed} ${FELTGATE_SEEDING}
    COMMENT "Seeding defects for ${target}" VERBATIM)
  add_executable(${target} ${arg_SOURCES} "${copies}/seeded_choice.hpp")
  set_target_properties(${target} PROPERTIES FELTGATE_DEFECT_FILE "${arg_FILE}")
  target_include_directories(${target} BEFORE PRIVATE "${copies}/model/include" "${copies}/model")
  # As quick to compile as -O0, nearly, and several times as quick to run. The twin is of the copies, too.
  target_compile_options(${target} PRIVATE -w -O1 -UFELTGATE_COMPILED_TWIN)
  target_precompile_headers(${target} REUSE_FROM feltgate_catch_main)
  feltgate_unity(${target})
  target_link_libraries(${target} PRIVATE
    feltgate_catch_main feltgate_model feltgate_chosen_defect ${arg_LIBRARIES})
endfunction()

# feltgate_defect_tests(<test> <program> [FILE f] [DEFECTS names...] [CASES tag]): <test>.<defect> passes when an
# assertion fails, <test>.none when the same program finds nothing in the copy without a defect. A defect with a line
# "Caught by: CASE[,CASE]" is tried with these cases alone. If all defects have that line, a usual run tries the copy
# without a defect with the cases of the first, else with all cases not tagged [endurance]. FILE is the program's where
# none is named. A usual run has a quarter of the programs, another one each week.
function(feltgate_defect_tests test program)
  cmake_parse_arguments(PARSE_ARGV 2 arg "" "FILE;CASES" "DEFECTS")
  if(NOT arg_FILE)
    get_target_property(arg_FILE ${program} FELTGATE_DEFECT_FILE)
  endif()
  feltgate_default_defects()
  feltgate_weekly(when ${program} 4)
  if(when)
    feltgate_only_whole(${program})
    if(TARGET ${program}_rtl)
      set_target_properties(${program}_rtl PROPERTIES EXCLUDE_FROM_ALL ON)
    endif()
  endif()
  set(command "-DTEST=${CMAKE_CROSSCOMPILING_EMULATOR};$<TARGET_FILE:${program}>;${arg_CASES}")
  set(cases "")
  set(all FALSE)
  foreach(name IN LISTS arg_DEFECTS)
    feltgate_defect_lines(case "${arg_FILE}" ${name} "Caught by: ")
    if(case)
      list(APPEND cases "${case}")
    else()
      set(all TRUE)
    endif()
    add_test(NAME ${test}.${name}
      COMMAND ${CMAKE_COMMAND} "${command};${case}" -P "${FELTGATE_EXPECT_FAILURE}" ${when})
    set_tests_properties(${test}.${name} PROPERTIES LABELS mutation TIMEOUT 3600
      ENVIRONMENT "FELTGATE_LONG=1;FELTGATE_DEFECT=${name};FELTGATE_MISMATCH_DIR=${PROJECT_BINARY_DIR}/mismatch/${name}")
  endforeach()
  if(all)
    set(cases "~[endurance]")
  endif()
  list(GET cases 0 cases)
  add_test(NAME ${test}.none
    COMMAND ${CMAKE_COMMAND} "${command}" "-DCASES=${cases}" -P "${FELTGATE_EXPECT_QUIET}" ${when})
  set_tests_properties(${test}.none PROPERTIES LABELS mutation TIMEOUT 3600
    ENVIRONMENT "FELTGATE_LONG=1;FELTGATE_DEFECT=none")
endfunction()
