// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The register map as read from rtl/registers.toml. Documentation: docs/registers.md (generated)
#pragma once

#include <string>
#include <vector>

namespace feltgate::config {
class TomlReader;
}

namespace feltgate::design {

/// Reads a text that is safe between quotation marks in generated code.
std::string plain_text(config::TomlReader& r, const std::string& key);

/// One word of the parameter RAM.
struct Parameter {
  std::string name;
  std::string scene;           ///< scene of the word; empty: shared by all scenes
  int slot = 0;                ///< the address; of a scene's word in the scene's bank of 32
  std::string kind;            ///< coefficient, signed, signal, limit, counts, integer or angle
  std::string signal;          ///< format of a word of kind signal or limit
  std::string same_format_as;  ///< coefficient whose format the word shares, or empty
  int bits = 31;               ///< of a word of kind integer
  bool saturates = false;      ///< a larger value of a design becomes the largest that fits
  int headroom_bits = 0;       ///< doublings above the design's value that a coefficient can take
  std::string option;          ///< option that a design needs to have the word; empty: all have it
  std::string while_armed;  ///< effect of a write while the motor is armed: refused, ramps or acts
  std::string unit;
  std::string doc;
  int address = 0;
  std::string place;  ///< "file:line" of the entry, for errors
};

struct Scene {
  std::string name;
  int number = 0;
};

struct Field {
  std::string name;
  int bit = 0;
  int width = 1;
  std::string doc;
};

struct Control {
  std::string name;
  int address = 0;
  std::string doc;
  std::vector<Field> fields;
};

struct Snapshot {
  std::string name;
  int slot = 0;              ///< the address, from the snapshot's first on
  std::string signal, unit;  ///< signal that gives the format; empty: plain bits
  std::string doc;
  std::vector<Field> fields;
  std::string place;  ///< "file:line" of the entry, for errors
};

/// A bit of the limits, or a numbered cause of a fault.
struct Cause {
  std::string name;
  int number = 0;
  std::string doc;
};

/// A word of the host's link, in addition to the core's port.
struct LinkWord {
  std::string name;
  int address = 0;
  bool writable = false;
  std::string doc;
  std::vector<Field> fields;
};

struct RegisterMap {
  std::string path;
  std::vector<Parameter> parameters;
  std::vector<Scene> scenes;
  std::vector<Control> controls;
  std::vector<Snapshot> snapshots;
  std::vector<Cause> constants;  ///< plain numbers, by value
  std::vector<Cause> limits;     ///< in the order of their bits
  std::vector<Cause> faults;     ///< in the order of their numbers, from 1 on
  std::vector<LinkWord> link_words;
  std::vector<Cause> link_constants;  ///< numbers of the link's format, by value

  /// Lowest bit of a control word's field. Throws config::ConfigError when there is no such field.
  int control_bit(const std::string& control, const std::string& field) const;
  const Parameter* find(const std::string& parameter) const;  ///< nullptr: no such parameter
  int scene_number(const std::string& name) const;            ///< -1 when there is no such scene
  std::vector<std::string> scene_names() const;
};

/// First address of the snapshot words in the register port's address space.
constexpr int snapshot_base = 0x300;

/// Reads the map. Throws config::ConfigError with file and line for a malformed entry, a slot that
/// is used twice, or an unknown scene.
RegisterMap read_registers(const std::string& path);
/// The same of a text; errors name it `path`.
RegisterMap registers_from_text(const std::string& text, const std::string& path);

}  // namespace feltgate::design
