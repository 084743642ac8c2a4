# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
#
# Toolchain file: the libraries for AArch64 with Debian's g++-aarch64-linux-gnu, run by qemu-user.
# Boost, toml++, fmt and Catch2 2 are headers; those of this machine are used. No library of another
# architecture is needed. docs/library.md
set(CMAKE_SYSTEM_NAME Linux)
set(CMAKE_SYSTEM_PROCESSOR aarch64)
set(CMAKE_CXX_COMPILER aarch64-linux-gnu-g++)
find_program(FELTGATE_QEMU NAMES qemu-aarch64 qemu-aarch64-static)
if(FELTGATE_QEMU)
  set(CMAKE_CROSSCOMPILING_EMULATOR "${FELTGATE_QEMU};-L;/usr/aarch64-linux-gnu")
endif()

# Those headers alone: the rest of /usr/include belongs to this machine's architecture.
set(FELTGATE_HEADERS "${CMAKE_BINARY_DIR}/headers")
foreach(library boost toml++ fmt catch2)
  if(EXISTS "/usr/include/${library}" AND NOT EXISTS "${FELTGATE_HEADERS}/include/${library}")
    file(MAKE_DIRECTORY "${FELTGATE_HEADERS}/include")
    file(CREATE_LINK "/usr/include/${library}" "${FELTGATE_HEADERS}/include/${library}" SYMBOLIC)
  endif()
endforeach()
set(CMAKE_FIND_ROOT_PATH /usr/aarch64-linux-gnu "${FELTGATE_HEADERS}")
set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
set(CMAKE_FIND_ROOT_PATH_MODE_LIBRARY ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_INCLUDE ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_PACKAGE ONLY)
# try_compile() projects have a binary folder of their own, without the links.
set(CMAKE_TRY_COMPILE_TARGET_TYPE STATIC_LIBRARY)
