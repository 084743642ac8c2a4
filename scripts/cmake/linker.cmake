# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
#
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
