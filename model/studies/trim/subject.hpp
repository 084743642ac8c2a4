// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// What trim() works on: a scene of one lever, or of a device with several axes, as motions that run
// with any model of the plant. Documentation: docs/speed-for-accuracy.md
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "sim/axes_loop/axes_scene.hpp"
#include "sim/loop/loop.hpp"
#include "sim/plant/parameters.hpp"
#include "sim/plant/plant.hpp"

namespace feltgate::trim {

// The quantities that a hand feels in a run (motor torque, position, force), as short means, and
// the difference of two runs in them.

// A largest or rms value of a reference below these counts as this value: one count of 4096,
// 1 mNm, 10 mN.
constexpr double least_position_rad = 1.534e-3, least_torque_nm = 1e-3, least_force_n = 1e-2;

/// Means of a signal, one per window, each weighted by a triangle of twice that length around it,
/// so that a small shift in time changes a mean only a little. The first and the last mean have
/// half a triangle.
class Signal {
 public:
  /// `window`: in clocks; `least`: see above, in the signal's unit.
  Signal(Clock window, double least) : window_(static_cast<double>(window)), least_(least) {}
  /// `value` held over the `clocks` after those before.
  void add(Clock clocks, double value);
  const std::vector<double>& means() const { return means_; }
  double least() const { return least_; }

 private:
  double window_, least_;
  Clock now_ = 0;
  std::vector<double> means_;
};

/// What is felt in a run: one signal for each axis, or each direction of the hand's force.
struct Felt {
  std::vector<Signal> torque;    ///< Kt*i, on the lever or joint, Nm
  std::vector<Signal> position;  ///< from where it starts, rad
  std::vector<Signal> force;     ///< of the hand, N; Nm where it turns
  double simulated_s = 0;
  double cpu_s = 0;                 ///< CPU time of the thread that ran it
  std::size_t states = 0;           ///< of the plant; of several axes not counted
  std::vector<std::string> broken;  ///< expectations of the scene that do not hold
  std::string fault;                ///< the first that opened the gates, with its time; or none
};

/// Largest and rms difference over the windows, relative to the reference's largest magnitude and
/// rms.
struct Loss {
  double peak = 0, rms = 0;
};

/// Of several axes the largest losses.
struct Difference {
  Loss torque, position, force;
  /// The largest of the six losses; a tolerance limits it.
  double worst() const;
};

/// `other` against `reference`, two runs of the same length.
Difference compare(const Felt& reference, const Felt& other);

/// CPU time of this thread so far, s.
double thread_cpu_s();

struct Options {
  std::string design = "lever";
  double tolerance = 0.01;  ///< of the full model's peak and of its rms, in (0, 1]
  /// Share of the tolerance that search and final check use, as other motions may lose more.
  double share = 0.75;
  double window_s = 1e-3;    ///< length of the means that are compared
  int full_step_clocks = 5;  ///< of the full model of one lever
  int unseen = 4;            ///< motions of the final check, 1 or more
  int timed_runs = 5;        ///< of both models, for Report::faster; 1 or more
  std::uint64_t seed = 1;    ///< of these motions
  int threads = 2;
  double longest_s = 0;  ///< the search ends after it, with the full model; 0: no limit
  std::function<void(double done)> progress;  ///< called now and then with 0..1; may be empty
};

/// The part "gates": gates that switch.
constexpr const char* gates = "gates";

/// The simulated effects of a scene's plant, and the step.
struct Model {
  plant::Effects effects;
  bool gates = true;  ///< true: the four gates switch; false: the mean voltage of the duty
  int step_clocks = 5;
};

/// A motion, at a share of the scene's own way and speed; feel() may run in several threads.
struct Course {
  double amplitude = 1, speed = 1;
  std::function<Felt(const Model& model)> feel;
};

/// A scene and its other motions.
struct Subject {
  Model full;
  std::function<std::vector<std::string>(const Model&)> parts;  ///< computed in a model
  Course own;
  std::function<Course(std::uint64_t seed)> other;
};

/// Makes the law of the scene; empty: it has none. Every run has a law of its own.
using LawMaker = std::function<std::unique_ptr<SceneLaw>()>;

/// Runs `scene` on the twin of `design` with the effects and step of `model`. Throws as
/// run_scenario does.
Felt feel(const Scenario& scene, const plant::Parameters& plant, const std::string& design,
          const Model& model, double window_s, const LawMaker& law = {});

/// The full model of the scene: gates, and every effect that the scene does not switch off. Of the
/// two frictions, `viscous` is used only if scene or plant has it. Reads the scene's file.
Model full_model(Scenario scene, const plant::Effects& of_plant, int step_clocks);

/// Parts of `model` that are computed: "gates", or the name of an effect; `has_mass`: whether a
/// hand of the scene has a mass.
std::vector<std::string> parts_of(const Model& model, bool has_mass);
void set_part(Model& model, const std::string& part, bool on);

Subject lever_subject(const Scenario& scene, const plant::Parameters& plant, const Options& options,
                      const LawMaker& law = {});
/// The loop of several axes has mean voltages and steps of 250 clocks: only effects are parts.
Subject axes_subject(const AxesScene& scene, const Options& options, const LawMaker& law);

// Other motions of a scene, for checks on motions that a search did not use.

/// A scene with its plant.
struct Motion {
  Scenario scene;
  plant::Parameters plant;
  double amplitude = 1, speed = 1;  ///< factors against the scene's own
};

/// The scene with the hand's way 0.7 to 1.3 times as long and everything in it 0.7 to 1.4 times as
/// fast, started up to two counts away, on an encoder of another seed; a hand with a mass is
/// another person's (each constant 0.8 to 1.25 times). Where the host moves instead of the hand,
/// the set-points of torque and voltage are scaled by the amplitude. The same seed gives the same
/// motion; consecutive seeds go round far and near, fast and slow.
Motion perturbed(const Scenario& scene, const plant::Parameters& plant, std::uint64_t seed);

/// A scene of a device.
struct AxesMotion {
  AxesScene scene;
  double amplitude = 1, speed = 1;  ///< factors against the scene's own
};

/// The same for a device. The way is 0.9 to 1.1 times as long, because a linkage has an end; only
/// levers and slides start elsewhere. A plane's host stays as it is.
AxesMotion perturbed(const AxesScene& scene, std::uint64_t seed);

/// Whether an impedance holds it.
bool has_mass(const plant::Hand& hand);
bool has_mass(const DeviceSetup& device);

}  // namespace feltgate::trim
