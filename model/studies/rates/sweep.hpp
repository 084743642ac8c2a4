// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Common parts of the measurement at several rates, for one lever and for a device with several
// axes. Documentation: docs/speed-for-accuracy.md
#pragma once

#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "sim/loop/felt.hpp"
#include "studies/rates/rates.hpp"

namespace feltgate::rates {

/// Below it nothing slides: the springs that hold an axis in the linear loop are that soft.
constexpr double least_slide_1_s = 0.01;

/// Runs one law at all rates, by the virtual run_law().
class Sweep {
 public:
  virtual ~Sweep() = default;

 protected:
  /// `design` is the device's design; `e` must outlive this object.
  Sweep(LawSource source, DesignInfo design, const design::Elaborated& e, const Options& options);

  /// Runs the law at the slower rates, the slowest first, and then at its fastest; `more` runs
  /// follow. Rates for which the law cannot be compiled become notes.
  void sweep(law::Compiled fast, std::size_t more);
  virtual void run_law(law::Compiled law, RateRow row) = 0;

  /// Whether the current row is the last one.
  bool last() const { return report_.rows.size() + 1 == all_; }
  Continuous::Setting setting(const Scenario& scene) const;
  /// A loop's progress as a share of all rows.
  std::function<void(double)> progress() const;
  /// Passes a value that the host has set to the continuous law, also the values set at load.
  void tell(Continuous& continuous, const std::string& name, double value) const;
  void tell_all(Continuous& continuous, const SceneLaw& law) const;
  /// Ticks from the samples of a run to the first tick with its torque.
  int delay_of(const RateRow& row) const;
  /// The same row in the ticks of another design: {every, delay}; nothing: its tick is slower.
  std::optional<std::pair<int, int>> in_ticks_of(const design::Elaborated& e,
                                                 const RateRow& row) const;
  stability::HostLink host_link(double rate_hz, double latency_s, double alpha) const;
  /// Margins of the whole torque, of a law whose springs and masses are states, which has delay
  /// lines, or whose host samples the device; as it runs at each rate.
  using Around = std::function<stability::AxesLoopModel(const Place&, const design::Elaborated&)>;
  void margins_by_states(const Around& around, const Places& places,
                         const stability::HostLink& host, const HostWords& words);
  /// A device that a hand holds off its rest by `offset_rad` and then lets go.
  struct Let {
    Place rest;
    Eigen::VectorXd hand_nm;  ///< what holds the device at rest
    Eigen::VectorXd offset_rad;
    double begin_s = 0, end_s = 0;  ///< of the swing
    int row_every = 1;
  };
  /// Lets the device go with this law, on a linear plant, and shows the angles to `seen`.
  using Swing = std::function<void(
      law::Compiled law, const Let& let,
      const std::function<void(double time_s, const Eigen::VectorXd& angles_rad)>& seen)>;
  /// The margin at rest near the report's place, by the linear loop and by the bits. `give_rad_nm`:
  /// how far the hand's grip gives way, which begins when the hand lets go; 0: a hand without mass.
  GainMargin judged(const std::string& of, const stability::AxesLoopModel& model,
                    const stability::HostLink& host, const HostWords& words, const Swing& swing,
                    double give_rad_nm = 0);
  /// Parameters of a run without what is not linear: the law's at a place, and the core's.
  std::map<std::string, double> linear_parameters(const law::Law& law, const Place& place) const;
  /// Notes the ticks without torque, which are not compared.
  void note_stale(const Acted& stale);
  void note_once(const std::string& note);
  /// Adds the figures of a run to the report.
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

/// Fits the scene's values to an image. At another rate the LSB of a parameter may differ, so its
/// range may end up to one LSB earlier; values beyond that end are moved to it.
Scenario fitted(Scenario scene, const law::Image& image);

}  // namespace feltgate::rates
