// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// A wrapper of a loop's law that reports the values set by its host: by events of the scene,
// trackers and planes. It forwards everything to the law. Documentation: docs/rates.md
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "axes_loop/axes_law.hpp"
#include "loop/scene_law.hpp"

namespace feltgate::rates {

/// Receives a parameter and its value, rounded to its word, in the unit of the law's file.
using ToldValue = std::function<void(const std::string& name, double value)>;

inline void tell(const ToldValue& told, const SceneLaw& law,
                 const std::map<std::string, double>& values) {
  for (const auto& [name, value] : values) told(name, law.value(name));
}

/// Wrapper for one lever. The law must outlive this object.
class ToldLaw : public SceneLaw {
 public:
  ToldLaw(SceneLaw& law, ToldValue told) : law_(law), told_(std::move(told)) {}
  const std::string& name() const override { return law_.name(); }
  bool compiled() const override { return law_.compiled(); }
  double bound_nm() const override { return law_.bound_nm(); }
  Writes load() const override { return law_.load(); }
  bool has(const std::string& parameter) const override { return law_.has(parameter); }
  std::string unit(const std::string& parameter) const override { return law_.unit(parameter); }
  void check(const std::string& parameter, double value) const override {
    law_.check(parameter, value);
  }
  void check(const std::map<std::string, double>& values) const override { law_.check(values); }
  double value(const std::string& parameter) const override { return law_.value(parameter); }
  Writes set(const std::map<std::string, double>& values) override {
    Writes writes = law_.set(values);
    tell(told_, law_, values);
    return writes;
  }
  bool is_mailbox(const std::string& parameter) const override {
    return law_.is_mailbox(parameter);
  }
  bool has_mailbox() const override { return law_.has_mailbox(); }
  double within(const std::string& parameter, double value) const override {
    return law_.within(parameter, value);
  }
  double period_s() const override { return law_.period_s(); }
  std::pair<std::string, double> event(const LawEvent& told) const override {
    return law_.event(told);
  }
  std::unique_ptr<LawRider> rider(const std::string& kind) const override {
    return law_.rider(kind);
  }
  std::vector<std::string> states() const override { return law_.states(); }
  std::unique_ptr<LawWatch> watch(SceneLaw::Told told) const override {
    return law_.watch(std::move(told));
  }

 private:
  SceneLaw& law_;
  ToldValue told_;
};

/// Wrapper for several axes. The law must outlive this object.
class ToldAxesLaw : public AxesLaw {
 public:
  ToldAxesLaw(AxesLaw& law, ToldValue told) : law_(law), told_(std::move(told)) {}
  const SceneLaw& host() const override { return law_.host(); }
  SceneLaw::Writes set(const std::map<std::string, double>& values) override {
    SceneLaw::Writes writes = law_.set(values);
    tell(told_, law_.host(), values);
    return writes;
  }
  int axes() const override { return law_.axes(); }
  double rate_hz() const override { return law_.rate_hz(); }
  int divider() const override { return law_.divider(); }
  double bound_nm(std::size_t axis) const override { return law_.bound_nm(axis); }
  std::unique_ptr<AxesLawRider> rider(const std::string& kind) const override {
    return law_.rider(kind);
  }

 private:
  AxesLaw& law_;
  ToldValue told_;
};

}  // namespace feltgate::rates
