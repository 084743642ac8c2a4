// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Lists the words that a host can access, and writes them as CSV. Documentation:
// docs/other-tools.md
#include "design/host_words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <sstream>

#include "design/generate.hpp"
#include "files/toml/toml_reader.hpp"

namespace feltgate::design {

namespace {

Format format_of(const Elaborated& e, const Snapshot& n) {
  for (const auto& [name, format] : named_formats(e.formats)) {
    if (name == n.signal) return format;
  }
  throw config::ConfigError(fmt::format(
      "{}: signal format \"{}\" is unknown; use that of a signal of the chain", n.place, n.signal));
}

void check_names(const Elaborated& e, const std::vector<HostWord>& words) {
  std::set<std::string> names;
  for (const HostWord& w : words) {
    if (names.insert(w.name).second) continue;
    throw config::ConfigError(
        fmt::format("{}:1: two words are called {}; rename one", e.registers.path, w.name));
  }
}

const char* mode(const HostWord& w) { return !w.reads ? "wo" : w.writes ? "rw" : "ro"; }

}  // namespace

std::vector<HostWord> host_words(const Elaborated& e) {
  std::vector<HostWord> words;
  for (const Word& p : e.words) {
    HostWord w;
    w.name = p.parameter.name;
    w.kind = "parameter";
    w.address = p.parameter.address;
    w.reads = w.writes = w.number = true;
    w.format = p.format;
    w.unit = p.parameter.unit;
    w.doc = p.parameter.doc;
    w.reset = p.raw;
    w.si = p.si;
    words.push_back(w);
  }
  for (const Control& c : e.registers.controls) {
    HostWord w;
    w.name = c.name;
    w.kind = "control";
    w.address = c.address;
    // Commands act once: there is nothing to read.
    w.reads = c.name != "command";
    w.writes = true;
    w.doc = c.doc;
    w.fields = c.fields;
    if (c.name == "control") w.reset = control_reset(e);
    words.push_back(w);
  }
  for (const Snapshot& n : e.registers.snapshots) {
    HostWord w;
    w.name = n.name;
    w.kind = "snapshot";
    w.address = snapshot_base + n.slot;
    w.reads = true;
    w.number = !n.signal.empty();
    if (w.number) w.format = format_of(e, n);
    w.unit = n.unit;
    w.doc = n.doc;
    w.fields = n.fields;
    words.push_back(w);
  }
  std::stable_sort(words.begin(), words.end(),
                   [](const HostWord& a, const HostWord& b) { return a.address < b.address; });
  check_names(e, words);
  return words;
}

std::vector<HostWord> link_host_words(const RegisterMap& map) {
  std::vector<HostWord> words;
  for (const LinkWord& l : map.link_words) {
    HostWord w;
    w.name = "link_" + l.name;
    w.kind = "link";
    w.address = l.address;
    w.reads = true;
    w.writes = l.writable;
    w.doc = l.doc;
    w.fields = l.fields;
    words.push_back(w);
  }
  return words;
}

std::string csr_csv(const Elaborated& e) {
  std::ostringstream s;
  s << "# SPDX-License-Identifier: Apache-2.0\n"
       "# SPDX-FileCopyrightText: 2026 the feltgate authors\n"
       "# Generated from rtl/designs/"
    << e.design.name
    << ".toml and rtl/registers.toml by `feltgate generate`: do not edit.\n"
       "# Addresses in bytes from the base of the port.\n"
       "csr_base,feltgate,0x00000000,,\n";
  for (const HostWord& w : host_words(e)) {
    s << fmt::format("csr_register,feltgate_{},0x{:08x},1,{}\n", w.name, 4 * w.address, mode(w));
  }
  const std::vector<HostWord> link = link_host_words(e.registers);
  if (!link.empty()) {
    s << fmt::format("# What only the link has, no bus.\ncsr_base,feltgate_link,0x{:08x},,\n",
                     4 * link.front().address);
  }
  for (const HostWord& w : link) {
    s << fmt::format("csr_register,feltgate_{},0x{:08x},1,{}\n", w.name, 4 * w.address, mode(w));
  }
  s << "constant,config_csr_data_width,32,,\n"
       "constant,config_csr_alignment,32,,\n"
       "constant,config_bus_address_width,32,,\n"
    << "constant,config_clock_frequency," << e.design.clock_hz << ",,\n"
    << "constant,feltgate_design," << e.design.name << ",,\n"
    << "constant,feltgate_tick_hz," << e.design.tick_hz << ",,\n";
  // Word = value in its unit * 2^fraction.
  for (const HostWord& w : host_words(e)) {
    if (!w.number) continue;
    s << fmt::format("constant,feltgate_{}_fraction,{},,\n", w.name, w.format.fraction);
    s << fmt::format("constant,feltgate_{}_unit,{},,\n", w.name, w.unit);
  }
  return s.str();
}

}  // namespace feltgate::design
