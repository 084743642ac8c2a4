// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The schedule of a tick as read from rtl/schedule.toml and checked against the register map, and
// the texts generated from both, which are equal in all designs. Documentation: docs/architecture.md
// (generated)
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "design/design.hpp"
#include "design/registers.hpp"

namespace feltgate::design {

/// A result that is needed: that of this tick, or of the previous one.
struct Need {
  std::string result;
  bool previous = false;
};

/// A product: in clock `slot` its operand is on the operand bus and its factor on the parameter
/// bus.
struct Product {
  std::string name;
  Need operand;
  std::vector<std::string> factors;  ///< possible factor words; none: a square
  std::vector<std::string> scenes;   ///< scenes in which it is formed; none: all
  int slot = 0;
  std::string operand_label, label;  ///< in the timing diagram
  std::string by, doc, place;
};

/// An action in a fixed clock of the wave; its result is valid one clock later.
struct Step {
  std::string name;
  int clock = 0;
  std::vector<Need> needs;
  std::string fetches;             ///< word that is on the parameter bus in its clock, or empty
  std::vector<std::string> takes;  ///< words that it takes from the parameter bus
  std::vector<std::string> reads;  ///< words of the snapshot that it reads
  int lasts = 0;                   ///< clocks for which the result is valid; 0: held
  bool on_operand_bus = false;     ///< the result occupies the operand bus while it lasts
  int no_product = 0;              ///< clocks, from its own on, in which the product bus must be 0
  std::string shows_in;            ///< a later result whose register this step writes first
  std::string output;              ///< label of the result in the timing diagram; none: not shown
  std::string by, doc, place;
};

struct Schedule {
  std::string path;
  int wave_length = 0, first_wave_clock = 0, multiplier_latency = 0;
  std::vector<Product> products;
  std::vector<Step> steps;

  const Product* product(const std::string& name) const;  ///< nullptr: no such product
  const Step* step(const std::string& name) const;        ///< nullptr: no such step
};

/// Mask of the slots that are read from the bank of the scene: bit n is slot n.
std::uint64_t scene_slots(const RegisterMap& map);

/// Reads and checks the schedule. Throws config::ConfigError with file, line and reason when it
/// cannot work.
Schedule read_schedule(const std::string& path, const RegisterMap& map);

/// Throws config::ConfigError when the design's tick is shorter than the wave.
void check_tick(const Design& design, const Schedule& s);

/// Text of rtl/generated/feltgate_map_pkg.sv.
std::string map_package(const RegisterMap& map, const Schedule& s);
/// Text of model/include/feltgate/generated/map.hpp.
std::string map_header(const RegisterMap& map, const Schedule& s);
/// Text of model/include/feltgate/generated/causes.hpp.
std::string causes_header(const RegisterMap& map);

/// Throws config::ConfigError with file, line and reason for a late result, for words that collide,
/// and for a clock outside the tick.
void check_schedule(const RegisterMap& map, const Schedule& s);

}  // namespace feltgate::design
