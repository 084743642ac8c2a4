# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
#
# feltgate_rtl: the Verilated core of each design, alone and in lock-step with its twin. A program that
# links it gets the back-ends "rtl" and "lockstep" from make_backend().
include_guard(GLOBAL)
include(verilate)

file(STRINGS "${FELTGATE_ROOT}/rtl/feltgate_core.f" FELTGATE_CORE_SOURCES REGEX "^[^/]")
list(TRANSFORM FELTGATE_CORE_SOURCES PREPEND "${FELTGATE_ROOT}/rtl/")

file(STRINGS "${FELTGATE_ROOT}/rtl/feltgate_axes.f" FELTGATE_AXES_SOURCES REGEX "^[^/]")
list(TRANSFORM FELTGATE_AXES_SOURCES PREPEND "${FELTGATE_ROOT}/rtl/")

# feltgate_core_of(<folder of its package> <top> <sources>): the module that a back-end of the design runs, and its
# files: the core, or with an engine of laws one axis and that.
function(feltgate_core_of folder top sources)
  set(of core)
  file(STRINGS "${folder}/feltgate_pkg.sv" engine REGEX " ENGINE = 1;")
  if(engine)
    set(of axes)
  endif()
  string(TOUPPER ${of} files)
  set(${top} feltgate_${of} PARENT_SCOPE)
  set(${sources} ${FELTGATE_${files}_SOURCES} PARENT_SCOPE)
endfunction()

add_library(feltgate_rtl STATIC "${FELTGATE_ROOT}/model/sim/backends/rtl_backends.cpp")
foreach(design IN LISTS FELTGATE_DESIGNS)
  set(type ${FELTGATE_TYPE_${design}})
  feltgate_core_of("${FELTGATE_ROOT}/rtl/generated/${design}" top sources)
  feltgate_verilate(core_${design} ${top}
    "${FELTGATE_ROOT}/rtl/generated/${design}/feltgate_pkg.sv;${sources}"
    CLASS Vcore_${design} FASTEST)
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
