# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
#
# feltgate_fast, feltgate_lever_law, ...: the program feltgate with one more preset. A
# back-end takes a minute to build, so each is built only when a command asks for it, and no other
# command builds or loads a preset. docs/designs.md
include_guard(GLOBAL)

get_target_property(libraries feltgate LINK_LIBRARIES)
# Designs that `feltgate choose` takes from its table: generated into the build folder.
file(GLOB own CONFIGURE_DEPENDS "${PROJECT_BINARY_DIR}/own/*/feltgate/generated/cfg.sv")
list(TRANSFORM own REPLACE "^.*/own/(.*)/feltgate/generated/.*$" "\\1" OUTPUT_VARIABLE own_names)
foreach(design IN LISTS FELTGATE_PRESETS own_names)
  set(header "${FELTGATE_ROOT}/model/include/feltgate/generated/${design}.hpp")
  if(design IN_LIST own_names)
    set(header "${PROJECT_BINARY_DIR}/own/${design}/feltgate/generated/${design}.hpp")
    set(package "${PROJECT_BINARY_DIR}/own/${design}/feltgate/generated/cfg.sv")
  elseif(EXISTS "${header}")
    feltgate_package(package ${design})
  else()
    continue()
  endif()
  feltgate_type_of(${design} type)
  feltgate_core_of("${header}" top sources)
  feltgate_device_of("${header}" device)
  feltgate_verilate(core_${design} ${top} "${package};${sources}" CLASS Vcore_${design} FASTEST ${device})
  set(part preset)
  if(design IN_LIST FELTGATE_AXES_PRESETS)
    set(part axes_preset)
  endif()
  feltgate_for_design(${part} "${PROJECT_BINARY_DIR}/backends/${design}_preset.cpp")
  # Tests of a device link its objects too.
  add_library(preset_${design} OBJECT "${PROJECT_BINARY_DIR}/backends/${design}_preset.cpp")
  target_compile_options(preset_${design} PRIVATE ${FELTGATE_BACKEND_OPTIONS})
  if(design IN_LIST own_names)
    target_include_directories(preset_${design} PRIVATE "${PROJECT_BINARY_DIR}/own/${design}")
  endif()
  target_link_libraries(preset_${design} PRIVATE ${libraries} core_${design})
  add_executable(feltgate_${design}
    $<TARGET_OBJECTS:preset_${design}> $<TARGET_OBJECTS:feltgate> $<TARGET_OBJECTS:feltgate_run_parts>)
  target_link_libraries(feltgate_${design} PRIVATE ${libraries} core_${design})
  if(NOT design STREQUAL "lever_law" AND NOT design IN_LIST FELTGATE_AXES_PRESETS)
    # `feltgate rates` also takes the law of a block.
    target_sources(feltgate_${design} PRIVATE $<TARGET_OBJECTS:preset_lever_law>)
    target_link_libraries(feltgate_${design} PRIVATE core_lever_law)
  endif()
  set_target_properties(core_${design} preset_${design} feltgate_${design} PROPERTIES EXCLUDE_FROM_ALL ON)
endforeach()
# `feltgate rates` without a scene takes all of them, `trim` each of them: those of several axes by their twins.
foreach(design IN LISTS FELTGATE_AXES_PRESETS)
  if(TARGET feltgate_lever_law)
    target_sources(feltgate_lever_law PRIVATE $<TARGET_OBJECTS:twin_${design}>)
  endif()
endforeach()
