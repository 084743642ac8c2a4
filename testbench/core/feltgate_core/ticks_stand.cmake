# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
#
# feltgate_ticks_stand(<name> <package> [DEFECT <file> <name>] [DEFINES ...] [INCLUDES ...] [AFTER target]):
# ticks_stand_test.cpp on a copy of the core in which the counter of the tick can be made to stand.
# DEFECT: a further change, with which the test must fail.
include_guard(GLOBAL)

function(feltgate_ticks_stand name package)
  cmake_parse_arguments(PARSE_ARGV 2 arg "" "AFTER" "DEFECT;DEFINES;INCLUDES")
  set(defects "${CMAKE_CURRENT_FUNCTION_LIST_DIR}/stand.diff" ticks_stand ${arg_DEFECT})
  set(files "")
  set(copies "${CMAKE_CURRENT_BINARY_DIR}/${name}.copies")
  set(sources ${FELTGATE_CORE_SOURCES})
  set(patched "")
  set(commands "")
  while(defects)
    list(POP_FRONT defects diff defect)
    list(APPEND files "${diff}")
    list(APPEND commands COMMAND ${Python3_EXECUTABLE} -B "${FELTGATE_DEFECTS}" copy "${diff}" ${defect}
      --output "${copies}")
    feltgate_patched_files(changed "${diff}" ${defect})
    foreach(file IN LISTS changed)
      list(TRANSFORM sources REPLACE "^${FELTGATE_ROOT}/${file}$" "${copies}/${file}")
      list(APPEND patched "${copies}/${file}")
    endforeach()
  endwhile()
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${files})
  add_custom_command(OUTPUT ${patched} ${commands}
    DEPENDS ${files} ${FELTGATE_CORE_SOURCES} ${FELTGATE_SEEDING} VERBATIM)
  feltgate_verilate(${name}_rtl feltgate_core "${package};${sources}" -Wno-lint -Wno-style)
  add_executable(${name}_test "${CMAKE_CURRENT_FUNCTION_LIST_DIR}/ticks_stand_test.cpp")
  if(arg_AFTER)
    add_dependencies(${name}_test ${arg_AFTER})
  endif()
  target_compile_definitions(${name}_test PRIVATE ${arg_DEFINES})
  target_include_directories(${name}_test PRIVATE ${arg_INCLUDES})
  target_compile_options(${name}_test PRIVATE ${FELTGATE_WARNINGS} -O2)
  target_link_libraries(${name}_test PRIVATE feltgate_catch_main feltgate_model ${name}_rtl)
  if(arg_DEFECT)
    add_test(NAME core.${name}
      COMMAND ${CMAKE_COMMAND} -DTEST=$<TARGET_FILE:${name}_test> -P "${FELTGATE_EXPECT_FAILURE}")
    set_tests_properties(core.${name} PROPERTIES LABELS mutation TIMEOUT 600)
  else()
    add_test(NAME core.${name} COMMAND ${name}_test)
    set_tests_properties(core.${name} PROPERTIES LABELS unit TIMEOUT 600)
  endif()
endfunction()
