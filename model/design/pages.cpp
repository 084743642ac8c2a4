// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Generates the register page and the table of a design. Documentation: docs/designs.md
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <sstream>

#include "design/generate.hpp"

namespace feltgate::design {

namespace {

std::string format_text(Format f) {
  return fmt::format("[{},{},{}]", f.sign, f.integer, f.fraction);
}

std::string hex(int v) { return fmt::format("0x{:03x}", v); }

}  // namespace

std::string bits_text(const Field& f) {
  if (f.width == 1) return fmt::format("{}", f.bit);
  return fmt::format("{}:{}", f.bit + f.width - 1, f.bit);
}

std::string register_page(const Elaborated& e) {
  std::ostringstream s;
  s << "# Registers\n\nGenerated from `rtl/registers.toml` by `feltgate generate`: do not edit.\n"
    << "Formats and values are those of the design `" << e.design.name
    << "`; another design's are\n"
    << "printed by `feltgate design NAME`. A write takes effect at the end of the running tick. "
       "The\n"
       "same as C header, SystemRDL and CSV: [other tools](other-tools.md#the-register-map).\n\n"
    << "## Parameters\n\nRead and written by the host. Armed: what a write does [while the motor "
       "is armed]"
       "(blocks/ramp.md#while-armed); a word\nof a scene ramps while that scene is in use.\n\n"
    << "| address | name | scene | format | unit | value | armed | meaning |\n"
    << "|---|---|---|---|---|---|---|---|\n";
  for (const Parameter& p : e.registers.parameters) {
    const auto at = std::find_if(e.words.begin(), e.words.end(),
                                 [&](const Word& w) { return w.parameter.name == p.name; });
    const bool built = at != e.words.end();
    s << "| " << hex(p.address) << " | `" << p.name << "` | " << (p.scene.empty() ? "all" : p.scene)
      << " | " << (built ? format_text(at->field()) : "") << " | " << p.unit << " | "
      << (built ? fmt::format("{:.7g}", at->si) : "no such word") << " | " << p.while_armed << " | "
      << p.doc << " |\n";
  }
  s << "\n## Control\n\n| address | name | bits | meaning |\n|---|---|---|---|\n";
  for (const Control& c : e.registers.controls) {
    for (const Field& f : c.fields) {
      s << "| " << hex(c.address) << " | `" << c.name << "." << f.name << "` | " << bits_text(f)
        << " | " << f.doc << " |\n";
    }
  }
  s << "\n## Snapshot\n\nRead only; all words are of one tick. `command.freeze` holds them while a "
       "slow host reads.\n\n| address | name | meaning |\n|---|---|---|\n";
  for (const Snapshot& n : e.registers.snapshots) {
    s << "| " << hex(snapshot_base + n.slot) << " | `" << n.name << "` | " << n.doc << " |\n";
  }
  s << "\n### Fields of the status\n\n| bits | field | meaning |\n|---|---|---|\n";
  for (const Snapshot& n : e.registers.snapshots) {
    for (const Field& f : n.fields) {
      s << "| " << bits_text(f) << " | `" << n.name << "." << f.name << "` | " << f.doc << " |\n";
    }
  }
  s << "\n### Limits\n\n| bit | limit | meaning |\n|---|---|---|\n";
  for (const Cause& c : e.registers.limits) {
    s << "| " << c.number << " | `" << c.name << "` | " << c.doc << " |\n";
  }
  s << "\n### Faults\n\n| number and bit | fault | meaning |\n|---|---|---|\n";
  for (const Cause& c : e.registers.faults) {
    s << "| " << c.number << " | `" << c.name << "` | " << c.doc << " |\n";
  }
  s << "\n## Scenes\n\n| number | scene |\n|---|---|\n";
  for (const Scene& scene : e.registers.scenes) {
    s << "| " << scene.number << " | " << scene.name << " |\n";
  }
  s << link_tables(e.registers);
  return s.str();
}

namespace {

/// How far the N-method's gain is from the exact factor.
std::string gain_text(const Elaborated& e) {
  const double gain = e.rad_s_per_count() / e.design.velocity_gain_rad_s();
  std::string text = fmt::format("\nvelocity gain error (against 2 pi/(Er Tp m1)): {:+.4f} %\n",
                                 100.0 * (gain - 1));
  constexpr double far = 0.02;
  if (std::abs(gain - 1.0) > far) {
    text += fmt::format(
        "  every velocity is wrong by that much: 2^n is far from the exact factor;\n"
        "  {}: write velocity.gain = \"exact\" instead of velocity.n\n",
        e.design.path);
  }
  return text;
}

}  // namespace

std::string design_table(const Elaborated& e) {
  std::ostringstream s;
  s << "design " << e.design.name << ": " << e.design.description << "\n\n";
  s << fmt::format("{:<24} {:>14} {:<13} {:<13} {:>11} {:>10} {:>11} {:>8}\n", "parameter", "value",
                   "unit", "format", "integer", "error", "largest", "headroom");
  for (const Word& w : e.words) {
    const double largest = std::ldexp(1.0, w.format.integer);
    const std::string headroom = w.si == 0 ? "-" : fmt::format("{:.2f}x", largest / std::abs(w.si));
    s << fmt::format("{:<24} {:>14.7g} {:<13} {:<13} {:>11} {:>+9.4f}% {:>11.5g} {:>8}\n",
                     w.parameter.name, w.si, w.parameter.unit, format_text(w.format), w.raw,
                     100.0 * w.relative_error(), largest, headroom);
  }
  s << "\n";
  s << fmt::format("{:<24} {:<13} {:>6} {:>14} {:>12}\n", "signal", "format", "bits", "range",
                   "LSB");
  for (const auto& [name, f] : named_formats(e.formats)) {
    s << fmt::format("{:<24} {:<13} {:>6} {:>14.6g} {:>12.4g}\n", name, format_text(f), f.width(),
                     std::ldexp(1.0, f.integer), std::ldexp(1.0, -f.fraction));
  }
  if (e.design.mt) {
    s << fmt::format(
        "\nvelocity: M/T over whole encoder cycles, {:g} us or more, up to {} cycles\n",
        1e6 * e.design.mt_window_s, e.design.mt_cycles);
  } else {
    s << gain_text(e);
  }
  s << fmt::format(
      "latency, sampled position to duty register: {} of {} clocks per tick, of a charge {}\n",
      latency_clocks, e.design.clocks_per_tick(), charge_latency_clocks);
  return s.str();
}

}  // namespace feltgate::design
