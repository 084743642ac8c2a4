#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
#
# run.sh ROOT BUILD: builds the libraries for AArch64 and runs the tests that need neither Verilator
# nor SystemC under qemu-user. Says "skipped" where that cannot be. docs/library.md
set -euo pipefail
root=$1 build=$2

skip() {
  echo "aarch64 skipped: $*"
  exit 0
}
command -v aarch64-linux-gnu-g++ >/dev/null || skip "no aarch64-linux-gnu-g++"
command -v qemu-aarch64 >/dev/null || command -v qemu-aarch64-static >/dev/null ||
  skip "no qemu-aarch64"
[[ -f /usr/include/catch2/catch.hpp ]] ||
  skip "Catch2 3 is a compiled library, of which there is none for AArch64 here; 2 is headers"

cmake -S "$root" -B "$build" -G Ninja -DCMAKE_BUILD_TYPE=Release \
  -DCMAKE_TOOLCHAIN_FILE="$root/scripts/cmake/aarch64.cmake" \
  -DFELTGATE_RTL=OFF -DFELTGATE_SIGROK=OFF -DFELTGATE_INSTALL=OFF -DFELTGATE_TESTS=ON
ninja -C "$build"
unset FELTGATE_LONG
ctest --test-dir "$build" --output-on-failure --no-tests=error -j "$(nproc)"
