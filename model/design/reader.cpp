// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Generates the header with one reader function per parameter of a design.
// Documentation: docs/designs.md
#include <fmt/format.h>

#include "design/generate.hpp"

namespace feltgate::design {

std::string reader_header(const RegisterMap& map) {
  std::string s =
      "// SPDX-License-Identifier: Apache-2.0\n"
      "// SPDX-FileCopyrightText: 2026 the feltgate authors\n//\n"
      "// Generated from rtl/registers.toml by `feltgate generate`: do not edit.\n"
      "#pragma once\n\n"
      "namespace feltgate {\n\n"
      "/// The parameters of design D by name, each in the format that D gives it. Derived is the\n"
      "/// class that inherits this; it reads any word: get<Key>(address).\n"
      "template <class D, class Derived>\n"
      "struct ParameterReader {\n";
  for (const Parameter& p : map.parameters) {
    s += fmt::format("  auto {0}() const {{\n    return word<D::P::{0}.key()>(D::A::{0});\n  }}\n",
                     p.name);
  }
  return s +
         "\n private:\n"
         "  template <int Key>\n"
         "  auto word(int address) const {\n"
         "    return static_cast<const Derived&>(*this).template get<Key>(address);\n"
         "  }\n"
         "};\n\n"
         "}  // namespace feltgate\n";
}

}  // namespace feltgate::design
