// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// A board without hardware: core and link, bridges, motors, lever or device, and hand in closed
// loop. Its interface is bytes in and bytes out. Documentation: docs/host.md
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "feltgate/random.hpp"
#include "host/board/core.hpp"
#include "host/board/recording.hpp"
#include "sim/backends/fnv1a.hpp"
#include "sim/loop/driven_plant.hpp"
#include "sim/loop/step_plan.hpp"

namespace feltgate::board {

/// A line that damages bytes with a given probability: one is lost, has a bit inverted, or is
/// doubled.
class BadLine {
 public:
  BadLine(double share, std::uint64_t seed) : share_(share), random_(seed) {}
  std::vector<std::uint8_t> through(const std::vector<std::uint8_t>& bytes);

 private:
  double share_;
  SplitMix64 random_;
};

/// What holds the lever: "free", "locked", "hold" (a hand that holds it where it is), "swing" (a
/// hand that swings it by 0.5 rad at 1 Hz), or the [hand] of a scene file, given by name or path.
/// Errors: std::invalid_argument or config::ConfigError.
plant::Hand hand_named(const std::string& name, const std::string& scenes_folder);

/// The simulated board; clock by clock for the core, step by step for the plant.
class Board {
 public:
  /// Power-up at clock 0.
  Board(std::unique_ptr<Core> core, const Setup& setup);
  virtual ~Board() = default;

  /// Bytes for the rx pin, from the present clock on.
  void receive(const std::vector<std::uint8_t>& bytes);
  /// Runs to this clock, or slightly beyond, to the end of a plant step.
  void run_to(Clock clock);
  Clock now() const { return now_; }
  /// The bytes that the tx pin has sent since the last call.
  std::vector<std::uint8_t> take_sent();

  const Core& core() const { return *core_; }
  Outcome outcome() const;

 protected:
  /// Runs core and plant to the end of the plant's next step, which is at `corner` at the latest.
  virtual void step(Clock corner) = 0;
  /// Runs the core with the pins as they are.
  void run_core(Clock clocks);

  std::unique_ptr<Core> core_;
  BoardIn in_;
  Clock now_ = 0;

 private:
  BadLine to_board_, from_board_;
  Clock arm_at_ = 0;
  bool arm_ = false;
  std::int64_t bytes_ = 0;
  Fnv1a byte_sum_;
};

/// A board with a lever, or with the knob of a motor with three phases.
class LeverBoard : public Board {
 public:
  /// Errors: those of check_step() if the plant is too stiff, and config::ConfigError for a motor
  /// that the core's bridge does not drive.
  LeverBoard(std::unique_ptr<Core> core, const plant::Parameters& plant, const plant::Hand& hand,
             const Setup& setup);
  const plant::Observables& plant() const { return plant_.shaft().observables(); }

 private:
  static StepPlan plan(const plant::Parameters& plant, const plant::Hand& hand,
                       const DesignInfo& design);
  void step(Clock corner) override;

  DrivenPlant plant_;
  std::vector<double> error_rad_;  ///< of an absolute encoder
  double shown_rad_ = 0;           ///< by it
  StepPlan plan_;
  bool looped_;            ///< by a current loop: a step is a clock of its modulators
  Clock last_clocks_ = 0;  ///< of the last step
};

// A board with several axes: a pantograph or another device in closed loop.

/// The board of a design with several axes. The joints' counts begin at the joints' zeros, as after
/// homing. The hand of `setup` is "free", "hold" or "swing" (its pen goes 40 mm to the side and
/// back, once a second) for a pantograph, else a scene file of the design's device; `find` converts
/// the names of scenes and devices to paths. Errors: std::invalid_argument, config::ConfigError.
std::unique_ptr<Board> make_axes_board(
    std::unique_ptr<Core> core, const Setup& setup,
    const std::function<std::string(const std::string& name, const std::string& folder)>& find);

}  // namespace feltgate::board
