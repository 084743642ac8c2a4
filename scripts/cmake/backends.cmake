# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
#
# feltgate::backends: the twin and the chains of any design. rtl.cmake adds the back-ends of Verilated cores.
include_guard(GLOBAL)

# FELTGATE_DESIGNS: those whose RTL is in every program that has some. That of the others, FELTGATE_PRESETS, is in programs
# of their own.
file(GLOB designs CONFIGURE_DEPENDS "${FELTGATE_ROOT}/rtl/designs/*.toml")
list(TRANSFORM designs REPLACE "^.*/(.*)\\.toml$" "\\1" OUTPUT_VARIABLE FELTGATE_DESIGNS)
set(presets "${FELTGATE_ROOT}/rtl/designs/presets.txt")
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS "${presets}")
file(STRINGS "${presets}" FELTGATE_PRESETS REGEX "^[a-z]")
list(REMOVE_ITEM FELTGATE_DESIGNS ${FELTGATE_PRESETS})

# feltgate_type_of(<design> <variable>): the type of its generated header, the name in UpperCamelCase, as the generator
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
# Twins of the designs that the program names.
add_library(feltgate_registry STATIC "${FELTGATE_ROOT}/model/sim/backends/backend.cpp"
  "${FELTGATE_ROOT}/model/sim/backends/axes_cores.cpp")
target_compile_options(feltgate_registry PRIVATE ${FELTGATE_BACKEND_OPTIONS})
target_link_libraries(feltgate_registry PUBLIC feltgate_chain PRIVATE fmt::fmt)
feltgate_export(registry)

# With those of rtl/designs, and those of files.
add_library(feltgate_backends STATIC "${FELTGATE_ROOT}/model/sim/backends/shipped_designs.cpp")
target_compile_options(feltgate_backends PRIVATE ${FELTGATE_WARNINGS})
target_link_libraries(feltgate_backends PUBLIC feltgate_registry feltgate_design)
# An archive's member is linked where something asks for it: this asks for the source of the designs.
target_link_options(feltgate_backends INTERFACE "LINKER:--undefined=feltgate_shipped_designs")
feltgate_export(backends)
