# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
#
# Extremes: decoder and low-pass alone as well, the decoder's count starting just below the wrap.
include_guard(GLOBAL)

feltgate_verilate(extremes_decoder quad_decoder "${FELTGATE_ROOT}/rtl/quad_decoder.sv"
  CLASS Vextremes_decoder -GResetPosition=2147483000)
foreach(mode "" _truncate _convergent)  # half up, floor, convergent
  list(APPEND extremes_lowpass_modes extremes_lowpass${mode})
  list(LENGTH extremes_lowpass_modes rounding)
  math(EXPR rounding "${rounding} - 1")
  feltgate_verilate(extremes_lowpass${mode} lowpass
    "${FELTGATE_ROOT}/rtl/generated/paper/feltgate_pkg.sv;${FELTGATE_MAP_PACKAGE};${FELTGATE_ROOT}/rtl/lowpass.sv"
    CLASS Vextremes_lowpass${mode} -GRounding=${rounding})
endforeach()

# A core of its own, with gains wider than any design for use needs them.
set(extremes_wide "${PROJECT_BINARY_DIR}/extremes_wide")
set(extremes_wide_design "${FELTGATE_ROOT}/testbench/extremes/designs/wide.toml")
add_custom_command(OUTPUT "${extremes_wide}/feltgate_pkg.sv" "${extremes_wide}/wide.hpp"
  COMMAND feltgate_generate "${FELTGATE_ROOT}"
    --design "${extremes_wide_design}" --output "${extremes_wide}"
  DEPENDS feltgate_generate "${extremes_wide_design}" "${FELTGATE_ROOT}/rtl/registers.toml"
  COMMENT "Generating the design wide" VERBATIM)
feltgate_verilate(extremes_wide_core feltgate_core
  "${extremes_wide}/feltgate_pkg.sv;${FELTGATE_CORE_SOURCES}" CLASS Vextremes_wide -O3)

feltgate_library(feltgate_extremes extremes
  feltgate_rtl feltgate_loop feltgate_design feltgate_stability)
target_sources(feltgate_extremes PRIVATE "${extremes_wide}/wide.hpp")
target_include_directories(feltgate_extremes PRIVATE "${extremes_wide}")
target_link_libraries(feltgate_extremes PRIVATE extremes_decoder ${extremes_lowpass_modes}
  extremes_wide_core nlohmann_json::nlohmann_json)
