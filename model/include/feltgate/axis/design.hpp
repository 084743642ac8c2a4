// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// A design as data: the constants of package cfg by their names, and the words of the host with
// address, format and value. Nothing is compiled for a design: `feltgate::design::as_data` fills it
// from the text of one, `of` from a generated header. docs/designs.md
#pragma once

#include <cstdint>
#include <iterator>
#include <map>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "feltgate/axis/fx.hpp"

namespace feltgate::axis {

/// A word of the host.
struct Word {
  std::string name;
  int address = 0;  ///< below 512
  int bits = 32;    ///< with its sign
  bool has_sign = false;
  int fraction = 0;
  std::uint32_t reset = 0;
};

struct Design {
  std::map<std::string, std::int64_t, std::less<>> constants;
  std::vector<Word> words;

  /// The constant of this name, e.g. "VELOCITY_F"; throws if there is none.
  int operator[](std::string_view name) const { return static_cast<int>(wide(name)); }
  std::int64_t wide(std::string_view name) const {
    const auto at = constants.find(name);
    if (at == constants.end()) throw std::out_of_range("design without " + std::string(name));
    return at->second;
  }
  Rounding rounding() const { return static_cast<Rounding>((*this)["ROUNDING"]); }
  bool has_scene(int scene) const { return ((*this)["SCENE_MASK"] >> scene & 1) != 0; }

  /// The design of a generated header, feltgate/generated/NAME.hpp.
  template <class D>
  static Design of() {
    Design d;
    for (const auto& c : D::constants) d.constants.emplace(c.name, c.value);
    for (const auto& p : D::parameters) {
      d.words.push_back({p.name, p.address, p.field.width(), p.field.sign == 1, p.field.fraction,
                         static_cast<std::uint32_t>(p.raw)});
    }
    return d;
  }
};

}  // namespace feltgate::axis
