// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The register map of a design for hosts and other tools: C headers, SystemRDL, and CSV as LiteX
// writes it. Documentation: docs/other-tools.md
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "design/design.hpp"

namespace feltgate::design {

/// A word that a host reads or writes.
struct HostWord {
  std::string name;
  std::string kind;  ///< parameter, control, snapshot or link
  int address = 0;   ///< in words
  bool reads = false, writes = false;
  bool number = false;      ///< true: a number with format and unit; false: plain bits
  Format format{0, 32, 0};  ///< format of the word
  std::string unit, doc;
  std::vector<Field> fields;
  std::int64_t reset = 0;  ///< value after configuration
  double si = 0;           ///< value of a parameter, in its unit
};

/// All words of the core's port, in the order of their addresses. Throws config::ConfigError when
/// two words have the same name or a snapshot word names an unknown signal.
std::vector<HostWord> host_words(const Elaborated& e);

/// The words that only the link has, named link_..., in the order of their addresses.
std::vector<HostWord> link_host_words(const RegisterMap& map);

/// Text of rtl/generated/feltgate_map.h, which is the same for every design.
std::string c_map_header(const Elaborated& e);
/// Text of rtl/generated/NAME/feltgate.h, which includes feltgate_map.h.
std::string c_header(const Elaborated& e);
/// Text of rtl/generated/NAME/feltgate.rdl.
std::string system_rdl(const Elaborated& e);
/// Text of rtl/generated/NAME/csr.csv.
std::string csr_csv(const Elaborated& e);

}  // namespace feltgate::design
