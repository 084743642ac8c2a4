// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Reader of rtl/schedule.toml. Documentation: docs/architecture.md
#include "design/schedule.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <set>

#include "feltgate/nearest.hpp"
#include "files/toml/toml_reader.hpp"

namespace feltgate::design {

const Product* Schedule::product(const std::string& name) const {
  for (const Product& p : products) {
    if (p.name == name) return &p;
  }
  return nullptr;
}

const Step* Schedule::step(const std::string& name) const {
  for (const Step& s : steps) {
    if (s.name == name) return &s;
  }
  return nullptr;
}


std::uint64_t scene_slots(const RegisterMap& map) {
  std::uint64_t slots = 0;
  for (const Parameter& p : map.parameters) {
    if (!p.scene.empty()) slots |= std::uint64_t{1} << p.slot;
  }
  return slots;
}

namespace {

std::string place(const config::TomlReader& r) {
  return fmt::format("{}:{}", r.file(), r.line("name"));
}

Need need(const std::string& text) {
  const std::string previous = "previous ";
  if (text.rfind(previous, 0) == 0) return {text.substr(previous.size()), true};
  return {text, false};
}

Product read_product(config::TomlReader r, const RegisterMap& map) {
  Product p;
  p.name = r.identifier("name");
  p.place = place(r);
  p.operand = need(r.text("operand"));
  if (r.has("factor")) p.factors = r.texts("factor");
  if (r.has("scenes")) p.scenes = r.texts("scenes");
  for (const std::string& name : p.factors) {
    const Parameter* word = map.find(name);
    if (word == nullptr || (word->kind != "coefficient" && word->kind != "signed")) {
      r.fail("factor", fmt::format("\"{}\" is no coefficient", name), "name one of " + map.path);
    }
    if (&name != &p.factors.front() && word->slot != p.slot) {
      r.fail("factor",
             fmt::format("{} comes by in slot {} and {} in slot {}, but their product is one",
                         p.factors.front(), p.slot, name, word->slot),
             "give them one slot, or each a product");
    }
    p.slot = word->slot;
    if (!word->scene.empty()) p.scenes.push_back(word->scene);
  }
  for (const std::string& scene : p.scenes) {
    if (map.scene_number(scene) < 0) {
      r.fail("scenes", fmt::format("there is no scene \"{}\"", scene),
             config::did_you_mean(scene, map.scene_names()) + "name one that is listed");
    }
  }
  if (p.factors.empty()) p.slot = static_cast<int>(r.integer("slot", 0, 63));
  const std::vector<std::string> labels = r.texts("label");
  if (labels.size() != 2) r.fail("label", "two labels are wanted", "write operand and product");
  for (const std::string& label : labels) {
    if (label.find_first_of("\"\\") != std::string::npos) {
      r.fail("label", "a label with \" or \\ cannot be drawn", "write it without");
    }
  }
  p.operand_label = labels[0];
  p.label = labels[1];
  p.by = r.identifier("by");
  p.doc = r.text("doc");
  r.finish();
  return p;
}

/// The clock of a name PARAM_AT_..., PRODUCT_AT_..., READ_AT_... or EVENT_AT_...
int clock_of(config::TomlReader& r, const std::string& name, const RegisterMap& map,
             const Schedule& s) {
  const std::size_t at = name.find("_AT_");
  const std::string kind = name.substr(0, at);
  std::string rest = at == std::string::npos ? "" : name.substr(at + 4);
  std::transform(rest.begin(), rest.end(), rest.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  const Product* product = s.product(rest);
  const Parameter* word = map.find(rest);
  if (kind == "PARAM" && product != nullptr) return product->slot;
  if (kind == "PARAM" && word != nullptr) return word->slot;
  if (kind == "PRODUCT" && product != nullptr) return product->slot + s.multiplier_latency;
  if (kind == "EVENT" && s.step(rest) != nullptr) return s.step(rest)->clock;
  for (const Snapshot& n : map.snapshots) {
    if (kind == "READ" && n.name == rest) return n.slot;
  }
  r.fail("after", fmt::format("there is no clock {}", name),
         "name PARAM_AT_<word>, PRODUCT_AT_<product>, READ_AT_<snapshot word> or "
         "EVENT_AT_<step that is listed before>");
}

Step read_step(config::TomlReader r, const RegisterMap& map, const Schedule& s) {
  Step step;
  step.name = r.identifier("name");
  step.place = place(r);
  if (r.has("after")) {
    step.clock = clock_of(r, r.text("after"), map, s);
    if (r.has("clocks")) step.clock += static_cast<int>(r.integer("clocks", -64, 64));
  } else {
    step.clock = static_cast<int>(r.integer("clock", 0, 63));
  }
  if (r.has("needs")) {
    for (const std::string& text : r.texts("needs")) step.needs.push_back(need(text));
  }
  if (r.has("fetches")) step.fetches = r.text("fetches");
  if (r.has("takes")) step.takes = r.texts("takes");
  if (r.has("reads")) step.reads = r.texts("reads");
  if (r.flag_or("passes", false)) step.lasts = 1;
  if (r.has("lasts")) step.lasts = static_cast<int>(r.integer("lasts", 1, 62));
  step.on_operand_bus = r.flag_or("on_operand_bus", false);
  if (step.on_operand_bus && step.lasts == 0) {
    r.fail("on_operand_bus", "what is held would keep the operand bus", "say how long it lasts");
  }
  if (r.has("no_product")) step.no_product = static_cast<int>(r.integer("no_product", 1, 62));
  if (r.has("shows_in")) step.shows_in = r.text("shows_in");
  if (r.has("output")) step.output = plain_text(r, "output");
  step.by = r.identifier("by");
  step.doc = r.text("doc");
  r.finish();
  return step;
}

/// Refuses a name that occurs twice: names become constants.
void once(config::TomlReader& r, std::set<std::string>& names) {
  if (!names.insert(r.identifier("name")).second) {
    r.fail("name", fmt::format("\"{}\" is listed twice", r.identifier("name")), "rename one");
  }
}

}  // namespace

Schedule read_schedule(const std::string& path, const RegisterMap& map) {
  const toml::table root = config::parse_toml_file(path);
  config::TomlReader top(root, path, "the schedule");
  Schedule s;
  s.path = path;
  config::TomlReader wave = top.section("wave");
  s.wave_length = static_cast<int>(wave.integer("clocks", 8, 62));
  s.first_wave_clock = static_cast<int>(wave.integer("first_clock", 2, 2));
  s.multiplier_latency = static_cast<int>(wave.integer("multiplier_latency", 4, 4));
  wave.finish();
  std::set<std::string> products, steps;
  for (config::TomlReader& r : top.sections("product")) {
    once(r, products);
    s.products.push_back(read_product(r, map));
  }
  for (config::TomlReader& r : top.sections("step")) {
    once(r, steps);
    s.steps.push_back(read_step(r, map, s));
  }
  top.finish();
  for (const char* name : {"sample", "duty", "snapshot"}) {
    if (s.step(name) == nullptr) top.fail("step", fmt::format("no step {}", name), "list it");
  }
  check_schedule(map, s);
  return s;
}

}  // namespace feltgate::design
