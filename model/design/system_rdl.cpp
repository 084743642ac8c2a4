// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Writes the register map of a design in SystemRDL 2.0. Documentation: docs/other-tools.md
#include <fmt/format.h>

#include <sstream>

#include "design/generate.hpp"
#include "design/host_words.hpp"
#include "design/text_edit.hpp"

namespace feltgate::design {

namespace {

std::string quoted(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') out += '\\';
    out += c;
  }
  return out + "\"";
}

const char* access(const HostWord& w) { return !w.reads ? "w" : w.writes ? "rw" : "r"; }

std::uint64_t bits_of(std::int64_t value, int width) {
  return static_cast<std::uint64_t>(value) & ((std::uint64_t{1} << width) - 1);
}

void field(std::ostringstream& s, const HostWord& w, const Field& f, bool number) {
  s << "    field {\n      desc = " << quoted(f.doc) << ";\n      sw = " << access(w)
    << "; hw = " << (w.writes ? "r" : "w") << ";\n";
  if (w.name == "command") s << "      singlepulse;\n";
  if (number) {
    s << fmt::format("      feltgate_format = \"[{},{},{}]\"; feltgate_unit = {};\n", w.format.sign,
                     w.format.integer, w.format.fraction, quoted(w.unit));
  }
  // The name is escaped because it may be a keyword of SystemRDL.
  s << fmt::format("    }} \\{} [{}:{}]", f.name, f.bit + f.width - 1, f.bit);
  if (w.writes && w.kind != "link") {
    s << fmt::format(" = {}'h{:x}", f.width, bits_of(w.reset >> f.bit, f.width));
  }
  s << ";\n";
}

void word(std::ostringstream& s, const HostWord& w) {
  s << "  reg {\n    desc = " << quoted(w.doc) << ";\n";
  for (const Field& f : w.fields) field(s, w, f, false);
  if (w.fields.empty()) {
    Field value;
    value.name = "value";
    value.width = w.number ? w.format.width() : 32;
    value.doc = w.doc;
    field(s, w, value, w.number);
  }
  s << fmt::format("  }} \\{} @ 0x{:x};\n\n", w.name, 4 * w.address);
}

}  // namespace

std::string system_rdl(const Elaborated& e) {
  std::ostringstream s;
  s << generated_banner("rtl/designs/" + e.design.name + ".toml and rtl/registers.toml", "") << "\n"
    << "property feltgate_format { type = string; component = field; };  // [S,I,F]\n"
    << "property feltgate_unit { type = string; component = field; };\n\n"
    << "addrmap feltgate_link {\n  name = \"feltgate's link\";\n"
    << "  desc = \"What only the host's link has, no bus. Addresses in bytes, four times the "
       "link's.\";\n"
    << "  default regwidth = 32;\n  default accesswidth = 32;\n\n";
  for (const HostWord& w : link_host_words(e.registers)) word(s, w);
  s << "};\n\n"
    << "addrmap feltgate {\n  name = " << quoted("feltgate, design " + e.design.name) << ";\n"
    << "  desc = " << quoted(e.design.description + ". Addresses in bytes; each word has 32 bits.")
    << ";\n  default regwidth = 32;\n  default accesswidth = 32;\n\n";
  for (const HostWord& w : host_words(e)) word(s, w);
  s << "};\n";
  return s.str();
}

}  // namespace feltgate::design
