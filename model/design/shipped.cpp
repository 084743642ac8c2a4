// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The designs that a build contains as texts. Documentation: docs/designs.md
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <stdexcept>

#include "design/info.hpp"
#include "feltgate/nearest.hpp"

namespace feltgate::design {

/// The files of rtl/designs; an entry without a name ends the list. And rtl/registers.toml. Both
/// are constant-initialised, so constructors of other files may read them.
extern const ShippedFile* const shipped_designs;
extern const char* const shipped_registers;

namespace {

const RegisterMap& registers() {
  static const RegisterMap map = registers_from_text(shipped_registers, "rtl/registers.toml");
  return map;
}

}  // namespace

bool is_path(const std::string& name) {
  const std::string ending = ".toml";
  return name.find('/') != std::string::npos ||
         (name.size() > ending.size() &&
          name.compare(name.size() - ending.size(), ending.size(), ending) == 0);
}

std::vector<std::string> shipped_names() {
  std::vector<std::string> names;
  for (const ShippedFile* f = shipped_designs; f->name != nullptr; ++f) names.emplace_back(f->name);
  return names;
}

Elaborated design_named(const std::string& name) {
  if (is_path(name)) return elaborate(read_design(name), registers());
  for (const ShippedFile* f = shipped_designs; f->name != nullptr; ++f) {
    if (name != f->name) continue;
    return elaborate(design_from_text(f->text, fmt::format("rtl/designs/{}.toml", name)),
                     registers());
  }
  throw std::invalid_argument(fmt::format(
      "design \"{}\" is unknown; {}choose one of {}, or give the path of a design file", name,
      config::did_you_mean(name, shipped_names()), fmt::join(shipped_names(), ", ")));
}

}  // namespace feltgate::design
