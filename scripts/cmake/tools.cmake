# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
#
# The program feltgate with the studies behind its commands, the generator and the benchmark.
include_guard(GLOBAL)

find_package(nlohmann_json REQUIRED)
find_package(CLI11 REQUIRED)
find_package(Eigen3 REQUIRED NO_MODULE)

# What the programs with commands share. CLI11 is headers: a program's words are read once, so that
# -O1 does.
add_library(feltgate_command_line STATIC
  "${FELTGATE_ROOT}/model/apps/commands/commands.cpp" "${FELTGATE_ROOT}/model/apps/commands/command_line.cpp")
target_compile_options(feltgate_command_line PRIVATE ${FELTGATE_WARNINGS} -O1)
target_compile_definitions(feltgate_command_line PRIVATE
  FELTGATE_SOURCE_DIR="${FELTGATE_ROOT}" FELTGATE_VERSION="${PROJECT_VERSION}")
target_link_libraries(feltgate_command_line PUBLIC feltgate_files feltgate_design CLI11::CLI11
  PRIVATE feltgate_axes_cores feltgate_units fmt::fmt)
# CLI11's header is eight seconds of the compiler: read once.
target_precompile_headers(feltgate_command_line PRIVATE <CLI/CLI.hpp> <fmt/format.h>)

# feltgate_program(<name> <sources> [libraries...])
function(feltgate_program name sources)
  list(TRANSFORM sources PREPEND "${FELTGATE_ROOT}/model/apps/commands/")
  add_executable(${name} ${sources})
  target_compile_options(${name} PRIVATE ${FELTGATE_WARNINGS} -O1)
  target_compile_definitions(${name} PRIVATE
    FELTGATE_SOURCE_DIR="${FELTGATE_ROOT}" FELTGATE_VERSION="${PROJECT_VERSION}")
  target_link_libraries(${name} PRIVATE ${ARGN} fmt::fmt)
  feltgate_unity(${name})
endfunction()

# What the programs of design points share; scripts/exploration/point.py compiles the rest.
feltgate_library(feltgate_explore studies/explore feltgate_plant_files nlohmann_json::nlohmann_json)

feltgate_library(feltgate_trim studies/trim feltgate_backends feltgate_loop feltgate_axes_loop)

# Where the constants of design and plant differ.
feltgate_library(feltgate_constants studies/stability ONLY "/constants\\.cpp$" feltgate_plant_files feltgate_design)
# Eigen's own warnings are not ours: its headers are system headers.
feltgate_library(feltgate_stability studies/stability EXCEPT "/constants\\.cpp$"
  feltgate_constants feltgate_backends Eigen3::Eigen)
target_link_libraries(feltgate_stability PRIVATE nlohmann_json::nlohmann_json)
# Eigen: its tests run within 5 % as long, and it compiles in three quarters of the time.
target_compile_options(feltgate_stability PRIVATE -O1)

# Sizes of the blocks of `lever`, as `feltgate synth --update` wrote them.
set(areas docs/verification/areas.json)
set_property(DIRECTORY "${CMAKE_SOURCE_DIR}" APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${areas})
file(READ "${CMAKE_SOURCE_DIR}/${areas}" figures)
foreach(block observer velocity_estimator travel_window axes_engine)
  string(JSON size ERROR_VARIABLE missing GET "${figures}" figures lever ${block} lut4_equivalents)
  if(missing)
    message(FATAL_ERROR "${areas}: no size of lever's ${block} (${missing}); run `feltgate synth --update`")
  endif()
  set(${block}_lut4 ${size})
endforeach()
math(EXPR lowpass_lut4 "${velocity_estimator_lut4} - ${travel_window_lut4}")  # what is left of it is its low-pass

# Scenes at several rates.
feltgate_library(feltgate_rates studies/rates feltgate_stability feltgate_loop feltgate_law_loop
  feltgate_axes_loop)
target_link_libraries(feltgate_rates PRIVATE nlohmann_json::nlohmann_json)
target_compile_definitions(feltgate_rates PRIVATE
  FELTGATE_VERSION="${PROJECT_VERSION}" FELTGATE_LUT4_ENGINE=${axes_engine_lut4})
target_compile_options(feltgate_rates PRIVATE -O1)

# The observer beside other controllers.
feltgate_library(feltgate_controllers studies/controllers feltgate_stability feltgate_loop)
target_link_libraries(feltgate_controllers PRIVATE nlohmann_json::nlohmann_json)
target_compile_definitions(feltgate_controllers PRIVATE FELTGATE_VERSION="${PROJECT_VERSION}"
  FELTGATE_LUT4_OBSERVER=${observer_lut4} FELTGATE_LUT4_LOWPASS=${lowpass_lut4})

# Constants of a motor from readings and recordings: the verbs calibrate and identify of a host.
feltgate_library(feltgate_calibrate host/calibrate feltgate_design feltgate_traces Eigen3::Eigen
  Boost::headers)
target_link_libraries(feltgate_calibrate PRIVATE nlohmann_json::nlohmann_json)
feltgate_library(feltgate_identify host/identify feltgate_calibrate)
target_link_libraries(feltgate_identify PRIVATE nlohmann_json::nlohmann_json)
# In one source with others g++ 12 takes a matrix of Eigen for uninitialized.
set_target_properties(feltgate_calibrate PROPERTIES UNITY_BUILD OFF)
# Eigen, of some hundred readings.
target_compile_options(feltgate_calibrate PRIVATE -O1)
target_compile_options(feltgate_identify PRIVATE -O1)
# The page for a browser: what runs natively of it; scripts/page.py compiles it for the browser.
feltgate_library(feltgate_page apps/page EXCEPT "_api" feltgate_backends feltgate_loop feltgate_design feltgate_law_loop
  feltgate_axes_loop feltgate_shape feltgate_proxy)
add_executable(feltgate_page_data EXCLUDE_FROM_ALL
  "${FELTGATE_ROOT}/model/apps/page/data_main.cpp")
target_compile_options(feltgate_page_data PRIVATE ${FELTGATE_WARNINGS})
target_compile_definitions(feltgate_page_data PRIVATE FELTGATE_SOURCE_DIR="${FELTGATE_ROOT}")
target_link_libraries(feltgate_page_data PRIVATE feltgate_page nlohmann_json::nlohmann_json fmt::fmt)
add_dependencies(feltgate_page_data feltgate_generate)  # page.py asks it whether the designs are current

# Outlines for the pantograph. SVG++ is a Boost library of headers.
feltgate_library(feltgate_shape studies/shape feltgate_law Boost::headers)
# The templates of SVG++ take half a minute of CPU time; optimised, twice as much again.
set_source_files_properties("${FELTGATE_ROOT}/model/studies/shape/read_svg.cpp" PROPERTIES
  SKIP_UNITY_BUILD_INCLUSION ON COMPILE_OPTIONS -O0)
# Height fields from images.
find_package(PNG REQUIRED)
feltgate_library(feltgate_texture studies/texture feltgate_law PNG::PNG)

# Meshes under the pen: docs/touch.md. Linked by name, as SystemC is: only who builds them needs TinyGLTF and
# meshoptimizer.
feltgate_library(feltgate_mesh sim/touch ONLY "/(glb|decimate)" feltgate_proxy)
target_link_libraries(feltgate_mesh PRIVATE tinygltf meshoptimizer)
# The proxy needs neither. It is the whole work of a run.
feltgate_library(feltgate_proxy sim/touch ONLY "/(mesh|proxy|edges)\\.")
foreach(name feltgate_mesh feltgate_proxy)
  target_compile_options(${name} PRIVATE -O2)
endforeach()

file(GLOB tool_sources CONFIGURE_DEPENDS RELATIVE "${FELTGATE_ROOT}/model/apps/commands"
  "${FELTGATE_ROOT}/model/apps/commands/*.cpp")
list(FILTER tool_sources EXCLUDE REGEX "_main\\.cpp$|^(commands|command_line)\\.cpp$")
# A first scene: nothing that it does not use. The RTL is a minute more, so it is left out where none
# is asked for.
set(run_names replay_command.cpp run_command.cpp run_report.cpp)
list(TRANSFORM run_names PREPEND "${FELTGATE_ROOT}/model/apps/commands/" OUTPUT_VARIABLE run_sources)
set(run_libraries feltgate_command_line feltgate_loop feltgate_constants feltgate_files
  nlohmann_json::nlohmann_json fmt::fmt)
add_library(feltgate_run_parts OBJECT ${run_sources})
target_compile_options(feltgate_run_parts PRIVATE ${FELTGATE_WARNINGS} -O1)
target_compile_definitions(feltgate_run_parts PRIVATE
  FELTGATE_SOURCE_DIR="${FELTGATE_ROOT}" FELTGATE_VERSION="${PROJECT_VERSION}")
target_precompile_headers(feltgate_run_parts REUSE_FROM feltgate_command_line)
feltgate_unity(feltgate_run_parts)
target_link_libraries(feltgate_run_parts PRIVATE ${run_libraries})
feltgate_program(feltgate_twin run_main.cpp ${run_libraries} feltgate_backends)
feltgate_program(feltgate_run run_main.cpp ${run_libraries} feltgate_backends core_lever)
target_sources(feltgate_twin PRIVATE $<TARGET_OBJECTS:feltgate_run_parts>)
target_sources(feltgate_run PRIVATE $<TARGET_OBJECTS:feltgate_run_parts> $<TARGET_OBJECTS:rtl_lever>)
if(NOT FELTGATE_TESTS)
  set_target_properties(feltgate_twin feltgate_run PROPERTIES EXCLUDE_FROM_ALL ON)
endif()

list(REMOVE_ITEM tool_sources ${run_names})
feltgate_program(feltgate "feltgate_main.cpp;${tool_sources}"
  feltgate_rtl feltgate_files feltgate_law feltgate_shape feltgate_texture feltgate_axes_loop feltgate_law_loop feltgate_loop feltgate_stability feltgate_rates feltgate_trim feltgate_controllers feltgate_design
  feltgate_command_line nlohmann_json::nlohmann_json)
target_sources(feltgate PRIVATE $<TARGET_OBJECTS:feltgate_run_parts>)

include(other_designs)

# What `feltgate explore` takes from the build; with synth it makes designs out of tree.
feltgate_program(feltgate_point_bounds bounds_main.cpp feltgate_bounds nlohmann_json::nlohmann_json)
add_dependencies(feltgate
  feltgate_generate feltgate_point_bounds feltgate_explore feltgate_chain feltgate_verilated)

# The host of a board; it needs no simulation, so it is built by itself.
file(GLOB host_sources CONFIGURE_DEPENDS RELATIVE "${FELTGATE_ROOT}/model/apps/commands"
  "${FELTGATE_ROOT}/model/apps/commands/host/*.cpp")
feltgate_program(feltgate_host
  "host_main.cpp;${host_sources}"
  feltgate_command_line feltgate_files feltgate_backends feltgate_hostlink feltgate_identify feltgate_linkage_files feltgate_traces nlohmann_json::nlohmann_json)

# Meshes under the pen; feltgate_touch_rtl also has the Verilated cores, a minute more.
foreach(kind twin rtl)
  set(name feltgate_touch)
  set(objects "")
  set(cores "")
  if(kind STREQUAL "rtl")
    set(name feltgate_touch_rtl)
    set(objects $<TARGET_OBJECTS:rtl_stylus_law>)
    set(cores core_stylus_law)
  endif()
  feltgate_program(${name}
    "touch_main.cpp;touch/touch_report.cpp;host/session.cpp;host/streaming.cpp"
    feltgate_command_line feltgate_files feltgate_mesh feltgate_axes_loop feltgate_hostlink feltgate_backends ${cores} nlohmann_json::nlohmann_json)
  target_sources(${name} PRIVATE ${objects})
  if(kind STREQUAL "rtl" OR NOT FELTGATE_TESTS)
    set_target_properties(${name} PROPERTIES EXCLUDE_FROM_ALL ON)
  endif()
endforeach()
if(NOT FELTGATE_TESTS)
  set_target_properties(feltgate_mesh PROPERTIES EXCLUDE_FROM_ALL ON)
endif()

# feltgate_fmu_DESIGN.so, the library in what `feltgate product fmu` writes, of designs with one axis and no engine; with
# tests those of lever and gimbal_motor are built, the others when asked for. Nothing but its functions is seen from outside:
# an importer may load two.
file(CONFIGURE OUTPUT "${PROJECT_BINARY_DIR}/fmu.map" CONTENT "{ global: fmi3*; feltgate_fmu_*; local: *; };\n")
foreach(design IN LISTS FELTGATE_DESIGNS FELTGATE_OTHERS)
  if(design MATCHES "_law$")
    continue()
  endif()
  set(name feltgate_fmu_${design})
  add_library(${name} MODULE "${FELTGATE_ROOT}/model/apps/fmu/fmu.cpp")
  set_target_properties(${name} PROPERTIES PREFIX "" POSITION_INDEPENDENT_CODE ON EXCLUDE_FROM_ALL ON)
  if(FELTGATE_TESTS AND design MATCHES "^(lever|gimbal_motor)$")
    set_target_properties(${name} PROPERTIES EXCLUDE_FROM_ALL OFF)
  endif()
  target_compile_definitions(${name} PRIVATE FELTGATE_FMU_DESIGN="${design}")
  target_compile_options(${name} PRIVATE ${FELTGATE_WARNINGS} -O1)
  target_link_libraries(${name} PRIVATE feltgate_backends feltgate_loop feltgate_plant_files feltgate_plant fmt::fmt)
  target_link_options(${name} PRIVATE "LINKER:--as-needed,--version-script=${PROJECT_BINARY_DIR}/fmu.map")
endforeach()

# The benchmark: only built when asked for.
feltgate_library(feltgate_bench_parts studies/bench feltgate_rtl feltgate_loop feltgate_law)
target_compile_definitions(feltgate_bench_parts PRIVATE FELTGATE_VERSION="${PROJECT_VERSION}")
feltgate_program(feltgate_bench bench_main.cpp
  feltgate_command_line feltgate_files feltgate_bench_parts nlohmann_json::nlohmann_json)
include(extremes)
include(faults)
include(board)
if(NOT FELTGATE_TESTS)
  set_target_properties(feltgate_bench feltgate_bench_parts feltgate_extremes
    feltgate_extreme_cases extremes_wide_core ${extremes_blocks} PROPERTIES EXCLUDE_FROM_ALL ON)
endif()
