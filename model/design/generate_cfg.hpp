// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The package `cfg` of a design: constants, formats, words and structs of the RTL. Documentation:
// docs/designs.md
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "design/design.hpp"
#include "design/generate.hpp"
#include "feltgate/axis/design.hpp"

namespace feltgate::design {

/// A register of params_t: a common word, or the word that the scene in force has in a slot.
struct ParamsRegister {
  std::string name;
  int bits = 0;
  bool is_signed = false;
  int address = 0;         ///< of its word; of a scene's word in the bank that no scene has
  std::int64_t reset = 0;  ///< the design's integer
};

/// The bank of the words of the scene in force. No scene has this number.
constexpr int bank_of_any_scene = 15;

/// In the order of params_t: the common words as in the register map, then the scenes' slots.
std::vector<ParamsRegister> params_registers(const Elaborated& e);

/// All constants of the package by their names there, in its order.
std::vector<Constant> cfg_constants(const Elaborated& e);

/// The same, and the words, as the twin takes them: no compiler sees the design.
axis::Design as_data(const Elaborated& e);

/// Text of rtl/generated/NAME/cfg.sv.
std::string cfg_package(const Elaborated& e);

}  // namespace feltgate::design
