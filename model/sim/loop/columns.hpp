// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The values that a run reports of a tick, and the one table of their columns: header, rows,
// documentation and arrays come from it. Documentation: docs/json.md
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace feltgate {

/// The signals of one back-end in a tick.
struct BackendSignals {
  double velocity_rad_s = 0, tau_ref_nm = 0, tau_hat_nm = 0;
  double torque_nm = 0;  ///< commanded: nominal torque constant times current_a
  double current_a = 0, voltage_v = 0;
  double duty = 0;  ///< of the PWM period, -1 to 1
};

/// All values of a tick. The base has the signals of the back-end that drives the motor.
struct Row : BackendSignals {
  double time_s = 0;
  // From the plant; 0 in a replay, which has no columns for them.
  double theta_rad = 0, omega_rad_s = 0, motor_torque_nm = 0, hand_torque_nm = 0, hand_felt_nm = 0;
  double position_rad = 0;  ///< from the core's count
  int limits = 0, faults = 0;
  bool law_stale = false;               ///< a mailbox of the law in force is too old: no torque
  std::vector<BackendSignals> engines;  ///< in the order of BackendChoice::names()
};

/// Where a column finds its value in a row; called for every column of every tick.
class ColumnValue {
 public:
  explicit ColumnValue(double Row::*value) : kind_(Kind::row), row_(value) {}
  explicit ColumnValue(int Row::*bits) : kind_(Kind::bits), bits_(bits) {}
  /// A signal of the back-end that drives the motor.
  explicit ColumnValue(double BackendSignals::*value) : kind_(Kind::signal), signal_(value) {}
  /// A signal of the n-th of Row::engines.
  ColumnValue(double BackendSignals::*value, std::size_t engine)
      : kind_(Kind::engine), signal_(value), engine_(engine) {}

  /// Whether the value is a set of bits, below 256, and no measured quantity.
  bool is_bits() const { return kind_ == Kind::bits; }
  double operator()(const Row& r) const {
    switch (kind_) {
      case Kind::row:
        return r.*row_;
      case Kind::bits:
        return r.*bits_;
      case Kind::signal:
        return r.*signal_;
      case Kind::engine:
        break;
    }
    return r.engines[engine_].*signal_;
  }

 private:
  enum class Kind { row, bits, signal, engine };
  Kind kind_;
  double Row::*row_ = nullptr;
  int Row::*bits_ = nullptr;
  double BackendSignals::*signal_ = nullptr;
  std::size_t engine_ = 0;
};

/// One column of a table of rows.
struct Column {
  std::string name;  ///< with unit, as in the header of a CSV file
  std::string unit;
  std::string meaning;
  int digits = 0;  ///< significant digits of a measured value; 0: all that it has
  ColumnValue value;
};

/// The columns of a run. Those of the plant exist only in a closed loop; each of `engines`, as from
/// BackendChoice::names(), has its own set.
std::vector<Column> row_columns(bool closed_loop, const std::vector<std::string>& engines);

/// The table of docs/json.md with every column; "X_" stands for the name of a back-end.
std::string columns_markdown();

}  // namespace feltgate
