# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
#
# feltgate::backends: the twin and the real chains of each design in rtl/designs, by name.
# rtl.cmake adds the back-ends of the Verilated core.
include_guard(GLOBAL)

file(GLOB designs CONFIGURE_DEPENDS "${FELTGATE_ROOT}/rtl/designs/*.toml")
# A new design gets its back-ends once its files are generated: then this list changes.
file(GLOB generated CONFIGURE_DEPENDS "${FELTGATE_ROOT}/model/include/feltgate/generated/*.hpp")
# Presets are in programs of their own: presets.cmake, python.cmake.
set(presets "${FELTGATE_ROOT}/rtl/designs/presets.txt")
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS "${presets}")
file(STRINGS "${presets}" FELTGATE_PRESETS REGEX "^[a-z]")
foreach(preset IN LISTS FELTGATE_PRESETS)
  list(REMOVE_ITEM designs "${FELTGATE_ROOT}/rtl/designs/${preset}.toml")
endforeach()

# feltgate_part_of(<variable> <file> <part>): the lines between "== PART" and the next such line, or the end.
function(feltgate_part_of variable file part)
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS "${file}")
  file(READ "${file}" text)
  set(head "\n== ${part}\n")
  string(FIND "${text}" "${head}" begin)
  if(begin EQUAL -1)
    message(FATAL_ERROR "${file}: no part ${part}")
  endif()
  string(LENGTH "${head}" length)
  math(EXPR begin "${begin} + ${length}")
  string(SUBSTRING "${text}" ${begin} -1 text)
  string(FIND "${text}" "\n== " end)
  if(NOT end EQUAL -1)
    math(EXPR end "${end} + 1")
  endif()
  string(SUBSTRING "${text}" 0 ${end} text)
  set(${variable} "${text}" PARENT_SCOPE)
endfunction()

# feltgate_for_design(<part> <output>): that part of design.cpp.in, filled for ${design} of C++ type ${type}.
function(feltgate_for_design part output)
  feltgate_part_of(text "${FELTGATE_ROOT}/scripts/cmake/design.cpp.in" ${part})
  file(CONFIGURE OUTPUT "${output}" CONTENT "${text}" @ONLY)
endfunction()

# feltgate_type_of(<design> <variable>): its C++ type, the name in UpperCamelCase, as the generator
# writes it.
function(feltgate_type_of design variable)
  string(REGEX REPLACE "[-_]" ";" words "${design}")
  set(type "")
  foreach(word IN LISTS words)
    string(SUBSTRING "${word}" 0 1 first)
    string(SUBSTRING "${word}" 1 -1 rest)
    string(TOUPPER "${first}" first)
    string(APPEND type "${first}${rest}")
  endforeach()
  set(${variable} "${type}" PARENT_SCOPE)
endfunction()

# feltgate_package(<variable> <design>): the cfg.sv of a design in rtl/designs. Three are committed; the others are made of
# their files at build time.
function(feltgate_package variable design)
  set(package "${FELTGATE_ROOT}/rtl/generated/${design}/cfg.sv")
  if(NOT EXISTS "${package}")
    set(folder "${PROJECT_BINARY_DIR}/designs/${design}")
    set(package "${folder}/cfg.sv")
    if(NOT TARGET package_${design})
      set(file "${FELTGATE_ROOT}/rtl/designs/${design}.toml")
      add_custom_command(OUTPUT "${package}"
        COMMAND feltgate_generate "${FELTGATE_ROOT}" --design "${file}" --output "${folder}"
        COMMAND ${CMAKE_COMMAND} -E touch "${package}"
        DEPENDS feltgate_generate "${file}" "${FELTGATE_ROOT}/rtl/registers.toml" VERBATIM)
      add_custom_target(package_${design} DEPENDS "${package}")
    endif()
  endif()
  set(${variable} "${package}" PARENT_SCOPE)
endfunction()

# What a tick leaves as words the next one takes as words: in pairs they would wait for the store.
set(FELTGATE_BACKEND_OPTIONS ${FELTGATE_WARNINGS} -O3 -fno-tree-slp-vectorize)
# The laws of any design tick by tick, in integers and in real arithmetic.
feltgate_sim_library(chain sim/reference)
target_compile_options(feltgate_chain PRIVATE ${FELTGATE_BACKEND_OPTIONS})
# The registry alone, for what leaves the choice of the designs to the program.
add_library(feltgate_registry STATIC "${FELTGATE_ROOT}/model/sim/backends/backend.cpp"
  "${FELTGATE_ROOT}/model/sim/backends/axes_cores.cpp")
target_compile_options(feltgate_registry PRIVATE ${FELTGATE_WARNINGS})
target_link_libraries(feltgate_registry PUBLIC feltgate_chain PRIVATE fmt::fmt)
feltgate_export(registry)

add_library(feltgate_backends STATIC "${FELTGATE_ROOT}/model/sim/backends/built_in_designs.cpp")
set(FELTGATE_DESIGNS "")
set(registrations "")
foreach(path IN LISTS designs)
  get_filename_component(design "${path}" NAME_WE)
  if(NOT EXISTS "${FELTGATE_ROOT}/model/include/feltgate/generated/${design}.hpp")
    message(STATUS "design ${design} has no generated files yet: run `feltgate generate`")
    continue()
  endif()
  feltgate_type_of(${design} type)
  set(FELTGATE_TYPE_${design} ${type})
  list(APPEND FELTGATE_DESIGNS ${design})
  feltgate_for_design(backends "${PROJECT_BINARY_DIR}/backends/${design}_backends.cpp")
  # Objects, so that a program may take one design alone.
  add_library(design_${design} OBJECT "${PROJECT_BINARY_DIR}/backends/${design}_backends.cpp")
  target_compile_options(design_${design} PRIVATE ${FELTGATE_BACKEND_OPTIONS})
  target_link_libraries(design_${design} PRIVATE feltgate_model fmt::fmt)
  target_sources(feltgate_backends PRIVATE $<TARGET_OBJECTS:design_${design}>)
  string(APPEND registrations "FELTGATE_DESIGN(${design})\n")
endforeach()
file(CONFIGURE OUTPUT "${PROJECT_BINARY_DIR}/backends/designs.inc" CONTENT "${registrations}")
target_link_libraries(feltgate_backends PUBLIC feltgate_registry PRIVATE fmt::fmt)
# An archive's member is linked where something asks for it: this asks for the registration.
target_link_options(feltgate_backends INTERFACE "LINKER:--undefined=feltgate_built_in_designs")
target_include_directories(feltgate_backends PRIVATE "${PROJECT_BINARY_DIR}/backends")
target_compile_options(feltgate_backends PRIVATE ${FELTGATE_BACKEND_OPTIONS})
feltgate_export(backends)
