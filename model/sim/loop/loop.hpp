// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Closed loop: one core, one plant, one clock. Chains in real arithmetic ride on the core's sampled
// counts. Documentation: docs/architecture.md
#pragma once

#include <cstdio>
#include <functional>
#include <iosfwd>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "../backends/backend.hpp"
#include "../reference/real_chain.hpp"
#include "backend_choice.hpp"
#include "columns.hpp"
#include "felt.hpp"
#include "figures.hpp"
#include "scenario.hpp"
#include "session.hpp"

namespace feltgate {

namespace bounds {
class Coverage;
}
namespace plant {
struct Observables;
}

/// Responses to one step of the torque reference.
struct StepFigures {
  double tau_ref_nm = 0;
  StepResponse tau_hat;       ///< of the observed torque
  StepResponse torque;        ///< of the motor torque, averaged over each PWM period
  bool tau_hat_void = false;  ///< at the end of the step, see Felt
};

/// The results of one back-end after a run.
struct BackendFigures {
  std::string name;
  bool compared = false;  ///< the error figures below were taken against RunResult::reference
  ErrorFigure velocity_rad_s, tau_hat_nm, torque_nm;
  std::vector<StepFigures> steps;
  std::int64_t saturations = 0;  ///< ticks in which a limit acted
  double busy_s = 0;             ///< time spent in the back-end
};

/// Counts of the pins' changes: legal steps, illegal ones, reversals.
struct PositionFigures {
  std::int64_t steps = 0, illegal = 0, reversals = 0;
};

/// An event that a law reported to the host.
struct RunEvent {
  double at_s = 0;
  std::string name;
  double value = 0;  ///< in SI units
};

/// Results of a run.
struct RunResult : SessionResult {
  PositionFigures position;
  std::int32_t last_position = 0;     ///< counts, from an independent count of the pins; wraps
  double largest_velocity_rad_s = 0;  ///< N-method, before the low-pass; needs a rider
  std::vector<BackendFigures> engines;
  Felt felt;
  std::string bound_sources;      ///< what each block adds to the bounds of felt.errors, as text
  std::vector<RunEvent> events;   ///< of the scene's law
  Clock longest_step_clocks = 0;  ///< of the plant
  std::size_t plant_states = 0;   ///< continuous states of the plant at the end
};

/// All inputs of the core during a run; enough to repeat it without the plant.
struct RunInputs {
  Clock clocks = 0;
  EncoderPins pins;  ///< at reset
  std::vector<EncoderEvent> edges;
  std::vector<HostWrite> writes;
};

/// Gets, tick by tick, what the chains beside the core get; not compared.
class Passenger {
 public:
  virtual ~Passenger() = default;
  /// A parameter, from the next tick on.
  virtual void set_parameter(int address, double value) = 0;
  virtual void tick(const Snapshot& s) = 0;
};

/// Options of a run.
struct RunOptions : SessionOptions {
  std::FILE* record = nullptr;  ///< gets the encoder's edges as a vector file; may be nullptr
  const bounds::Coverage* coverage = nullptr;  ///< ticks in which bounds are checked
  Passenger* passenger = nullptr;
  RunInputs* inputs = nullptr;  ///< filled if given; a scene that uses the stop pin then throws
  std::function<void(const Row&)> row;  ///< called for every row_every-th tick; may be empty
  /// called after each run of the law with the time of its samples and its states in SI; may be
  /// empty. Errors: std::invalid_argument where the RTL leads alone: it does not show when a run
  /// begins.
  std::function<void(double at_s, const std::vector<double>& states)> law_states;
  /// called after each step of the plant, which took `clocks` clocks; may be empty
  std::function<void(Clock clocks, const plant::Observables&)> plant_step;
};

/// The scene as it is run on a design: with a current loop a step of the plant is a clock of its
/// modulator, and the bridge follows the gates.
Scenario as_run(Scenario scenario, const DesignInfo& design);

/// Runs a scene. Errors: std::invalid_argument for a scene, parameter or back-end that the design
/// does not have.
RunResult run_scenario(const Scenario& scenario, const plant::Parameters& plant,
                       const RunOptions& options);

/// A scene whose caller says how far it runs: the steps and rows of run_scenario(), no results.
class SteppedRun {
 public:
  virtual ~SteppedRun() = default;
  /// Runs to the end of the first step that reaches this clock, at most to the scene's end. Errors:
  /// plant::MotionError.
  virtual void run_to(Clock clock) = 0;
  /// Replaces the hand by this phase, from the next step on.
  virtual void take(const plant::HandPhase& phase) = 0;
};

/// All must outlive it; `scenario` is one of as_run(). Errors: those of run_scenario().
std::unique_ptr<SteppedRun> stepped_run(const Scenario& scenario, const plant::Parameters& plant,
                                        const RunOptions& options);

/// One line of FUDI per hit: "MS NAME NUMBER VALUES;", where MS is the time since the line before;
/// Pure Data's qlist plays it (docs/devices/strings-and-drums.md). Events within `run_s` whose
/// names end in the same number become one line, with the name of the first one and the values in
/// order. Without a number, NUMBER is left out.
std::string event_lines(const std::vector<RunEvent>& events, double run_s);

}  // namespace feltgate
