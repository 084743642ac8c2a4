# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
#
# Verilator: its run-time as a library and feltgate_verilate(). docs/testing.md
include_guard(GLOBAL)

# Slots, clocks, addresses and bits, equal in all designs; a block's sources need it beside a package.
set(FELTGATE_MAP_PACKAGE "${FELTGATE_ROOT}/rtl/generated/map.sv")
set(FELTGATE_JOIN_SOURCES "${CMAKE_CURRENT_LIST_DIR}/join_sources.cmake")
set(FELTGATE_INSTRUMENT "${FELTGATE_ROOT}/scripts/rtl_coverage/instrument.py")

find_package(verilator REQUIRED HINTS $ENV{VERILATOR_ROOT} /usr/share/verilator)
find_package(ZLIB REQUIRED)
find_package(Threads REQUIRED)

# Verilator's own run-time, compiled once; the second one has the counts that feltgate coverage reads.
find_library(FELTGATE_ATOMIC_LIBRARY NAMES atomic libatomic.so.1)
foreach(kind "" _coverage)
  set(runtime feltgate_verilated${kind})
  add_library(${runtime} STATIC
    ${VERILATOR_ROOT}/include/verilated.cpp
    ${VERILATOR_ROOT}/include/verilated_threads.cpp
    ${VERILATOR_ROOT}/include/verilated_fst_c.cpp)
  target_include_directories(${runtime} SYSTEM PUBLIC
    ${VERILATOR_ROOT}/include ${VERILATOR_ROOT}/include/vltstd)
  target_compile_definitions(${runtime} PUBLIC
    VM_COVERAGE=$<BOOL:${kind}> VM_SC=0 VM_TRACE=1 VM_TRACE_FST=1 VM_TRACE_VCD=0)
  target_compile_features(${runtime} PUBLIC cxx_std_17)
  target_compile_options(${runtime} PRIVATE -w -O2)
  target_link_libraries(${runtime} PUBLIC ZLIB::ZLIB Threads::Threads
    $<$<BOOL:${FELTGATE_ATOMIC_LIBRARY}>:${FELTGATE_ATOMIC_LIBRARY}>)
endforeach()
# Its headers take the compiler a second, most of the time of a small block: with hundreds of blocks they are read once.
if(FELTGATE_TESTS)
  # These two define macros before they include the headers.
  set_source_files_properties(${VERILATOR_ROOT}/include/verilated.cpp
    ${VERILATOR_ROOT}/include/verilated_fst_c.cpp PROPERTIES SKIP_PRECOMPILE_HEADERS ON)
  target_precompile_headers(feltgate_verilated PRIVATE <verilated.h> <verilated_fst_c.h>)
endif()
target_sources(feltgate_verilated_coverage PRIVATE ${VERILATOR_ROOT}/include/verilated_cov.cpp)
set_target_properties(feltgate_verilated_coverage PROPERTIES EXCLUDE_FROM_ALL TRUE)

# Only the oldest supported version decides which warnings are errors: newer ones learn new warnings.
execute_process(COMMAND ${VERILATOR_BIN} --version OUTPUT_VARIABLE FELTGATE_VERILATOR_VERSION)
string(REGEX MATCH "[0-9]+\\.[0-9]+" FELTGATE_VERILATOR_VERSION "${FELTGATE_VERILATOR_VERSION}")
# A block takes whole structs and uses the fields that concern it. Among axes whole structs go around, their bits do not.
set(FELTGATE_VERILATOR_WARNINGS -Wall -Wno-UNUSEDSIGNAL -Wno-UNOPTFLAT)
if(NOT FELTGATE_VERILATOR_VERSION VERSION_EQUAL "5.006")
  list(APPEND FELTGATE_VERILATOR_WARNINGS -Wno-fatal)
endif()
if("${FELTGATE_ROOT}${PROJECT_BINARY_DIR}" MATCHES " ")
  # Verilator ends a path at its first space, and then misses the module's name in it.
  list(APPEND FELTGATE_VERILATOR_WARNINGS -Wno-DECLFILENAME)
endif()

# For a model that runs for minutes: some percent faster than -O2, which packs words in pairs that are
# read again one by one.
set(FELTGATE_FASTEST_RTL -O3 -fno-tree-slp-vectorize)

# feltgate_verilate(<target> <top> <sources> [CLASS <name>] [FASTEST] [SYSTEMC] [COVERAGE] [verilator arguments...]):
# static library <target> with the class <name> (default V<top>), generated and compiled at build
# time as one translation unit. SYSTEMC: the class is an sc_module, which needs feltgate_verilated_sc.
# FASTEST: for a model that runs for minutes.
# COVERAGE: it counts what is reached, docs/testing.md; built where something asks for it.
function(feltgate_verilate target top sources)
  cmake_parse_arguments(PARSE_ARGV 3 arg "FASTEST;SYSTEMC;COVERAGE" "CLASS" "")
  if(NOT arg_CLASS)
    set(arg_CLASS V${top})
  endif()
  set(directory "${CMAKE_CURRENT_BINARY_DIR}/${target}.verilated")
  set(joined "${directory}/all.cpp")
  set(kind --cc --trace-fst)
  set(runtime feltgate_verilated)
  if(arg_SYSTEMC)
    set(kind --sc)
    set(runtime feltgate_verilated_sc)
  endif()
  # A function of ten thousand lines takes the compiler minutes, cut in pieces a fraction of that.
  set(speed --output-split-cfuncs 200)
  set(optimised -O2)
  if(arg_FASTEST)
    set(speed -O3)
    set(optimised -O2 ${FELTGATE_FASTEST_RTL})
  endif()
  set(instrument "")
  if(arg_COVERAGE)
    list(APPEND kind --coverage --coverage-max-width 4096 --assert)  # cover points count with --assert alone from 5.032 on
    set(runtime feltgate_verilated_coverage)
    set(instrument COMMAND ${Python3_EXECUTABLE} -B "${FELTGATE_INSTRUMENT}" "${directory}" ${arg_CLASS})
  endif()
  add_custom_command(
    OUTPUT "${joined}" "${directory}/${arg_CLASS}.h"
    COMMAND ${CMAKE_COMMAND} -E rm -rf "${directory}"
    COMMAND ${CMAKE_COMMAND} -E make_directory "${directory}"
    COMMAND ${CMAKE_COMMAND} -E env "VERILATOR_ROOT=${VERILATOR_ROOT}" ${VERILATOR_BIN} ${kind}
            --prefix ${arg_CLASS} --top-module ${top} --Mdir "${directory}"
            --x-initial unique --x-assign unique --output-split 0 ${speed} ${FELTGATE_VERILATOR_WARNINGS}
            "-I${FELTGATE_ROOT}/rtl/tops"
            ${arg_UNPARSED_ARGUMENTS} ${sources}
    ${instrument}
    COMMAND ${CMAKE_COMMAND} -DDIRECTORY=${directory} -P "${FELTGATE_JOIN_SOURCES}"
    DEPENDS ${sources} "${FELTGATE_JOIN_SOURCES}" $<$<BOOL:${arg_COVERAGE}>:${FELTGATE_INSTRUMENT}>
    COMMENT "Verilating ${target}" VERBATIM)
  add_library(${target} STATIC "${joined}" "${directory}/${arg_CLASS}.h")
  if(arg_COVERAGE)
    set_target_properties(${target} PROPERTIES EXCLUDE_FROM_ALL TRUE)
  endif()
  target_include_directories(${target} SYSTEM PUBLIC "${directory}")
  target_compile_options(${target} PRIVATE -w ${optimised})
  target_link_libraries(${target} PUBLIC ${runtime})
  if(FELTGATE_TESTS AND runtime STREQUAL "feltgate_verilated" AND NOT arg_FASTEST)
    target_precompile_headers(${target} REUSE_FROM feltgate_verilated)
  endif()
endfunction()
