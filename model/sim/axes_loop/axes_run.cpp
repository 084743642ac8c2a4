// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The closed loop of a device with several axes. Documentation: docs/devices.md
#include "sim/axes_loop/axes_run.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <memory>
#include <optional>
#include <stdexcept>
#include <type_traits>

#include <fmt/format.h>

#include "feltgate/largest.hpp"
#include "files/toml/toml_reader.hpp"
#include "sim/axes_loop/axes_columns.hpp"
#include "sim/axes_loop/homing.hpp"
#include "sim/axes_loop/plane_host.hpp"
#include "sim/loop/felt.hpp"
#include "sim/plant/axes_loop.hpp"
#include "sim/plant/drive.hpp"

namespace feltgate {

namespace {

/// Accumulates one signal, tick by tick.
class SignalRecord {
 public:
  /// For a run of `ticks` ticks.
  explicit SignalRecord(std::int64_t ticks)
      : late_(ticks - ticks / 4), last_(std::min(ticks - 1, ticks - ticks / 10)) {}
  void add(double value) {
    low_ = smaller(low_, value);
    high_ = larger(high_, value);
    if (tick_ >= late_) {
      late_low_ = smaller(late_low_, value);
      late_high_ = larger(late_high_, value);
    }
    if (tick_ >= last_) {
      sum_ += value;
      ++count_;
    }
    ++tick_;
  }
  double low() const { return low_; }
  double high() const { return high_; }
  /// Mean of the last tenth.
  double end() const { return count_ == 0 ? 0.0 : sum_ / static_cast<double>(count_); }
  /// Largest - smallest value in the last quarter.
  double swing() const { return late_high_ < late_low_ ? 0.0 : late_high_ - late_low_; }

 private:
  std::int64_t late_, last_, tick_ = 0, count_ = 0;
  double low_ = 1e300, high_ = -1e300, late_low_ = 1e300, late_high_ = -1e300, sum_ = 0;
};

/// Sums of the energy in both directions.
class HandWork {
 public:
  /// Updates the sums; `work_j` is the plant's present count, J.
  void follow(double work_j) {
    const double more_j = work_j - net_j_;
    net_j_ = work_j;
    (more_j > 0 ? energy_.taken_from_hand_j : given_j_) += more_j;
    energy_.peak_from_hand_j = larger(energy_.peak_from_hand_j, net_j_);
    energy_.peak_to_hand_j = larger(energy_.peak_to_hand_j, -net_j_);
  }
  double net_j() const { return net_j_; }
  FeltEnergy energy() const {
    FeltEnergy energy = energy_;
    energy.given_to_hand_j = 0.0 - given_j_;
    return energy;
  }

 private:
  FeltEnergy energy_;
  double net_j_ = 0, given_j_ = 0;
};

/// The limits that can make the commanded torque differ from the law's.
constexpr unsigned limits_of_torque = limit::torque | limit::ramp | limit::hold | limit::chatter;

void tell_beyond_bounds(AxesResult* r, double torque_lsb_nm) {
  for (std::size_t n = 0; n < r->axes.size(); ++n) {
    const double off_nm = r->axes[n].law_error_nm.max(), bound_nm = r->axes[n].bound_nm;
    if (!std::isfinite(bound_nm)) {
      note_large_error(*r, of_axis("law_error_nm", n), off_nm, r->axes[n].torque.asked.value,
                       torque_lsb_nm);
    }
    if (off_nm <= bound_nm) continue;
    r->broken.push_back(fmt::format(
        "axis {}: the torque is off from the law in {} by {:.4g} Nm, above its proven bound {:.4g} "
        "Nm",
        n, r->reference, off_nm, bound_nm));
  }
}

template <class Plant>
class AxesRun : plant::AxesDevice<Plant> {
 public:
  static constexpr std::size_t axes = Plant::axes;

  AxesRun(const AxesScene& scene, Plant& plant, const AxesRunOptions& options)
      : s_(scene.scenario),
        options_(options),
        choice_(choose_axes_backends(options.engine)),
        plant_(plant),
        host_(make_axes_cores(options.design, choice_.lead, plant.parameters().name, axes)),
        cores_(static_cast<AxesCores&>(host_.backend())),
        design_(cores_.design()),
        session_(s_, host_, options),
        columns_(columns_of<Plant>(scene)) {
    for (const std::string& kind : choice_.riders) {
      riders_.push_back({kind, options.law->rider(kind)});
    }
    if (scene.plane) plane_.emplace(*scene.plane, design_.clock_hz);
    ticks_to_come_ = session_.end() / design_.clocks_per_tick;
    for (std::size_t k = 1; k < columns_.size(); ++k) records_.emplace_back(ticks_to_come_);
    for (std::size_t n = 0; n < axes; ++n) {
      meters_.emplace_back(1.0 / static_cast<double>(design_.tick_hz));
    }
  }

  AxesResult run() {
    const auto began = std::chrono::steady_clock::now();
    if (!options_.fst.empty()) cores_.trace(options_.fst, options_.fst_from, options_.fst_to);
    homed_ = home(cores_, plant_, options_.seed, design_.pwm_period);
    for (const AxesSnapshot& s : cores_.snapshots()) forget_writes(s);
    for (std::size_t n = 0; n < axes; ++n) {
      position_rad_[n] = static_cast<double>(plant_.encoder(n).count()) * design_.count_rad;
    }
    host_.load(*options_.law);
    session_.begin();
    plant::AxesLoop<Plant> loop(plant_, *this, most_clocks);
    const Clock end = session_.end();
    while (plant_.now() < end) {
      const Clock now = plant_.now();
      session_.act(now, plant_.seen().theta_rad[0], position_rad_[0], [](const Event&) {});
      Clock until = std::min(end, session_.next());
      if constexpr (DeviceSignals<Plant>::has_pen) {
        if (plane_) {
          auto words = plane_->act(now, DeviceSignals<Plant>::counted(plant_, position_rad_));
          // The words are limited to the law's ranges.
          for (auto& [name, value] : words) value = options_.law->within(name, value);
          host_.set_parameters(words);
          until = std::min(until, plane_->next());
        }
      }
      loop.run(until, [this](const Plant& p) {
        work_.follow(p.seen().hand_work_j);
        session_.report_progress(p.now());
      });
    }
    // The cores still have to run the clocks of the last step.
    advance_to(plant_.now());
    busy_s_ = std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
    return result();
  }

 private:
  static constexpr Clock most_clocks = 250;
  /// A new duty is in force so many clocks after the start of a PWM period.
  static constexpr Clock duty_clocks = 25;

  struct Rider {
    std::string kind;
    std::unique_ptr<LawRider> law;
  };

  /// Runs the cores to a clock of the plant.
  void advance_to(Clock clock) {
    const Clock clocks = clock + homed_ - cores_.now();
    if (clocks <= 0) return;
    cores_.advance(clocks);
    for (const AxesSnapshot& s : cores_.snapshots()) tick(s);
  }

  // AxesDevice: called by the loop.
  std::array<plant::Bridge, axes> act(const plant::AxesSense<Plant>& sense) override {
    for (std::size_t n = 0; n < axes; ++n) {
      for (EncoderEvent e : sense.events[n]) {
        e.clock += homed_;
        cores_.edge(n, e);
      }
    }
    advance_to(sense.now);
    std::array<plant::Bridge, axes> bridges;
    for (std::size_t n = 0; n < axes; ++n) {
      bridges[n] = plant::Bridge::averaged(cores_.duty(n) / static_cast<double>(design_.pwm_period),
                                           cores_.gates_enabled(n));
    }
    return bridges;
  }
  Clock next(Clock now) const override {
    const Clock since = (now + most_clocks - duty_clocks) % most_clocks;
    return now + most_clocks - since;
  }

  double nm(std::int64_t raw) const {
    return std::ldexp(static_cast<double>(raw), -design_.torque.fraction);
  }

  /// No chain runs beside a device; the host's writes that were carried out are forgotten.
  void forget_writes(const AxesSnapshot& s) {
    host_.chain_inputs(s.data(), [](std::size_t, const HostWrite&) {});
  }
  void ride(const AxesSnapshot& s) {
    const bool in_law = host_.in_law(s[0]);
    kept_nm_ = {};
    for (Rider& r : riders_) {
      if (in_law && !law_entered_) r.law->enter();
      const LawRider::Torques* now_nm = r.law->in_force(s[0]);
      if (now_nm != nullptr && r.kind == reference_) {
        if (in_law) compare(s, *now_nm);
        kept_nm_ = *now_nm;
      }
      for (std::int64_t n = law_changes_; n < s[0].law_changes; ++n) r.law->change();
      r.law->follow(s.data(), nullptr);
    }
    law_entered_ = in_law;
    law_changes_ = std::max(law_changes_, s[0].law_changes);
  }
  void compare(const AxesSnapshot& s, const LawRider::Torques& law_nm) {
    for (std::size_t n = 0; n < axes; ++n) {
      if ((s[n].limits & limits_of_torque) != 0) continue;
      errors_[n].add(nm(s[n].tau_ref) - law_nm[n]);
    }
  }

  void tick(const AxesSnapshot& s) {
    if (session_.ticks() >= ticks_to_come_) return;
    forget_writes(s);
    ride(s);
    unsigned faults = 0;
    row_.clear();
    row_.push_back(static_cast<double>(session_.ticks()) / static_cast<double>(design_.tick_hz));
    for (std::size_t n = 0; n < axes; ++n) {
      const double asked_nm = nm(s[n].tau_ref), motor_nm = plant_.seen().motor_nm[n];
      const double current_a =
          std::ldexp(static_cast<double>(s[n].current_ref), -design_.current.fraction);
      meters_[n].tick(asked_nm, design_.torque_constant_nm_a * current_a, s[n].limits, s[n].faults);
      meters_[n].motor(motor_nm, asked_nm);
      faults |= s[n].faults;
      Row& r = axes_rows_[n];
      r.position_rad = position_rad_[n] = s[n].position * design_.count_rad;
      r.velocity_rad_s = std::ldexp(static_cast<double>(s[n].velocity), -design_.velocity.fraction);
      r.tau_ref_nm = asked_nm;
      r.tau_hat_nm = nm(s[n].tau_hat);
      r.limits = s[n].limits;
      r.faults = s[n].faults;
      r.law_stale = s[0].law_stale;
      row_.insert(row_.end(), {plant_.seen().theta_rad[n], r.position_rad, r.velocity_rad_s,
                               asked_nm, r.tau_hat_nm, motor_nm, kept_nm_[n],
                               static_cast<double>(r.limits), static_cast<double>(r.faults)});
    }
    const bool told = session_.ticks() % options_.row_every == 0;
    DeviceSignals<Plant>::add(plant_, row_);
    if constexpr (DeviceSignals<Plant>::has_pen) {
      if (plane_) plane_->add(plant_.now(), DeviceSignals<Plant>::pen(plant_), row_);
    }
    if constexpr (std::is_same_v<Plant, plant::Pantograph>) {
      if (options_.lead && told) {
        const PenLead to = options_.lead(row_);
        plant_.steer(to.target_m, to.rate_m_s);
      }
    }
    for (std::size_t k = 1; k < row_.size(); ++k) records_[k - 1].add(row_[k]);
    if (options_.row && told) options_.row(row_);
    if (options_.axes) tell_axes();
    session_.tick(s[0], faults);
  }

  /// A plant step ends up to 4 ticks after this tick; within it the signals are treated as straight
  /// lines.
  void tell_axes() {
    const Clock left = plant_.now() - (session_.ticks() + 1) * design_.clocks_per_tick;
    const double back_s = static_cast<double>(left) / static_cast<double>(design_.clock_hz);
    for (std::size_t n = 0; n < axes; ++n) {
      Row& r = axes_rows_[n];
      r.time_s = row_[0];
      r.omega_rad_s = plant_.seen().omega_rad_s[n];
      r.theta_rad = plant_.seen().theta_rad[n] - back_s * r.omega_rad_s;
    }
    options_.axes(axes_rows_);
  }

  AxesResult result() {
    AxesResult out;
    session_.fill_result(out);
    out.device = plant_.parameters().name;
    out.law = options_.law->name();
    out.homing_clocks = homed_;
    out.reference = reference_;
    out.busy_s = busy_s_;
    out.energy = work_.energy();
    for (std::size_t n = 0; n < axes; ++n) {
      const Felt felt = meters_[n].felt();
      out.axes.push_back(
          {felt.torque, felt.limits, felt.faults, errors_[n], options_.law->bound_on_words_nm(n)});
    }
    fill_figures(out);
    session_.check_expectations(out);
    tell_beyond_bounds(&out, std::ldexp(1.0, -design_.torque.fraction));
    return out;
  }

  void fill_figures(AxesResult& out) const {
    auto& f = out.figures;
    if (plane_) plane_->add_figures(f);
    f["law_stale_s"] = out.law_stale.seconds;
    f["hand_energy_j"] = work_.net_j();
    f["hand_energy_least_j"] = 0.0 - out.energy.peak_to_hand_j;
    for (std::size_t n = 0; n < axes; ++n) f[of_axis("law_error_nm", n)] = errors_[n].max();
    for (std::size_t k = 1; k < columns_.size(); ++k) {
      const SignalRecord& r = records_[k - 1];
      f[columns_[k] + ".min"] = r.low();
      f[columns_[k] + ".max"] = r.high();
      f[columns_[k] + ".end"] = r.end();
      f[columns_[k] + ".swing"] = r.swing();
    }
  }

  const Scenario& s_;
  std::optional<PlaneHost> plane_;
  std::array<double, axes> position_rad_ = {};  ///< from the cores' last counts
  const AxesRunOptions& options_;
  BackendChoice choice_;
  std::string reference_ = choice_.reference();
  Plant& plant_;
  RunHost host_;
  AxesCores& cores_;
  const DesignInfo& design_;
  Session session_;
  std::vector<std::string> columns_;
  Clock homed_ = 0;
  std::vector<Rider> riders_;
  bool law_entered_ = false;
  std::int64_t law_changes_ = 1;  ///< parameter sets that the riders know; loading is the first
  LawRider::Torques kept_nm_{};
  std::array<ErrorFigure, axes> errors_;
  std::int64_t ticks_to_come_ = 0;
  std::vector<double> row_;
  std::vector<Row> axes_rows_ = std::vector<Row>(axes);
  std::vector<SignalRecord> records_;
  std::vector<FeltMeter> meters_;
  HandWork work_;
  double busy_s_ = 0;
};

template <class Setup>
AxesResult run_on(const AxesScene& scene, const Setup& setup, const AxesRunOptions& options) {
  const plant::Drive drive = plant::drive_of(design_named(options.design));
  typename Setup::Plant plant(setup.parameters, scene.scenario.effects, drive, setup.hand);
  return AxesRun<typename Setup::Plant>(scene, plant, options).run();
}

}  // namespace

std::vector<std::string> axes_columns(const AxesScene& scene) {
  return std::visit(
      [&](const auto& setup) {
        return columns_of<typename std::decay_t<decltype(setup)>::Plant>(scene);
      },
      scene.device);
}

AxesResult run_axes(const AxesScene& scene, const AxesRunOptions& options) {
  try {
    AxesResult result =
        std::visit([&](const auto& setup) { return run_on(scene, setup, options); }, scene.device);
    result.speed_jumps = speed_jumps(scene);
    return result;
  } catch (const plant::MotionError& error) {
    throw config::ConfigError(scene.scenario.path + ": " + error.what());
  }
}

// Selection of the back-ends of several axes.

BackendChoice choose_axes_backends(const std::string& engines) {
  const BackendChoice all = choose_backends(engines);
  if (all.rider_drives) {
    throw std::invalid_argument("--engine " + engines +
                                ": the motors of several axes are driven by the core; add twin or "
                                "rtl");
  }
  BackendChoice c{all.lead == "twin" ? "twin" : "lockstep", {}, false};
  for (const std::string& rider : all.riders) {
    if (rider == "float" && engines == "all") continue;
    if (rider == "float") {
      throw std::invalid_argument(
          "--engine float: beside several axes runs the law in double and quad; choose these");
    }
    c.riders.push_back(rider);
  }
  return c;
}

std::unique_ptr<AxesCores> make_axes_cores(const std::string& design, const std::string& lead,
                                           const std::string& device, std::size_t axes) {
  const int has = design_named(design).axes;
  if (has == static_cast<int>(axes)) return make_axes_cores(design, lead);
  throw std::invalid_argument(fmt::format(
      "design {} has {} axes and the device {} {}; take one with as many, such as {}_law", design,
      has, device, axes, device));
}

}  // namespace feltgate
