// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Runs a law in step with a chain: the image, or the graph in the chain's number type.
// Documentation: docs/laws.md
#include "sim/law_loop/scene_law.hpp"

#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include "feltgate/quad.hpp"
#include "law/engine/machine.hpp"
#include "law/evaluate.hpp"
#include "law/load.hpp"

namespace feltgate {

namespace {

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

}  // namespace

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

}  // namespace feltgate
