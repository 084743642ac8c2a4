// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The closed loop of a device with several axes: its cores with the engine of their law, its plant,
// and the law in real numbers beside them. Documentation: docs/devices.md
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

/// The results of one axis after a run.
struct AxisFigures {
  FeltTorque torque;                            ///< hand and motor_error are left empty
  std::map<std::string, Acted> limits, faults;  ///< by name; only those that acted
  ErrorFigure law_error_nm;  ///< commanded torque against the law in real numbers
  double bound_nm = 0;       ///< proven bound of that error; infinite: none
};

/// Results of a run.
struct AxesResult {
  std::string design, subject, device, law;
  Clock clocks = 0;  ///< of the scene
  Clock homing_clocks = 0;
  std::int64_t ticks = 0;
  bool lock_step = false;
  std::int64_t mismatches = 0;
  std::string first_mismatch;
  Clock first_mismatch_clock = 0;  ///< counted from reset, including homing
  std::string reference;           ///< "quad", "double" or none
  double simulated_s = 0, busy_s = 0;
  std::vector<AxisFigures> axes;
  FeltEnergy energy;
  Acted law_stale;  ///< time in the law with a mailbox that was too old
  std::map<std::string, double> figures;
  std::vector<Expected> expectations;
  std::vector<std::string> broken;       ///< broken expectations and bounds, one line each
  std::vector<std::string> speed_jumps;  ///< one sentence per jump of a lever's hand
};

/// Target for the end of the hand's own spring, and the rate at which it moves on.
struct PenLead {
  plant::Vec2 target_m, rate_m_s;
};

/// Options of a run.
struct AxesRunOptions {
  std::string design;
  std::string engine = "all";  ///< comma list of rtl, twin, double, quad; rtl includes the twin
  AxesLaw* law = nullptr;      ///< the law that the scene runs
  std::uint64_t seed = 1;
  std::string fst;                  ///< waveform of the clocks fst_from to fst_to; empty: none
  Clock fst_from = 0, fst_to = -1;  ///< counted from reset
  /// Called for every row_every-th tick with the values of axes_columns(); may be empty.
  std::function<void(const std::vector<double>&)> row;
  int row_every = 1;
  /// Called for every tick with one row per axis; angle and speed are the plant's. May be empty.
  std::function<void(const std::vector<Row>&)> axes;
  /// Leads an impedance hand at the pen of a pantograph, instead of its profiles; called with every
  /// row of axes_columns(). May be empty.
  std::function<PenLead(const std::vector<double>&)> lead;
  std::function<void(double done)> progress;  ///< called from time to time with 0..1; may be empty
};

/// Names of the values in a row, with units; ".n" stands for axis n.
std::vector<std::string> axes_columns(const AxesScene& scene);

/// Runs a scene. Errors: std::invalid_argument for an engine or design that does not exist.
AxesResult run_axes(const AxesScene& scene, const AxesRunOptions& options);

}  // namespace feltgate
