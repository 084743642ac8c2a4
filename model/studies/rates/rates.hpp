// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Measures one scene at several rates: error of the torque, stability margin, clocks and time; for
// one lever and for a device with several axes. Documentation: docs/speed-for-accuracy.md
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "design/design.hpp"
#include "sim/axes_loop/axes_scene.hpp"
#include "sim/plant/parameters.hpp"
#include "studies/rates/bits_margin.hpp"
#include "studies/rates/block_laws.hpp"
#include "studies/rates/margin.hpp"
#include "studies/rates/slow_law.hpp"

namespace feltgate::rates {

/// A scene with its torque renewed at one rate.
struct RateRow {
  double rate_hz = 0;
  int ticks = 1;       ///< between two updates
  bool block = false;  ///< true: the core's own block; false: the engine runs a law
  int runs = 1;        ///< runs of the engine per update
  ErrorFigure error;   ///< of the torque reference against the continuous law, Nm; of all axes
  double mean_error_nm = 0;          ///< of the first axis
  std::vector<ErrorFigure> of_axes;  ///< as `error`, for each axis
  Margin margin;
  double swing_nm = 0;              ///< several axes: largest swing of a torque in the last quarter
  int expected = 0;                 ///< bounds that the scene sets for its figures; of several axes
  std::vector<std::string> broken;  ///< of these, a line each
  int clocks_used = 0;              ///< clocks of the engine per run
  int clocks_available = 0;         ///< clocks between its runs; 0 for a block
  int instructions = 0;
  double cpu_s_per_s = 0;  ///< of the closed loop with the twin, per simulated second
  std::int64_t mismatches = 0, clocks_compared = 0;  ///< RTL and twin in lock-step
  std::string first_mismatch;
  std::string fault;  ///< first fault that opened the gates, with its time; empty: none
};

/// Another design at the same scene, by its linear loop and its velocity estimate in double.
struct Beside {
  std::string path;
  ErrorFigure floor;            ///< of its counts and velocity, held over its tick
  std::vector<Margin> margins;  ///< for each row; of a block in the design's own tick
};

struct Report {
  std::string scene, title, law, plant;  ///< plant: or device
  int axes = 1;
  std::string block_gates;  ///< size of the scene's block; empty: no block renders the scene
  double simulated_s = 0;
  double largest_nm = 0;  ///< of the continuous law
  Slope slope;
  ErrorFigure floor;               ///< of counts and estimated velocity, at every tick, all axes
  double damping_nm_s_rad = 0;     ///< of the lever or each joint, for the margins
  std::vector<RateRow> rows;       ///< the slowest rate first
  std::vector<Beside> beside;      ///< as the options name them
  std::optional<Place> place;      ///< of a margin of the whole torque
  std::vector<GainMargin> gains;   ///< of the last row at rest, beside the bits; if asked for
  std::vector<std::string> notes;  ///< why rates or margins are missing
};

struct Options {
  std::vector<double> rates_hz{144, 490, 1e3, 10e3, 40e3, 100e3};
  bool lock_step = false;                          ///< the RTL beside the twin
  std::function<void(double done)> progress = {};  ///< 0..1; may be empty
  bool gains = false;                              ///< Report::gains
  bool bits = false;                               ///< of those, also by the bits
  bool whole_torque = false;                       ///< margins of the whole torque, of any law
  std::vector<design::Elaborated> beside = {};     ///< of one lever: Report::beside
  /// Of one lever: the design whose block, or whose engine for a scene "law", runs; empty: those
  /// below. Its block then has no margin here.
  std::string design = {};
};

/// The designs on which blocks and laws run.
inline constexpr const char* block_design = "lever";
inline constexpr const char* law_design = "lever_law";

/// Measures a scene of one lever. The fastest rate is always measured: that of the law, and the
/// tick rate if a block renders the scene; the options add slower rates. `law` is the scene's law,
/// or the law for its block. `e` is the design of the law. Throws as require_one_law(), LawError,
/// and std::invalid_argument for a law of several axes.
Report measure(const Scenario& scene, const LawSource& law, const plant::Parameters& plant,
               const design::Elaborated& e, const Options& options);

/// The same for a device with several axes; `e` is its design "DEVICE_law". The law runs at each
/// rate on the twin, or on RTL and twin. Throws LawError, and std::invalid_argument for a design
/// that this program lacks or a law that is not for these axes.
Report measure(const AxesScene& scene, const LawSource& law, const design::Elaborated& e,
               const Options& options);

/// The report as text tables, as JSON (schema feltgate-rates/1), and as CSV with a row per rate.
std::string report_text(const Report& report);
std::string reports_json(const std::vector<Report>& reports);
std::string reports_csv(const std::vector<Report>& reports);

/// A rate as text: "490 Hz", "1 kHz", "0.5 MHz".
std::string rate_text(double hz);

}  // namespace feltgate::rates
