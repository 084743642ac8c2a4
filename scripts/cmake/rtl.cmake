# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
#
# feltgate_rtl: the Verilated cores of lever and paper, alone and in lock-step with their twins. A program that links it
# gets the back-ends "rtl" and "lockstep" from make_backend(); rtl_<design> does so for another one.
include_guard(GLOBAL)
include(verilate)

# feltgate_rtl_files(<variable> <list>): the files of rtl/<list>.f.
function(feltgate_rtl_files variable list)
  file(STRINGS "${FELTGATE_ROOT}/rtl/${list}.f" files REGEX "^[^/]")
  list(TRANSFORM files PREPEND "${FELTGATE_ROOT}/rtl/")
  set(${variable} "${files}" PARENT_SCOPE)
endfunction()

# The devices with all options, and with a port for each of their pins.
feltgate_rtl_files(FELTGATE_CORE_SOURCES feltgate_options)
list(APPEND FELTGATE_CORE_SOURCES "${FELTGATE_ROOT}/model/sim/backends/feltgate_core.sv")
feltgate_rtl_files(FELTGATE_AXES_SOURCES feltgate_axes)

# feltgate_has(<variable> <file> <regex>): whether a line of a design's file matches.
function(feltgate_has variable file regex)
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS "${file}")
  file(STRINGS "${file}" lines REGEX "${regex}")
  list(LENGTH lines ${variable})
  set(${variable} ${${variable}} PARENT_SCOPE)
endfunction()

# feltgate_device_of(<file> <variable>): the arguments of Verilator by which rtl/tops/device.svh takes the device of the
# design in this file, and the folder of that file.
function(feltgate_device_of file variable)
  feltgate_has(absolute_encoder "${file}" "^\\[absolute_encoder\\]")
  feltgate_has(current_loop "${file}" "^\\[current_loop\\]")
  feltgate_has(three_phases "${file}" "^phases *= *3")
  set(device lever)
  if(absolute_encoder AND three_phases AND current_loop)
    set(device gimbal_current)
  elseif(absolute_encoder AND three_phases)
    set(device gimbal_motor)
  elseif(absolute_encoder)
    set(device lever_absolute)
  elseif(three_phases)
    set(device hall_motor)
  elseif(current_loop)
    set(device lever_current)
  endif()
  string(TOUPPER ${device} device)
  set(${variable} "-I${FELTGATE_ROOT}/rtl/tops" "-DFELTGATE_${device}" PARENT_SCOPE)
endfunction()

# feltgate_core_of(<file> <top> <sources>): the module that a back-end of the design runs, and its
# files: the core, or with an engine of laws one axis and that.
function(feltgate_core_of file top sources)
  set(of core)
  feltgate_has(engine "${file}" "^\\[engine\\]")
  if(engine)
    set(of axes)
  endif()
  string(TOUPPER ${of} files)
  set(files ${FELTGATE_${files}_SOURCES})
  if(engine)
    list(PREPEND files ${FELTGATE_CORE_SOURCES})
    list(REMOVE_ITEM files "${FELTGATE_ROOT}/model/sim/backends/feltgate_core.sv")
    list(REMOVE_DUPLICATES files)
  endif()
  feltgate_has(mt "${file}" "^estimator *= *\"mt\"")
  if(mt)
    list(TRANSFORM files REPLACE "/rtl/core/velocity_estimator.sv$" "/rtl/options/mt/velocity_estimator.sv")
    list(PREPEND files "${FELTGATE_ROOT}/rtl/core/fx.sv" "${FELTGATE_ROOT}/rtl/options/mt/span_meter.sv")
    list(REMOVE_DUPLICATES files)
  endif()
  set(${top} feltgate_${of} PARENT_SCOPE)
  set(${sources} ${files} PARENT_SCOPE)
endfunction()

# feltgate_rtl_design(<design> <file> <package>): core_<design>, which is Verilated, and rtl_<design>, which adds it to
# the back-ends: objects, so that it stays in every program that takes them.
function(feltgate_rtl_design design file package)
  feltgate_core_of("${file}" top sources)
  feltgate_device_of("${file}" device)
  feltgate_verilate(core_${design} ${top} "${package};${sources}" CLASS Vcore_${design} FASTEST ${device})
  feltgate_type_of(${design} type)
  # A source of each design, so that each has an object: what it includes differs.
  set(source "${PROJECT_BINARY_DIR}/rtl/${design}.cpp")
  file(CONFIGURE OUTPUT "${source}" CONTENT "#include \"sim/backends/rtl_of_design.cpp\"\n")
  add_library(rtl_${design} OBJECT "${source}")
  target_compile_definitions(rtl_${design} PRIVATE FELTGATE_DESIGN=${type} FELTGATE_DESIGN_HEADER="feltgate/generated/${design}.hpp"
    FELTGATE_RTL=Vcore_${design} FELTGATE_RTL_HEADER="Vcore_${design}.h")
  target_compile_options(rtl_${design} PRIVATE ${FELTGATE_TWIN_OPTIONS})
  target_include_directories(rtl_${design} PRIVATE "${FELTGATE_HEADERS}")
  add_dependencies(rtl_${design} feltgate_headers)
  target_link_libraries(rtl_${design} PRIVATE feltgate_axes_cores core_${design} fmt::fmt)
endfunction()

add_library(feltgate_rtl INTERFACE)
foreach(design IN LISTS FELTGATE_DESIGNS FELTGATE_OTHERS)
  feltgate_package(package ${design})
  feltgate_rtl_design(${design} "${FELTGATE_ROOT}/rtl/designs/${design}.toml" "${package}")
  if(design IN_LIST FELTGATE_DESIGNS)
    target_sources(feltgate_rtl INTERFACE $<TARGET_OBJECTS:rtl_${design}>)
    target_link_libraries(feltgate_rtl INTERFACE core_${design})
  else()
    set_target_properties(core_${design} rtl_${design} PROPERTIES EXCLUDE_FROM_ALL ON)
  endif()
endforeach()
target_link_libraries(feltgate_rtl INTERFACE feltgate_backends)
