// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Reader of rtl/engine/engine.toml. Documentation: docs/engine-isa.md (generated)
#include "design/engine_map.hpp"

#include <fmt/format.h>

#include <set>

#include "files/toml/toml_reader.hpp"

namespace feltgate::design {

namespace {

using config::TomlReader;

int integer(TomlReader& r, const std::string& key, int low, int high) {
  return static_cast<int>(r.integer(key, low, high));
}

Field read_field(TomlReader& r, int bits, std::uint64_t& used) {
  Field f;
  f.name = r.identifier("name");
  f.bit = integer(r, "bit", 0, bits - 1);
  if (r.has("width")) f.width = integer(r, "width", 1, bits);
  f.doc = plain_text(r, "doc");
  const std::uint64_t mask = ((std::uint64_t{1} << f.width) - 1) << f.bit;
  if (f.bit + f.width > bits || (used & mask) != 0) {
    r.fail("bit", f.name + " overlaps another field, or ends beyond the word", "move it");
  }
  used |= mask;
  r.finish();
  return f;
}

EngineWords read_words(TomlReader& r, const std::string& first, std::set<int>& used) {
  EngineWords w;
  w.name = r.identifier("name");
  w.first = integer(r, first, 0, 4095);
  if (r.has("words")) w.words = integer(r, "words", 1, 4096 - w.first);
  static const std::vector<std::string> accesses{"read", "write", "write_only"};
  if (r.has("access")) w.access = accesses[r.choice("access", accesses)];
  w.doc = plain_text(r, "doc");
  std::uint64_t bits = 0;
  for (TomlReader& f : r.sections("fields")) w.fields.push_back(read_field(f, 32, bits));
  for (int n = w.first; n < w.first + w.words; ++n) {
    if (!used.insert(n).second) {
      r.fail(first, w.name + " shares an address with another entry", "choose a free one");
    }
  }
  r.finish();
  return w;
}

}  // namespace

EngineDescription read_engine(const std::string& path) {
  const toml::table root = config::parse_toml_file(path);
  TomlReader top(root, path, "the engine");
  EngineDescription e;
  int bits = 36;
  for (TomlReader& r : top.sections("constant")) {
    e.constants.push_back(
        {r.identifier("name"), integer(r, "value", 0, 65535), plain_text(r, "doc")});
    if (e.constants.back().name == "program_bits") bits = e.constants.back().number;
    r.finish();
  }
  std::size_t mode = 0;
  for (TomlReader& r : top.sections("shift")) {
    if (mode == 4 || integer(r, "mode", 0, 3) != static_cast<int>(mode)) {
      r.fail("mode", "the modes are 0, 1, 2, 3", "list each once, in order");
    }
    e.shifts[mode++] = integer(r, "bits", 0, 31);
    r.finish();
  }
  if (mode != 4) top.fail("shift", "a mode has no shift", "list four");
  std::uint64_t used = 0;
  for (TomlReader& r : top.sections("field")) e.fields.push_back(read_field(r, bits, used));
  if (used + 1 != std::uint64_t{1} << bits) {
    top.fail("field", "the fields leave bits of the program word out", "name every bit");
  }
  for (TomlReader& r : top.sections("op")) {
    e.ops.push_back({r.identifier("name"), static_cast<int>(e.ops.size()), plain_text(r, "doc")});
    r.finish();
  }
  if (e.ops.size() != 16) top.fail("op", "the field op has 16 numbers", "list one op for each");
  std::set<int> data, host;
  for (TomlReader& r : top.sections("region")) e.regions.push_back(read_words(r, "first", data));
  if (data.size() != 512) top.fail("region", "a data word is in no region", "name all 512");
  for (TomlReader& r : top.sections("host")) e.host.push_back(read_words(r, "address", host));
  int bit = 0;
  for (TomlReader& r : top.sections("reset")) {
    EngineResetField w;
    w.field.name = r.identifier("name");
    w.field.bit = bit;
    w.field.width = integer(r, "width", 1, 32);
    w.value = r.integer("value", 0, (std::int64_t{1} << w.field.width) - 1);
    w.field.doc = plain_text(r, "doc");
    bit += w.field.width;
    e.reset.push_back(w);
    r.finish();
  }
  top.finish();
  return e;
}

}  // namespace feltgate::design
