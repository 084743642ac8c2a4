// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Reader of rtl/registers.toml. Documentation: docs/registers.md (generated)
#include "design/registers.hpp"

#include <fmt/format.h>

#include <set>

#include "feltgate/nearest.hpp"
#include "files/toml/toml_reader.hpp"

namespace feltgate::design {

int RegisterMap::scene_number(const std::string& name) const {
  for (const Scene& s : scenes) {
    if (s.name == name) return s.number;
  }
  return -1;
}

std::vector<std::string> RegisterMap::scene_names() const {
  std::vector<std::string> names;
  for (const Scene& s : scenes) names.push_back(s.name);
  return names;
}

int RegisterMap::control_bit(const std::string& control, const std::string& field) const {
  for (const Control& c : controls) {
    if (c.name != control) continue;
    for (const Field& f : c.fields) {
      if (f.name == field) return f.bit;
    }
  }
  throw config::ConfigError(fmt::format("{}:1: no field {}.{}; list it", path, control, field));
}

const Parameter* RegisterMap::find(const std::string& parameter) const {
  for (const Parameter& p : parameters) {
    if (p.name == parameter) return &p;
  }
  return nullptr;
}

std::string plain_text(config::TomlReader& r, const std::string& key) {
  std::string text = r.text(key);
  if (text.find_first_of("\"\\") != std::string::npos) {
    r.fail(key, fmt::format("a {} with \" or \\ cannot be written into a program", key),
           "write it without");
  }
  return text;
}

namespace {

int small(config::TomlReader& r, const std::string& key, std::int64_t high) {
  return static_cast<int>(r.integer(key, 0, high));
}

Parameter read_parameter(config::TomlReader r, const RegisterMap& map, std::set<int>& used) {
  static const std::vector<std::string> kinds{"coefficient", "signed",  "signal", "limit",
                                              "counts",      "integer", "angle"};
  Parameter p;
  p.name = r.identifier("name");
  p.place = fmt::format("{}:{}", r.file(), r.line("name"));
  if (r.has("scene")) p.scene = r.text("scene");
  p.slot = small(r, "slot", p.scene.empty() ? 63 : 31);
  p.kind = kinds[r.choice("kind", kinds)];
  if (p.kind == "signal" || p.kind == "limit") p.signal = r.text("format");
  if (p.kind == "integer") {
    p.bits = static_cast<int>(r.integer("bits", 1, 31));
    p.saturates = r.flag_or("saturates", false);
  }
  if (r.has("same_format_as")) p.same_format_as = r.text("same_format_as");
  p.while_armed = p.scene.empty() ? "refused" : "ramps";
  if (r.has("while_armed")) {
    static const std::vector<std::string> effects{"acts", "ramps", "refused"};
    p.while_armed = effects[r.choice("while_armed", effects)];
  }
  if (!p.scene.empty() && p.while_armed == "refused") {
    r.fail("while_armed", "the port refuses words that all scenes share, and no others",
           "let it ramp");
  }
  if (r.has("option"))
    p.option = std::vector<std::string>{"three_phases"}[r.choice("option", {"three_phases"})];
  if (r.has("headroom_bits")) p.headroom_bits = small(r, "headroom_bits", 8);
  p.unit = plain_text(r, "unit");
  p.doc = r.text("doc");
  p.address = p.slot;
  if (!p.scene.empty()) {
    const int number = map.scene_number(p.scene);
    if (number < 2) {
      r.fail("scene", fmt::format("scene \"{}\" has no bank", p.scene),
             config::did_you_mean(p.scene, map.scene_names()) + "list it under [[scene]]");
    }
    p.address += 32 * number;
  }
  if (!used.insert(p.address).second) {
    r.fail("slot", p.name + " shares its address with another parameter", "choose a free slot");
  }
  r.finish();
  return p;
}

/// Checks the input scenes: if one word of a scene acts at once, all its words must.
void check_inputs(const RegisterMap& map) {
  for (const Parameter& p : map.parameters) {
    for (const Parameter& other : map.parameters) {
      if (p.scene.empty() || p.scene != other.scene || p.while_armed == other.while_armed) continue;
      throw config::ConfigError(
          fmt::format("{}: {} and {} are words of one scene and differ in while_armed; write the "
                      "same for both",
                      p.place, p.name, other.name));
    }
  }
}

std::vector<Field> read_fields(config::TomlReader& r) {
  std::vector<Field> fields;
  for (config::TomlReader& f : r.sections("fields")) {
    Field field;
    field.name = f.identifier("name");
    field.bit = small(f, "bit", 31);
    field.width = f.has("width") ? small(f, "width", 32) : 1;
    if (field.bit + field.width > 32)
      f.fail("width", "the field ends beyond bit 31", "make it narrower");
    field.doc = f.text("doc");
    f.finish();
    fields.push_back(field);
  }
  return fields;
}

Control read_control(config::TomlReader r) {
  Control c;
  c.name = r.identifier("name");
  c.address = small(r, "address", 0x2ff);
  c.doc = r.text("doc");
  c.fields = read_fields(r);
  r.finish();
  return c;
}

Snapshot read_snapshot(config::TomlReader r, std::set<int>& used) {
  Snapshot n;
  n.name = r.identifier("name");
  n.place = fmt::format("{}:{}", r.file(), r.line("name"));
  n.slot = small(r, "slot", 63);
  if (!used.insert(n.slot).second) {
    r.fail("slot", n.name + " shares its address with another word", "choose a free slot");
  }
  if (r.has("format")) {
    n.signal = r.text("format");
    n.unit = plain_text(r, "unit");
  }
  n.doc = r.text("doc");
  n.fields = read_fields(r);
  r.finish();
  return n;
}

LinkWord read_link_word(config::TomlReader r, std::set<int>& used) {
  LinkWord w;
  w.name = r.identifier("name");
  w.address = static_cast<int>(r.integer("address", 0x1000, 0x1fff));
  if (!used.insert(w.address).second) {
    r.fail("address", w.name + " shares its address with another word", "choose a free one");
  }
  if (r.has("access")) {
    static const std::vector<std::string> accesses{"read", "write"};
    w.writable = r.choice("access", accesses) == 1;
  }
  w.doc = r.text("doc");
  w.fields = read_fields(r);
  r.finish();
  return w;
}

/// Reads the entries under `key`; their numbers count up from `first`.
std::vector<Cause> read_causes(config::TomlReader& top, const std::string& section,
                               const std::string& key, int first) {
  std::vector<Cause> causes;
  for (config::TomlReader& r : top.sections(section)) {
    const int next = first + static_cast<int>(causes.size());
    Cause c{r.identifier("name"), small(r, key, 15), plain_text(r, "doc")};
    if (c.number != next) {
      r.fail(key, fmt::format("{} follows {}", c.number, next - 1),
             fmt::format("list them in order; this one is {}", next));
    }
    causes.push_back(c);
    r.finish();
  }
  return causes;
}

RegisterMap registers_of(const toml::table& root, const std::string& path) {
  config::TomlReader top(root, path, "the register map");
  RegisterMap map;
  map.path = path;
  for (config::TomlReader& r : top.sections("scene")) {
    map.scenes.push_back({r.identifier("name"), small(r, "number", 15)});
    r.finish();
  }
  std::set<int> used;
  for (config::TomlReader& r : top.sections("parameter")) {
    map.parameters.push_back(read_parameter(r, map, used));
  }
  check_inputs(map);
  for (config::TomlReader& r : top.sections("control")) map.controls.push_back(read_control(r));
  std::set<int> snapshot_used;
  for (config::TomlReader& r : top.sections("snapshot")) {
    map.snapshots.push_back(read_snapshot(r, snapshot_used));
  }
  for (config::TomlReader& r : top.sections("constant")) {
    map.constants.push_back({r.identifier("name"), small(r, "value", 30), r.text("doc")});
    r.finish();
  }
  std::set<int> link_used;
  for (config::TomlReader& r : top.sections("link_word")) {
    map.link_words.push_back(read_link_word(r, link_used));
  }
  for (config::TomlReader& r : top.sections("link_constant")) {
    map.link_constants.push_back(
        {r.identifier("name"), small(r, "value", 0x7fffffff), r.text("doc")});
    r.finish();
  }
  map.limits = read_causes(top, "limit", "bit", 0);
  map.faults = read_causes(top, "fault", "number", 1);
  top.finish();
  return map;
}

}  // namespace

RegisterMap read_registers(const std::string& path) {
  return registers_of(config::parse_toml_file(path), path);
}

RegisterMap registers_from_text(const std::string& text, const std::string& path) {
  return registers_of(config::parse_toml_text(text, path), path);
}

}  // namespace feltgate::design
