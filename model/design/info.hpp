// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// A design of a file as run-time information: nothing is compiled for it. Documentation:
// docs/designs.md
#pragma once

#include <string>
#include <vector>

#include "design/design.hpp"
#include "feltgate/design_info.hpp"

namespace feltgate::design {

DesignInfo info_of(const Elaborated& e);

/// A file that scripts/cmake/embed_designs.cmake has put into this library.
struct ShippedFile {
  const char *name, *text;
};

/// The designs of rtl/designs that this library was built with, in alphabetical order.
std::vector<std::string> shipped_names();
/// Whether this is the path of a design file rather than a name: it has a / or ends with .toml.
bool is_path(const std::string& name_or_path);
/// One of them by its name, or the design of a file by its path, which has a / or ends with .toml.
/// Errors: std::invalid_argument that names the choices; those of read_design() and elaborate().
Elaborated design_named(const std::string& name_or_path);

}  // namespace feltgate::design
