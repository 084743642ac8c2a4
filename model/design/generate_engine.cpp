// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Generates package, header and page from rtl/engine/engine.toml. Documentation: docs/engine-isa.md
#include <fmt/format.h>

#include <sstream>

#include "design/engine_map.hpp"
#include "design/generate.hpp"
#include "design/text_edit.hpp"

namespace feltgate::design {

namespace {

constexpr const char* kSource = "rtl/engine/engine.toml";

void engine_fields_sv(std::ostringstream& s, const std::string& name, const Field& f) {
  s << fmt::format("  localparam int B_{} = {};\n", upper(name), f.bit);
  if (f.width > 1) s << fmt::format("  localparam int W_{} = {};\n", upper(name), f.width);
}

void engine_fields_sv(std::ostringstream& s, const std::string& prefix,
                      const std::vector<Field>& fields) {
  for (const Field& f : fields) engine_fields_sv(s, prefix + f.name, f);
}

void engine_fields_cpp(std::ostringstream& s, const std::string& prefix,
                       const std::vector<Field>& fields) {
  for (const Field& f : fields) {
    s << fmt::format("    static constexpr int {}{} = {};  ///< {}\n", prefix, f.name, f.bit, f.doc)
      << fmt::format("    static constexpr int {}{}_width = {};\n", prefix, f.name, f.width);
  }
}

std::string range_text(const EngineWords& w, const char* format) {
  const std::string first = fmt::format(fmt::runtime(format), w.first);
  if (w.words == 1) return first;
  return first + " to " + fmt::format(fmt::runtime(format), w.first + w.words - 1);
}

}  // namespace

std::string engine_package(const EngineDescription& e) {
  std::ostringstream s;
  s << generated_banner(kSource, "Numbers, instructions and addresses of the engine.")
    << "\n`default_nettype none\n\n"
    << "/* verilator lint_off UNUSEDPARAM */  // a block uses the constants that concern it\n"
    << "package feltgate_engine_pkg;\n";
  for (const Cause& c : e.constants) {
    s << fmt::format("  localparam int {} = {};  // {}\n", upper(c.name), c.number, c.doc);
  }
  s << "\n  // Shifts of a product, by the field mode.\n";
  for (std::size_t n = 0; n < e.shifts.size(); ++n) {
    s << fmt::format("  localparam int SHIFT_{} = {};\n", n, e.shifts[n]);
  }
  s << "\n  // Bits (B) and widths (W) of a program word's fields.\n";
  engine_fields_sv(s, "", e.fields);
  s << "\n  // Instructions.\n";
  for (const Cause& c : e.ops) {
    s << fmt::format("  localparam logic [3:0] OP_{} = 4'd{};\n", upper(c.name), c.number);
  }
  s << "\n  // First data words of the regions.\n";
  for (const EngineWords& w : e.regions) {
    s << fmt::format("  localparam logic [8:0] D_{} = 9'd{};\n", upper(w.name), w.first);
  }
  s << "\n  // Addresses of the host, and bits of what is there.\n";
  for (const EngineWords& w : e.host) {
    s << fmt::format("  localparam logic [11:0] H_{} = 12'h{:03x};\n", upper(w.name), w.first);
    engine_fields_sv(s, w.name + "_", w.fields);
  }
  s << "\n  // What the engine's words hold after a reset: fields, and an engine that waits for a "
       "host.\n";
  int bits = 0;
  std::string parts;
  for (const EngineResetField& w : e.reset) {
    engine_fields_sv(s, "reset_" + w.field.name, w.field);
    bits = w.field.bit + w.field.width;
    parts = fmt::format("{}'d{}", w.field.width, w.value) + (parts.empty() ? "" : ", ") + parts;
  }
  s << fmt::format("  localparam int RESET_BITS = {};\n", bits)
    << fmt::format("  localparam logic [{}:0] RESET_EMPTY = {{{}}};\n", bits - 1, parts);
  s << "endpackage\n/* verilator lint_on UNUSEDPARAM */\n\n`default_nettype wire\n";
  return s.str();
}

std::string engine_header(const EngineDescription& e) {
  std::ostringstream s;
  s << generated_banner(kSource, "") << "#pragma once\n\n#include <cstdint>\n"
    << "#include <string_view>\n\nnamespace feltgate {\n\n"
    << "/// Instructions of the engine. x, y: the data words at a and b; yf: y's low 18 bits,\n"
    << "/// signed; acc: the result before. docs/engine-isa.md\n"
    << "enum class EngineOp : std::uint8_t {\n";
  for (const Cause& c : e.ops) s << fmt::format("  {},  ///< {}\n", c.name, c.doc);
  s << "};\n\n/// Numbers, fields and addresses of the engine.\nstruct EngineMap {\n";
  for (const Cause& c : e.constants) {
    s << fmt::format("  static constexpr int {} = {};  ///< {}\n", c.name, c.number, c.doc);
  }
  s << "  static constexpr int shifts[] = {";
  for (std::size_t n = 0; n < e.shifts.size(); ++n) s << (n > 0 ? ", " : "") << e.shifts[n];
  s << "};  ///< of a product, by the field mode\n"
    << "  static constexpr std::string_view op_names[] = {\n     ";
  for (const Cause& c : e.ops) s << fmt::format(" \"{}\",", c.name);
  s << "};\n\n  /// Lowest bits of a program word's fields, and their widths.\n  struct B {\n";
  engine_fields_cpp(s, "", e.fields);
  s << "  };\n\n  /// First data words of the regions.\n  struct D {\n";
  for (const EngineWords& w : e.regions) {
    s << fmt::format("    static constexpr int {} = {};\n", w.name, w.first);
  }
  s << "  };\n\n  /// Addresses of the host.\n  struct H {\n";
  for (const EngineWords& w : e.host) {
    s << fmt::format("    static constexpr int {} = 0x{:03x};\n", w.name, w.first);
  }
  s << "  };\n\n  /// Bits of the host's words.\n  struct S {\n";
  for (const EngineWords& w : e.host) engine_fields_cpp(s, w.name + "_", w.fields);
  s << "  };\n};\n\n/// What the engine's words hold after a reset.\nstruct EngineReset {\n";
  for (const EngineResetField& w : e.reset) {
    s << fmt::format("  unsigned {} = {};  ///< {}\n", w.field.name, w.value, w.field.doc);
  }
  s << "\n  /// Calls `visit(value, width)` for each, from the lowest bit of the RTL's parameter "
       "on.\n"
       "  template <class Visit>\n  void for_each(Visit&& visit) const {\n";
  for (const EngineResetField& w : e.reset) {
    s << fmt::format("    visit({}, {});\n", w.field.name, w.field.width);
  }
  s << "  }\n};\n\n}  // namespace feltgate\n";
  return s.str();
}

std::string engine_page(const EngineDescription& e) {
  std::ostringstream s;
  s << "# Engine: instructions and memories\n\nGenerated from "
       "[rtl/engine/engine.toml](../rtl/engine/engine.toml) by `feltgate generate`: do not edit. "
       "The block:\n[engine](blocks/engine.md). Exact semantics in C++:\n"
       "[engine_ops.hpp](../model/include/feltgate/engine_ops.hpp).\n\n"
       "## Program word\n\n| bits | field | meaning |\n|---|---|---|\n";
  for (const Field& f : e.fields) {
    s << fmt::format("| {} | `{}` | {} |\n", bits_text(f), f.name, f.doc);
  }
  s << "\n## Instructions\n\nx, y: the data words at a and b; yf: the low 18 bits of y, signed; "
       "acc: the result before, 0 in a run's first instruction.\nA run's first flag is 0, in the "
       "first run after reset, arming, a write of `run` or entry into the scene 1. sat: to the "
       "nearest in 32 "
       "bits, wrap: the low 32 bits,\nround(v >> s) = floor((v + 2^(s-1)) / 2^s), s: ";
  for (std::size_t n = 0; n < e.shifts.size(); ++n) {
    s << (n > 0 ? ", " : "") << e.shifts[n];
  }
  s << " in mode 0 to 3.\n\n| op | name | result |\n|---|---|---|\n";
  for (const Cause& c : e.ops) s << fmt::format("| {} | `{}` | {} |\n", c.number, c.name, c.doc);
  s << "\n## Data memory\n\n| words | region | meaning |\n|---|---|---|\n";
  for (const EngineWords& w : e.regions) {
    s << fmt::format("| {} | {} | {} |\n", range_text(w, "{}"), w.name, w.doc);
  }
  s << "\n## Host\n\n| address | name | bits | host | meaning |\n|---|---|---|---|---|\n";
  for (const EngineWords& w : e.host) {
    s << fmt::format("| {} | `{}` | | {} | {} |\n", range_text(w, "{:#05x}"), w.name,
                     w.access == "write"  ? "reads, writes"
                     : w.access == "read" ? "reads"
                                          : "writes",
                     w.doc);
    for (const Field& f : w.fields) {
      s << fmt::format("| {} | `{}.{}` | {} | | {} |\n", range_text(w, "{:#05x}"), w.name, f.name,
                       bits_text(f), f.doc);
    }
  }
  s << "\n## After a reset\n\nFields of the parameter `Reset` of "
       "[engine](blocks/engine.md#host).\n\n"
       "| bits | name | by default | meaning |\n|---|---|---|---|\n";
  for (const EngineResetField& w : e.reset) {
    s << fmt::format("| {} | `{}` | {} | {} |\n", bits_text(w.field), w.field.name, w.value,
                     w.field.doc);
  }
  s << "\n## Numbers\n\n| name | value | meaning |\n|---|---|---|\n";
  for (const Cause& c : e.constants) {
    s << fmt::format("| `{}` | {} | {} |\n", c.name, c.number, c.doc);
  }
  return s.str();
}

}  // namespace feltgate::design
