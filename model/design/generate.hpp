// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Writes what follows from a design: the SystemVerilog package, the C++ header, and the pages that
// list registers and the wave. Documentation: docs/designs.md
#pragma once

#include <string>

#include "design/design.hpp"

namespace feltgate::design {

/// Text of rtl/generated/NAME/feltgate_pkg.sv.
std::string systemverilog_package(const Elaborated& e);

/// Text of model/include/feltgate/generated/NAME.hpp.
std::string cpp_header(const Elaborated& e);

/// Text of model/include/feltgate/generated/reader.hpp.
std::string reader_header(const RegisterMap& map);

/// Text of rtl/generated/NAME/parameters.mem, which $readmemh takes: the 512 words, each behind its
/// check, in hexadecimal.
std::string memory_text(const Elaborated& e);

/// A line per parameter: name, address, integer, exact value in its unit.
std::string values_text(const Elaborated& e);

/// Text of docs/registers.md; the formats shown are those of `e`.
std::string register_page(const Elaborated& e);

/// The table that `feltgate design NAME` prints.
std::string design_table(const Elaborated& e);

/// Names and formats of all signals, in the order of the wave.
std::vector<std::pair<std::string, Format>> named_formats(const Formats& f);

}  // namespace feltgate::design
