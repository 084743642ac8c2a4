// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The closed loop of a simulated board. Documentation: docs/host.md
#include "host/board/board.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <stdexcept>

#include "sim/backends/absolute_sensor.hpp"
#include "sim/loop/loop.hpp"
#include "sim/loop/scenario.hpp"
#include "sim/loop/scenario_check.hpp"

namespace feltgate::board {

namespace {

constexpr double kArmAfter_s = 0.01;  ///< when the panel's switch arms, after power-up

plant::HandPhase phase(plant::HandPhase::Kind kind) {
  plant::HandPhase p;
  p.kind = kind;
  return p;
}

}  // namespace

std::vector<std::uint8_t> BadLine::through(const std::vector<std::uint8_t>& bytes) {
  if (share_ <= 0) return bytes;
  std::vector<std::uint8_t> out;
  for (const std::uint8_t byte : bytes) {
    if (random_.uniform() >= share_) {
      out.push_back(byte);
      continue;
    }
    switch (random_.below(3)) {
      case 0:
        break;
      case 1:
        out.push_back(static_cast<std::uint8_t>(byte ^ (1U << random_.below(8))));
        break;
      default:
        out.insert(out.end(), 2, byte);
    }
  }
  return out;
}

plant::Hand hand_named(const std::string& name, const std::string& scenes_folder) {
  using Kind = plant::HandPhase::Kind;
  plant::Hand hand;
  if (name == "free") return hand;
  if (name == "locked") {
    hand.phases = {phase(Kind::kLocked)};
    return hand;
  }
  if (name == "hold" || name == "swing") {
    hand.phases = {phase(Kind::kImpedance)};
    if (name == "swing") {
      constexpr double day_s = 1e5, quarter_rad = 1.5707963267948966;
      plant::Segment s;
      s.kind = plant::Segment::Kind::kSine;
      s.duration_s = day_s;
      s.amplitude = 0.5;
      s.frequency_hz = 1;
      s.phase_rad = -quarter_rad;  // starts at rest
      hand.phases[0].profile = {s};
      hand.phases[0].duration_s = day_s;
    }
    return hand;
  }
  namespace fs = std::filesystem;
  const bool path = name.find('/') != std::string::npos || fs::path(name).extension() == ".toml";
  const fs::path file = path ? fs::path(name) : fs::path(scenes_folder) / (name + ".toml");
  if (!fs::exists(file)) {
    throw std::invalid_argument(
        fmt::format("--hand {}: is neither free, locked, hold or swing nor a scene file; the "
                    "scenes are in {}",
                    name, scenes_folder));
  }
  return read_scenario(file.string()).hand;
}

Board::Board(std::unique_ptr<Core> core, const Setup& setup)
    : core_(std::move(core)),
      to_board_(setup.bad_line, setup.seed),
      from_board_(setup.bad_line, setup.seed + 1),
      arm_at_(core_->design().request_at(
          std::llround(kArmAfter_s * static_cast<double>(core_->design().clock_hz)))),
      arm_(setup.arm) {
  in_.scene = static_cast<std::uint8_t>(scene_number(core_->design(), setup.scene));
}

void Board::receive(const std::vector<std::uint8_t>& bytes) {
  for (const std::uint8_t byte : to_board_.through(bytes)) core_->send(byte);
}

void Board::run_to(Clock clock) {
  while (now_ < clock) {
    if (arm_ && now_ >= arm_at_) in_.arm = true;
    step(arm_ && now_ < arm_at_ ? arm_at_ : std::numeric_limits<Clock>::max());
  }
}

void Board::run_core(Clock clocks) {
  if (clocks <= 0) return;
  core_->run(in_, clocks);
  now_ += clocks;
}

LeverBoard::LeverBoard(std::unique_ptr<Core> core, const plant::Parameters& parameters,
                       const plant::Hand& hand, const Setup& setup)
    : Board(std::move(core), setup),
      plant_(parameters, parameters.effects, hand, core_->design(), false),
      plan_(plan(parameters, hand, core_->design())),
      looped_(core_->design().current_full_scale_a > 0) {
  if (parameters.effects.encoder_imperfect) {
    for (const double mrad : parameters.encoder.absolute_error_mrad) {
      error_rad_.push_back(1e-3 * mrad);
    }
  }
  shown_rad_ = shown_angle(plant().theta_rad, error_rad_);
  in_.encoder[0] = plant_.shaft().encoder().pins();
}

StepPlan LeverBoard::plan(const plant::Parameters& parameters, const plant::Hand& hand,
                          const DesignInfo& design) {
  Scenario s = as_run(scene_of(parameters, hand), design);
  check_phases(s, parameters, design);
  check_step(s, parameters, static_cast<double>(design.clock_hz));
  if (s.switched) return StepPlan(s.step_clocks);
  // Where the plant allows it, steps end with ticks, which the twin takes as a whole.
  const int tick = design.clocks_per_tick;
  if (longest_step_clocks(s, parameters, static_cast<double>(design.clock_hz)) >= tick) {
    s.step_clocks = (s.step_clocks + tick - 1) / tick * tick;
  }
  return {s, parameters, design};
}

// As in the loop of scenes: the core's last bridge state drives the motor in this step, and the
// core gets each edge in its clock.
void LeverBoard::step(Clock corner) {
  const Clock end = plan_.end_of_step(now_, std::min(corner, plant_.shaft().next_corner()),
                                      std::numeric_limits<Clock>::max());
  const double before_rad = plant().theta_rad;
  if (looped_) {
    plant_.advance(core_->take_gates(), last_clocks_, end - now_);
    in_.current_data = plant_.current_bits();
  } else {
    plant_.advance(*core_, end - now_);
  }
  last_clocks_ = end - now_;
  const double shown_rad = shown_angle(plant().theta_rad, error_rad_);
  core_->turn_encoder(shown_rad_, shown_rad, end - now_);
  shown_rad_ = shown_rad;
  HallChange hall;
  if (plant_.has_hall()) hall = plant_.hall(before_rad, plant().theta_rad, now_, end - now_);
  const auto run_to = [&](Clock clock) {
    const Clock until = std::clamp(clock, now_, end);
    in_.hall = hall.code(now_);
    if (hall.at > now_ && hall.at < until) {
      run_core(hall.at - now_);
      in_.hall = hall.after;
    }
    run_core(until - now_);
  };
  for (const EncoderEvent& e : plant_.shaft().events()) {
    run_to(e.clock);
    in_.encoder[0] = e.pins;
  }
  run_to(end);
}

std::vector<std::uint8_t> Board::take_sent() {
  auto bytes = core_->take_received();
  bytes_ += static_cast<std::int64_t>(bytes.size());
  for (const std::uint8_t b : bytes) byte_sum_.add_at_once(b);
  return from_board_.through(bytes);
}

Outcome Board::outcome() const {
  return {now_, core_->ticks().ticks(), core_->ticks().value(), bytes_, byte_sum_.value()};
}

}  // namespace feltgate::board
