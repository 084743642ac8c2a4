# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
#
# feltgate_block_test(<block> [WITH_DEFECTS | DEFECT_FILE <file>] [NAME <test>] [DESIGN <design> | PACKAGE <cfg.sv>]
#                     [SOURCES extra.sv...] [PARAMS -GName=value...]
#                     [DEFINES NAME=value...] [LIBRARIES target...] [TESTS more.cpp...])
# verilates the RTL of the block, links it with testbench/<room>/<block>/<block>_test.cpp and with the TESTS in
# the same folder, and adds the CTest <test> (default <block>, labels unit and lockstep).
# WITH_DEFECTS: also <test>.<defect> (label mutation) for each defect in the folder's defects.diff, which passes only when an
# assertion fails, and mutate.<test>, a share of the block's mutants. DEFECT_FILE: those of another file, without mutants.
# SOURCES are relative to the repository. PARAMS
# go to the RTL, DEFINES to the test. <test>_cover is the same test on RTL with coverage counters.
# docs/testing.md
include_guard(GLOBAL)

if(FELTGATE_RTL)
  include("${CMAKE_CURRENT_LIST_DIR}/verilate.cmake")
endif()
include("${CMAKE_CURRENT_LIST_DIR}/defects.cmake")
include("${CMAKE_CURRENT_LIST_DIR}/mutants.cmake")
include("${CMAKE_CURRENT_LIST_DIR}/coverage.cmake")

find_package(Catch2 QUIET)
if(NOT Catch2_FOUND)
  # Version 2 is headers, which do where this is compiled for another machine; 3 is a library.
  find_path(FELTGATE_CATCH_INCLUDE_DIR catch2/catch.hpp REQUIRED)
  add_library(Catch2::Catch2 INTERFACE IMPORTED)
  target_include_directories(Catch2::Catch2 SYSTEM INTERFACE "${FELTGATE_CATCH_INCLUDE_DIR}")
endif()

if(NOT TARGET feltgate_catch_main)
  # main() and the reports of a mismatch.
  add_library(feltgate_catch_main STATIC
    ${FELTGATE_ROOT}/testbench/common/catch_main.cpp ${FELTGATE_ROOT}/testbench/common/mismatch.cpp)
  target_include_directories(feltgate_catch_main PUBLIC
    ${FELTGATE_ROOT}/testbench/common ${FELTGATE_ROOT}/model/include ${FELTGATE_HEADERS})
  if(TARGET feltgate_headers)
    add_dependencies(feltgate_catch_main feltgate_headers)
  endif()
  target_compile_definitions(feltgate_catch_main PUBLIC
    FELTGATE_BUILD_DIR="${PROJECT_BINARY_DIR}" FELTGATE_SOURCE_DIR="${FELTGATE_ROOT}")
  target_compile_features(feltgate_catch_main PUBLIC cxx_std_17)
  target_compile_options(feltgate_catch_main PRIVATE ${FELTGATE_WARNINGS} -O1)
  target_link_libraries(feltgate_catch_main PUBLIC Catch2::Catch2
    INTERFACE $<LINK_ONLY:$<TARGET_NAME_IF_EXISTS:feltgate_twin_parts>>)
  # Catch2's header is a second of the compiler, of most tests the greater half: read once.
  target_precompile_headers(feltgate_catch_main PRIVATE "${FELTGATE_ROOT}/testbench/common/catch.hpp")
  set_source_files_properties(${FELTGATE_ROOT}/testbench/common/catch_main.cpp
    PROPERTIES SKIP_PRECOMPILE_HEADERS ON)  # it says what Catch2's header is to be
endif()

if(FELTGATE_RTL AND NOT TARGET feltgate_lock_step)
  # The headers of every block's test, read once.
  file(CONFIGURE OUTPUT "${PROJECT_BINARY_DIR}/lock_step.cpp" CONTENT "#include \"lock_step.hpp\"\n")
  add_library(feltgate_lock_step OBJECT "${PROJECT_BINARY_DIR}/lock_step.cpp")
  target_compile_options(feltgate_lock_step PRIVATE ${FELTGATE_WARNINGS} -O1)
  target_include_directories(feltgate_lock_step PRIVATE "${FELTGATE_ROOT}/model")
  target_link_libraries(feltgate_lock_step PRIVATE feltgate_catch_main feltgate_verilated)
  target_precompile_headers(feltgate_lock_step PRIVATE
    "${FELTGATE_ROOT}/testbench/common/catch.hpp" "${FELTGATE_ROOT}/testbench/common/lock_step.hpp")
endif()

function(feltgate_block_test block)
  cmake_parse_arguments(PARSE_ARGV 1 arg "WITH_DEFECTS" "DEFECTS;DEFECT_FILE;NAME;DESIGN;PACKAGE" "SOURCES;PARAMS;DEFINES;LIBRARIES;TESTS")
  if(arg_UNPARSED_ARGUMENTS)
    message(FATAL_ERROR "feltgate_block_test(${block}): unknown ${arg_UNPARSED_ARGUMENTS}")
  endif()
  if(NOT arg_NAME)
    set(arg_NAME ${block})
  endif()
  if(NOT arg_DESIGN)
    set(arg_DESIGN lever)
  endif()
  if(arg_DEFECTS)
    message(FATAL_ERROR "${block}: DEFECTS ${arg_DEFECTS}; defects are in defects.diff, say WITH_DEFECTS")
  endif()
  if(NOT arg_PACKAGE)
    feltgate_package(arg_PACKAGE ${arg_DESIGN})
  endif()
  set(package "${arg_PACKAGE}" "${FELTGATE_MAP_PACKAGE}")
  set(sources "")
  foreach(source IN LISTS arg_SOURCES)
    get_filename_component(source "${source}" ABSOLUTE BASE_DIR "${FELTGATE_ROOT}")
    list(APPEND sources "${source}")
  endforeach()
  # rtl/link and rtl/engine have packages of their own.
  file(GLOB own "${FELTGATE_ROOT}/rtl/*/${block}.sv")
  list(APPEND sources ${own})
  foreach(folder link engine)
    if(own MATCHES "/rtl/${folder}/")
      list(APPEND package "${FELTGATE_ROOT}/rtl/generated/feltgate_${folder}_pkg.sv")
    endif()
  endforeach()
  feltgate_tests_of(folder ${block})
  list(REMOVE_ITEM sources "${FELTGATE_MAP_PACKAGE}")  # among the sources of the core

  # A block with a defect has the same ports, so one object of the test serves both.
  feltgate_verilate(${arg_NAME}_rtl ${block} "${package};${sources}" ${arg_PARAMS})
  list(TRANSFORM arg_TESTS PREPEND "${folder}/")
  add_library(${arg_NAME}_object OBJECT
    "${folder}/${block}_test.cpp" ${arg_TESTS})
  target_compile_definitions(${arg_NAME}_object PRIVATE ${arg_DEFINES})
  target_compile_options(${arg_NAME}_object PRIVATE ${FELTGATE_WARNINGS} -O1)
  target_precompile_headers(${arg_NAME}_object REUSE_FROM feltgate_lock_step)
  feltgate_unity(${arg_NAME}_object)
  target_link_libraries(${arg_NAME}_object PUBLIC feltgate_catch_main ${arg_LIBRARIES})
  target_link_libraries(${arg_NAME}_object PRIVATE ${arg_NAME}_rtl)
  if(TARGET feltgate_model)
    target_link_libraries(${arg_NAME}_object PUBLIC feltgate_model)
  endif()

  add_executable(${arg_NAME}_test $<TARGET_OBJECTS:${arg_NAME}_object>)
  target_link_libraries(${arg_NAME}_test PRIVATE
    feltgate_catch_main ${arg_LIBRARIES} ${arg_NAME}_rtl)
  # What is instantiated otherwise, and not the core or more: a usual run has one in 3.
  set(when "")
  if(NOT arg_NAME STREQUAL block AND NOT block MATCHES "^feltgate_")
    feltgate_weekly(when ${arg_NAME} 3)
  endif()
  if(when)
    feltgate_only_whole(${arg_NAME}_test ${arg_NAME}_rtl ${arg_NAME}_object)
  endif()
  add_test(NAME ${arg_NAME} COMMAND ${arg_NAME}_test ${when})
  set_tests_properties(${arg_NAME} PROPERTIES LABELS "unit;lockstep" TIMEOUT 3600)

  feltgate_cover_program(${arg_NAME} ${block} "${package};${sources}"
    LIBRARIES ${arg_LIBRARIES} PARAMS ${arg_PARAMS})
  if(arg_WITH_DEFECTS)
    set(arg_DEFECT_FILE "${folder}/defects.diff")
  endif()
  if(arg_DEFECT_FILE)
    feltgate_verilate_defects(${arg_NAME}_defects_rtl ${block} "${package}" "${sources}" FILE "${arg_DEFECT_FILE}" ${arg_PARAMS})
    add_executable(${arg_NAME}_defects $<TARGET_OBJECTS:${arg_NAME}_object>)
    target_link_libraries(${arg_NAME}_defects PRIVATE
      feltgate_catch_main ${arg_LIBRARIES} ${arg_NAME}_defects_rtl)
    feltgate_same_class(${arg_NAME}_defects ${block} ${arg_NAME}_rtl ${arg_NAME}_defects_rtl)
    feltgate_defect_tests(${arg_NAME} ${arg_NAME}_defects FILE "${arg_DEFECT_FILE}")
  endif()
  if(arg_WITH_DEFECTS)
    feltgate_mutants(${arg_NAME} ${block} "${package};${sources}" "${arg_LIBRARIES}" ${arg_PARAMS})
  endif()
endfunction()
