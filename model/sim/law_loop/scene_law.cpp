// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// A compiled law for loops, and what runs beside it. Documentation: docs/laws.md
#include "sim/law_loop/scene_law.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <stdexcept>
#include <utility>

#include "feltgate/axes_ports.hpp"
#include "feltgate/quad.hpp"
#include "law/engine/machine.hpp"
#include "law/evaluate.hpp"
#include "law/load.hpp"

namespace feltgate {

namespace {

SceneLaw::Writes of_port(const std::vector<law::HostWord>& words) {
  SceneLaw::Writes writes;
  for (const law::HostWord& w : words) writes.emplace_back(axes_engine + w.address, w.data);
  return writes;
}

/// A host's change of a parameter: its number, and the new value in SI.
struct LawChange {
  std::size_t parameter;
  double si;
};
/// The changed value in the number type of a chain: word times step. A value in counts is thus
/// equal to the position in counts with which it is compared.
template <class N>
N rounded(const law::Compiled& law, const LawChange& c) {
  for (const law::ImageWord& w : law.image.words) {
    if (!w.formula.empty() || w.name != law.law.parameters[c.parameter].name) continue;
    return static_cast<N>(std::nearbyint(c.si / w.scale)) * static_cast<N>(w.scale);
  }
  return static_cast<N>(c.si);
}

/// Changes of parameters in the order in which the host sets them, one entry per commit; the list
/// may grow. Laws run in the number type of their chain: "fixed" runs the image, "quad" the graph
/// in binary128, the others the graph in double.
using LawChanges = std::vector<std::vector<LawChange>>;

template <class N>
class RealLaw : public LawRider {
 public:
  RealLaw(const law::Compiled& law, const DesignInfo& design, const LawChanges& changes)
      : law_(law), design_(design), changes_(changes), evaluation_(law.law) {}
  void change() override {
    for (const LawChange& c : changes_.at(next_++)) {
      evaluation_.set_parameter(c.parameter, rounded<N>(law_, c));
    }
  }

 private:
  void reset() override { evaluation_.reset(); }
  Torques run(const Snapshot* axes, const LawSample* own) override {
    inputs_.clear();
    for (const law::Input& in : law_.law.inputs) {
      inputs_.push_back(value_of(in.source, axes[in.axis], own == nullptr ? own : own + in.axis));
    }
    evaluation_.run(inputs_);
    Torques torques{};
    for (std::size_t n = 0; n < law_.law.outputs.size(); ++n) {
      torques[static_cast<std::size_t>(law_.law.outputs[n].axis)] =
          static_cast<double>(evaluation_.outputs()[n]);
    }
    return torques;
  }
  N value_of(law::Source source, const Snapshot& s, const LawSample* own) const {
    const auto scaled = [](std::int64_t raw, Format f) {
      return std::ldexp(static_cast<double>(raw), -f.fraction);
    };
    switch (source) {
      case law::Source::position:
        return static_cast<N>(s.position) * static_cast<N>(design_.count_rad);
      case law::Source::velocity:
        return static_cast<N>(own != nullptr ? own->velocity_rad_s
                                             : scaled(s.velocity, design_.velocity));
      case law::Source::tau_hat:
        break;
    }
    return static_cast<N>(own != nullptr ? own->tau_hat_nm : scaled(s.tau_hat, design_.torque));
  }

  const law::Compiled& law_;
  const DesignInfo& design_;
  const LawChanges& changes_;
  std::size_t next_ = 0;
  law::Evaluation<N> evaluation_;
  std::vector<N> inputs_;
};

/// The parameter words of an image while the host changes them.
class ChangedWords {
 public:
  ChangedWords(const law::Compiled& law, const LawChanges& changes)
      : law_(law), changes_(changes) {}
  /// The words after the next commit.
  std::vector<std::int32_t> next() {
    for (const LawChange& c : changes_.at(next_++)) {
      values_[law_.law.parameters[c.parameter].name] = c.si;
    }
    std::vector<double> values;
    for (const law::ImageWord& w : law_.image.words) {
      if (!w.formula.empty()) continue;
      const auto known = values_.find(w.name);
      values.push_back(known == values_.end() ? w.initial * w.scale : known->second);
    }
    return law::parameter_words(law_.image, values);
  }

 private:
  const law::Compiled& law_;
  const LawChanges& changes_;
  std::size_t next_ = 0;
  std::map<std::string, double> values_;  ///< SI
};

/// Commits the words to a machine.
void commit(law::Machine& runner, const std::vector<std::int32_t>& words) {
  for (std::size_t n = 0; n < words.size(); ++n) {
    runner.set_parameter(static_cast<int>(n), words[n]);
  }
  runner.commit();
}

/// The inputs of a run; `own` as in LawRider::follow().
law::MachineInputs inputs_of(const Snapshot* axes, std::size_t count, const LawSample* own) {
  law::MachineInputs in{};
  for (std::size_t n = 0; n < count; ++n) {
    const std::int64_t velocity = own == nullptr ? axes[n].velocity : own[n].velocity;
    const std::int64_t tau_hat = own == nullptr ? axes[n].tau_hat : own[n].tau_hat;
    in[3 * n] = axes[n].position;
    in[3 * n + 1] = static_cast<std::int32_t>(velocity);
    in[3 * n + 2] = static_cast<std::int32_t>(tau_hat);
  }
  in[9] = static_cast<std::int32_t>(axes[0].tick);
  return in;
}

/// Runs the image of a law in the interpreter.
class FixedLaw : public LawRider {
 public:
  FixedLaw(const law::Compiled& law, const DesignInfo& design, const LawChanges& changes)
      : words_(law, changes),
        axes_(law.law.outputs.size()),
        torque_(design.torque),
        machine_(law::memory(law.image)) {}
  void change() override { commit(machine_, words_.next()); }

 private:
  void reset() override { machine_.enter(); }
  Torques run(const Snapshot* axes, const LawSample* own) override {
    const law::MachineRun& done = machine_.run(0, inputs_of(axes, axes_, own));
    Torques torques{};
    for (std::size_t n = 0; n < axes_; ++n) {
      torques[n] =
          std::ldexp(static_cast<double>(saturate(torque_, done.outputs[n])), -torque_.fraction);
    }
    return torques;
  }
  static std::int64_t saturate(Format f, std::int32_t word) {
    const std::int64_t end = std::int64_t{1} << (f.width() - 1);
    return word >= end ? end - 1 : word < -end ? -end : word;
  }

  ChangedWords words_;
  std::size_t axes_;
  Format torque_;
  law::Machine machine_;
};

/// Runs the image in the interpreter, which shows its words.
class StateWatch : public LawWatch {
 public:
  StateWatch(const law::Compiled& law, const DesignInfo& design, const LawChanges& changes,
             SceneLaw::Told told)
      : law_(law),
        tick_s_(1 / static_cast<double>(design.tick_hz)),
        words_(law, changes),
        machine_(law::memory(law.image)),
        told_(std::move(told)),
        states_(law.law.states.size()) {}
  void enter() override { machine_.enter(); }
  void change() override { commit(machine_, words_.next()); }
  void run(const Snapshot& s) override {
    machine_.run(law_.target.thread, inputs_of(&s, 1, nullptr));
    const int first = law_.target.thread * EngineMap::private_words;
    for (std::size_t k = 0; k < states_.size(); ++k) {
      const int address = first + law_.assembled.state_address[k];
      states_[k] = machine_.memory().data_at(address) * law_.program.states[k].scale;
    }
    told_(s.tick * tick_s_, states_);
  }

 private:
  const law::Compiled& law_;
  double tick_s_;
  ChangedWords words_;
  law::Machine machine_;
  SceneLaw::Told told_;
  std::vector<double> states_;
};

std::unique_ptr<LawRider> make_law_rider(const law::Compiled& law, const DesignInfo& design,
                                         const std::string& kind, const LawChanges& changes) {
  if (kind == "fixed") return std::make_unique<FixedLaw>(law, design, changes);
  if (kind == "quad") return std::make_unique<RealLaw<Quad>>(law, design, changes);
  return std::make_unique<RealLaw<double>>(law, design, changes);
}

std::unique_ptr<LawWatch> make_law_watch(const law::Compiled& law, const DesignInfo& design,
                                         const LawChanges& changes, SceneLaw::Told told) {
  return std::make_unique<StateWatch>(law, design, changes, std::move(told));
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
