// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Closed loop of a device with several axes: its cores and the engine of their law, its plant, the
// law in real numbers beside them. Documentation: docs/devices.md
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "axes_law.hpp"
#include "axes_scene.hpp"
#include "loop/columns.hpp"
#include "loop/felt.hpp"
#include "loop/figures.hpp"

namespace feltgate {

/// What is known of an axis after a run.
struct AxisFigures {
  FeltTorque torque;                            ///< hand and motor_error are left empty
  std::map<std::string, Acted> limits, faults;  ///< by name; only those that acted
  ErrorFigure law_error_nm;  ///< of the commanded torque from the law in real numbers
  double bound_nm = 0;       ///< proven for it; infinite: none
};

struct AxesResult {
  std::string design, subject, device, law;
  Clock clocks = 0;  ///< of the scene
  Clock homing_clocks = 0;
  std::int64_t ticks = 0;
  bool lock_step = false;
  std::int64_t mismatches = 0;
  std::string first_mismatch;
  Clock first_mismatch_clock = 0;  ///< from reset, homing included
  std::string reference;           ///< "quad", "double" or none
  double simulated_s = 0, busy_s = 0;
  std::vector<AxisFigures> axes;
  FeltEnergy energy;
  Acted law_stale;  ///< time in the law with a mailbox that was too old
  std::map<std::string, double> figures;
  std::vector<Expected> expectations;
  std::vector<std::string> broken;  ///< expectations and bounds that do not hold, one line each
  std::vector<std::string> speed_jumps;  ///< of a lever's hand, a sentence each
};

/// Where the end of a hand's own spring is to be, and how fast it goes on from there.
struct PenLead {
  plant::Vec2 target_m, rate_m_s;
};

struct AxesRunOptions {
  std::string design;
  std::string engine = "all";  ///< comma list of rtl, twin, double, quad; rtl brings the twin
  AxesLaw* law = nullptr;      ///< what the scene runs
  std::uint64_t seed = 1;
  std::string fst;                  ///< waveform of the clocks fst_from to fst_to; empty: none
  Clock fst_from = 0, fst_to = -1;  ///< from reset
  /// Called for every row_every-th tick with the values of axes_columns(); may be empty.
  std::function<void(const std::vector<double>&)> row;
  int row_every = 1;
  /// Called for every tick with a row an axis, angle and speed the plant's own; may be empty.
  std::function<void(const std::vector<Row>&)> axes;
  /// Leads an impedance hand on the pen of a pantograph instead of its profiles: asked with every
  /// such row; may be empty.
  std::function<PenLead(const std::vector<double>&)> lead;
  std::function<void(double done)> progress;  ///< called now and then with 0..1; may be empty
};

/// Names of what a row holds, with units; ".n" for axis n.
std::vector<std::string> axes_columns(const AxesScene& scene);

/// Runs a scene. Throws std::invalid_argument for an engine or design that is not there.
AxesResult run_axes(const AxesScene& scene, const AxesRunOptions& options);

}  // namespace feltgate
