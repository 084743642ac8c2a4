// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The engine's numbers, instructions and memories as read from rtl/engine/engine.toml, and the
// texts generated from them. Documentation: docs/engine-isa.md (generated)
#pragma once

#include <array>
#include <string>
#include <vector>

#include "design/design.hpp"
#include "design/registers.hpp"
#include "law/target.hpp"

namespace feltgate::design {

/// A range of words of a memory or of the host's addresses.
struct EngineWords {
  std::string name;
  int first = 0;
  int words = 1;
  std::string access = "read";  ///< "read", "write" (reads and writes) or "write_only"
  std::string doc;
  std::vector<Field> fields;
};

/// The value of an engine word's field after a reset.
struct EngineResetField {
  Field field;
  std::int64_t value = 0;
};

struct EngineDescription {
  std::vector<Cause> constants;
  std::array<int, 4> shifts{};  ///< shifts of a product, by the field mode
  std::vector<Field> fields;    ///< fields of a program word; they fill it
  std::vector<Cause> ops;       ///< by number
  std::vector<EngineWords> regions;
  std::vector<EngineWords> host;
  std::vector<EngineResetField> reset;  ///< fields from bit 0 on, without a gap
};

/// Reads the description. Throws config::ConfigError with file and line for a malformed entry, for
/// fields that overlap or leave a bit unused, and for words that share an address.
EngineDescription read_engine(const std::string& path);

/// Texts of rtl/generated/feltgate_engine_pkg.sv, model/include/feltgate/generated/engine.hpp and
/// docs/engine-isa.md.
std::string engine_package(const EngineDescription& engine);
std::string engine_header(const EngineDescription& engine);
std::string engine_page(const EngineDescription& engine);

// Converts a design to a target of the law compiler: its rates and formats.

/// The properties of design `e` that the law compiler needs.
inline law::Target law_target(const Elaborated& e) {
  law::Target t;
  t.design = e.design.name;
  t.tick_hz = e.design.tick_hz;
  t.clocks_per_tick = e.design.clocks_per_tick();
  t.counts_per_turn = 4 * e.design.lines;
  t.velocity = e.design.velocity;
  t.torque = e.design.torque;
  return t;
}

}  // namespace feltgate::design
