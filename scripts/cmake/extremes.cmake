# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
#
# The cases of testbench/campaigns/extremes and the program feltgate_extremes, which writes their page. With
# the decoder alone, whose count starts just below the wrap, and a filter alone in each rounding. docs/extremes.md
include_guard(GLOBAL)

set(extremes_folder "${FELTGATE_ROOT}/testbench/campaigns/extremes")
feltgate_verilate(extremes_decoder quad_decoder
  "${FELTGATE_MAP_PACKAGE};${FELTGATE_ROOT}/rtl/core/quad_decoder.sv"
  -GResetPosition=2147483000)
set(extremes_blocks extremes_decoder)
file(READ "${FELTGATE_ROOT}/rtl/generated/lever/cfg.sv" extremes_lever)
set(extremes_roundings half_up down convergent)
foreach(number 0 1 2)
  list(GET extremes_roundings ${number} rounding)
  string(REPLACE " ROUNDING = 0;" " ROUNDING = ${number};" package "${extremes_lever}")
  set(sources "${PROJECT_BINARY_DIR}/extremes_filter/${rounding}/cfg.sv")
  file(CONFIGURE OUTPUT "${sources}" CONTENT "${package}" @ONLY)
  foreach(name generated/map core/fx core/travel_window core/velocity_estimator)
    list(APPEND sources "${FELTGATE_ROOT}/rtl/${name}.sv")
  endforeach()
  feltgate_verilate(extremes_filter_${rounding} filter_alone "${sources};${extremes_folder}/filter_alone.sv"
    CLASS Vfilter_${rounding})
  list(APPEND extremes_blocks extremes_filter_${rounding})
endforeach()
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS "${FELTGATE_ROOT}/rtl/generated/lever/cfg.sv")
# An engine of one axis, as the design with one has it, and one of three.
file(GLOB extremes_engine_parts CONFIGURE_DEPENDS "${FELTGATE_ROOT}/rtl/engine/*.sv")
feltgate_package(lever_law_package lever_law)
set(extremes_engine_sources "${lever_law_package}"
  "${FELTGATE_MAP_PACKAGE}" "${FELTGATE_ROOT}/rtl/generated/feltgate_engine_pkg.sv" ${extremes_engine_parts})
feltgate_verilate(extremes_engine engine "${extremes_engine_sources}")
feltgate_verilate(extremes_engine_axes engine "${extremes_engine_sources}"
  CLASS Vextremes_engine_axes -GAxisCount=3)
list(APPEND extremes_blocks extremes_engine extremes_engine_axes)

# A core of its own: paper with one voltage gain, and gains wider than any design for use needs them, for every Kp of
# the study of Jn/J. The cases write the values.
find_package(Python3 3.11 COMPONENTS Interpreter REQUIRED)
set(extremes_wide "${PROJECT_BINARY_DIR}/extremes_wide")
set(point_design "${FELTGATE_ROOT}/testbench/campaigns/explore/point_design.py")
file(MAKE_DIRECTORY "${extremes_wide}")
add_custom_command(OUTPUT "${extremes_wide}/cfg.sv" "${extremes_wide}/wide.hpp"
  COMMAND ${Python3_EXECUTABLE} -B "${point_design}" "${extremes_wide}/wide.toml" paper encoder.index=0
          control.kp_1_kg_m2=4200.0 voltage.kv_low=1.0 voltage.kv_high=1.0 motor.motor_current_limit_a=19.677293
          supervisor.polarity_current_a=1.0
  COMMAND feltgate_generate "${FELTGATE_ROOT}" --design "${extremes_wide}/wide.toml" --output "${extremes_wide}"
  DEPENDS feltgate_generate "${point_design}" "${FELTGATE_ROOT}/rtl/designs/paper.toml"
          "${FELTGATE_ROOT}/scripts/exploration/design_text.py" "${FELTGATE_ROOT}/rtl/registers.toml"
  COMMENT "Generating the design wide" VERBATIM)
feltgate_verilate(extremes_wide_core feltgate_core
  "${extremes_wide}/cfg.sv;${FELTGATE_CORE_SOURCES}" CLASS Vextremes_wide FASTEST)

file(GLOB extremes_sources CONFIGURE_DEPENDS "${extremes_folder}/*.cpp")
list(FILTER extremes_sources EXCLUDE REGEX "_(main|test)\\.cpp$")
add_library(feltgate_extreme_cases STATIC ${extremes_sources} "${extremes_wide}/wide.hpp")
target_compile_options(feltgate_extreme_cases PRIVATE ${FELTGATE_WARNINGS})
target_compile_definitions(feltgate_extreme_cases PRIVATE FELTGATE_WIDE_DESIGN="${extremes_wide}/wide.toml")
target_include_directories(feltgate_extreme_cases
  PUBLIC "${FELTGATE_ROOT}/testbench" "${FELTGATE_ROOT}/testbench/common" PRIVATE "${extremes_wide}")
target_link_libraries(feltgate_extreme_cases
  PUBLIC feltgate_rtl feltgate_loop feltgate_law feltgate_design feltgate_stability
  PRIVATE extremes_wide_core ${extremes_blocks} nlohmann_json::nlohmann_json fmt::fmt)

feltgate_program(feltgate_extremes ""
  feltgate_command_line feltgate_files feltgate_extreme_cases)
target_sources(feltgate_extremes PRIVATE "${extremes_folder}/extremes_main.cpp")
