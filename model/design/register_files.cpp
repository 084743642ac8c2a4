// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The register map as C99 headers, of all designs the addresses and fields, of each design the
// conversions between words and SI units; and in SystemRDL 2.0. Documentation: docs/other-tools.md
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <sstream>

#include "design/generate.hpp"
#include "design/host_words.hpp"
#include "design/text_edit.hpp"

namespace feltgate::design {

namespace {

constexpr const char* helpers = R"(
#ifdef __cplusplus
extern "C" {
#endif

/* Addresses count words of 32 bits; on a bus that counts bytes: */
#define FELTGATE_BYTES(address) (4u * (address))
/* A field of a word, and a value at the place of a field:
   FELTGATE_GET(FELTGATE_STATUS_MODE, word), FELTGATE_PUT(FELTGATE_CONTROL_SCENE, 3) */
#define FELTGATE_GET(field, word) (((uint32_t)(word) & field##_MASK) >> field##_BIT)
#define FELTGATE_PUT(field, value) (((uint32_t)(value) << field##_BIT) & field##_MASK)

/* The word nearest to value * scale, halves away from 0; beyond low and high the nearer of them;
   0 for what is no number. */
static inline uint32_t feltgate_word(double value, double scale, double low, double high) {
  const double scaled = value * scale;
  double rest;
  int64_t whole;
  if (!(scaled == scaled)) return 0;
  if (scaled >= high) return (uint32_t)(int64_t)high;
  if (scaled <= low) return (uint32_t)(int64_t)low;
  whole = (int64_t)scaled;
  rest = scaled - (double)whole;
  if (rest >= 0.5) ++whole;
  if (rest <= -0.5) --whole;
  return (uint32_t)whole;
}

/* What the low bits of a word say; bits above them are ignored, as in the core. */
static inline double feltgate_value(uint32_t word, int bits, int has_sign, double scale) {
  const uint32_t top = 1u << (bits - 1);
  const uint32_t low = bits < 32 ? word & ((top << 1) - 1u) : word;
  if (!has_sign || !(low & top)) return (double)low / scale;
  return ((double)low - 2.0 * (double)top) / scale;
}

#ifdef __cplusplus
}
#endif
)";

std::string comment(const std::string& text) { return "  /* " + text + " */\n"; }

void constants(std::ostringstream& s, const char* title, const char* prefix, const char* format,
               const std::vector<Cause>& causes) {
  s << "\n/* " << title << " */\n";
  for (const Cause& c : causes) {
    s << fmt::format("#define FELTGATE_{}{} ", prefix, upper(c.name))
      << fmt::format(fmt::runtime(format), c.number) << comment(c.doc);
  }
}

void field(std::ostringstream& s, const std::string& word, const Field& f) {
  const std::string name = "FELTGATE_" + word + "_" + upper(f.name);
  const std::uint64_t mask = ((std::uint64_t{1} << f.width) - 1) << f.bit;
  s << fmt::format("#define {}_BIT {}", name, f.bit) << comment(f.doc)
    << fmt::format("#define {}_MASK 0x{:08x}u\n", name, mask);
}

void conversions(std::ostringstream& s, const HostWord& w) {
  s << "\n";
  const std::string name = "FELTGATE_" + upper(w.name);
  const Format f = w.format;
  const double scale = std::ldexp(1.0, f.fraction);
  const double high = std::ldexp(1.0, f.width() - f.sign) - 1;
  const double low = f.sign == 1 ? -high - 1 : 0;
  s << fmt::format("#define {}_VALUE(word) feltgate_value((word), {}, {}, {})\n", name, f.width(),
                   f.sign, real_literal(scale));
  if (!w.writes) return;
  s << fmt::format("#define {}_WORD(value) feltgate_word((value), {}, {}, {})\n", name,
                   real_literal(scale), real_literal(low), real_literal(high))
    << fmt::format("#define {}_DEFAULT {}\n", name, real_literal(w.si))
    << fmt::format("#define {}_RESET 0x{:08x}u\n", name, static_cast<std::uint32_t>(w.reset));
}

void word(std::ostringstream& s, const HostWord& w) {
  const std::string name = upper(w.name);
  const std::string unit = w.number ? " [" + w.unit + "]" : "";
  s << fmt::format("\n#define FELTGATE_{} 0x{:03x}u", name, w.address) << comment(w.doc + unit);
  for (const Field& f : w.fields) field(s, name, f);
}

/// Whether only designs with an option have the word: then it is not in the map of all designs.
bool of_option(const Elaborated& e, const HostWord& w) {
  const Parameter* p = e.registers.find(w.name);
  return p != nullptr && !p->option.empty();
}

}  // namespace

std::string c_map_header(const Elaborated& e) {
  std::vector<HostWord> words = host_words(e);
  words.erase(std::remove_if(words.begin(), words.end(),
                             [&](const HostWord& w) { return of_option(e, w); }),
              words.end());
  std::ostringstream s;
  s << generated_banner("rtl/registers.toml", "")
    << "// The register map of all designs for C99 and C++: addresses, fields, numbers.\n"
    << "#ifndef FELTGATE_MAP_H\n#define FELTGATE_MAP_H\n\n#include <stdint.h>\n"
    << helpers << "\n/* Words by their address. */\n";
  for (const HostWord& w : words) word(s, w);
  s << "\n/* What only the host's link has, no bus: docs/link.md. */\n";
  for (const HostWord& w : link_host_words(e.registers)) word(s, w);
  s << "\n/* X(name, NAME) for each parameter that all designs have. */\n#define "
       "FELTGATE_PARAMETERS(X)";
  for (const HostWord& w : words) {
    if (w.kind == "parameter") s << fmt::format(" \\\n  X({}, {})", w.name, upper(w.name));
  }
  s << "\n\n/* Scenes. */\n";
  for (const Scene& scene : e.registers.scenes) {
    s << "#define FELTGATE_SCENE_" << upper(scene.name) << " " << scene.number << "u\n";
  }
  constants(s, "Bits of FELTGATE_STATUS_LIMITS.", "LIMIT_", "(1u << {})", e.registers.limits);
  constants(s, "Numbers in FELTGATE_FAULTS_FIRST; fault n is also bit n of FELTGATE_FAULTS_SEEN.",
            "FAULT_", "{}u", e.registers.faults);
  constants(s, "Numbers that fields and words refer to.", "", "{}", e.registers.constants);
  constants(s, "Of the link's format.", "LINK_FORMAT_", "{}", e.registers.link_constants);
  s << "\n#endif\n";
  return s.str();
}

std::string c_header(const Elaborated& e) {
  const Design& d = e.design;
  std::ostringstream s;
  s << generated_banner("rtl/designs/" + d.name + ".toml and rtl/registers.toml", "")
    << "// The design " << d.name << " for C99 and C++: values, formats, what a reset leaves.\n"
    << "#ifndef FELTGATE_H\n#define FELTGATE_H\n\n#include \"feltgate_map.h\"\n"
    << "\n/* The design. */\n"
    << "#define FELTGATE_DESIGN_NAME \"" << d.name << "\"\n"
    << "#define FELTGATE_CLOCK_HZ " << d.clock_hz << "\n#define FELTGATE_TICK_HZ " << d.tick_hz
    << "\n#define FELTGATE_PWM_PERIOD " << d.pwm_period_clocks() << comment("[clock]")
    << "#define FELTGATE_COUNT_RAD " << real_literal(d.count_rad())
    << comment("one count; an angle in rad / FELTGATE_COUNT_RAD is in counts")
    << "#define FELTGATE_SUPPLY_V " << real_literal(d.full_duty_v()) << "\n"
    << "\n/* NAME_WORD(value) is the word of a value in its unit, NAME_VALUE(word) the value of a "
       "word, NAME_DEFAULT\n   and NAME_RESET what configuration leaves there. Units: "
       "feltgate_map.h. */\n";
  for (const HostWord& w : host_words(e)) {
    if (of_option(e, w)) word(s, w);
    if (w.number) conversions(s, w);
    if (w.name == "control") {
      s << fmt::format("\n#define FELTGATE_CONTROL_RESET 0x{:08x}u\n",
                       static_cast<std::uint32_t>(w.reset));
    }
  }
  for (const HostWord& w : link_host_words(e.registers)) {
    if (w.number) conversions(s, w);
  }
  s << "\n#endif\n";
  return s.str();
}

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

void rdl_field(std::ostringstream& s, const HostWord& w, const Field& f, bool number) {
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

void rdl_word(std::ostringstream& s, const HostWord& w) {
  s << "  reg {\n    desc = " << quoted(w.doc) << ";\n";
  for (const Field& f : w.fields) rdl_field(s, w, f, false);
  if (w.fields.empty()) {
    Field value;
    value.name = "value";
    value.width = w.number ? w.format.width() : 32;
    value.doc = w.doc;
    rdl_field(s, w, value, w.number);
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
  for (const HostWord& w : link_host_words(e.registers)) rdl_word(s, w);
  s << "};\n\n"
    << "addrmap feltgate {\n  name = " << quoted("feltgate, design " + e.design.name) << ";\n"
    << "  desc = " << quoted(e.design.description + ". Addresses in bytes; each word has 32 bits.")
    << ";\n  default regwidth = 32;\n  default accesswidth = 32;\n\n";
  for (const HostWord& w : host_words(e)) rdl_word(s, w);
  s << "};\n";
  return s.str();
}

}  // namespace feltgate::design
