// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Generates the addresses, bits and numbers of the host's link: package, header, and its part of
// the register page. Documentation: docs/link.md
#include <fmt/format.h>

#include <algorithm>
#include <sstream>
#include <vector>

#include "design/generate.hpp"
#include "design/text_edit.hpp"
#include "feltgate/crc32.hpp"

namespace feltgate::design {

namespace {

/// The words of the snapshot in the order of their slots.
std::vector<Snapshot> by_slot(const RegisterMap& map) {
  std::vector<Snapshot> words = map.snapshots;
  std::sort(words.begin(), words.end(),
            [](const Snapshot& a, const Snapshot& b) { return a.slot < b.slot; });
  return words;
}

}  // namespace

std::string link_package(const RegisterMap& map) {
  std::ostringstream s;
  s << generated_banner("rtl/registers.toml", "Addresses, bits and numbers of the host's link.")
    << "\n`default_nettype none\n\n"
    << "/* verilator lint_off UNUSEDPARAM */  // a block uses the constants that concern it\n"
    << "package feltgate_link_pkg;\n";
  for (const Cause& c : map.link_constants) {
    s << fmt::format("  localparam int {} = 'h{:x};  // {}\n", upper(c.name), c.number, c.doc);
  }
  s << fmt::format(
      "\n  // The CRC-32 of a frame: reflected polynomial, register after a whole frame.\n"
      "  localparam logic [31:0] CRC_POLYNOMIAL = 32'h{:08x};\n"
      "  localparam logic [31:0] CRC_GOOD = 32'h{:08x};\n",
      crc32_polynomial, crc32_good);
  s << "\n  // Addresses of the words; bits (B) and widths (W) of their fields.\n";
  for (const LinkWord& w : map.link_words) {
    s << fmt::format("  localparam logic [15:0] A_{} = 16'h{:04x};\n", upper(w.name), w.address);
    for (const Field& f : w.fields) {
      const std::string name = upper(w.name + "_" + f.name);
      s << fmt::format("  localparam int B_{} = {};\n", name, f.bit);
      if (f.width > 1) s << fmt::format("  localparam int W_{} = {};\n", name, f.width);
    }
  }
  const std::vector<Snapshot> words = by_slot(map);
  s << "\n  // The snapshot's words by number, in the order of their slots.\n"
    << fmt::format("  localparam int SNAPSHOT_WORDS = {};\n", words.size())
    << fmt::format("  localparam logic [5:0] FIRST_SLOT = 6'd{};\n", words.front().slot);
  for (std::size_t n = 0; n < words.size(); ++n) {
    s << fmt::format("  localparam int N_{} = {};\n", upper(words[n].name), n);
  }
  s << "endpackage\n/* verilator lint_on UNUSEDPARAM */\n\n`default_nettype wire\n";
  return s.str();
}

std::string link_header(const RegisterMap& map) {
  std::ostringstream s;
  s << generated_banner("rtl/registers.toml", "") << "#pragma once\n\n#include <cstdint>\n"
    << "#include <string_view>\n\nnamespace feltgate {\n\n"
    << "/// A word of the host's link.\nstruct LinkWord {\n  std::string_view name;\n"
    << "  std::uint16_t address;\n  bool writable;\n};\n\n"
    << "/// Addresses, bits and numbers of the host's link.\nstruct LinkMap {\n";
  for (const Cause& c : map.link_constants) {
    s << fmt::format("  static constexpr std::uint32_t {} = 0x{:x};  ///< {}\n", c.name, c.number,
                     c.doc);
  }
  s << "\n  /// Addresses.\n  struct A {\n";
  for (const LinkWord& w : map.link_words) {
    s << fmt::format("    static constexpr std::uint16_t {} = 0x{:04x};\n", w.name, w.address);
  }
  s << "  };\n\n  /// Bits of the words' fields, and their widths.\n  struct B {\n";
  for (const LinkWord& w : map.link_words) {
    for (const Field& f : w.fields) {
      s << fmt::format("    static constexpr int {}_{} = {};\n", w.name, f.name, f.bit);
      if (f.width > 1) {
        s << fmt::format("    static constexpr int {}_{}_width = {};\n", w.name, f.name, f.width);
      }
    }
  }
  s << "  };\n\n  /// The snapshot's words by number, in the order of their slots.\n  struct N {\n";
  const std::vector<Snapshot> words = by_slot(map);
  for (std::size_t n = 0; n < words.size(); ++n) {
    s << fmt::format("    static constexpr int {} = {};\n", words[n].name, n);
  }
  s << "  };\n"
    << fmt::format("  static constexpr int snapshot_words = {};\n", words.size())
    << "  static constexpr int slots[] = {";
  for (std::size_t n = 0; n < words.size(); ++n) s << (n > 0 ? ", " : "") << words[n].slot;
  s << "};\n\n  static constexpr LinkWord all[] = {\n";
  for (const LinkWord& w : map.link_words) {
    s << fmt::format("      {{\"{}\", A::{}, {}}},\n", w.name, w.name, w.writable);
  }
  s << "  };\n};\n\n}  // namespace feltgate\n";
  return s.str();
}

std::string link_tables(const RegisterMap& map) {
  std::ostringstream s;
  s << "\n## Link\n\nWhere the [host's link](link.md) is built, it has words of its own beside "
       "these.\n\n| address | name | bits | host | meaning |\n|---|---|---|---|---|\n";
  for (const LinkWord& w : map.link_words) {
    s << fmt::format("| 0x{:04x} | `{}` | 31:0 | {} | {} |\n", w.address, w.name,
                     w.writable ? "reads, writes" : "reads", w.doc);
    for (const Field& f : w.fields) {
      s << fmt::format("| 0x{:04x} | `{}.{}` | {} | | {} |\n", w.address, w.name, f.name,
                       bits_text(f), f.doc);
    }
  }
  s << "\n### Numbers of the link\n\n| name | value | meaning |\n|---|---|---|\n";
  for (const Cause& c : map.link_constants) {
    s << fmt::format("| `{}` | {:#x} | {} |\n", c.name, c.number, c.doc);
  }
  return s.str();
}

}  // namespace feltgate::design
