// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The closed loop of a device with several axes. Documentation: docs/devices.md
#include "axes_loop/axes_run.hpp"

#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <map>
#include <memory>
#include <optional>
#include <stdexcept>
#include <type_traits>

#include "axes_loop/axes_columns.hpp"
#include "axes_loop/axes_engines.hpp"
#include "axes_loop/hand_work.hpp"
#include "axes_loop/homing.hpp"
#include "axes_loop/plane_host.hpp"
#include "axes_loop/signal_record.hpp"
#include "config/toml_reader.hpp"
#include "feltgate/axes_ports.hpp"
#include "loop/expectations.hpp"
#include "loop/feed_clock.hpp"
#include "loop/scenario_check.hpp"
#include "plant/axes_loop.hpp"
#include "plant/drive.hpp"

namespace feltgate {

namespace {

/// The limits that can make the commanded torque differ from the law's.
constexpr unsigned limits_of_torque = limit::torque | limit::ramp | limit::hold | limit::chatter;

void tell_beyond_bounds(AxesResult* r) {
  for (std::size_t n = 0; n < r->axes.size(); ++n) {
    const double off_nm = r->axes[n].law_error_nm.max(), bound_nm = r->axes[n].bound_nm;
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
        choice_(choose_axes_engines(options.engine)),
        plant_(plant),
        cores_(make_axes_cores(options.design, choice_.lead, plant.parameters().name, axes)),
        design_(cores_->design()),
        columns_(columns_of<Plant>(scene)),
        scene_(scene_number(design_, s_.scene)),
        mode_(s_.mode),
        feed_(s_.feed_hz, design_.clock_hz) {
    for (const std::string& kind : choice_.riders) {
      riders_.push_back({kind, options.law->rider(kind), nullptr});
    }
    if (scene.plane) plane_.emplace(*scene.plane, design_.clock_hz);
    ticks_to_come_ = clock_of(s_.duration_s) / design_.clocks_per_tick;
    for (std::size_t k = 1; k < columns_.size(); ++k) records_.emplace_back(ticks_to_come_);
    for (std::size_t n = 0; n < axes; ++n) {
      meters_.emplace_back(1.0 / static_cast<double>(design_.tick_hz));
    }
  }

  AxesResult run() {
    const auto began = std::chrono::steady_clock::now();
    if (!options_.fst.empty()) cores_->trace(options_.fst, options_.fst_from, options_.fst_to);
    homed_ = home(*cores_, plant_, options_.seed, design_.pwm_period);
    for (std::size_t n = 0; n < axes; ++n) {
      position_rad_[n] = static_cast<double>(plant_.encoder(n).count()) * design_.count_rad;
    }
    for (const auto& [address, data] : options_.law->host().load()) cores_->write(address, data);
    set_parameters(s_.parameters);
    control(false);
    plant::AxesLoop<Plant> loop(plant_, *this, most_clocks);
    const Clock end = clock_of(s_.duration_s);
    std::size_t next = 0;
    const Clock arm_at = clock_of(s_.arm_s);
    while (plant_.now() < end) {
      const Clock now = plant_.now();
      if (!arm_done_ && now >= arm_at) {
        arm_done_ = true;
        control(true);
      }
      while (next < s_.events.size() && now >= clock_of(s_.events[next].at_s)) {
        apply(s_.events[next++]);
      }
      if (feed_.due(now)) write_law({});
      Clock until = std::min(end, feed_.next());
      if constexpr (DeviceSignals<Plant>::has_pen) {
        if (plane_) {
          auto words = plane_->act(now, DeviceSignals<Plant>::counted(plant_, position_rad_));
          // The words are limited to the law's ranges.
          for (auto& [name, value] : words) value = options_.law->host().within(name, value);
          set_parameters(words);
          until = std::min(until, plane_->next());
        }
      }
      if (!arm_done_) until = std::min(until, arm_at);
      if (next < s_.events.size()) until = std::min(until, clock_of(s_.events[next].at_s));
      loop.run(until, [this](const Plant& p) { stepped(p); });
    }
    // The cores still have to run the clocks of the last step.
    cores_->advance(plant_.now() + homed_ - cores_->now());
    for (const AxesSnapshot& s : cores_->snapshots()) tick(s);
    if (options_.progress) options_.progress(1.0);
    busy_s_ = std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
    return result(end);
  }

 private:
  static constexpr Clock most_clocks = 250;
  /// A new duty is in force so many clocks after the start of a PWM period.
  static constexpr Clock duty_clocks = 25;

  struct Rider {
    std::string kind;
    std::unique_ptr<AxesLawRider> law;
    const AxesLawRider::Torques* now_nm;
  };

  Clock clock_of(double seconds) const {
    return std::llround(std::min(seconds * static_cast<double>(design_.clock_hz), 0x1p62));
  }

  void write_all(int address, std::uint32_t data) {
    for (int n = 0; n < static_cast<int>(axes); ++n) {
      cores_->write(n * axes_stride + address, data);
    }
  }
  void set_parameters(const std::map<std::string, double>& settings) {
    std::map<std::string, double> of_law;
    for (const auto& [name, value] : settings) {
      if (options_.law->host().has(name)) {
        of_law[name] = value;
        continue;
      }
      const ParameterInfo* info = design_.find(name);
      if (info == nullptr) throw std::invalid_argument(design_.unknown(name));
      write_all(info->address, static_cast<std::uint32_t>(quantise_parameter(*info, value)));
    }
    if (!of_law.empty()) write_law(of_law);
  }
  /// Writes words of the law, and a commit; empty: sends the present values again.
  void write_law(const std::map<std::string, double>& values) {
    for (const auto& [address, data] : options_.law->set(values)) cores_->write(address, data);
  }
  void control(bool arm) {
    armed_ = arm;
    const ControlBits& bits = design_.control;
    std::uint32_t word = design_.control_reset | 1u << bits.host;
    if (arm) word |= 1u << bits.arm;
    word |= static_cast<std::uint32_t>(scene_) << bits.scene;
    word |= static_cast<std::uint32_t>(mode_) << bits.mode;
    write_all(design_.control_address, word);
  }
  void apply(const Event& e) {
    set_parameters(e.set);
    if (e.stop) cores_->stop(*e.stop);
    if (!e.scene && !e.mode && !e.arm) return;
    if (e.scene) scene_ = scene_number(design_, *e.scene);
    if (e.mode) mode_ = *e.mode;
    control(e.arm.value_or(armed_));
  }

  // AxesDevice: called by the loop.
  plant::AxesCommand<axes> act(const plant::AxesSense<Plant>& sense) override {
    for (std::size_t n = 0; n < axes; ++n) {
      for (EncoderEvent e : sense.events[n]) {
        e.clock += homed_;
        cores_->edge(n, e);
      }
    }
    if (const Clock clocks = sense.now + homed_ - cores_->now(); clocks > 0) {
      cores_->advance(clocks);
      for (const AxesSnapshot& s : cores_->snapshots()) tick(s);
    }
    plant::AxesCommand<axes> command;
    for (std::size_t n = 0; n < axes; ++n) {
      command.bridges[n] = plant::Bridge::averaged(
          cores_->duty(n) / static_cast<double>(design_.pwm_period), cores_->gates_enabled(n));
    }
    return command;
  }
  Clock next(Clock now) const override {
    const Clock since = (now + most_clocks - duty_clocks) % most_clocks;
    return now + most_clocks - since;
  }

  void stepped(const Plant& p) {
    work_.follow(p.seen().hand_work_j);
    if (options_.progress && p.now() >= next_report_) {
      options_.progress(p.seconds() / s_.duration_s);
      next_report_ = p.now() + design_.clock_hz / 100;
    }
  }

  double nm(std::int64_t raw) const {
    return std::ldexp(static_cast<double>(raw), -design_.torque.fraction);
  }

  void ride(const AxesSnapshot& s) {
    const bool in_law = s[0].armed && design_.scene_number("law") == s[0].scene;
    if (in_law && s[0].law_stale && stale_ticks_++ == 0) stale_from_ = ticks_;
    kept_nm_ = {};
    for (Rider& r : riders_) {
      if (in_law && !law_entered_) r.law->enter();
      r.now_nm = r.law->torques_nm(s);
      if (in_law && r.now_nm != nullptr && r.kind == choice_.reference) compare(s, *r.now_nm);
      if (r.now_nm != nullptr && r.kind == choice_.reference) kept_nm_ = *r.now_nm;
      for (std::int64_t n = law_changes_; n < s[0].law_changes; ++n) r.law->change();
      r.law->follow(s);
    }
    law_entered_ = in_law;
    law_changes_ = std::max(law_changes_, s[0].law_changes);
  }
  void compare(const AxesSnapshot& s, const AxesLawRider::Torques& law_nm) {
    for (std::size_t n = 0; n < axes; ++n) {
      if ((s[n].limits & limits_of_torque) != 0) continue;
      errors_[n].add(nm(s[n].tau_ref) - law_nm[n]);
    }
  }

  void tick(const AxesSnapshot& s) {
    if (ticks_ >= ticks_to_come_) return;
    ride(s);
    row_.clear();
    row_.push_back(static_cast<double>(ticks_) / static_cast<double>(design_.tick_hz));
    for (std::size_t n = 0; n < axes; ++n) {
      const double asked_nm = nm(s[n].tau_ref), motor_nm = plant_.seen().motor_nm[n];
      const double current_a =
          std::ldexp(static_cast<double>(s[n].current_ref), -design_.current.fraction);
      meters_[n].tick(asked_nm, design_.torque_constant_nm_a * current_a, s[n].limits, s[n].faults);
      meters_[n].motor(motor_nm, asked_nm);
      faults_ |= s[n].faults;
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
    const bool told = ticks_ % options_.row_every == 0;
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
    ++ticks_;
  }

  /// A plant step ends up to 4 ticks after this tick; within it the signals are treated as straight
  /// lines.
  void tell_axes() {
    const Clock left = plant_.now() - (ticks_ + 1) * design_.clocks_per_tick;
    const double back_s = static_cast<double>(left) / static_cast<double>(design_.clock_hz);
    for (std::size_t n = 0; n < axes; ++n) {
      Row& r = axes_rows_[n];
      r.time_s = row_[0];
      r.omega_rad_s = plant_.seen().omega_rad_s[n];
      r.theta_rad = plant_.seen().theta_rad[n] - back_s * r.omega_rad_s;
    }
    options_.axes(axes_rows_);
  }

  AxesResult result(Clock end) {
    AxesResult out;
    out.design = design_.name;
    out.subject = s_.name;
    out.device = plant_.parameters().name;
    out.law = options_.law->host().name();
    out.clocks = end;
    out.homing_clocks = homed_;
    out.ticks = ticks_;
    out.lock_step = choice_.lead == "lockstep";
    out.mismatches = cores_->mismatches();
    out.first_mismatch = cores_->first_mismatch();
    out.first_mismatch_clock = cores_->first_mismatch_clock();
    out.reference = choice_.reference;
    out.simulated_s = static_cast<double>(end) / static_cast<double>(design_.clock_hz);
    out.busy_s = busy_s_;
    out.energy = work_.energy();
    const double tick_s = 1.0 / static_cast<double>(design_.tick_hz);
    out.law_stale = {static_cast<double>(stale_ticks_) * tick_s,
                     static_cast<double>(stale_from_) * tick_s};
    for (std::size_t n = 0; n < axes; ++n) {
      const Felt felt = meters_[n].felt();
      out.axes.push_back(
          {felt.torque, felt.limits, felt.faults, errors_[n], options_.law->bound_nm(n)});
    }
    fill_figures(out);
    ExpectationsHeld held = hold_expectations(s_, out.design, out.figures);
    out.expectations = std::move(held.all);
    out.broken = std::move(held.broken);
    tell_beyond_bounds(&out);
    return out;
  }

  void fill_figures(AxesResult& out) const {
    auto& f = out.figures;
    if (plane_) plane_->add_figures(f);
    f["mismatches"] = static_cast<double>(out.mismatches);
    f["faults"] = faults_;
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
  AxesEngines choice_;
  Plant& plant_;
  std::unique_ptr<AxesCores> cores_;
  const DesignInfo& design_;
  std::vector<std::string> columns_;
  int scene_, mode_;
  bool armed_ = false, arm_done_ = false;
  Clock homed_ = 0, next_report_ = 0;
  FeedClock feed_;
  std::vector<Rider> riders_;
  bool law_entered_ = false;
  std::int64_t law_changes_ = 1;  ///< parameter sets that the riders know; loading is the first
  AxesLawRider::Torques kept_nm_{};
  std::array<ErrorFigure, axes> errors_;
  std::int64_t ticks_ = 0, ticks_to_come_ = 0, stale_ticks_ = 0, stale_from_ = 0;
  std::vector<double> row_;
  std::vector<Row> axes_rows_ = std::vector<Row>(axes);
  std::vector<SignalRecord> records_;
  std::vector<FeltMeter> meters_;
  int faults_ = 0;
  HandWork work_;
  double busy_s_ = 0;
};

template <class Setup>
AxesResult run_on(const AxesScene& scene, const Setup& setup, const AxesRunOptions& options) {
  const AxesDesignMakers* d = find_axes_design(options.design);
  const plant::Drive drive = d == nullptr ? plant::Drive{} : plant::drive_of(d->info());
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

}  // namespace feltgate
