// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Generates the package and the header that all designs share: addresses, bits and numbers.
// Documentation: docs/designs.md
#include <fmt/format.h>

#include <algorithm>
#include <sstream>
#include <vector>

#include "design/generate.hpp"
#include "design/text_edit.hpp"
#include "feltgate/crc32.hpp"

namespace feltgate::design {

namespace {

/// Mask of the common words whose write has `effect` while the motor is armed: bit n is word n.
std::uint64_t words_that(const RegisterMap& map, const std::string& effect) {
  std::uint64_t mask = 0;
  for (const Parameter& p : map.parameters) {
    if (p.scene.empty() && p.while_armed == effect) mask |= std::uint64_t{1} << p.address;
  }
  return mask;
}
/// Mask of the scenes whose words act at once: bit n is scene n.
unsigned input_scenes(const RegisterMap& map) {
  unsigned mask = 0;
  for (const Parameter& p : map.parameters) {
    if (!p.scene.empty() && p.while_armed == "acts") mask |= 1U << map.scene_number(p.scene);
  }
  return mask;
}

void fields_sv(std::ostringstream& s, const std::string& word, const std::vector<Field>& fields) {
  for (const Field& f : fields) {
    s << "  localparam int B_" << upper(word + "_" + f.name) << " = " << f.bit << ";\n";
    if (f.width > 1) {
      s << "  localparam int W_" << upper(word + "_" + f.name) << " = " << f.width << ";\n";
    }
  }
}

/// Number of bits up to the highest bit of any field.
int used_bits(const std::vector<Field>& fields) {
  int bits = 0;
  for (const Field& f : fields) bits = std::max(bits, f.bit + f.width);
  return bits;
}

void fields_cpp(std::ostringstream& s, const std::string& word, const std::vector<Field>& fields) {
  for (const Field& f : fields) {
    s << "    static constexpr int " << word << "_" << f.name << " = " << f.bit << ";\n";
    if (f.width > 1) {
      s << "    static constexpr int " << word << "_" << f.name << "_width = " << f.width << ";\n";
    }
  }
}

void masks_sv(std::ostringstream& s, const RegisterMap& map) {
  s << fmt::format(
      "  // While armed: words of all scenes that are refused or ramp, by address; scenes whose "
      "words "
      "act at once.\n"
      "  localparam logic [63:0] REFUSED_WHILE_ARMED = 64'h{:016x};\n"
      "  localparam logic [63:0] RAMPS_WHILE_ARMED = 64'h{:016x};\n"
      "  localparam logic [15:0] INPUT_SCENES = 16'h{:04x};\n",
      words_that(map, "refused"), words_that(map, "ramps"), input_scenes(map));
  for (const Cause& c : map.constants) {
    s << "  localparam int " << upper(c.name) << " = " << c.number << ";  // " << c.doc << "\n";
  }
}

/// Numbers of scenes, limits and faults, control words, fields.
void numbers_sv(std::ostringstream& s, const RegisterMap& map) {
  s << "\n  // Scene numbers.\n";
  for (const Scene& scene : map.scenes) {
    s << "  localparam logic [3:0] SCENE_" << upper(scene.name) << " = 4'd" << scene.number
      << ";\n";
  }
  s << "\n  // Addresses of the control words and of the snapshot's first; bits (B) and widths (W) "
       "of the\n"
       "  // words' fields.\n"
    << fmt::format("  localparam logic [11:0] A_SNAPSHOT = 12'h{:03x};\n", snapshot_base);
  for (const Control& c : map.controls) {
    s << fmt::format("  localparam logic [11:0] A_{} = 12'h{:03x};\n", upper(c.name), c.address);
    s << "  localparam int W_" << upper(c.name) << " = " << used_bits(c.fields) << ";\n";
    fields_sv(s, c.name, c.fields);
  }
  for (const Snapshot& n : map.snapshots) fields_sv(s, n.name, n.fields);
  s << "\n  // Bits of the limits.\n";
  for (const Cause& c : map.limits) {
    s << "  localparam int L_" << upper(c.name) << " = " << c.number << ";  // " << c.doc << "\n";
  }
  s << "\n  // Causes of fault: numbers of the first fault, and bits of the faults.\n"
    << "  localparam int FAULT_NONE = 0;\n";
  for (const Cause& c : map.faults) {
    s << "  localparam int FAULT_" << upper(c.name) << " = " << c.number << ";  // " << c.doc
      << "\n";
  }
}

}  // namespace

std::string map_package(const RegisterMap& map) {
  std::ostringstream s;
  s << generated_banner("rtl/registers.toml", "Addresses, bits, numbers of all designs.")
    << "\n`default_nettype none\n\n"
    << "/* verilator lint_off UNUSEDPARAM */  // a block uses the constants that concern it\n"
    << "package map;\n";
  masks_sv(s, map);
  s << "\n  // Places of the snapshot's words, from A_SNAPSHOT on.\n";
  for (const Snapshot& n : map.snapshots) {
    s << fmt::format("  localparam logic [5:0] S_{} = 6'd{};\n", upper(n.name), n.slot);
  }
  s << "\n  // Addresses of the parameters.\n";
  for (const Parameter& p : map.parameters) {
    s << fmt::format("  localparam logic [11:0] A_{} = 12'h{:03x};\n", upper(p.name), p.address);
  }
  numbers_sv(s, map);
  s << "endpackage\n/* verilator lint_on UNUSEDPARAM */\n\n`default_nettype wire\n";
  return s.str();
}

std::string map_header(const RegisterMap& map) {
  std::ostringstream s;
  s << generated_banner("rtl/registers.toml", "") << "#pragma once\n\n#include <cstdint>\n"
    << "#include <string_view>\n\nnamespace feltgate {\n\n"
    << "/// Addresses, bits and numbers of all designs.\nstruct Map {\n"
    << "  /// While armed: words of all scenes that are refused or ramp, by address; scenes whose\n"
       "  /// words act at once.\n"
    << fmt::format(
           "  static constexpr std::uint64_t refused_while_armed = 0x{:x};\n"
           "  static constexpr std::uint64_t ramps_while_armed = 0x{:x};\n"
           "  static constexpr unsigned input_scenes = 0x{:x};\n",
           words_that(map, "refused"), words_that(map, "ramps"), input_scenes(map));
  for (const Cause& c : map.constants) {
    s << "  static constexpr int " << c.name << " = " << c.number << ";  ///< " << c.doc << "\n";
  }
  s << "\n  /// Places of the snapshot's words, from C::snapshot on.\n  struct R {\n";
  for (const Snapshot& n : map.snapshots) {
    s << "    static constexpr int " << n.name << " = " << n.slot << ";\n";
  }
  s << "  };\n\n  /// Addresses of the parameters.\n  struct A {\n";
  for (const Parameter& p : map.parameters) {
    s << "    static constexpr int " << p.name << " = " << p.address << ";\n";
  }
  s << "  };\n\n  /// Scene numbers.\n  struct S {\n";
  for (const Scene& scene : map.scenes) {
    s << "    static constexpr int " << scene.name << " = " << scene.number << ";\n";
  }
  s << "  };\n  /// Number of a scene by name, -1 when there is none.\n"
    << "  static constexpr int scene_number(std::string_view scene) {\n";
  for (const Scene& scene : map.scenes) {
    s << "    if (scene == \"" << scene.name << "\") return " << scene.number << ";\n";
  }
  s << "    return -1;\n  }\n  /// All of them, built or not, in the order of their numbers.\n"
    << "  static constexpr std::string_view scene_names[] = {";
  for (const Scene& scene : map.scenes) {
    s << (&scene == &map.scenes.front() ? "" : ",") << "\n      \"" << scene.name << "\"";
  }
  s << "};\n\n  /// Addresses of control and snapshot words, and bits of the words' fields.\n"
    << "  struct C {\n"
    << "    static constexpr int snapshot = " << snapshot_base << ";\n";
  for (const Control& c : map.controls) {
    s << "    static constexpr int " << c.name << " = " << c.address << ";\n"
      << "    static constexpr int " << c.name << "_width = " << used_bits(c.fields) << ";\n";
    fields_cpp(s, c.name, c.fields);
  }
  for (const Snapshot& n : map.snapshots) {
    s << "    static constexpr int read_" << n.name << " = " << snapshot_base + n.slot << ";\n";
    fields_cpp(s, n.name, n.fields);
  }
  s << "  };\n\n  /// Bits of the limits.\n  struct L {\n";
  for (const Cause& c : map.limits) {
    s << "    static constexpr int " << c.name << " = " << c.number << ";\n";
  }
  s << "  };\n};\n\n}  // namespace feltgate\n";
  return s.str();
}

std::string causes_header(const RegisterMap& map) {
  std::ostringstream s;
  s << generated_banner("rtl/registers.toml", "What holds the torque back and what closes the")
    << "// gates, by bit and by name.\n"
    << "#pragma once\n\n#include <array>\n#include <cstdint>\n\nnamespace feltgate {\n\n"
    << "/// Bits of Snapshot::limits: which limit holds the torque now.\nnamespace limit {\n";
  for (const Cause& c : map.limits) {
    s << "constexpr unsigned " << c.name << " = " << (1 << c.number) << ";  ///< " << c.doc << "\n";
  }
  s << "/// By the number of the bit.\ninline constexpr std::array<const char*, "
    << map.limits.size() << "> names{";
  for (const Cause& c : map.limits) {
    s << (&c == &map.limits.front() ? "" : ",") << "\n    \"" << c.name << "\"";
  }
  s << "};\n}  // namespace limit\n\n"
    << "/// Numbers of the causes, as in first_fault and as bits of faults.\n"
    << "enum class Fault : std::uint8_t {\n  none = 0,\n";
  for (const Cause& c : map.faults) {
    s << "  " << c.name << " = " << c.number << ",  ///< " << c.doc << "\n";
  }
  s << "};\n/// Its bit of faults.\nconstexpr std::uint16_t fault_bit(Fault cause) {\n"
    << "  return static_cast<std::uint16_t>(1U << static_cast<unsigned>(cause));\n}\n"
    << "/// By the number of the cause.\ninline constexpr std::array<const char*, "
    << map.faults.size() + 1 << "> fault_names{\n    \"none\"";
  for (const Cause& c : map.faults) s << ",\n    \"" << c.name << "\"";
  s << "};\n\n}  // namespace feltgate\n";
  return s.str();
}

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
