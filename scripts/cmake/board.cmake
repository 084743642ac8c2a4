# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
#
# Simulated boards: feltgate_board has the twin of any design, feltgate_board_rtl_NAME also the Verilated RTL of one.
# docs/host.md
include_guard(GLOBAL)

feltgate_library(feltgate_board_parts host/board EXCEPT "/rtl_of_board\\.cpp$" feltgate_backends feltgate_loop feltgate_axes_loop)
target_compile_options(feltgate_board_parts PRIVATE ${FELTGATE_TWIN_OPTIONS})
set(board_libraries feltgate_command_line feltgate_board_parts feltgate_files feltgate_design)
feltgate_program(feltgate_board board_main.cpp ${board_libraries})

feltgate_rtl_files(linked_sources feltgate_linked)
list(PREPEND linked_sources ${FELTGATE_CORE_SOURCES})
list(REMOVE_DUPLICATES linked_sources)
foreach(design IN LISTS FELTGATE_DESIGNS FELTGATE_OTHERS)
  feltgate_device_of("${FELTGATE_ROOT}/rtl/designs/${design}.toml" device)
  feltgate_package(package ${design})
  feltgate_verilate(board_${design} board_pins
    "${package};${linked_sources};${FELTGATE_ROOT}/model/host/board/board_pins.sv" CLASS Vboard_${design} FASTEST ${device})
  feltgate_type_of(${design} type)
  set(source "${PROJECT_BINARY_DIR}/rtl/board_${design}.cpp")
  file(CONFIGURE OUTPUT "${source}" CONTENT "#include \"host/board/rtl_of_board.cpp\"\n")
  add_library(board_rtl_${design} OBJECT "${source}")
  target_compile_definitions(board_rtl_${design} PRIVATE FELTGATE_DESIGN=feltgate::${type}
    FELTGATE_DESIGN_HEADER="feltgate/generated/${design}.hpp" FELTGATE_RTL=Vboard_${design} FELTGATE_RTL_HEADER="Vboard_${design}.h")
  target_include_directories(board_rtl_${design} PRIVATE "${FELTGATE_HEADERS}")
  add_dependencies(board_rtl_${design} feltgate_headers)
  target_compile_options(board_rtl_${design} PRIVATE ${FELTGATE_TWIN_OPTIONS})
  target_link_libraries(board_rtl_${design} PRIVATE feltgate_board_parts board_${design})
  add_executable(feltgate_board_rtl_${design} $<TARGET_OBJECTS:feltgate_board> $<TARGET_OBJECTS:board_rtl_${design}>)
  target_link_libraries(feltgate_board_rtl_${design} PRIVATE ${board_libraries} board_${design} fmt::fmt)
  set_target_properties(board_${design} board_rtl_${design} feltgate_board_rtl_${design} PROPERTIES EXCLUDE_FROM_ALL ON)
endforeach()
