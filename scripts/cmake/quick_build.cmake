# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
#
# Tools that make a build quicker where they are installed: ccache and another linker.

# Compiles through ccache if it is installed. testbench/apps/launcher/checkout_test.py checks that ccache
# gives no outdated result.
if(NOT DEFINED CMAKE_CXX_COMPILER_LAUNCHER)
  find_program(FELTGATE_CCACHE ccache DOC "Keeps what was compiled; FALSE: not used")
  if(FELTGATE_CCACHE)
    # Without these two ccache keeps nothing that is compiled with a precompiled header.
    set(CMAKE_CXX_COMPILER_LAUNCHER "${CMAKE_COMMAND}" -E env
      CCACHE_SLOPPINESS=pch_defines,time_macros "${FELTGATE_CCACHE}")
  endif()
endif()

# Links by mold if it is installed, else by gold, which comes with Debian 12's binutils: both take less time than the
# compiler's own linker, and a build with tests links hundreds of programs.
if(NOT CMAKE_CROSSCOMPILING)
  find_program(FELTGATE_LINKER NAMES mold ld.gold DOC "Links the programs; FALSE: the compiler's own linker")
  if(FELTGATE_LINKER)
    get_filename_component(linker "${FELTGATE_LINKER}" NAME)
    string(REPLACE "ld." "" linker "${linker}")
    add_link_options("-fuse-ld=${linker}")
  endif()
endif()
