# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
#
# feltgate_lock_step(<block> [DESIGNS design...] [TEST file.cpp] [SOURCES other.sv...] [FILE block.sv] [FOLDER folder]
#   [PARAMS -GName=value...]): a block of package cfg beside its twin.
# Verilates the block of each design (default lever and paper), writes its ports for C++ and links both with
# <block>_test.cpp as the CTest <block>.<design>, labels unit and lockstep. SOURCES lie in rtl/, before the block, and
# FILE, the block, where two have its name. FOLDER has cfg.sv and header of a design that only tests use. Of the first
# design the CTest mutate.<block>.<design> tries mutants; <block>.<design>_cover counts what is reached. docs/testing.md
include_guard(GLOBAL)

function(feltgate_lock_step block)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "TEST;FILE;FOLDER" "DESIGNS;SOURCES;PARAMS")
  if(arg_UNPARSED_ARGUMENTS)
    message(FATAL_ERROR "feltgate_lock_step(${block}): unknown ${arg_UNPARSED_ARGUMENTS}")
  endif()
  if(NOT arg_DESIGNS)
    set(arg_DESIGNS lever paper)
  endif()
  if(NOT arg_TEST)
    set(arg_TEST ${block}_test.cpp)
  endif()
  list(TRANSFORM arg_SOURCES PREPEND "${FELTGATE_ROOT}/rtl/")
  file(GLOB own "${FELTGATE_ROOT}/rtl/*/${block}.sv")
  if(arg_FILE)
    set(own "${FELTGATE_ROOT}/rtl/${arg_FILE}")
  endif()
  set(ports "${FELTGATE_ROOT}/testbench/common/block_ports.py")
  list(GET arg_DESIGNS 0 first)
  foreach(design IN LISTS arg_DESIGNS)
    set(name ${block}.${design})
    set(folder "${CMAKE_CURRENT_BINARY_DIR}/${name}")
    if(arg_FOLDER)
      set(package "${arg_FOLDER}/cfg.sv")
      set(header "${arg_FOLDER}/${design}.hpp")
    else()
      feltgate_package(package ${design})
      set(header "feltgate/generated/${design}.hpp")
    endif()
    set(sources "${package}" "${FELTGATE_ROOT}/rtl/generated/map.sv"
      "${FELTGATE_ROOT}/rtl/core/fx.sv" ${arg_SOURCES} ${own})
    feltgate_verilate(${name}_rtl ${block} "${sources}" -Wno-UNUSEDSIGNAL ${arg_PARAMS})
    add_custom_command(OUTPUT "${folder}/ports/${block}.hpp"
      COMMAND ${CMAKE_COMMAND} -E make_directory "${folder}/ports"
      COMMAND ${CMAKE_COMMAND} -E env "VERILATOR_ROOT=${VERILATOR_ROOT}" ${VERILATOR_BIN} --xml-only
              --xml-output "${folder}/${block}.xml" --Mdir "${folder}" --top-module ${block}
              -Wno-fatal -Wno-lint ${arg_PARAMS} ${sources}
      COMMAND ${Python3_EXECUTABLE} -B "${ports}" "${folder}/${block}.xml" "${folder}/ports/${block}.hpp"
      DEPENDS ${sources} "${ports}" VERBATIM)
    add_library(${name}_object OBJECT ${arg_TEST} "${folder}/ports/${block}.hpp")
    feltgate_type_of(${design} type)
    target_compile_definitions(${name}_object PRIVATE FELTGATE_DESIGN=feltgate::${type}
      FELTGATE_DESIGN_HEADER="${header}")
    target_compile_options(${name}_object PRIVATE ${FELTGATE_WARNINGS} -O1)
    target_precompile_headers(${name}_object REUSE_FROM feltgate_catch_main)
    target_include_directories(${name}_object PRIVATE "${folder}")
    target_link_libraries(${name}_object PRIVATE feltgate_catch_main ${name}_rtl)
    add_executable(${name}_test $<TARGET_OBJECTS:${name}_object>)
    target_link_libraries(${name}_test PRIVATE feltgate_catch_main ${name}_rtl)
    feltgate_cover_program(${name} ${block} "${sources}" PARAMS ${arg_PARAMS})
    set(when "")
    if(design STREQUAL first)
      feltgate_mutants(${name} ${block} "${sources}" "" ${arg_PARAMS})
    else()
      feltgate_weekly(when ${name} 3)
    endif()
    if(when)
      feltgate_only_whole(${name}_test ${name}_rtl ${name}_object)
    endif()
    add_test(NAME ${name} COMMAND ${name}_test ${when})
    set_tests_properties(${name} PROPERTIES LABELS "unit;lockstep" TIMEOUT 3600)
  endforeach()
endfunction()
