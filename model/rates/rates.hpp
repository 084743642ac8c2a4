// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// One scene at several rates: error of the torque, distance from instability, clocks and time; of
// one lever, and of a device with several axes.
// Documentation: docs/rates.md
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "axes_loop/axes_scene.hpp"
#include "design/design.hpp"
#include "plant/parameters.hpp"
#include "rates/block_laws.hpp"
#include "rates/margin.hpp"
#include "rates/slow_law.hpp"

namespace feltgate::rates {

/// A scene with its torque renewed at one rate.
struct RateRow {
  double rate_hz = 0;
  int ticks = 1;       ///< between two updates
  bool block = false;  ///< the core's own block; else the engine runs a law
  int runs = 1;        ///< of the engine from one update to the next
  ErrorFigure error;   ///< of the torque reference against the continuous law, Nm; of all axes
  double mean_error_nm = 0;          ///< of the first axis
  std::vector<ErrorFigure> of_axes;  ///< the same as `error`, of each
  Margin margin;
  double swing_nm = 0;  ///< of several axes: the largest of their torques' in the last quarter
  int expected = 0;     ///< bounds that the scene sets for its figures; of several axes
  std::vector<std::string> broken;  ///< of these, a line each
  int clocks_used = 0;              ///< of the engine for a run
  int clocks_available = 0;         ///< from one of its runs to the next; 0 for a block
  int instructions = 0;
  double cpu_s_per_s = 0;  ///< of the closed loop with the twin, per simulated second
  std::int64_t mismatches = 0, clocks_compared = 0;  ///< RTL and twin in lock-step
  std::string first_mismatch;
  std::string fault;  ///< the first that opened the gates, with its time; empty: none
};

struct Report {
  std::string scene, title, law, plant;  ///< plant: or device
  int axes = 1;
  std::string block_gates;  ///< empty: no block renders it
  double simulated_s = 0;
  double largest_nm = 0;  ///< of the continuous law
  Slope slope;
  ErrorFigure floor;               ///< of counts and estimated velocity, at every tick, all axes
  double damping_nm_s_rad = 0;     ///< of the lever or each joint, for the margins
  std::vector<RateRow> rows;       ///< the slowest first
  std::vector<std::string> notes;  ///< why rates or margins are missing
};

struct Options {
  std::vector<double> rates_hz{144, 490, 1e3, 10e3, 40e3, 100e3};
  bool lock_step = false;                     ///< the RTL beside the twin
  std::function<void(double done)> progress;  ///< 0..1; may be empty
};

/// The designs that blocks and laws run on.
inline constexpr const char* block_design = "lever";
inline constexpr const char* law_design = "lever_law";

/// Rates that are slower than the scene's fastest, which is always measured: that of its law, and
/// the tick's where a block renders it. `law` is the scene's, or that for its block. `e` is
/// law_design. Errors: those of require_one_law(), LawError, and std::invalid_argument for a law of
/// several axes.
Report measure(const Scenario& scene, const LawSource& law, const plant::Parameters& plant,
               const design::Elaborated& e, const Options& options);

/// The same of a device with several axes, whose design "DEVICE_law" `e` is: its law at each rate
/// on its twin, or on RTL and twin. Errors: LawError; std::invalid_argument for a design
/// that this program lacks, or a law that is not for these axes.
Report measure(const AxesScene& scene, const LawSource& law, const design::Elaborated& e,
               const Options& options);

/// Name of the design of a scene's device.
std::string axes_design(const AxesScene& scene);

/// Tables for people; JSON by the schema feltgate-rates/1; a row of CSV a rate of a scene.
std::string report_text(const Report& report);
std::string reports_json(const std::vector<Report>& reports);
std::string reports_csv(const std::vector<Report>& reports);

/// "490 Hz", "1 kHz", "0.5 MHz" as people write it.
std::string rate_text(double hz);

}  // namespace feltgate::rates
