// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The closed loop of core, plant and host. Documentation: docs/architecture.md
#include "sim/loop/loop.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <stdexcept>

#include <fmt/format.h>

#include "feltgate/current_sense.hpp"
#include "files/toml/toml_reader.hpp"
#include "sim/backends/absolute_sensor.hpp"
#include "sim/loop/driven_plant.hpp"
#include "sim/loop/ensemble.hpp"
#include "sim/loop/rest.hpp"
#include "sim/loop/scenario_bounds.hpp"
#include "sim/loop/scenario_check.hpp"
#include "sim/loop/step_plan.hpp"
#include "sim/plant/plant.hpp"
#include "sim/traces/capture.hpp"
#include "sim/traces/vector_file.hpp"

namespace feltgate {

namespace {

/// The torques from one step of the reference to the next event.
struct StepRecord {
  double tau_ref_nm;
  StepSamples tau_hat, torque;
  bool tau_hat_void = false;
};

class ScenarioRun : public SteppedRun {
 public:
  ScenarioRun(const Scenario& scenario, const plant::Parameters& plant, const RunOptions& options)
      : s_(scenario),
        options_(options),
        choice_(choose_backends(options.engine)),
        driven_(plant, scenario.effects, scenario.hand, design_named(options.design),
                scenario.switched),
        plant_(driven_.shaft()),
        core_(options.design, choice_, options.seed, plant_.encoder().pins(),
              Waveform{options.fst, options.fst_from, options.fst_to}),
        looped_(core_.design().current_full_scale_a > 0),
        plan_(plan(scenario, plant, core_.design(), choice_)),
        mean_(core_.design().pwm_period, plan_.phase()),
        felt_(1.0 / static_cast<double>(core_.design().tick_hz), looped_),
        session_(scenario, core_, options),
        counter_(plant_.encoder().pins()) {
    if (looped_) check_loop();
    if (choice_.rider_drives && core_.design().phases == 3) {
      throw std::invalid_argument("design " + options.design +
                                  " turns its voltage with three legs, which chains in real "
                                  "arithmetic do not; choose the back-ends rtl,twin");
    }
    last_.theta_rad = plant_.observables().theta_rad;
    if (scenario.effects.encoder_imperfect) {
      for (const double mrad : plant.encoder.absolute_error_mrad) error_rad_.push_back(1e-3 * mrad);
    }
    shown_rad_ = shown_angle(last_.theta_rad, error_rad_);
    if (scenario.rest_from_s) rest_.from_clock = session_.clock_of(*scenario.rest_from_s);
    if (scenario.drag_from_s) drag_.from_clock = session_.clock_of(*scenario.drag_from_s);
  }

  void begin() {
    const DesignInfo& d = core_.design();
    const Clock end = session_.end();
    if (options_.record != nullptr) {
      recorder_ = std::make_unique<traces::VectorWriter>(
          options_.record, "the record of scene " + s_.name,
          traces::VectorHeader{d.name, d.clock_hz, {"A", "B", "Z"}}, plant_.encoder().pins());
    }
    core_.cover(options_.coverage);
    if (options_.law != nullptr) core_.run_law(*options_.law);
    if (options_.law_states) watch_states();
    core_.carry(options_.passenger);
    if (options_.inputs != nullptr) {
      *options_.inputs = {end, plant_.encoder().pins(), {}, {}};
      core_.note_writes(&options_.inputs->writes);
    }
    core_.skip_self_test();
    session_.begin();
  }

  void run_to(Clock clock) override {
    const DesignInfo& d = core_.design();
    const Clock end = session_.end(), to = std::min(clock, end);
    while (core_.lead().now() < to) {
      const Clock now = core_.lead().now();
      session_.act(now, plant_.observables().theta_rad, position_ * d.count_rad,
                   [&](const Event& e) { applied(e); });
      // A request takes effect by the end of its tick, and its consequences by the end of the next.
      if (core_.writes_wait()) plan_.stir(now, 2 * d.clocks_per_tick);
      step(plan_.end_of_step(now, std::min(session_.next(), plant_.next_corner()), end) - now);
      session_.report_progress(now);
    }
  }

  RunResult run() {
    begin();
    run_to(session_.end());
    if (recorder_) recorder_->finish(session_.end() + 1);
    return result();
  }

  void take(const plant::HandPhase& phase) override { plant_.take(phase); }

 private:
  /// Gates and chains in real arithmetic can change within a PWM period; they need equal steps.
  static StepPlan plan(const Scenario& s, const plant::Parameters& plant, const DesignInfo& d,
                       const BackendChoice& choice) {
    if (s.step_given || s.switched || choice.rider_drives) return StepPlan(s.step_clocks);
    return {s, plant, d};
  }

  /// The loop needs the winding's ripple, and a core that measures it.
  void check_loop() const {
    const std::string name = core_.design().name;
    if (choice_.rider_drives) {
      throw std::invalid_argument("design " + name +
                                  " controls a measured current, which chains in real arithmetic "
                                  "do not; choose the back-ends rtl,twin");
    }
    if (!s_.effects.inductance) {
      throw std::invalid_argument(
          "design " + name + " controls a measured current; leave the effect \"inductance\" on");
    }
  }

  void watch_states() {
    if (choice_.lead == "rtl") {
      throw std::invalid_argument(
          "the RTL alone does not show when a law runs; for its states add the twin: --engine all");
    }
    if (options_.law == nullptr) throw std::invalid_argument("the scene has no law with states");
    core_.watch_law(options_.law->watch(options_.law_states));
  }

  void applied(const Event& e) {
    if (e.stop && options_.inputs != nullptr) {
      throw std::invalid_argument("scene " + s_.name +
                                  " uses the stop pin, which recorded inputs do not hold");
    }
    if (e.stop) plan_.stir(core_.lead().now(), 2 * core_.design().clocks_per_tick);
    if (e.open_phase) driven_.open_phase(static_cast<std::size_t>(*e.open_phase));
    end_step();
    if (e.step_nm) {
      step_ = std::make_unique<StepRecord>(StepRecord{*e.step_nm, StepSamples(last_.tau_hat_nm),
                                                      StepSamples(last_.motor_torque_nm)});
    }
  }

  /// Ends a torque step; only its figures are kept.
  void end_step() {
    if (!step_) return;
    const double tick_s = 1.0 / static_cast<double>(core_.design().tick_hz), to = step_->tau_ref_nm;
    steps_.push_back({to, step_->tau_hat.response(tick_s, to), step_->torque.response(tick_s, to),
                      step_->tau_hat_void});
    step_.reset();
  }

  void drive(Clock clocks) {
    const Backend& lead = core_.lead_const();
    if (!choice_.rider_drives) return driven_.advance(lead, last_clocks_, clocks);
    driven_.advance(core_.rider(0)->out().duty_clocks, lead.gates_enabled(), clocks);
  }

  // The bridge state of the last interval drives the motor in this one, so no edge depends on its
  // own future. With a current loop a step is a clock of its modulators, whose edge is the second
  // clock of the step: their bits are of the currents at the end.
  void step(Clock clocks) {
    const plant::Observables& o = plant_.observables();
    before_ = {o.theta_rad, o.omega_rad_s, o.hand_torque_nm, mean_.mean()};
    drive(clocks);
    if (clocks != last_clocks_) {
      longest_step_clocks_ = std::max(longest_step_clocks_, clocks);
      dt_s_ = static_cast<double>(clocks) / static_cast<double>(core_.design().clock_hz);
    }
    last_clocks_ = clocks;
    if (options_.plant_step) options_.plant_step(clocks, o);
    mean_.add(clocks, o.motor_torque_mean_nm);
    felt_.step(dt_s_, o.hand_torque_nm, o.omega_rad_s);
    if (plant_.now() > drag_.from_clock) {
      drag_.step(dt_s_, o.hand_torque_nm, before_.omega_rad_s, o.omega_rad_s);
    }
    const auto& events = plant_.events();
    if (options_.inputs != nullptr) {
      auto& edges = options_.inputs->edges;
      edges.insert(edges.end(), events.begin(), events.end());
    }
    for (const EncoderEvent& e : events) {
      counter_.add(e);
      if (recorder_) recorder_->add(e);
    }
    if (looped_) core_.lead().set_current_bits(driven_.current_bits());
    if (driven_.has_hall()) {
      core_.lead().set_hall(
          driven_.hall(before_.theta_rad, o.theta_rad, plant_.now() - clocks, clocks));
    }
    const double shown_rad = shown_angle(o.theta_rad, error_rad_);
    core_.lead().turn_encoder(shown_rad_, shown_rad, clocks);
    shown_rad_ = shown_rad;
    core_.advance(clocks, events.data(), events.data() + events.size(),
                  [this](const Snapshot& s) { tick(s); });
  }

  /// One tick of the core. A plant step may last several ticks; between its ends the signals are
  /// treated as straight lines.
  void tick(const Snapshot& s) {
    const plant::Observables& o = plant_.observables();
    Row& r = last_;
    const Clock left = plant_.now() - (session_.ticks() + 1) * core_.design().clocks_per_tick;
    const double back =
        left > 0 ? static_cast<double>(left) / static_cast<double>(last_clocks_) : 0.0;
    const auto then = [back](double now, double before) { return now - back * (now - before); };
    const double theta_rad = then(o.theta_rad, before_.theta_rad);
    absorbed_j_ -= r.tau_ref_nm * (theta_rad - r.theta_rad);
    r.theta_rad = theta_rad;
    r.motor_torque_nm = left > 0 ? before_.motor_mean_nm : mean_.mean();
    core_.signals(r, s);
    felt_.tick(r.tau_ref_nm, r.torque_nm, s.limits, s.faults);
    felt_.motor(r.motor_torque_nm, r.tau_ref_nm);
    position_ = s.position;
    if (plant_.now() >= rest_.from_clock) rest_.add(theta_rad, r.tau_ref_nm);
    tau_ref_.add(r.tau_ref_nm);
    tau_hat_.add(r.tau_hat_nm);
    velocity_.add(r.velocity_rad_s);
    theta_.add(r.theta_rad);
    if (step_) {
      step_->tau_hat.add(r.tau_hat_nm);
      step_->torque.add(r.motor_torque_nm);
      step_->tau_hat_void = felt_.tau_hat_void(s.limits);
    }
    if (options_.row && session_.ticks() % options_.row_every == 0) {
      r.time_s =
          static_cast<double>(session_.ticks()) / static_cast<double>(core_.design().tick_hz);
      r.omega_rad_s = then(o.omega_rad_s, before_.omega_rad_s);
      r.hand_torque_nm = then(o.hand_torque_nm, before_.hand_torque_nm);
      r.hand_felt_nm = felt_.hand_nm();
      core_.fill(r, s);
      options_.row(r);
    }
    session_.tick(s, s.faults);
  }

  RunResult result() {
    RunResult out;
    session_.fill_result(out);
    out.longest_step_clocks = longest_step_clocks_;
    out.plant_states = driven_.state_size();
    const traces::Statistics& p = counter_.result();
    out.position = {p.steps, p.illegal, p.reversals};
    out.largest_velocity_rad_s = core_.largest_velocity_rad_s();
    out.reference = choice_.reference();
    out.engines = core_.figures();
    out.felt = felt_.felt();
    out.felt.closed_loop = true;
    end_step();
    for (BackendFigures& e : out.engines) {
      if (closes_loop(e.name)) e.steps = steps_;
    }
    if (options_.law != nullptr) {
      for (const LawEvent& e : core_.lead().law_events()) {
        const auto [name, value] = options_.law->event(e);
        out.events.push_back({e.tick / static_cast<double>(core_.design().tick_hz), name, value});
      }
    }
    fill_figures(out, steps_);
    session_.check_expectations(out);
    return out;
  }

  /// Whether this back-end's duty drove the motor; only its torques are responses to the steps.
  bool closes_loop(const std::string& engine) const {
    return choice_.rider_drives ? engine == choice_.riders[0] : engine == "rtl" || engine == "twin";
  }

  void fill_figures(RunResult& out, const std::vector<StepFigures>& steps) const {
    auto& f = out.figures;
    f["tau_ref_min_nm"] = tau_ref_.low;
    f["tau_ref_max_nm"] = tau_ref_.high;
    f["tau_hat_min_nm"] = tau_hat_.low;
    f["tau_hat_max_nm"] = tau_hat_.high;
    f["velocity_min_rad_s"] = velocity_.low;
    f["velocity_max_rad_s"] = velocity_.high;
    f["theta_min_rad"] = theta_.low;
    f["theta_max_rad"] = theta_.high;
    f["theta_end_rad"] = last_.theta_rad;
    f["tau_ref_end_nm"] = last_.tau_ref_nm;
    f["hand_energy_j"] = out.felt.energy.net_from_hand_j();
    f["energy_absorbed_j"] = absorbed_j_;
    for (const BackendFigures& e : out.engines) {
      if (is_core(e)) f["torque_error_nm"] = e.torque_nm.max();  // RTL and twin are equal
    }
    if (s_.rest_from_s) rest_.tell(f);
    if (s_.drag_from_s) drag_.tell(f);
    std::map<std::string, int> told;
    for (const RunEvent& e : out.events) {
      const int n = told[e.name]++;
      f[fmt::format("event.{}.{}", e.name, n)] = e.value;
      f[fmt::format("event_s.{}.{}", e.name, n)] = e.at_s;
    }
    if (options_.law != nullptr) f["events"] = static_cast<double>(out.events.size());
    for (std::size_t i = 0; i < steps.size(); ++i) {
      const std::string n = fmt::format(".{}", i);
      f["tau_hat_settling_ms" + n] = steps[i].tau_hat.settling_ms;
      f["tau_hat_final_nm" + n] = steps[i].tau_hat.final_value_nm;
      f["tau_hat_final_error_nm" + n] = steps[i].tau_hat.final_value_nm - steps[i].tau_ref_nm;
      f["torque_settling_ms" + n] = steps[i].torque.settling_ms;
      f["torque_final_nm" + n] = steps[i].torque.final_value_nm;
      f["overshoot_pct" + n] = steps[i].torque.overshoot_pct;
      f["final_error_pct" + n] = steps[i].torque.final_error_pct;
    }
  }

  const Scenario& s_;
  const RunOptions& options_;
  BackendChoice choice_;
  DrivenPlant driven_;
  plant::ShaftPlant& plant_;
  Ensemble core_;
  bool looped_;  ///< the core measures the motor's current
  StepPlan plan_;
  plant::PeriodMean mean_;
  FeltMeter felt_;
  Session session_;
  traces::StepCounter counter_;
  std::unique_ptr<traces::VectorWriter> recorder_;
  Clock last_clocks_ = 0;  ///< 0: none yet
  Clock longest_step_clocks_ = 0;
  double dt_s_ = 0;
  /// The plant's outputs at the start of its last step.
  struct {
    double theta_rad = 0, omega_rad_s = 0, hand_torque_nm = 0, motor_mean_nm = 0;
  } before_;
  std::vector<double> error_rad_;  // of an absolute encoder
  double shown_rad_ = 0;           // by it
  double absorbed_j_ = 0;
  SignalRange tau_ref_, tau_hat_, velocity_, theta_;
  std::int32_t position_ = 0;  ///< counts, from the core's last output
  Rest rest_;
  Drag drag_;
  Row last_;
  std::unique_ptr<StepRecord> step_;  ///< the step in progress
  std::vector<StepFigures> steps_;
};

}  // namespace

Scenario as_run(Scenario scenario, const DesignInfo& design) {
  if (design.current_full_scale_a > 0) {
    scenario.switched = scenario.step_given = true;
    scenario.step_clocks = CurrentSense::Parameters{}.divider;
  }
  return scenario;
}

RunResult run_scenario(const Scenario& given, const plant::Parameters& plant,
                       const RunOptions& options) {
  const Scenario scenario = as_run(given, design_named(options.design));
  check_scenario(scenario, plant, design_named(options.design), options.law);
  try {
    return ScenarioRun(scenario, plant, options).run();
  } catch (const plant::MotionError& error) {
    throw config::ConfigError(scenario.path.empty() ? error.what()
                                                    : scenario.path + ": " + error.what());
  }
}

std::unique_ptr<SteppedRun> stepped_run(const Scenario& scenario, const plant::Parameters& plant,
                                        const RunOptions& options) {
  check_scenario(scenario, plant, design_named(options.design), options.law);
  auto run = std::make_unique<ScenarioRun>(scenario, plant, options);
  run->begin();
  return run;
}

// The events of a law as FUDI, for Pure Data.

namespace {

/// The digits at the end of a name; may be empty.
std::string number_of(const std::string& name) {
  const auto last = name.find_last_not_of("0123456789");
  return last == std::string::npos ? "" : name.substr(last + 1);
}

}  // namespace

std::string event_lines(const std::vector<RunEvent>& events, double run_s) {
  std::string text;
  double before_s = 0;
  for (std::size_t i = 0; i < events.size();) {
    const RunEvent& first = events[i];
    const std::string number = number_of(first.name);
    text += fmt::format("{:.3f} {}", 1e3 * (first.at_s - before_s),
                        first.name.substr(0, first.name.size() - number.size()));
    if (!number.empty()) text += " " + number;
    before_s = first.at_s;
    for (std::size_t k = i; i < events.size(); ++i) {
      const RunEvent& e = events[i];
      const bool together =
          i == k || (e.at_s - first.at_s < run_s && !number.empty() && number_of(e.name) == number);
      if (!together) break;
      text += fmt::format(" {:.6g}", e.value);
    }
    text += ";\n";
  }
  return text;
}

}  // namespace feltgate
