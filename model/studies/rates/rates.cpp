// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Documentation: docs/speed-for-accuracy.md
#include "studies/rates/rates.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <ctime>
#include <memory>
#include <optional>
#include <stdexcept>
#include <utility>

#include "sim/law_loop/scene_law.hpp"
#include "sim/loop/loop.hpp"
#include "studies/rates/sweep.hpp"

namespace feltgate::rates {

namespace {

void require_one_axis(const law::Compiled& law, const LawSource& source) {
  int axes = 0;
  for (const law::Output& o : law.law.outputs) axes = std::max(axes, o.axis);
  for (const law::Input& i : law.law.inputs) axes = std::max(axes, i.axis);
  if (axes == 0) return;
  throw std::invalid_argument(
      fmt::format("{}: a law of {} axes, and rates runs one lever; choose "
                  "a scene whose law has one axis",
                  source.path, axes + 1));
}

class LeverSweep : public Sweep {
 public:
  LeverSweep(const Scenario& scene, const LawSource& source, const plant::Parameters& plant,
             const design::Elaborated& e, const Options& options)
      : Sweep(source, design_named(law_of(scene, options)), e, options),
        scene_(scene),
        plant_(plant),
        block_(block_law(scene.scene)),
        on_block_(options.design.empty() ? block_design : options.design),
        on_law_(law_of(scene, options)) {
    require_one_law(scene);
    scene_.expectations.clear();
    of_law_ = block_ != nullptr ? as_law(scene_, *block_, design_named(on_block_)) : scene_;
  }

  Report run() {
    law::Compiled fast = fastest(source_, target_);
    require_one_axis(fast, source_);
    report_.scene = scene_.name;
    report_.title = scene_.title;
    report_.law = block_ != nullptr && block_->file.empty() ? block_->scene : fast.law.name;
    report_.plant = plant_.name;
    report_.simulated_s = scene_.duration_s;
    sweep(std::move(fast), block_ != nullptr ? 1 : 0);
    if (block_ != nullptr) run_block();
    if (whole_torque()) {
      margins_by_states(
          [this](const Place&, const design::Elaborated& e) {
            return stability::make_axes_model(e, linear_plant());
          },
          places_, link(), words());
      if (options_.gains && report_.place) judge();
    } else {
      margins();
    }
    return report_;
  }

 private:
  static std::string law_of(const Scenario& scene, const Options& options) {
    return options.design.empty() || block_law(scene.scene) != nullptr ? law_design
                                                                       : options.design;
  }

  void run_law(law::Compiled law, RateRow row) override {
    const Scenario scene = fitted(of_law_, law.image);
    const std::unique_ptr<SceneLaw> loaded = make_scene_law(std::move(law), design_);
    run(scene, on_law_, loaded.get(), row);
  }

  void run_block() {
    RateRow row;
    row.block = true;
    run(scene_, on_block_, nullptr, row);
  }

  void run(const Scenario& scene, const std::string& design, SceneLaw* law, RateRow row) {
    Continuous::Setting set = setting(scene);
    set.slope = set.floor = row.block || (block_ == nullptr && last());
    set.places = set.floor;
    set.words = words();
    for (std::size_t n = 0; set.floor && n < options_.beside.size(); ++n) {
      set.beside.push_back(estimator(options_.beside[n], design_named(design)));
    }
    // A law's parameter is what its word says, so its rounding is no error.
    Continuous continuous(
        continuous_law_,
        law == nullptr ? changes_of(of_law_, continuous_law_) : std::vector<Change>{}, set);
    RunOptions o;
    o.design = design;
    o.engine = options_.lock_step ? "rtl,twin" : "twin";
    if (law != nullptr) {
      tell_all(continuous, *law);
      law->tell_values(
          [&](const std::string& name, double value) { tell(continuous, name, value); });
      o.law = law;
    }
    o.row_every = 1;
    o.row = [&](const Row& r) { continuous.tick(r); };
    o.progress = progress();
    const RunResult result = run_scenario(scene, plant_, o);
    if (law != nullptr) law->tell_values({});
    row.mismatches = result.mismatches;
    row.clocks_compared = result.lock_step ? result.clocks : 0;
    row.first_mismatch = result.first_mismatch;
    row.fault = first_fault(result.felt.faults);
    if (row.fault.empty()) note_stale(result.law_stale);
    row.cpu_s_per_s = cpu_s(scene, design, law) / result.simulated_s;
    if (set.places) places_ = continuous.places();
    for (std::size_t n = 0; n < set.beside.size(); ++n) {
      report_.beside.push_back({options_.beside[n].design.path, continuous.beside(n), {}});
    }
    add(std::move(row), continuous, set);
  }

  Estimator estimator(const design::Elaborated& e, const DesignInfo& of_run) const {
    const stability::LinearLoop loop = stability::make_linear_loop(e, linear_plant());
    const auto every = std::lround(loop.tick_s * static_cast<double>(of_run.tick_hz));
    return {std::max(1, static_cast<int>(every)), loop.m1, loop.raw_rad_s_rad, loop.velocity_a1};
  }

  /// CPU time of the closed loop alone, without observers.
  double cpu_s(const Scenario& scene, const std::string& design, SceneLaw* law) const {
    RunOptions o;
    o.design = design;
    o.engine = "twin";
    o.law = law;
    const std::clock_t begin = std::clock();
    run_scenario(scene, plant_, o);
    return static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
  }

  bool whole_torque() const {
    return options_.whole_torque || !continuous_law_.lines.empty() || scene_.tracker ||
           places_.any_states() || keeps_time(source_);
  }

  /// What the tracker's host makes of its samples.
  HostWords words() const {
    if (!scene_.tracker) return {};
    const auto index = [&](const std::string& name) {
      const auto& all = continuous_law_.parameters;
      const auto at = std::find_if(all.begin(), all.end(),
                                   [&](const law::Parameter& p) { return p.name == name; });
      return static_cast<std::size_t>(at - all.begin());
    };
    const std::size_t angle = index(scene_.tracker->mailbox);
    const bool both = !scene_.tracker->encoder_mailbox.empty();
    const std::size_t encoder = both ? index(scene_.tracker->encoder_mailbox) : angle;
    return [=](const Eigen::VectorXd& filtered, const Eigen::VectorXd& sampled,
               law::Evaluation<double>& law) {
      law.set_parameter(angle, filtered[0]);
      if (both) law.set_parameter(encoder, sampled[0]);
    };
  }
  stability::HostLink link() const {
    if (!scene_.tracker) return {};
    const TrackerSettings& t = *scene_.tracker;
    return host_link(t.rate_hz, t.latency_s, t.alpha);
  }

  /// Without a hand, and with the scene's if it has a mass.
  void judge() {
    const auto swings = [&](const plant::HandPhase* hand) {
      return [this, hand](law::Compiled law, const Let& let, const auto& seen) {
        swing(std::move(law), let, hand, seen);
      };
    };
    report_.gains.push_back(judged("alone", stability::make_axes_model(e_, linear_plant()), link(),
                                   words(), swings(nullptr)));
    const auto& phases = scene_.hand.phases;
    if (phases.empty() || phases.back().kind != plant::HandPhase::Kind::kImpedance) return;
    const plant::HandDynamics hand = plant::dynamics_of(phases.back().impedance, hand_radius_m());
    report_.gains.push_back(
        judged("with the scene's hand", stability::make_axes_model(e_, linear_plant(), &hand),
               link(), words(), swings(&phases.back()), 1 / hand.grip_stiffness_nm_rad));
  }
  double hand_radius_m() const { return scene_.hand.radius_m.value_or(plant_.lever.radius_m); }

  void swing(law::Compiled law, const Let& let, const plant::HandPhase* hand,
             const std::function<void(double, const Eigen::VectorXd&)>& seen) {
    using Phase = plant::HandPhase;
    using Segment = plant::Segment;
    Scenario s;
    s.name = s.path = scene_.name;
    s.duration_s = let.end_s;
    s.scene = "law";
    s.law = law.law.name;
    s.arm_s = 0.01;
    s.parameters = linear_parameters(law.law, let.rest);
    s.parameters.insert(of_law_.parameters.begin(), of_law_.parameters.end());  // such as a cut-off
    s.tracker = scene_.tracker;
    if (s.tracker) s.tracker->noise_rad = s.tracker->resolution_rad = 0;
    const auto& all = law.law.parameters;
    const bool mailbox =
        std::any_of(all.begin(), all.end(), [](const auto& p) { return p.mailbox; });
    if (mailbox && !s.tracker) s.feed_hz = 500;
    const plant::Parameters plant = linear_plant();
    s.effects = plant.effects;
    s.effects.lugre = s.effects.dead_voltage = s.effects.dead_time = false;
    s.effects.supply_limit = s.effects.encoder_imperfect = false;
    s.effects.hand_dynamics = true;
    const double held_rad = let.rest.inputs[0] + let.offset_rad[0];
    Phase bring;
    bring.kind = Phase::Kind::kPrescribed;
    bring.duration_s = let.begin_s;
    bring.profile = {{Segment::Kind::kHold, 0.02}, {Segment::Kind::kMinimumJerk, 0.1, held_rad}};
    Phase free;
    free.kind = Phase::Kind::kTorque;
    double to = let.hand_nm[0];
    if (hand != nullptr) {
      free.kind = Phase::Kind::kImpedance;
      free.impedance = hand->impedance;
      const plant::HandDynamics d = plant::dynamics_of(hand->impedance, hand_radius_m());
      to = let.rest.inputs[0] + to * (1 / d.stiffness_nm_rad + 1 / d.grip_stiffness_nm_rad);
    }
    free.profile = {{Segment::Kind::kStep, 1, to}};
    s.hand.radius_m = scene_.hand.radius_m;
    s.hand.phases = {bring, free};
    s = fitted(std::move(s), law.image);
    const std::unique_ptr<SceneLaw> loaded = make_scene_law(std::move(law), design_);
    RunOptions o;
    o.design = on_law_;
    o.engine = "twin";
    o.law = loaded.get();
    o.row_every = let.row_every;
    o.row = [&](const Row& r) { seen(r.time_s, Eigen::VectorXd::Constant(1, r.theta_rad)); };
    run_scenario(s, plant, o);
  }

  /// Enables the lever's linear friction, which plant files contain for such studies.
  plant::Parameters linear_plant() const {
    plant::Parameters plant = plant_;
    plant.effects = scene_.effects;
    plant.effects.viscous = true;
    return plant;
  }

  void margins() {
    const stability::LoopModel model = stability::make_model(e_, linear_plant());
    report_.damping_nm_s_rad = model.damping_nm_s_rad;
    for (RateRow& r : report_.rows) {
      if (r.block && !options_.design.empty()) continue;
      r.margin = margin(model, report_.slope, r.ticks, delay_of(r));
    }
    for (std::size_t n = 0; n < report_.beside.size(); ++n) {
      const design::Elaborated& e = options_.beside[n];
      const stability::LoopModel other = stability::make_model(e, linear_plant());
      for (const RateRow& r : report_.rows) {
        const auto in = in_ticks_of(e, r);
        const Margin of = in ? margin(other, report_.slope, in->first, in->second) : Margin{};
        report_.beside[n].margins.push_back(of);
      }
    }
  }

  Scenario scene_, of_law_;
  const plant::Parameters& plant_;
  const BlockLaw* block_;
  std::string on_block_, on_law_;  ///< designs
  Places places_;
};

}  // namespace

Report measure(const Scenario& scene, const LawSource& source, const plant::Parameters& plant,
               const design::Elaborated& e, const Options& options) {
  return LeverSweep(scene, source, plant, e, options).run();
}

}  // namespace feltgate::rates
