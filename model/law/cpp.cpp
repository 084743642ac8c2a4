// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Documentation: docs/law-compiler.md
#include "law/cpp.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "law/units.hpp"

namespace feltgate::law {

namespace {

/// Escapes a text for a string literal: a file's name may contain any byte.
std::string escaped(const std::string& text) {
  std::string s;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\') s += '\\';
    // An octal escape ends after three digits, whatever follows.
    s += byte < 0x20 || byte == 0x7f ? fmt::format("\\{:03o}", byte) : std::string(1, c);
  }
  return s;
}

/// Makes a text safe for a comment of one line.
std::string in_comment(std::string text) {
  for (char& c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte < 0x20 || byte == 0x7f) c = '?';
  }
  // A trailing backslash would continue the comment on the next line.
  if (!text.empty() && text.back() == '\\') text.back() = '/';
  return text;
}

const char* constant_text(bool value) { return value ? "true" : "false"; }

class Header {
 public:
  Header(const Compiled& c, const std::string& source, const std::string& space)
      : c_(c), law_(c.law), source_(source), space_(space), class_(cpp_class(law_.name)) {}

  std::string run() {
    std::string s = fmt::format(
        "// SPDX-License-Identifier: Apache-2.0\n"
        "//\n// Generated from {}\n// by `feltgate law`: do not edit.\n"
        "#pragma once\n\n#include <array>\n#include <cstddef>\n#include <cstdint>\n\n"
        "#include \"feltgate/law_ops.hpp\"\n\n"
        "namespace feltgate::{} {{\n\n{}template <class N>\nclass {} {{\n public:\n",
        in_comment(source_), space_, about(), class_);
    s += facts() + functions() + members();
    return s + "};\n\n}  // namespace feltgate::" + space_ + "\n";
  }

 private:
  // The comment that describes the law.

  std::string about() const {
    const auto count = static_cast<int>(c_.assembled.instructions.size());
    std::string s = fmt::format(
        "/// {}\n///\n/// For design {}: {} instructions, {} clocks from start to start, {:.9g} "
        "Hz.\n",
        in_comment(law_.summary.empty() ? law_.name : law_.summary), c_.target.design, count,
        engine_period(count, c_.target.axes), c_.rate_hz);
    for (std::size_t o = 0; o < law_.outputs.size(); ++o) {
      s += fmt::format("/// Torque of axis {}: proven within {:.3g} Nm of the law{}.\n",
                       law_.outputs[o].axis, c_.bound.output[o],
                       c_.bound.strips.empty() ? "" : ", but in strips");
    }
    for (const Strip& strip : c_.bound.strips) {
      s += fmt::format(
          "/// Strip: line {}, within {:.3g} {} of equal a comparison may go either way.\n",
          strip.place.line, strip.width, text_of(strip.unit));
    }
    return s;
  }

  std::string facts() const {
    std::string s = fmt::format(
        "  static constexpr const char* name = \"{}\";\n"
        "  static constexpr const char* design = \"{}\";\n"
        "  /// CRC-32 of the image that an engine runs for this.\n"
        "  static constexpr std::uint32_t image_crc = 0x{:08x};\n"
        "  static constexpr int instructions = {};\n"
        "  static constexpr int ticks_per_run = {};\n\n",
        escaped(law_.name), c_.target.design, crc(c_.image), c_.assembled.instructions.size(),
        c_.divider);
    s += list("LawInput", "inputs", law_.inputs.size());
    for (std::size_t i = 0; i < law_.inputs.size(); ++i) {
      const Input& in = law_.inputs[i];
      s += fmt::format("      {{\"{}\", {}, {}, {}}},\n", in.name, in.axis,
                       static_cast<int>(in.source), cpp_number(scale(in)));
    }
    s += "  }};\n" + list("LawWord", "words", c_.image.words.size());
    for (const ImageWord& w : c_.image.words) {
      s += fmt::format("      {{\"{}\", \"{}\", {}, {}, {}, {}, {}, {}, {}}},\n", w.name, w.unit,
                       cpp_number(w.scale), cpp_number(w.to_si), w.lower, w.upper, w.initial,
                       constant_text(!w.formula.empty()), w.word);
    }
    s += "  }};\n" + list("LawOutput", "outputs", law_.outputs.size());
    for (std::size_t i = 0; i < law_.outputs.size(); ++i) {
      s += fmt::format(
          "      {{\"{}\", {}, {}, {}}},\n", law_.outputs[i].name, law_.outputs[i].axis,
          cpp_number(std::ldexp(1.0, -c_.target.torque.fraction)), cpp_number(c_.bound.output[i]));
    }
    s += "  }};\n" + list("LawEvent", "events", c_.image.events.size());
    for (const ImageEvent& e : c_.image.events) {
      s += fmt::format("      {{\"{}\", {}, {}}},\n", e.name, e.number, cpp_number(e.scale));
    }
    return s + fmt::format(
                   "  }}}};\n  /// Words that are parameters themselves.\n"
                   "  static constexpr std::size_t parameters = {};\n\n",
                   primaries());
  }

  static std::string list(const char* type, const char* name, std::size_t size) {
    return fmt::format("  static constexpr std::array<law::{}, {}> {}{{{{\n", type, size, name);
  }

  std::string functions() const {
    const bool none = c_.image.words.empty();
    std::string s = fmt::format(
        "  using O = law::LawOps<N>;\n"
        "  using Word = typename O::Word;\n"
        "  /// Words of what it is given, as `inputs` lists them.\n"
        "  using Inputs = std::array<Word, inputs.size()>;\n"
        "  /// What may happen in a run, as `events` lists it.\n"
        "  using Events = std::array<law::LawHappened<Word>, events.size()>;\n\n"
        "  {}() {{\n"
        "    for (std::size_t n = 0; n < words.size(); ++n) set_word(n, words[n].initial);\n"
        "    if constexpr (!N::is_fixed) {{\n"
        "      std::array<double, parameters> values{{}};\n"
        "      std::size_t next = 0;\n"
        "      for (const law::LawWord& w : words) {{\n"
        "        if (!w.derived) values[next++] = w.initial * w.scale;\n"
        "      }}\n"
        "      set_values(values);\n"
        "    }}\n"
        "  }}\n\n"
        "  /// The next run is the first: states begin at their initial values, lines with zeros.\n"
        "  void enter() {{{} first_ = true; }}\n"
        "  /// A word of `words` as the host writes it.\n"
        "  void set_word(std::size_t n, std::int32_t w) {{ word_[n] = O::word(w); }}\n"
        "  /// All parameters, in SI, in the order of those `words` that are not derived. In "
        "fixed\n"
        "  /// point they are rounded and limited to their ranges.\n"
        "  template <class T>\n"
        "  void set_values(const std::array<T, parameters>& values) {{\n"
        "    if constexpr (N::is_fixed) {{\n"
        "      std::array<double, parameters> si{{}};\n"
        "      for (std::size_t n = 0; n < parameters; ++n) si[n] = "
        "static_cast<double>(values[n]);\n"
        "      const auto w = law::law_words<{}>(si);\n"
        "      for (std::size_t n = 0; n < w.size(); ++n) set_word(n, w[n]);\n"
        "    }} else {{\n"
        "      std::array<Word, parameters> si{{}};\n"
        "      for (std::size_t n = 0; n < parameters; ++n) si[n] = static_cast<Word>(values[n]);\n"
        "      word_ = words_of(si);\n"
        "    }}\n"
        "  }}\n"
        "  /// The words of all for values in SI, not rounded.\n"
        "  template <class T>\n"
        "  static std::array<T, words.size()> words_of(const std::array<T, parameters>&{}) {{\n"
        "    return {{{{\n",
        class_, has_lines() ? " lines_.clear();" : "", class_, none ? "" : " value");
    std::map<std::string, std::string> names;
    std::size_t next = 0;
    for (const ImageWord& w : c_.image.words) {
      if (w.formula.empty()) names[w.name] = fmt::format("value[{}]", next++);
    }
    for (const ImageWord& w : c_.image.words) {
      const std::string value = w.formula.empty() ? names[w.name] : cpp_formula(w.formula, names);
      s += fmt::format("        {} / T({}),\n", value, cpp_number(w.scale));
    }
    s += "    }};\n  }\n\n";
    s += "  /// A run.\n  void run(const Inputs&" + std::string(law_.inputs.empty() ? "" : " in") +
         ") {\n" + cpp_body(c_) + "  }\n\n";
    return s +
           "  /// Of the last run that wrote it: word of the torque of an axis.\n"
           "  const Word& output(std::size_t axis) const { return out_[axis]; }\n"
           "  /// Of the last run.\n"
           "  const Events& happened() const { return happened_; }\n\n";
  }

  std::string members() const {
    std::string s = " private:\n" + cpp_functions(c_) + table();
    s += "  bool first_ = true;\n";
    s += "  std::array<Word, words.size()> word_{};\n  std::array<Word, 3> out_{};\n";
    s += "  Events happened_{};\n";
    for (std::size_t k = 0; k < c_.program.states.size(); ++k) {
      if (c_.program.states[k].next.from == From::none) continue;
      s += fmt::format("  Word {}_{{}};{}\n", cpp_state(law_, static_cast<int>(k)), state_note(k));
    }
    if (has_lines()) s += fmt::format("  law::LawLines<N, {}> lines_{{}};\n", c_.image.line_base);
    return s;
  }

  std::string state_note(std::size_t k) const {
    if (k >= law_.states.size()) return {};
    const State& s = law_.states[k];
    return fmt::format("  ///< {:.6g} .. {:.6g} {}, step {:.3g}", s.range.lower, s.range.upper,
                       text_of(s.unit), c_.program.states[k].scale);
  }

  std::string table() const {
    std::size_t size = 0;
    for (const TableUse& t : c_.program.tables) {
      if (t.line < 0) size = std::max(size, at(t.base) + t.words.size());
    }
    if (c_.program.tables.empty()) return {};
    std::string s;
    for (const TableUse& t : c_.program.tables) {
      if (t.line >= 0) continue;
      s += fmt::format("  /// Words {} to {}: {}; error {:.3g} of the last bit: {}\n", t.base,
                       at(t.base) + t.words.size() - 1, t.what, t.error, t.proof);
    }
    s += fmt::format("  static constexpr std::array<law::LawSegment, {}> table{{{{", size);
    for (std::size_t n = 0; n < size; ++n) {
      const std::uint64_t w = c_.image.table[n];
      s += fmt::format("{}{{{}, {}}},", n % 6 == 0 ? "\n      " : " ", engine_table_value(w),
                       engine_table_slope(w));
    }
    return s + "\n  }};\n\n";
  }

  double scale(const Input& in) const {
    return in.source == Source::position   ? c_.target.count_rad()
           : in.source == Source::velocity ? std::ldexp(1.0, -c_.target.velocity.fraction)
                                           : std::ldexp(1.0, -c_.target.torque.fraction);
  }
  std::size_t primaries() const {
    std::size_t n = 0;
    for (const ImageWord& w : c_.image.words) n += w.formula.empty() ? 1 : 0;
    return n;
  }
  bool has_lines() const { return !law_.lines.empty(); }

  const Compiled& c_;
  const Law& law_;
  std::string source_, space_, class_;
};

}  // namespace

std::string cpp_header(const Compiled& compiled, const std::string& source,
                       const std::string& space) {
  return Header(compiled, source, space).run();
}

}  // namespace feltgate::law
