# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
#
# The launcher's table of commands: every target that it names exists here.
set(feltgate_table "${FELTGATE_ROOT}/scripts/commands.txt")
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS "${feltgate_table}")
file(STRINGS "${feltgate_table}" feltgate_rows REGEX "^[a-z]+\\|")
foreach(row IN LISTS feltgate_rows)
  string(REGEX REPLACE "^[a-z]+\\|[^|]*\\|([^|]*)\\|.*" "\\1" targets "${row}")
  separate_arguments(targets)
  foreach(target IN LISTS targets)
    if(target MATCHES "^feltgate" AND NOT TARGET ${target})
      message(FATAL_ERROR "scripts/commands.txt: no target ${target}: ${row}")
    endif()
  endforeach()
endforeach()
