// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The closed loop of a device with several axes: its cores with the engine of their law, its plant,
// and the law in real numbers beside them. Documentation: docs/devices.md
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "axes_scene.hpp"
#include "sim/backends/axes_cores.hpp"
#include "sim/loop/backend_choice.hpp"
#include "sim/loop/columns.hpp"
#include "sim/loop/felt.hpp"
#include "sim/loop/figures.hpp"
#include "sim/loop/session.hpp"

namespace feltgate {

/// The results of one axis after a run.
struct AxisFigures {
  FeltTorque torque;                            ///< hand and motor_error are left empty
  std::map<std::string, Acted> limits, faults;  ///< by name; only those that acted
  ErrorFigure law_error_nm;  ///< commanded torque against the law in real numbers
  double bound_nm = 0;       ///< proven bound of that error; infinite: none
};

/// Results of a run.
struct AxesResult : SessionResult {
  std::string device, law;
  Clock homing_clocks = 0;
  double busy_s = 0;
  std::vector<AxisFigures> axes;
  FeltEnergy energy;
  std::vector<std::string> speed_jumps;  ///< one sentence per jump of a lever's hand
};

/// Target for the end of the hand's own spring, and the rate at which it moves on.
struct PenLead {
  plant::Vec2 target_m, rate_m_s;
};

/// Options of a run; rtl includes the twin, and "all" has no float.
struct AxesRunOptions : SessionOptions {
  /// Called for every row_every-th tick with the values of axes_columns(); may be empty.
  std::function<void(const std::vector<double>&)> row;
  /// Called for every tick with one row per axis; angle and speed are the plant's. May be empty.
  std::function<void(const std::vector<Row>&)> axes;
  /// Leads an impedance hand at the pen of a pantograph, instead of its profiles; called with every
  /// row of axes_columns(). May be empty.
  std::function<PenLead(const std::vector<double>&)> lead;
};

/// Names of the values in a row, with units; ".n" stands for axis n.
std::vector<std::string> axes_columns(const AxesScene& scene);

/// Runs a scene. Errors: std::invalid_argument for an engine or design that does not exist.
AxesResult run_axes(const AxesScene& scene, const AxesRunOptions& options);

// Selects the back-ends of several axes by the names that a user gives.

/// Like choose_backends(), but rtl includes its twin, and "all" has no float.
/// Errors: std::invalid_argument that names the choices.
BackendChoice choose_axes_backends(const std::string& engines);

/// Makes the cores of a design, of the kind `lead`, for a device with `axes` axes.
/// Errors: std::invalid_argument for a design that does not exist or has another number of axes.
std::unique_ptr<AxesCores> make_axes_cores(const std::string& design, const std::string& lead,
                                           const std::string& device, std::size_t axes);

}  // namespace feltgate
