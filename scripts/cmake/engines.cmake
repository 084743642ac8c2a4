# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
#
# One engine library per design in rtl/designs: the Verilated core, its twin, both in lock-step.
include_guard(GLOBAL)
include("${CMAKE_CURRENT_LIST_DIR}/verilate.cmake")

file(STRINGS "${FELTGATE_ROOT}/rtl/feltgate_core.f" FELTGATE_CORE_SOURCES REGEX "^[^/]")
list(TRANSFORM FELTGATE_CORE_SOURCES PREPEND "${FELTGATE_ROOT}/rtl/")

file(GLOB designs CONFIGURE_DEPENDS "${FELTGATE_ROOT}/rtl/designs/*.toml")
# The engine of a preset costs a minute to build, so it is built when somebody asks for it.
set(FELTGATE_PRESETS "" CACHE STRING "Of fast, balanced and exact those whose engines are built")
foreach(preset fast balanced exact)
  if(NOT preset IN_LIST FELTGATE_PRESETS)
    list(REMOVE_ITEM designs "${FELTGATE_ROOT}/rtl/designs/${preset}.toml")
  endif()
endforeach()
add_library(feltgate_engines STATIC
  "${FELTGATE_ROOT}/model/engines/engine.cpp")
set(registrations "")
set(FELTGATE_BUDGET_SOURCES "")
foreach(path IN LISTS designs)
  get_filename_component(design "${path}" NAME_WE)
  if(NOT EXISTS "${FELTGATE_ROOT}/rtl/generated/${design}/feltgate_pkg.sv")
    message(STATUS "design ${design} has no generated files yet: run `feltgate generate`")
    continue()
  endif()
  # The C++ type of a design: its name in UpperCamelCase, as the generator writes it.
  string(REGEX REPLACE "[-_]" ";" words "${design}")
  set(type "")
  foreach(word IN LISTS words)
    string(SUBSTRING "${word}" 0 1 first)
    string(SUBSTRING "${word}" 1 -1 rest)
    string(TOUPPER "${first}" first)
    string(APPEND type "${first}${rest}")
  endforeach()
  feltgate_verilate(core_${design} feltgate_core
    "${FELTGATE_ROOT}/rtl/generated/${design}/feltgate_pkg.sv;${FELTGATE_CORE_SOURCES}"
    CLASS Vcore_${design} -O3)
  configure_file("${CMAKE_CURRENT_LIST_DIR}/design_engines.cpp.in"
    "${CMAKE_BINARY_DIR}/engines/${design}_engines.cpp" @ONLY)
  target_sources(feltgate_engines PRIVATE "${CMAKE_BINARY_DIR}/engines/${design}_engines.cpp")
  target_link_libraries(feltgate_engines PUBLIC core_${design})
  configure_file("${CMAKE_CURRENT_LIST_DIR}/design_budget.cpp.in"
    "${CMAKE_BINARY_DIR}/engines/${design}_budget.cpp" @ONLY)
  list(APPEND FELTGATE_BUDGET_SOURCES "${CMAKE_BINARY_DIR}/engines/${design}_budget.cpp")
  string(APPEND registrations "FELTGATE_DESIGN(${design})\n")
endforeach()
file(CONFIGURE OUTPUT "${CMAKE_BINARY_DIR}/engines/designs.inc" CONTENT "${registrations}")
target_link_libraries(feltgate_engines PUBLIC feltgate_model Boost::headers PRIVATE fmt::fmt)
target_include_directories(feltgate_engines PRIVATE "${CMAKE_BINARY_DIR}/engines")
# What a tick leaves as words the next one takes as words: in pairs they would wait for the store.
target_compile_options(feltgate_engines PRIVATE ${FELTGATE_WARNINGS} -O3 -fno-tree-slp-vectorize)
