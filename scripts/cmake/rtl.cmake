# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
#
# feltgate_rtl: the Verilated core of each design, alone and in lock-step with its twin. A program that
# links it gets the back-ends "rtl" and "lockstep" from make_backend().
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

# feltgate_device_of(<header> <variable>): the arguments of Verilator by which rtl/tops/device.svh takes the device of the
# design with this header, and the folder of that file.
function(feltgate_device_of header variable)
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS "${header}")
  foreach(name absolute_encoder current_loop phases)
    file(STRINGS "${header}" line REGEX " ${name} = [0-9]+;")
    string(REGEX REPLACE ".* = ([0-9]+).*" "\\1" ${name} "${line}")
  endforeach()
  set(device lever)
  if(absolute_encoder AND phases EQUAL 3 AND current_loop)
    set(device gimbal_current)
  elseif(absolute_encoder AND phases EQUAL 3)
    set(device gimbal_motor)
  elseif(absolute_encoder)
    set(device lever_absolute)
  elseif(phases EQUAL 3)
    set(device hall_motor)
  elseif(current_loop)
    set(device lever_current)
  endif()
  string(TOUPPER ${device} device)
  set(${variable} "-I${FELTGATE_ROOT}/rtl/tops" "-DFELTGATE_${device}" PARENT_SCOPE)
endfunction()

# feltgate_core_of(<header> <top> <sources>): the module that a back-end of the design runs, and its
# files: the core, or with an engine of laws one axis and that.
function(feltgate_core_of header top sources)
  set(of core)
  file(STRINGS "${header}" engine REGEX " engine = 1;")
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
  file(STRINGS "${header}" mt REGEX " mt_counts = [1-9]")
  if(mt)
    list(TRANSFORM files REPLACE "/rtl/core/velocity_estimator.sv$" "/rtl/options/mt/velocity_estimator.sv")
    list(PREPEND files "${FELTGATE_ROOT}/rtl/core/fx.sv" "${FELTGATE_ROOT}/rtl/options/mt/span_meter.sv")
    list(REMOVE_DUPLICATES files)
  endif()
  set(${top} feltgate_${of} PARENT_SCOPE)
  set(${sources} ${files} PARENT_SCOPE)
endfunction()

add_library(feltgate_rtl STATIC "${FELTGATE_ROOT}/model/sim/backends/rtl_backends.cpp")
foreach(design IN LISTS FELTGATE_DESIGNS)
  set(type ${FELTGATE_TYPE_${design}})
  set(header "${FELTGATE_ROOT}/model/include/feltgate/generated/${design}.hpp")
  feltgate_core_of("${header}" top sources)
  feltgate_device_of("${header}" device)
  feltgate_package(package ${design})
  feltgate_verilate(core_${design} ${top} "${package};${sources}" CLASS Vcore_${design} FASTEST ${device})
  feltgate_for_design(rtl "${PROJECT_BINARY_DIR}/backends/${design}_rtl.cpp")
  add_library(rtl_${design} OBJECT "${PROJECT_BINARY_DIR}/backends/${design}_rtl.cpp")
  target_compile_options(rtl_${design} PRIVATE ${FELTGATE_BACKEND_OPTIONS})
  target_link_libraries(rtl_${design} PRIVATE feltgate_model core_${design} fmt::fmt)
  target_sources(feltgate_rtl PRIVATE $<TARGET_OBJECTS:rtl_${design}>)
  target_link_libraries(feltgate_rtl PUBLIC core_${design})
endforeach()
target_link_libraries(feltgate_rtl PUBLIC feltgate_backends PRIVATE fmt::fmt)
target_include_directories(feltgate_rtl PRIVATE "${PROJECT_BINARY_DIR}/backends")
target_compile_options(feltgate_rtl PRIVATE ${FELTGATE_BACKEND_OPTIONS})
# An archive's member is linked where something asks for it: this asks for the registration.
target_link_options(feltgate_rtl INTERFACE "LINKER:--undefined=feltgate_rtl_backends")
