// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// A core with its riders: queues register writes for all of them and collects their errors against
// the most exact one. Used by closed loop and replay. Documentation: docs/architecture.md
#pragma once

#include <deque>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "sim/backends/sampled_watch.hpp"
#include "sim/loop/loop.hpp"
#include "sim/loop/run_host.hpp"
#include "studies/bounds/coverage.hpp"

namespace feltgate {

/// A waveform file of the clocks [from, to]; to < 0: to the end; empty path: none.
struct Waveform {
  std::string path;
  Clock from = 0, to = -1;
};

/// A leading core, and chains in real arithmetic on its samples.
class Ensemble final : public RunHost {
 public:
  Ensemble(const std::string& design, const BackendChoice& choice, std::uint64_t seed,
           EncoderPins pins, const Waveform& waveform);

  Backend& lead() { return *lead_; }
  const Backend& lead_const() const { return *lead_; }

  /// Loads a law and lets the riders run it: RunHost::load().
  void run_law(SceneLaw& law);
  /// Sets an observer of the law that run_law() has loaded; nullptr: none.
  void watch_law(std::unique_ptr<LawWatch> watch) { watch_ = std::move(watch); }
  /// Appends every later write to `log`.
  void note_writes(std::vector<HostWrite>* log) { log_ = log; }
  /// From the next tick on, also collects the errors of the ticks that `coverage` covers,
  /// separately.
  void cover(const bounds::Coverage* coverage) {
    covers_ = coverage != nullptr;
    if (covers_) coverage_ = *coverage;
  }
  /// Sets what the caller carries along; nullptr: nothing.
  void carry(Passenger* passenger) { passenger_ = passenger; }

  /// Advances the core, then the riders on each new snapshot; calls `each` with every snapshot.
  template <class Each>
  void advance(Clock clocks, const EncoderEvent* first, const EncoderEvent* last, Each&& each) {
    lead_watch_.time([&] { lead_->advance(clocks, first, last); });
    for (const Snapshot& s : lead_->snapshots()) {
      ride(s);
      each(s);
    }
  }

  /// The signals, in the tick of `s`, of the back-end that drives the motor; voltage and duty are
  /// missing, since only a row of output needs them: fill().
  void signals(BackendSignals& e, const Snapshot& s) const {
    if (choice_.rider_drives) {
      e = of_chain(riders_[0].chain->out());
      return;
    }
    e.velocity_rad_s = velocity_rad_s(s);
    e.tau_ref_nm = torque_nm(s.tau_ref);
    e.tau_hat_nm = torque_nm(s.tau_hat);
    e.current_a = current_a(s);
    e.torque_nm = design().torque_constant_nm_a * e.current_a;
  }
  /// Fills a row: position, limits, faults and the signals of every back-end in the tick of `s`.
  void fill(Row& row, const Snapshot& s) const;
  const BackendChoice& choice() const { return choice_; }
  const RealChain* rider(std::size_t i) const { return riders_[i].chain.get(); }

  double velocity_rad_s(const Snapshot& s) const {
    return static_cast<double>(s.velocity) * unit_.velocity_rad_s;
  }
  double torque_nm(std::int64_t raw) const { return static_cast<double>(raw) * unit_.torque_nm; }
  double current_a(const Snapshot& s) const {
    return static_cast<double>(s.current_ref) * unit_.current_a;
  }
  double voltage_v(const Snapshot& s) const {
    return static_cast<double>(s.voltage) * unit_.voltage_v;
  }

  /// Largest |N-method velocity| that the riders saw before the low-pass, rad/s.
  double largest_velocity_rad_s() const { return largest_counts_ * design().rad_s_per_count; }

  /// Error and speed figures of all back-ends; the steps are empty.
  std::vector<BackendFigures> figures() const;

 private:
  struct Rider {
    std::unique_ptr<RealChain> chain;
    std::unique_ptr<LawRider> law;  ///< for a scene with a law
    BackendFigures figures;
    SampledWatch watch;
  };
  /// Value of a signal's last bit: a power of two, so that the product is exact.
  struct Units {
    double velocity_rad_s = 0, torque_nm = 0, current_a = 0, voltage_v = 0;
  };

  BackendSignals of_core(const Snapshot& s) const;
  BackendSignals of_chain(const ChainOut& o) const;
  void write(const HostWrite& w) override;
  void ride(const Snapshot& s);
  void follow_law(Rider& r, const Snapshot& s) const;
  void watch_velocity(std::int16_t travel);
  void check_coverage(const Snapshot& s);
  void compare(BackendFigures& f, double velocity_rad_s, double tau_hat_nm, double current_a);

  BackendChoice choice_;
  Backend* lead_;
  Units unit_;
  std::vector<Rider> riders_;
  const RealChain* reference_ = nullptr;
  Passenger* passenger_ = nullptr;
  bounds::Coverage coverage_;
  bool covers_ = false;
  std::deque<std::int16_t> window_;  ///< travel at the last m1 ticks
  int largest_counts_ = 0;
  std::unique_ptr<LawWatch> watch_;
  std::int64_t law_changes_ = 1;  ///< parameter sets that the riders know; loading is the first
  bool law_entered_ = false;
  std::vector<HostWrite>* log_ = nullptr;
  BackendFigures lead_figures_;
  SampledWatch lead_watch_;
};

}  // namespace feltgate
