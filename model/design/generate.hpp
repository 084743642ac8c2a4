// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Generates the files of all designs and of one: map, C++ header, pages. Documentation:
// docs/designs.md
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "design/design.hpp"

namespace feltgate::design {

/// A plain integer that RTL and twin share.
struct Constant {
  std::string name;
  std::int64_t value;
  std::string doc;
};

/// The constants of a design, in the order of its packages.
std::vector<Constant> design_constants(const Elaborated& e);

/// Texts of rtl/generated/map.sv and model/include/feltgate/generated/map.hpp: addresses, bits and
/// numbers, which are equal in all designs.
std::string map_package(const RegisterMap& map);
std::string map_header(const RegisterMap& map);
/// Text of model/include/feltgate/generated/causes.hpp.
std::string causes_header(const RegisterMap& map);

/// Text of model/include/feltgate/generated/NAME.hpp.
std::string cpp_header(const Elaborated& e);

/// Text of rtl/generated/NAME/parameters.mem for $readmemh: the 512 words in hexadecimal, each
/// after its check bits.
std::string memory_text(const Elaborated& e);

/// One line per parameter: name, address, integer, exact value in its unit.
std::string values_text(const Elaborated& e);

/// Text of docs/registers.md; the formats shown are those of `e`.
std::string register_page(const Elaborated& e);

/// Texts of rtl/generated/feltgate_link_pkg.sv and model/include/feltgate/generated/link.hpp.
std::string link_package(const RegisterMap& map);
std::string link_header(const RegisterMap& map);
/// The link's part of the register page.
std::string link_tables(const RegisterMap& map);

/// The bits of a field: "5", or "7:4" for several.
std::string bits_text(const Field& f);

/// CRC-32 of everything that a host must know of a design to interpret its words: docs/link.md.
std::uint32_t design_crc(const Elaborated& e);

/// The table that `feltgate design NAME` prints.
std::string design_table(const Elaborated& e);

/// The control word after a reset.
std::uint32_t control_reset(const Elaborated& e);

/// Names and formats of all signals, in the order of the data.
std::vector<std::pair<std::string, Format>> named_formats(const Formats& f);

}  // namespace feltgate::design
