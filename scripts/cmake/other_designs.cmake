# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
#
# feltgate_fast, feltgate_lever_law, ...: the program feltgate with the RTL of one more design. It takes a minute to build,
# so it is built only when a command asks for it. docs/designs.md
include_guard(GLOBAL)

get_target_property(libraries feltgate LINK_LIBRARIES)
# Designs that `feltgate choose` takes from its table: generated into the build folder.
file(GLOB own CONFIGURE_DEPENDS "${PROJECT_BINARY_DIR}/own/*/feltgate/generated/cfg.sv")
list(TRANSFORM own REPLACE "^.*/own/(.*)/feltgate/generated/.*$" "\\1" OUTPUT_VARIABLE own_names)
foreach(design IN LISTS own_names)
  set(folder "${PROJECT_BINARY_DIR}/own/${design}")
  feltgate_rtl_design(${design} "${folder}/${design}.toml" "${folder}/feltgate/generated/cfg.sv")
  target_include_directories(rtl_${design} PRIVATE "${folder}")
  set_target_properties(core_${design} rtl_${design} PROPERTIES EXCLUDE_FROM_ALL ON)
endforeach()
foreach(design IN LISTS FELTGATE_OTHERS own_names)
  add_executable(feltgate_${design} EXCLUDE_FROM_ALL
    $<TARGET_OBJECTS:rtl_${design}> $<TARGET_OBJECTS:feltgate> $<TARGET_OBJECTS:feltgate_run_parts>)
  target_link_libraries(feltgate_${design} PRIVATE ${libraries} core_${design})
  if(NOT design STREQUAL "lever_law")  # `feltgate rates` also takes the law of a block
    target_sources(feltgate_${design} PRIVATE $<TARGET_OBJECTS:rtl_lever_law>)
    target_link_libraries(feltgate_${design} PRIVATE core_lever_law)
  endif()
endforeach()
