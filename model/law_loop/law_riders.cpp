// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Programs beside real chains. Documentation: docs/laws.md
#include "law_loop/scene_law.hpp"

#include <cmath>
#include <map>
#include <vector>

#include "engine/law_runner.hpp"
#include "feltgate/quad.hpp"
#include "law/evaluate.hpp"
#include "law/load.hpp"

namespace feltgate {

namespace {

template <class N>
class RealLaw : public LawRider {
 public:
  RealLaw(const law::Compiled& law, const DesignInfo& design, const LawChanges& changes)
      : law_(law), count_rad_(design.count_rad), changes_(changes), evaluation_(law.law) {}
  void change() override {
    for (const LawChange& c : changes_.at(next_++)) {
      evaluation_.set_parameter(c.parameter, rounded<N>(law_, c));
    }
  }

 private:
  void reset() override { evaluation_.reset(); }
  double run(const Snapshot& s, const RealChain& chain) override {
    const ChainOut& o = chain.out();
    inputs_.clear();
    for (const law::Input& in : law_.law.inputs) {
      inputs_.push_back(in.source == law::Source::position
                            ? static_cast<N>(s.position) * static_cast<N>(count_rad_)
                        : in.source == law::Source::velocity ? static_cast<N>(o.velocity_rad_s)
                                                             : static_cast<N>(o.tau_hat_nm));
    }
    evaluation_.run(inputs_);
    return static_cast<double>(evaluation_.outputs().front());
  }

  const law::Compiled& law_;
  double count_rad_;
  const LawChanges& changes_;
  std::size_t next_ = 0;
  law::Evaluation<N> evaluation_;
  std::vector<N> inputs_;
};

/// The image: compiled C++ where the law is a shipped one, else its words in the interpreter.
class FixedLaw : public LawRider {
 public:
  FixedLaw(const law::Compiled& law, const DesignInfo& design, const LawChanges& changes)
      : law_(law),
        torque_(design.torque),
        changes_(changes),
        runner_(law::make_law_runner(law::memory(law.image), law::crc(law.image))) {}
  void change() override {
    for (const LawChange& c : changes_.at(next_++)) {
      values_[law_.law.parameters[c.parameter].name] = c.si;
    }
    std::vector<double> values;
    for (const law::ImageWord& w : law_.image.words) {
      if (!w.formula.empty()) continue;
      const auto known = values_.find(w.name);
      values.push_back(known == values_.end() ? w.initial * w.scale : known->second);
    }
    const std::vector<std::int32_t> words = law::parameter_words(law_.image, values);
    for (std::size_t n = 0; n < words.size(); ++n) {
      runner_->set_parameter(static_cast<int>(n), words[n]);
    }
    runner_->commit();
  }

 private:
  void reset() override { runner_->enter(); }
  double run(const Snapshot& s, const RealChain& chain) override {
    const ChainRaw& raw = *chain.raw();
    const auto tick = static_cast<std::int32_t>(s.tick);
    const law::MachineInputs in{
        s.position, static_cast<std::int32_t>(raw.velocity), raw.tau_hat, 0, 0, 0, 0, 0, 0, tick};
    const std::int32_t word = runner_->run(in).outputs[0];
    return std::ldexp(static_cast<double>(saturate(torque_, word)), -torque_.fraction);
  }
  static std::int64_t saturate(Format f, std::int32_t word) {
    const std::int64_t end = std::int64_t{1} << (f.width() - 1);
    return word >= end ? end - 1 : word < -end ? -end : word;
  }

  const law::Compiled& law_;
  Format torque_;
  const LawChanges& changes_;
  std::size_t next_ = 0;
  std::map<std::string, double> values_;  ///< SI
  std::unique_ptr<law::LawRunner> runner_;
};

}  // namespace

std::unique_ptr<LawRider> make_law_rider(const law::Compiled& law, const DesignInfo& design,
                                         const std::string& kind, const LawChanges& changes) {
  if (kind == "fixed") return std::make_unique<FixedLaw>(law, design, changes);
  if (kind == "quad") return std::make_unique<RealLaw<Quad>>(law, design, changes);
  return std::make_unique<RealLaw<double>>(law, design, changes);
}

}  // namespace feltgate
