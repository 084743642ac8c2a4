# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
#
# Simulated boards. feltgate_board has the twins of the designs that every program has, feltgate_board_NAME that of a
# preset, and feltgate_board_rtl_NAME twin and Verilated RTL of one design. docs/host.md
include_guard(GLOBAL)

feltgate_library(feltgate_board_parts host/board feltgate_backends feltgate_loop feltgate_axes_loop)
target_compile_options(feltgate_board_parts PRIVATE ${FELTGATE_BACKEND_OPTIONS})
set(board_libraries feltgate_command_line feltgate_board_parts feltgate_files feltgate_design)
feltgate_program(feltgate_board board_main.cpp ${board_libraries})

# feltgate_board_objects(<kind> <part> [library]): board_<kind>_<design>, which makes that kind of ${design} known.
function(feltgate_board_objects kind part)
  feltgate_type_of(${design} type)
  set(source "${PROJECT_BINARY_DIR}/backends/${design}_board_${kind}.cpp")
  feltgate_for_design(${part} "${source}")
  add_library(board_${kind}_${design} OBJECT "${source}")
  target_compile_options(board_${kind}_${design} PRIVATE ${FELTGATE_BACKEND_OPTIONS})
  target_link_libraries(board_${kind}_${design} PRIVATE feltgate_board_parts ${ARGN})
  set_target_properties(board_${kind}_${design} PROPERTIES EXCLUDE_FROM_ALL ON)
endfunction()

# feltgate_board_program(<name> [library]): board_main.cpp with these objects and libraries, built when it is asked for.
function(feltgate_board_program name)
  add_executable(${name} $<TARGET_OBJECTS:feltgate_board> ${ARGN})
  target_link_libraries(${name} PRIVATE ${board_libraries} fmt::fmt)
  set_target_properties(${name} PROPERTIES EXCLUDE_FROM_ALL ON)
endfunction()

feltgate_rtl_files(linked_sources feltgate_linked)
list(PREPEND linked_sources ${FELTGATE_CORE_SOURCES})
list(REMOVE_DUPLICATES linked_sources)
foreach(design IN LISTS FELTGATE_DESIGNS FELTGATE_PRESETS)
  set(header "${FELTGATE_ROOT}/model/include/feltgate/generated/${design}.hpp")
  if(NOT EXISTS "${header}")
    continue()
  endif()
  feltgate_board_objects(twin board)
  set(twin $<TARGET_OBJECTS:board_twin_${design}>)
  if(design IN_LIST FELTGATE_PRESETS)
    feltgate_board_program(feltgate_board_${design} ${twin})
  else()
    target_sources(feltgate_board PRIVATE ${twin})
  endif()
  feltgate_device_of("${header}" device)
  feltgate_package(package ${design})
  feltgate_verilate(board_${design} board_pins
    "${package};${linked_sources};${FELTGATE_ROOT}/model/host/board/board_pins.sv" CLASS Vboard_${design} FASTEST ${device})
  set_target_properties(board_${design} PROPERTIES EXCLUDE_FROM_ALL ON)
  feltgate_board_objects(rtl board_rtl board_${design})
  feltgate_board_program(feltgate_board_rtl_${design} ${twin} $<TARGET_OBJECTS:board_rtl_${design}>)
  target_link_libraries(feltgate_board_rtl_${design} PRIVATE board_${design})
endforeach()
