# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
#
# Laws as C++, made during the build. docs/laws.md
include_guard(GLOBAL)

add_executable(feltgate_laws "${FELTGATE_ROOT}/model/apps/commands/laws_main.cpp")
target_compile_options(feltgate_laws PRIVATE ${FELTGATE_WARNINGS})
target_link_libraries(feltgate_laws PRIVATE feltgate_law fmt::fmt)

# feltgate_law_headers(<target> <list> <files.law...>): an interface library with laws/NAME.hpp of each file, and
# laws/LIST.hpp, whose visit_LIST() goes through all.
function(feltgate_law_headers target list)
  set(folder "${CMAKE_CURRENT_BINARY_DIR}/${target}")
  set(headers "${folder}/laws/${list}.hpp")
  foreach(file IN LISTS ARGN)
    get_filename_component(name "${file}" NAME_WE)
    list(APPEND headers "${folder}/laws/${name}.hpp")
  endforeach()
  add_custom_command(OUTPUT ${headers}
    COMMAND feltgate_laws "${folder}" laws ${list} ${ARGN}
    DEPENDS feltgate_laws ${ARGN} COMMENT "Laws as C++: ${list}" VERBATIM)
  add_library(${target} INTERFACE)
  target_sources(${target} INTERFACE ${headers})
  target_include_directories(${target} INTERFACE "${folder}")
  target_link_libraries(${target} INTERFACE feltgate_model)
endfunction()

file(GLOB laws CONFIGURE_DEPENDS "${FELTGATE_ROOT}/rtl/laws/*.law")
feltgate_law_headers(feltgate_shipped_headers shipped ${laws})
# What runs a law: the shipped ones compiled, others interpreted.
feltgate_library(feltgate_shipped_laws law/laws feltgate_shipped_headers)
