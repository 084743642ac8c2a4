// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// What the rates of one lever and those of a device with several axes have in common.
// Documentation: docs/rates.md
#pragma once

#include <map>
#include <string>
#include <vector>

#include "loop/felt.hpp"
#include "rates/rates.hpp"

namespace feltgate::rates {

/// One law at all rates, by the virtual run_law().
class Sweep {
 public:
  virtual ~Sweep() = default;

 protected:
  /// `design` is that of the device; `e` must outlive this.
  Sweep(LawSource source, DesignInfo design, const design::Elaborated& e, const Options& options);

  /// Runs the law at the rates that are slower than its fastest, the slowest first, then at that;
  /// `more` runs follow. Rates at which it cannot be compiled become notes.
  void sweep(law::Compiled fast, std::size_t more);
  virtual void run_law(law::Compiled law, RateRow row) = 0;

  /// Whether the row under way is the last of all.
  bool last() const { return report_.rows.size() + 1 == all_; }
  Continuous::Setting setting(const Scenario& scene) const;
  /// A loop's progress as a share of all rows.
  std::function<void(double)> progress() const;
  /// What the host has set, for the continuous law; and all that the law was loaded with.
  void tell(Continuous& continuous, const std::string& name, double value) const;
  void tell_all(Continuous& continuous, const SceneLaw& law) const;
  /// From the samples of a run to the first tick in which its torque is in force.
  int delay_of(const RateRow& row) const;
  /// Ticks without torque, which are not compared.
  void note_stale(const Acted& stale);
  void note_once(const std::string& note);
  /// Takes the figures of a run over.
  void add(RateRow row, const Continuous& continuous, const Continuous::Setting& setting);

  LawSource source_;
  DesignInfo design_;
  const design::Elaborated& e_;
  const Options& options_;
  law::Target target_;
  law::Law continuous_law_;
  int every_ = 1;
  Report report_;

 private:
  void leave_out(int ticks, const std::string& reason);
  RateRow row_of(const law::Compiled& law, int ticks) const;

  std::size_t all_ = 0;
};

/// At another rate a parameter may have another step, and its range ends up to a step earlier: what
/// the scene sets there is moved to the end.
Scenario fitted(Scenario scene, const law::Image& image);

/// The first of these faults, with its time; empty: none.
std::string first_fault(const std::map<std::string, Acted>& faults);

}  // namespace feltgate::rates
