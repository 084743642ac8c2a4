// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// A compiled law for loops. Documentation: docs/laws.md
#include "sim/law_loop/scene_law.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <stdexcept>

#include "feltgate/axes_ports.hpp"
#include "law/load.hpp"

namespace feltgate {

namespace {

SceneLaw::Writes of_port(const std::vector<law::HostWord>& words) {
  SceneLaw::Writes writes;
  for (const law::HostWord& w : words) writes.emplace_back(axes_engine + w.address, w.data);
  return writes;
}

class CompiledSceneLaw : public SceneLaw {
 public:
  CompiledSceneLaw(law::Compiled law, DesignInfo design)
      : law_(std::move(law)), design_(std::move(design)), parameters_(law_.image) {
    // The riders start with values that are rounded to words.
    changes_.emplace_back();
    for (std::size_t n = 0; n < law_.law.parameters.size(); ++n) {
      const law::Parameter& p = law_.law.parameters[n];
      if (p.derived < 0 && has(p.name)) note(n);
    }
  }
  const std::string& name() const override { return law_.law.name; }
  bool of_position_alone() const override {
    const auto& inputs = law_.law.inputs;
    return std::all_of(inputs.begin(), inputs.end(),
                       [](const law::Input& in) { return in.source == law::Source::position; });
  }
  double bound_on_words_nm(std::size_t axis) const override {
    const auto& outputs = law_.law.outputs;
    for (std::size_t n = 0; n < outputs.size(); ++n) {
      if (!law_.bound.states_bounded || !law_.bound.strips.empty()) break;
      if (outputs[n].axis == static_cast<int>(axis)) return law_.bound.output[n];
    }
    return std::numeric_limits<double>::infinity();
  }
  Writes load() const override { return of_port(law::load_into_zeros(law_.image)); }
  bool has(const std::string& parameter) const override {
    return parameters_.find(parameter) != nullptr;
  }
  std::string unit(const std::string& parameter) const override {
    return parameters_.find(parameter)->unit;
  }
  void check(const std::string& parameter, double value) const override {
    parameters_.check(parameter, value);
  }
  void check(const std::map<std::string, double>& values) const override {
    parameters_.check(values);
  }
  double value(const std::string& parameter) const override { return parameters_.value(parameter); }
  bool is_mailbox(const std::string& parameter) const override {
    const auto& all = law_.law.parameters;
    return std::any_of(all.begin(), all.end(),
                       [&](const law::Parameter& p) { return p.mailbox && p.name == parameter; });
  }
  bool has_mailbox() const override {
    const auto& all = law_.law.parameters;
    return std::any_of(all.begin(), all.end(), [](const law::Parameter& p) { return p.mailbox; });
  }
  double within(const std::string& parameter, double value) const override {
    return parameters_.within(parameter, value);
  }
  Writes set(const std::map<std::string, double>& values) override {
    const auto words = parameters_.set(values);
    changes_.emplace_back();
    for (std::size_t n = 0; n < law_.law.parameters.size(); ++n) {
      if (values.count(law_.law.parameters[n].name) != 0) note(n);
    }
    if (told_value_) {
      for (const auto& [name, value] : values) told_value_(name, parameters_.value(name));
    }
    return of_port(words);
  }
  double period_s() const override {
    return law_.image.threads[0].divider / static_cast<double>(design_.tick_hz);
  }
  std::pair<std::string, double> event(const LawEvent& told) const override {
    for (const law::ImageEvent& e : law_.image.events) {
      if (e.number == told.number) return {e.name, told.value * e.scale};
    }
    return {fmt::format("event{}", told.number), told.value};
  }
  std::unique_ptr<LawRider> rider(const std::string& kind) const override {
    auto made = make_law_rider(law_, design_, kind, changes_);
    made->change();
    return made;
  }
  std::vector<std::string> states() const override {
    std::vector<std::string> names;
    for (const law::State& s : law_.law.states) names.push_back(s.name);
    return names;
  }
  std::unique_ptr<LawWatch> watch(Told told) const override {
    auto made = make_law_watch(law_, design_, changes_, std::move(told));
    made->change();
    return made;
  }

 private:
  void note(std::size_t parameter) {
    const law::Parameter& p = law_.law.parameters[parameter];
    changes_.back().push_back({parameter, parameters_.value(p.name) * p.to_si});
  }

  law::Compiled law_;
  DesignInfo design_;
  law::LoadedParameters parameters_;
  LawChanges changes_;
};

}  // namespace

void require_one_torque(const law::Compiled& law, const std::string& path) {
  for (const law::Output& o : law.law.outputs) {
    if (o.axis == 0) continue;
    throw std::invalid_argument(fmt::format(
        "{}:{}: a torque for axis {}, and the scene has one lever; name a device with "
        "so many axes in the scene, in place of plant and above its tables: "
        "device = \"{}\"; `feltgate law {}` measures laws of several axes",
        path, o.place.line, o.axis, law.law.outputs.size() > 2 ? "gimbal" : "two_levers", path));
  }
}

std::unique_ptr<SceneLaw> make_scene_law(const std::string& path, const DesignInfo& design) {
  law::Compiled law = law::compile_file(path, law::target_of(design));
  require_one_torque(law, path);
  return make_scene_law(std::move(law), design);
}
std::unique_ptr<SceneLaw> make_scene_law(law::Compiled law, const DesignInfo& design) {
  return std::make_unique<CompiledSceneLaw>(std::move(law), design);
}

std::unique_ptr<SceneLaw> make_axes_law(const std::string& path, const DesignInfo& design,
                                        int axes) {
  return make_axes_law(law::compile_file(path, law::target_of(design)), path, design, axes);
}
std::unique_ptr<SceneLaw> make_axes_law(law::Compiled law, const std::string& path,
                                        const DesignInfo& design, int axes) {
  unsigned given = 0;
  for (const law::Output& o : law.law.outputs) {
    if (o.axis >= axes) {
      throw std::invalid_argument(fmt::format(
          "{}:{}: a torque for axis {}, and the device has {} axes; take a device with more", path,
          o.place.line, o.axis, axes));
    }
    given |= 1U << o.axis;
  }
  if (given != (1U << axes) - 1U) {
    throw std::invalid_argument(fmt::format(
        "{}: not all of the device's {} axes get a torque; write out torque[{}] = 0 for "
        "one that shall be free",
        path, axes, axes - 1));
  }
  return make_scene_law(std::move(law), design);
}

}  // namespace feltgate
