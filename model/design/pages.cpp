// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The register page and the table of a design. Documentation: docs/designs.md
#include <cmath>
#include <cstdio>
#include <sstream>

#include "design/generate.hpp"

namespace feltgate::design {

namespace {

std::string format_text(Format f) {
  return "[" + std::to_string(f.sign) + "," + std::to_string(f.integer) + "," +
         std::to_string(f.fraction) + "]";
}

std::string hex(int v) {
  char text[16];
  std::snprintf(text, sizeof text, "0x%03x", v);
  return text;
}

}  // namespace

std::string register_page(const Elaborated& e) {
  std::ostringstream s;
  s << "# Registers\n\nGenerated from `rtl/registers.toml` by `feltgate generate`: do not edit.\n"
    << "Formats and values are those of the design `" << e.design.name
    << "`; another design's are\n"
    << "printed by `feltgate design NAME`. A write takes effect at the end of the running tick.\n\n"
    << "## Parameters\n\nRead and written by the host. Slot: the clock of the wave in which the "
       "word "
       "is on the\nparameter bus.\n\n"
    << "| address | name | scene | slot | format | unit | value | meaning |\n"
    << "|---|---|---|---|---|---|---|---|\n";
  for (const Word& w : e.words) {
    char value[40];
    std::snprintf(value, sizeof value, "%.7g", w.si);
    s << "| " << hex(w.parameter.address) << " | `" << w.parameter.name << "` | "
      << (w.parameter.scene.empty() ? "all" : w.parameter.scene) << " | " << w.parameter.slot
      << " | " << format_text(w.format) << " | " << w.parameter.unit << " | " << value << " | "
      << w.parameter.doc << " |\n";
  }
  s << "\n## Control\n\n| address | name | bits | meaning |\n|---|---|---|---|\n";
  for (const Control& c : e.registers.controls) {
    for (const Field& f : c.fields) {
      s << "| " << hex(c.address) << " | `" << c.name << "." << f.name << "` | "
        << (f.width == 1 ? std::to_string(f.bit)
                         : std::to_string(f.bit + f.width - 1) + ":" + std::to_string(f.bit))
        << " | " << f.doc << " |\n";
    }
  }
  s << "\n## Snapshot\n\nRead only; all words are of one tick. `command.freeze` holds them while a "
       "slow host reads.\n\n| address | name | meaning |\n|---|---|---|\n";
  for (const Snapshot& n : e.registers.snapshots) {
    s << "| " << hex(snapshot_base + n.slot) << " | `" << n.name << "` | " << n.doc << " |\n";
  }
  s << "\n## Scenes\n\n| number | scene |\n|---|---|\n";
  for (const Scene& scene : e.registers.scenes) {
    s << "| " << scene.number << " | " << scene.name << " |\n";
  }
  return s.str();
}

std::string design_table(const Elaborated& e) {
  std::ostringstream s;
  char line[200];
  s << "design " << e.design.name << ": " << e.design.description << "\n\n";
  std::snprintf(line, sizeof line, "%-24s %14s %-13s %-13s %11s %10s %11s %8s\n", "parameter",
                "value", "unit", "format", "integer", "error", "largest", "headroom");
  s << line;
  for (const Word& w : e.words) {
    const double largest = std::ldexp(1.0, w.format.integer);
    char headroom[24] = "-";
    if (w.si != 0) std::snprintf(headroom, sizeof headroom, "%.2fx", largest / std::abs(w.si));
    std::snprintf(line, sizeof line, "%-24s %14.7g %-13s %-13s %11lld %+9.4f%% %11.5g %8s\n",
                  w.parameter.name.c_str(), w.si, w.parameter.unit.c_str(),
                  format_text(w.format).c_str(), static_cast<long long>(w.raw),
                  100.0 * w.relative_error(), largest, headroom);
    s << line;
  }
  s << "\n";
  std::snprintf(line, sizeof line, "%-24s %-13s %6s %14s %12s\n", "signal", "format", "bits",
                "range", "LSB");
  s << line;
  for (const auto& [name, f] : named_formats(e.formats)) {
    std::snprintf(line, sizeof line, "%-24s %-13s %6d %14.6g %12.4g\n", name.c_str(),
                  format_text(f).c_str(), f.width(), std::ldexp(1.0, f.integer),
                  std::ldexp(1.0, -f.fraction));
    s << line;
  }
  const double two_pi = 6.283185307179586;
  const double gain = e.rad_s_per_count() * e.design.m1 * 4.0 * e.design.lines /
                      (two_pi * static_cast<double>(e.design.tick_hz));
  std::snprintf(line, sizeof line,
                "\nvelocity gain error (against 2 pi/(Er Tp m1)): %+.4f %%\n"
                "latency, sampled position to duty register: %d of %d clocks per tick\n",
                100.0 * (gain - 1.0), latency_clocks, e.design.clocks_per_tick());
  s << line;
  return s.str();
}

}  // namespace feltgate::design
