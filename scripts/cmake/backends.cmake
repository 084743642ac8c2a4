# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
#
# feltgate::backends: the twin and the chains of any design. rtl.cmake adds the back-ends of Verilated cores.
include_guard(GLOBAL)

# FELTGATE_DESIGNS: those whose RTL is in every program that has some. That of FELTGATE_OTHERS is in programs of their own.
file(GLOB designs CONFIGURE_DEPENDS "${FELTGATE_ROOT}/rtl/designs/*.toml")
list(TRANSFORM designs REPLACE "^.*/(.*)\\.toml$" "\\1" OUTPUT_VARIABLE FELTGATE_OTHERS)
set(FELTGATE_DESIGNS lever paper)
list(REMOVE_ITEM FELTGATE_OTHERS ${FELTGATE_DESIGNS})

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

# The packages and C++ headers of all designs, made of their files at build time: the headers as feltgate/generated/NAME.hpp,
# for tests and for what knows a Verilated core.
set(FELTGATE_HEADERS "${PROJECT_BINARY_DIR}/designs/include")
set(headers "")
foreach(design IN LISTS FELTGATE_DESIGNS FELTGATE_OTHERS)
  set(folder "${PROJECT_BINARY_DIR}/designs/${design}")
  set(header "${FELTGATE_HEADERS}/feltgate/generated/${design}.hpp")
  add_custom_command(OUTPUT "${folder}/cfg.sv" "${header}"
    COMMAND feltgate_generate "${FELTGATE_ROOT}" --design "${FELTGATE_ROOT}/rtl/designs/${design}.toml" --output "${folder}"
    COMMAND ${CMAKE_COMMAND} -E copy_if_different "${folder}/${design}.hpp" "${header}"
    COMMAND ${CMAKE_COMMAND} -E touch "${folder}/cfg.sv" "${header}"
    DEPENDS feltgate_generate "${FELTGATE_ROOT}/rtl/designs/${design}.toml" "${FELTGATE_ROOT}/rtl/registers.toml" VERBATIM)
  list(APPEND headers "${header}")
endforeach()
add_custom_target(feltgate_headers DEPENDS ${headers})

# feltgate_package(<variable> <design>): its cfg.sv. Three are committed.
function(feltgate_package variable design)
  set(package "${FELTGATE_ROOT}/rtl/generated/${design}/cfg.sv")
  if(NOT EXISTS "${package}")
    set(package "${PROJECT_BINARY_DIR}/designs/${design}/cfg.sv")
  endif()
  set(${variable} "${package}" PARENT_SCOPE)
endfunction()

# The laws of any design tick by tick, in integers and in real arithmetic.
feltgate_sim_library(chain sim/reference)
target_compile_options(feltgate_chain PRIVATE ${FELTGATE_TWIN_OPTIONS})
# Twins of the designs that the program names, of one axis and of several.
add_library(feltgate_registry STATIC "${FELTGATE_ROOT}/model/sim/backends/backend.cpp")
target_link_libraries(feltgate_registry PUBLIC feltgate_chain feltgate_twin_parts PRIVATE fmt::fmt)
add_library(feltgate_axes_cores STATIC "${FELTGATE_ROOT}/model/sim/backends/axes_cores.cpp")
target_link_libraries(feltgate_axes_cores PUBLIC feltgate_registry PRIVATE fmt::fmt)
foreach(library registry axes_cores)
  target_compile_options(feltgate_${library} PRIVATE ${FELTGATE_TWIN_OPTIONS})
  feltgate_export(${library})
endforeach()

# With those of rtl/designs, and those of files.
add_library(feltgate_backends STATIC "${FELTGATE_ROOT}/model/sim/backends/shipped_designs.cpp")
target_compile_options(feltgate_backends PRIVATE ${FELTGATE_WARNINGS})
target_link_libraries(feltgate_backends PUBLIC feltgate_axes_cores feltgate_design)
# An archive's member is linked where something asks for it: this asks for the source of the designs.
target_link_options(feltgate_backends INTERFACE "LINKER:--undefined=feltgate_shipped_designs")
feltgate_export(backends)
