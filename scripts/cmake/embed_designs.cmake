# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
#
# cmake -DROOT=... -DOUTPUT=... -P embed_designs.cmake: the files of rtl/designs and rtl/registers.toml as texts of
# model/design/info.cpp.
file(GLOB files "${ROOT}/rtl/designs/*.toml")
list(SORT files)
set(designs "")
foreach(file IN LISTS files)
  get_filename_component(name "${file}" NAME_WE)
  file(READ "${file}" text)
  string(APPEND designs "    {\"${name}\", R\"toml(${text})toml\"},\n")
endforeach()
file(READ "${ROOT}/rtl/registers.toml" registers)
# A literal has at most 65536 bytes in some compilers: in two parts, which the compiler joins.
string(LENGTH "${registers}" length)
math(EXPR half "${length} / 2")
string(SUBSTRING "${registers}" 0 ${half} first)
string(SUBSTRING "${registers}" ${half} -1 second)
file(WRITE "${OUTPUT}" "// Written by scripts/cmake/embed_designs.cmake: do not edit.
#include \"design/info.hpp\"

namespace feltgate::design {

namespace {
constexpr ShippedFile files[] = {
${designs}    {nullptr, nullptr}};
}  // namespace

extern const ShippedFile* const shipped_designs;
extern const char* const shipped_registers;
const ShippedFile* const shipped_designs = files;
const char* const shipped_registers = R\"toml(${first})toml\" R\"toml(${second})toml\";

}  // namespace feltgate::design
")
