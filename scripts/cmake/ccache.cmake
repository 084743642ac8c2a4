# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
#
# Compiles through ccache if it is installed. testbench/apps/launcher/ccache_test.py checks that ccache
# gives no outdated result.
if(NOT DEFINED CMAKE_CXX_COMPILER_LAUNCHER)
  find_program(FELTGATE_CCACHE ccache DOC "Keeps what was compiled; FALSE: not used")
  if(FELTGATE_CCACHE)
    # Without these two ccache keeps nothing that is compiled with a precompiled header.
    set(CMAKE_CXX_COMPILER_LAUNCHER "${CMAKE_COMMAND}" -E env
      CCACHE_SLOPPINESS=pch_defines,time_macros "${FELTGATE_CCACHE}")
  endif()
endif()
