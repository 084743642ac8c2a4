// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// A compiled law of several axes for a closed loop. Documentation: docs/devices.md
#include "axes_loop/axes_law.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <limits>
#include <stdexcept>
#include <utility>
#include <vector>

#include "feltgate/quad.hpp"
#include "law/compile.hpp"
#include "law/evaluate.hpp"
#include "law_loop/scene_law.hpp"

namespace feltgate {

namespace {

template <class N>
class RealAxesLaw : public AxesLawRider {
 public:
  RealAxesLaw(const law::Compiled& law, const DesignInfo& design, const LawChanges& changes)
      : law_(law), design_(design), changes_(changes), evaluation_(law.law) {}

  void enter() override {
    evaluation_.reset();
    runs_.clear();
  }
  void change() override {
    for (const LawChange& c : changes_.at(next_++)) {
      evaluation_.set_parameter(c.parameter, rounded<N>(law_, c));
    }
  }
  const Torques* torques_nm(const AxesSnapshot& s) override {
    if (!s[0].law_known) return nullptr;
    while (!runs_.empty() && static_cast<std::int32_t>(s[0].law_tick - runs_.front().first) > 0) {
      runs_.pop_front();
    }
    return runs_.empty() || runs_.front().first != s[0].law_tick ? nullptr : &runs_.front().second;
  }
  void follow(const AxesSnapshot& s) override {
    if (!s[0].law_begins) return;
    inputs_.clear();
    for (const law::Input& in : law_.law.inputs) {
      inputs_.push_back(value_of(in.source, s[static_cast<std::size_t>(in.axis)]));
    }
    evaluation_.run(inputs_);
    Torques torques{};
    for (std::size_t n = 0; n < law_.law.outputs.size(); ++n) {
      torques[static_cast<std::size_t>(law_.law.outputs[n].axis)] =
          static_cast<double>(evaluation_.outputs()[n]);
    }
    runs_.emplace_back(s[0].tick, torques);
  }

 private:
  N value_of(law::Source source, const Snapshot& s) const {
    const auto scaled = [](std::int64_t raw, Format f) {
      return static_cast<N>(std::ldexp(static_cast<double>(raw), -f.fraction));
    };
    switch (source) {
      case law::Source::position:
        return static_cast<N>(s.position) * static_cast<N>(design_.count_rad);
      case law::Source::velocity:
        return scaled(s.velocity, design_.velocity);
      case law::Source::tau_hat:
        break;
    }
    return scaled(s.tau_hat, design_.torque);
  }

  const law::Compiled& law_;
  const DesignInfo& design_;
  const LawChanges& changes_;
  std::size_t next_ = 0;
  law::Evaluation<N> evaluation_;
  std::vector<N> inputs_;
  std::deque<std::pair<std::uint32_t, Torques>> runs_;  ///< by the tick of their samples
};

class CompiledAxesLaw : public AxesLaw {
 public:
  CompiledAxesLaw(law::Compiled law, DesignInfo design)
      : law_(std::move(law)), design_(std::move(design)), host_(make_scene_law(law_, design_)) {
    changes_.emplace_back();
    for (std::size_t n = 0; n < law_.law.parameters.size(); ++n) {
      const law::Parameter& p = law_.law.parameters[n];
      if (p.derived < 0 && host_->has(p.name)) note(n);
    }
  }
  const SceneLaw& host() const override { return *host_; }
  SceneLaw::Writes set(const std::map<std::string, double>& values) override {
    SceneLaw::Writes writes = host_->set(values);
    changes_.emplace_back();
    for (std::size_t n = 0; n < law_.law.parameters.size(); ++n) {
      if (values.count(law_.law.parameters[n].name) != 0) note(n);
    }
    return writes;
  }
  int axes() const override { return static_cast<int>(law_.law.outputs.size()); }
  double rate_hz() const override { return law_.rate_hz; }
  int divider() const override { return law_.divider; }
  double bound_nm(std::size_t axis) const override {
    if (!law_.bound.states_bounded || !law_.bound.strips.empty()) {
      return std::numeric_limits<double>::infinity();
    }
    for (std::size_t n = 0; n < law_.law.outputs.size(); ++n) {
      if (law_.law.outputs[n].axis == static_cast<int>(axis)) return law_.bound.output[n];
    }
    return std::numeric_limits<double>::infinity();
  }
  std::unique_ptr<AxesLawRider> rider(const std::string& kind) const override {
    std::unique_ptr<AxesLawRider> made;
    if (kind == "quad") {
      made = std::make_unique<RealAxesLaw<Quad>>(law_, design_, changes_);
    } else {
      made = std::make_unique<RealAxesLaw<double>>(law_, design_, changes_);
    }
    made->change();
    return made;
  }

 private:
  /// Notes the value in force of a parameter, as rounded to its word.
  void note(std::size_t parameter) {
    const law::Parameter& p = law_.law.parameters[parameter];
    changes_.back().push_back({parameter, host_->value(p.name) * p.to_si});
  }

  law::Compiled law_;
  DesignInfo design_;
  std::unique_ptr<SceneLaw> host_;
  LawChanges changes_;
};

}  // namespace

std::unique_ptr<AxesLaw> make_axes_law(const std::string& path, const DesignInfo& design,
                                       int axes) {
  return make_axes_law(law::compile_file(path, law::target_of(design)), path, design, axes);
}

std::unique_ptr<AxesLaw> make_axes_law(law::Compiled law, const std::string& path,
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
  return std::make_unique<CompiledAxesLaw>(std::move(law), design);
}

}  // namespace feltgate
