# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
#
# feltgate_board: a simulated board with the twin; feltgate_board_rtl also has the Verilated RTL. docs/board.md
include_guard(GLOBAL)

feltgate_library(feltgate_board_parts host/board EXCEPT "/rtl_cores" feltgate_backends feltgate_loop feltgate_axes_loop)
# Also presets: an engine, three phases, and of devices with several axes those with a pen.
set(board_designs ${FELTGATE_DESIGNS} lever_law gimbal_motor pantograph_law stylus_law)
set(axes_of_pantograph_law 2)
set(axes_of_stylus_law 3)
set(registrations "")
foreach(design IN LISTS board_designs)
  feltgate_type_of(${design} type)
  set(axes 1)
  if(DEFINED axes_of_${design})
    set(axes ${axes_of_${design}})
  endif()
  string(APPEND registrations "FELTGATE_DESIGN(${design})\n")
  set(generated "${PROJECT_BINARY_DIR}/backends/${design}_board")
  feltgate_for_design(board "${generated}.cpp")
  target_sources(feltgate_board_parts PRIVATE "${generated}.cpp")
endforeach()
file(CONFIGURE OUTPUT "${PROJECT_BINARY_DIR}/backends/board_designs.inc" CONTENT "${registrations}")
# The RTL of one design: each costs a minute to compile.
set(design lever)
set(type ${FELTGATE_TYPE_lever})
file(STRINGS "${FELTGATE_ROOT}/rtl/feltgate_linked.f" linked_sources REGEX "^[^/]")
list(TRANSFORM linked_sources PREPEND "${FELTGATE_ROOT}/rtl/")
feltgate_verilate(board_lever board_pins
  "${FELTGATE_ROOT}/rtl/generated/lever/feltgate_pkg.sv;${linked_sources};${FELTGATE_ROOT}/model/host/board/board_pins.sv"
  CLASS Vboard_lever FASTEST)
set(rtl_sources "${FELTGATE_ROOT}/model/host/board/rtl_cores.cpp"
  "${PROJECT_BINARY_DIR}/backends/lever_board_rtl.cpp")
feltgate_for_design(board_rtl "${PROJECT_BINARY_DIR}/backends/lever_board_rtl.cpp")

target_include_directories(feltgate_board_parts PRIVATE "${PROJECT_BINARY_DIR}/backends")
target_compile_options(feltgate_board_parts PRIVATE ${FELTGATE_BACKEND_OPTIONS})

set(board_libraries feltgate_command_line feltgate_board_parts feltgate_files feltgate_design)
feltgate_program(feltgate_board board_main.cpp ${board_libraries})
feltgate_program(feltgate_board_rtl board_main.cpp ${board_libraries} board_lever)
target_sources(feltgate_board_rtl PRIVATE ${rtl_sources})
target_include_directories(feltgate_board_rtl PRIVATE "${PROJECT_BINARY_DIR}/backends")
set_source_files_properties(${rtl_sources} PROPERTIES COMPILE_OPTIONS "-O3;-fno-tree-slp-vectorize")
