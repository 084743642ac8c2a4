// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Closed loop: one core, one plant, one clock; real-arithmetic chains ride along on the core's
// sampled counts. Documentation: docs/architecture.md
#pragma once

#include <cstdio>
#include <functional>
#include <iosfwd>
#include <map>
#include <string>
#include <vector>

#include "../engines/engine.hpp"
#include "../reference/real_chain.hpp"
#include "columns.hpp"
#include "engine_choice.hpp"
#include "felt.hpp"
#include "figures.hpp"
#include "scenario.hpp"

namespace feltgate {

namespace bounds {
class Coverage;
}
class SceneLaw;
namespace plant {
struct Observables;
}

struct StepFigures {
  double tau_ref_nm = 0;
  StepResponse tau_hat;  ///< of the observed torque
  StepResponse torque;   ///< of the motor torque, averaged over each PWM period
};

/// What is known of one engine after a run.
struct EngineFigures {
  std::string name;
  bool compared = false;  ///< the error figures below were taken against RunResult::reference
  ErrorFigure velocity_rad_s, tau_hat_nm, torque_nm;
  /// The same in the ticks for which error bounds hold; empty where none were given.
  ErrorFigure covered_velocity_rad_s, covered_tau_hat_nm, covered_torque_nm;
  std::int64_t uncovered = 0;  ///< ticks without bounds of the torques: ramps, saturation
  std::vector<StepFigures> steps;
  std::int64_t saturations = 0;  ///< ticks in which a limit held
  double busy_s = 0;             ///< time spent in the engine
};

struct PositionFigures {
  std::int64_t steps = 0, illegal = 0, reversals = 0;
};

/// What a law told the host.
struct RunEvent {
  double at_s = 0;
  std::string name;
  double value = 0;  ///< SI
};

struct RunResult {
  std::string design, subject;  ///< subject: scene or trace
  Clock clocks = 0;
  std::int64_t ticks = 0;
  std::int64_t mismatches = 0;
  std::string first_mismatch;
  Clock first_mismatch_clock = 0;
  bool lock_step = false;
  PositionFigures position;
  std::int32_t last_position = 0;     ///< counts, by an independent count of the pins; wraps
  double largest_velocity_rad_s = 0;  ///< of the N-method before its low-pass; needs a rider
  std::string reference;  ///< engine that the others are compared with, "quad" or "double", or none
  std::vector<EngineFigures> engines;
  Felt felt;
  Acted law_stale;               ///< armed, but a mailbox of the law was too old: no torque
  std::vector<RunEvent> events;  ///< of the scene's law
  std::map<std::string, double> figures;  ///< what scene files put bounds on
  std::vector<std::string> broken;  ///< expectations and bounds that do not hold, one line each
  double simulated_s = 0;
  Clock longest_step_clocks = 0;   ///< of the plant
  std::size_t plant_states = 0;    ///< continuous states of the plant at the end
  plant::Evaluations evaluations;  ///< of the plant's effects
};

/// A register write of the host: the word for fixed point, the value for real arithmetic.
struct HostWrite {
  Clock clock = 0;  ///< when it was queued; one is carried out per tick
  int address = 0;
  std::uint32_t data = 0;
  double value = 0;  ///< in the parameter's unit; 0 for control and command words
};

/// All that reached the core during a run: enough to repeat it without the plant.
struct RunInputs {
  Clock clocks = 0;
  EncoderPins pins;  ///< at reset
  std::vector<EncoderEvent> edges;
  std::vector<HostWrite> writes;
};

struct RunOptions {
  std::string design = "lever";
  std::string engine = "all";  ///< comma list, see choose_engines()
  SceneLaw* law = nullptr;     ///< what the scene "law" runs; parameters by its names too
  std::uint64_t seed = 1;
  std::string fst;                  ///< waveform of the clocks fst_from to fst_to; empty: none
  Clock fst_from = 0, fst_to = -1;  ///< fst_to < 0: to the end
  std::FILE* record = nullptr;      ///< gets the encoder's edges as a vector file; may be none
  const bounds::Coverage* coverage = nullptr;  ///< of error bounds that are to be checked
  RealChain* passenger = nullptr;  ///< rides along on the samples and writes, uncompared
  RunInputs* inputs = nullptr;     ///< filled when given; a scene that uses the stop pin throws
  std::function<void(const Row&)> row;  ///< called for every row_every-th tick; may be empty
  int row_every = 1;
  /// called after each run of the law: time of its samples and its states, SI; may be empty. Throws
  /// std::invalid_argument where the RTL leads alone, which does not show when a run begins.
  std::function<void(double at_s, const std::vector<double>& states)> law_states;
  /// called after each step of the plant, which took `clocks`; may be empty
  std::function<void(Clock clocks, const plant::Observables&)> plant_step;
  std::function<void(double done)> progress;  ///< called now and then with 0..1; may be empty
};

/// Runs a scene. Throws std::invalid_argument for a scene, parameter or engine that the design has
/// not.
RunResult run_scenario(const Scenario& scenario, const plant::Parameters& plant,
                       const RunOptions& options);

}  // namespace feltgate
