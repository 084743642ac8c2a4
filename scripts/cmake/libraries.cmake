# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
#
# The libraries for users: feltgate::core (headers, no dependency) and feltgate::sim with its parts.
# Of these, feltgate::plant and feltgate::backends read no file. docs/library.md
include_guard(GLOBAL)

# Twin, laws, generated designs.
add_library(feltgate_model INTERFACE)
add_library(feltgate::core ALIAS feltgate_model)
set_target_properties(feltgate_model PROPERTIES EXPORT_NAME core)
target_include_directories(feltgate_model INTERFACE
  "$<BUILD_INTERFACE:${FELTGATE_ROOT}/model/include>" "$<INSTALL_INTERFACE:include>")
target_compile_features(feltgate_model INTERFACE cxx_std_17)
if(NOT FELTGATE_SIM)
  return()
endif()

# The twin takes the compiler long in each source that includes it, so that it is compiled once here.
# pip needs one axis alone.
set(parts compiled_core)
if(NOT FELTGATE_PYTHON)
  list(APPEND parts compiled_axes compiled_linked)
endif()
list(TRANSFORM parts REPLACE "(.+)" "${FELTGATE_ROOT}/model/sim/backends/\\1.cpp")
add_library(feltgate_twin_parts STATIC ${parts})
# What a tick leaves as words the next one takes as words: in pairs they would wait for the store.
set(FELTGATE_TWIN_OPTIONS ${FELTGATE_WARNINGS} -O3 -fno-tree-slp-vectorize)
target_compile_options(feltgate_twin_parts PRIVATE ${FELTGATE_TWIN_OPTIONS})
target_compile_features(feltgate_twin_parts PUBLIC cxx_std_17)
target_compile_definitions(feltgate_twin_parts PUBLIC FELTGATE_COMPILED_TWIN)
target_include_directories(feltgate_twin_parts PUBLIC
  "$<BUILD_INTERFACE:${FELTGATE_ROOT}/model/include>" "$<INSTALL_INTERFACE:include>")
# In somebody else's project feltgate::core remains headers.
if(PROJECT_IS_TOP_LEVEL)
  target_link_libraries(feltgate_model INTERFACE "$<BUILD_INTERFACE:feltgate_twin_parts>")
endif()

find_package(Boost 1.74 REQUIRED)
find_package(fmt 9 QUIET)
if(NOT fmt_FOUND)
  # Headers without the library, as where this is compiled for another machine.
  find_path(FELTGATE_FMT_INCLUDE_DIR fmt/format.h REQUIRED)
  add_library(fmt::fmt INTERFACE IMPORTED)
  target_include_directories(fmt::fmt SYSTEM INTERFACE "${FELTGATE_FMT_INCLUDE_DIR}")
  target_compile_definitions(fmt::fmt INTERFACE FMT_HEADER_ONLY=1)
endif()
find_path(FELTGATE_TOML_INCLUDE_DIR toml++/toml.h REQUIRED)

# In the source tree a room of headers is model/sim/<room>; its users write feltgate/<room>/x.hpp.
set(FELTGATE_ROOMS backends loop plant reference systemc traces)
set(FELTGATE_STAGED_INCLUDE "${PROJECT_BINARY_DIR}/include")
file(MAKE_DIRECTORY "${FELTGATE_STAGED_INCLUDE}/feltgate")
foreach(room IN LISTS FELTGATE_ROOMS)
  file(CREATE_LINK "${FELTGATE_ROOT}/model/sim/${room}" "${FELTGATE_STAGED_INCLUDE}/feltgate/${room}"
    SYMBOLIC)
endforeach()

# feltgate_unity(<target>): its sources share what they include. pip compiles everything once, so more
# of them share it there.
function(feltgate_unity name)
  set(batch 6)
  if(FELTGATE_PYTHON)
    set(batch 16)
  endif()
  set_target_properties(${name} PROPERTIES UNITY_BUILD ${FELTGATE_UNITY} UNITY_BUILD_BATCH_SIZE ${batch})
endfunction()

# feltgate_library(<name> <folder> [ONLY <regex>] [EXCEPT <regex>] [libraries...]): a static library
# of the sources of model/<folder>, but a program's, whose names match.
function(feltgate_library name folder)
  cmake_parse_arguments(PARSE_ARGV 2 arg "" "ONLY;EXCEPT" "")
  file(GLOB sources CONFIGURE_DEPENDS "${FELTGATE_ROOT}/model/${folder}/*.cpp")
  list(FILTER sources EXCLUDE REGEX "_main\\.cpp$")
  if(arg_ONLY)
    list(FILTER sources INCLUDE REGEX "${arg_ONLY}")
  endif()
  if(arg_EXCEPT)
    list(FILTER sources EXCLUDE REGEX "${arg_EXCEPT}")
  endif()
  add_library(${name} STATIC ${sources})
  target_compile_options(${name} PRIVATE ${FELTGATE_WARNINGS})
  target_link_libraries(${name} PUBLIC feltgate_model ${arg_UNPARSED_ARGUMENTS} PRIVATE fmt::fmt)
  feltgate_unity(${name})
endfunction()

# feltgate_sim_library(<name> <folder> ...): the same, exported as feltgate::<name>.
function(feltgate_sim_library name)
  feltgate_library(feltgate_${name} ${ARGN})
  feltgate_export(${name})
endfunction()

function(feltgate_export name)
  add_library(feltgate::${name} ALIAS feltgate_${name})
  set_target_properties(feltgate_${name} PROPERTIES EXPORT_NAME ${name})
  target_include_directories(feltgate_${name} INTERFACE
    "$<BUILD_INTERFACE:${FELTGATE_STAGED_INCLUDE}>")
  set_property(GLOBAL APPEND PROPERTY FELTGATE_SIM_TARGETS feltgate_${name})
endfunction()

feltgate_export(twin_parts)
# Strict reading of TOML files and what needs it.
feltgate_sim_library(config files/toml)
target_include_directories(feltgate_config SYSTEM PUBLIC
  "$<BUILD_INTERFACE:${FELTGATE_TOML_INCLUDE_DIR}>")
# Output files that are whole or not there.
feltgate_sim_library(files files)
feltgate_sim_library(design design feltgate_config)
# It has the designs as texts, so that nothing needs their files at run time.
file(GLOB designs CONFIGURE_DEPENDS "${FELTGATE_ROOT}/rtl/designs/*.toml")
set(embedded "${PROJECT_BINARY_DIR}/shipped_designs.cpp")
add_custom_command(OUTPUT "${embedded}"
  COMMAND ${CMAKE_COMMAND} "-DROOT=${FELTGATE_ROOT}" "-DOUTPUT=${embedded}" -P "${CMAKE_CURRENT_LIST_DIR}/embed_designs.cmake"
  DEPENDS ${designs} "${FELTGATE_ROOT}/rtl/registers.toml" "${CMAKE_CURRENT_LIST_DIR}/embed_designs.cmake" VERBATIM)
target_sources(feltgate_design PRIVATE "${embedded}")
# Writes what follows from the files of designs.
add_executable(feltgate_generate EXCLUDE_FROM_ALL "${FELTGATE_ROOT}/model/apps/commands/generate_main.cpp")
target_compile_options(feltgate_generate PRIVATE ${FELTGATE_WARNINGS} -O1)
target_link_libraries(feltgate_generate PRIVATE feltgate_design fmt::fmt)

feltgate_sim_library(bounds studies/bounds feltgate_design Boost::headers)

# Amounts with units are of use without laws.
feltgate_sim_library(units law ONLY "/units\\.cpp$")
# Laws as files: reader, evaluation, compiler. The grammar is Boost.Spirit X3, in one source.
feltgate_library(feltgate_law law EXCEPT "/units\\.cpp$" feltgate_units Boost::headers)

# The host's side of the link; Boost.Asio in headers.
find_package(Threads REQUIRED)
feltgate_library(feltgate_hostlink host feltgate_design feltgate_law Boost::headers Threads::Threads)

# The plant itself reads no file; plant_files reads plants and hands.
feltgate_sim_library(plant sim/plant EXCEPT "_file\\.cpp$")
feltgate_sim_library(plant_files sim/plant ONLY "_file\\.cpp$"
  feltgate_plant feltgate_traces feltgate_config)
# scripts/exploration/point.py links what it needs of it, without feltgate_traces.
set_target_properties(feltgate_plant_files PROPERTIES UNITY_BUILD OFF)
# Devices with several axes: docs/devices/pantograph.md, docs/devices/three-axes.md
foreach(device "linkage;pantograph" "gimbal;gimbal")
  list(GET device 0 name)
  list(GET device 1 folder)
  feltgate_sim_library(${name} sim/plant/${folder} EXCEPT "_file\\.cpp$" feltgate_plant)
  feltgate_sim_library(${name}_files sim/plant/${folder} ONLY "_file\\.cpp$"
    feltgate_${name} feltgate_plant_files)
endforeach()

if(FELTGATE_SIGROK)
  find_package(LibArchive REQUIRED)
  feltgate_sim_library(traces sim/traces)
  target_link_libraries(feltgate_traces PRIVATE LibArchive::LibArchive)
  target_compile_definitions(feltgate_traces PRIVATE FELTGATE_SIGROK)
else()
  feltgate_sim_library(traces sim/traces EXCEPT "/sigrok")
endif()

include(backends)
feltgate_sim_library(loop sim/loop
  feltgate_registry feltgate_plant_files feltgate_traces feltgate_bounds feltgate_units)
# Laws in a loop: the engine's image, and the law in real numbers beside it.
feltgate_library(feltgate_law_loop sim/law_loop feltgate_law feltgate_loop)
# Devices of several axes with their laws, in one loop.
feltgate_library(feltgate_axes_loop sim/axes_loop feltgate_axes_cores feltgate_law_loop feltgate_linkage_files
  feltgate_gimbal_files)
# A closed loop hands scalars from step to step; packed in pairs they would wait for the store.
foreach(target feltgate_plant feltgate_linkage feltgate_gimbal feltgate_loop feltgate_axes_loop)
  target_compile_options(${target} PRIVATE -fno-tree-slp-vectorize)
endforeach()

# Read once, not in a loop: optimised as far as that compiles fast.
foreach(target feltgate_config feltgate_files feltgate_design feltgate_hostlink)
  target_compile_options(${target} PRIVATE -O1)
endforeach()

add_library(feltgate_sim INTERFACE)
target_link_libraries(feltgate_sim INTERFACE
  feltgate_backends feltgate_loop feltgate_linkage_files feltgate_gimbal_files)
feltgate_export(sim)

# sc_modules of twin and motor: headers. SystemC itself is looked for by who links them.
add_library(feltgate_systemc INTERFACE)
add_library(feltgate::systemc ALIAS feltgate_systemc)
set_target_properties(feltgate_systemc PROPERTIES EXPORT_NAME systemc)
target_link_libraries(feltgate_systemc INTERFACE feltgate_plant systemc)
