// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Generates the timing diagram of the schedule. Documentation: docs/architecture.md
#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <sstream>

#include "design/schedule.hpp"

namespace feltgate::design {

namespace {

/// Items joined by ", ".
std::string joined(const std::vector<std::string>& items) {
  std::string text;
  for (const std::string& item : items) text += (text.empty() ? "" : ", ") + item;
  return text;
}

/// Colours of the timing diagram.
char colour(const std::string& by) {
  if (by == "scenes") return '4';
  return by == "supervisor" ? '9' : '5';
}

/// One lane of the timing diagram, one character per clock; it begins before wave clock 0.
class Lane {
 public:
  Lane(std::string name, const Schedule& s, char idle)
      : name_(std::move(name)),
        ahead_(s.first_wave_clock),
        wave_(static_cast<std::size_t>(s.wave_length + s.first_wave_clock), '.') {
    wave_[0] = idle;
  }
  void put(int clock, char level, const std::string& label = "") {
    wave_[static_cast<std::size_t>(clock + ahead_)] = level;
    if (!label.empty()) labels_.push_back({clock, label});
  }
  /// As put(), and idle again in the next clock unless that is already set.
  void pulse(int clock, char level, char idle, const std::string& label = "") {
    put(clock, level, label);
    const auto next = static_cast<std::size_t>(clock + ahead_ + 1);
    if (next < wave_.size() && wave_[next] == '.') wave_[next] = idle;
  }
  std::string text() {
    std::stable_sort(labels_.begin(), labels_.end(),
                     [](const Label& a, const Label& b) { return a.clock < b.clock; });
    std::vector<std::string> data;
    for (const Label& l : labels_) data.push_back("\"" + l.text + "\"");
    std::string line = fmt::format("    {{\"name\": \"{}\", \"wave\": \"{}\"", name_, wave_);
    if (!data.empty()) line += fmt::format(", \"data\": [{}]", joined(data));
    return line + "}";
  }

 private:
  struct Label {
    int clock;
    std::string text;
  };
  std::string name_;
  int ahead_;
  std::string wave_;
  std::vector<Label> labels_;
};

/// Colour of a word: of the scenes for a scene's word, otherwise of the block that uses it.
char colour_of_word(const Parameter& p, const Schedule& s) {
  if (!p.scene.empty()) return '4';
  if (const Product* product = s.product(p.name)) {
    return product->by == "supervisor" ? '9' : '=';
  }
  for (const Step& step : s.steps) {
    if (step.by == "supervisor" && step.clock == p.slot) return '9';
  }
  return '=';
}

}  // namespace

std::string timing_diagram(const RegisterMap& map, const Schedule& schedule) {
  Lane tick("tick", schedule, '0'), wave("wave[0]", schedule, '0');
  Lane param("param", schedule, 'x'), operand("operand", schedule, 'x'),
      product("product", schedule, 'x'), valid("snapshot_valid_o", schedule, '0');
  const int last = schedule.wave_length - schedule.first_wave_clock - 1;
  tick.pulse(last, '1', '0');
  wave.pulse(0, '1', '0');
  std::vector<int> drawn;
  const auto once = [&drawn](int slot) {
    if (std::find(drawn.begin(), drawn.end(), slot) != drawn.end()) return false;
    drawn.push_back(slot);
    return true;
  };
  for (const Parameter& p : map.parameters) {
    if (p.slot < schedule.wave_length && once(p.slot)) {
      param.pulse(p.slot, colour_of_word(p, schedule), 'x', p.scene.empty() ? p.label : "scene");
    }
  }
  drawn.clear();
  for (const Product& p : schedule.products) {
    if (!once(p.slot)) continue;
    operand.pulse(p.slot, colour(p.by), 'x', p.operand_label);
    product.pulse(p.slot + schedule.multiplier_latency, colour(p.by), 'x', p.label);
  }
  for (const Snapshot& n : map.snapshots) {
    if (n.with.empty()) operand.pulse(n.slot, '2', 'x', n.label);
  }
  valid.pulse(schedule.step("snapshot")->clock, '1', '0');
  std::string lanes;
  const auto add = [&lanes](const std::string& line) { lanes += line + ",\n"; };
  add(tick.text());
  add(wave.text());
  add("    {}");
  add(param.text());
  add(operand.text());
  add(product.text());
  add("    {}");
  std::vector<Step> shown;
  for (const Step& step : schedule.steps) {
    if (!step.output.empty()) shown.push_back(step);
  }
  std::stable_sort(shown.begin(), shown.end(),
                   [](const Step& a, const Step& b) { return a.clock < b.clock; });
  for (const Step& step : shown) {
    Lane lane(step.output, schedule, '=');
    lane.put(-schedule.first_wave_clock, '=', "tick k-1");
    lane.put(step.clock + 1, step.by == "supervisor" ? '9' : '7', "tick k");
    add(lane.text());
  }
  add("    {}");
  lanes += valid.text() + "\n";
  return "{\n  \"signal\": [\n" + lanes +
         "  ],\n"
         "  \"head\": {\"text\": \"One tick: clocks of the wave\", \"tock\": " +
         fmt::format("{}", -schedule.first_wave_clock) +
         "},\n"
         "  \"foot\": {\"text\": \"blue: the chain; orange: the scene; red: the supervisor; white "
         "operands: words that only pass by for the snapshot; hatched: not used\"},\n"
         "  \"config\": {\"wrap\": 26}\n}\n";
}

}  // namespace feltgate::design
