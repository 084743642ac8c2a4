// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Shows ticks of the stream to people and writes them for other programs. Documentation:
// docs/host.md
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <string>
#include <vector>

#include "host/host_device.hpp"

namespace feltgate::host {

/// The unit as a suffix of column names: "rad_s" for rad/s; empty for counts and shares.
std::string unit_suffix(const std::string& unit);

/// Head and rows of a CSV that PlotJuggler and `replay` read: time_s, then one column per quantity.
std::string csv_head(const std::vector<const Quantity*>& columns);
std::string csv_row(const std::vector<const Quantity*>& columns, const Tick& tick);

/// A value from lowest to highest in eighths of a line: "▁▂▅█".
std::string sparkline(const std::deque<double>& values);

/// What is shown of a tick.
struct LiveColumn {
  std::string name, unit;
  std::function<double(const Tick&)> value;
};
std::vector<LiveColumn> live_columns(const std::vector<const Quantity*>& quantities);

/// The display of the verb watch.
class Live {
 public:
  enum class Form { terminal, lines, teleplot };
  Live(Device& device, std::vector<LiveColumn> columns, Form form);
  void show(const Tick& tick);
  /// Moves the cursor below the display.
  void finish();

 private:
  void on_terminal(const Tick& tick);
  void as_line(const Tick& tick);
  void as_teleplot(const Tick& tick);
  std::string status(const Tick& tick) const;

  Device& device_;
  std::vector<LiveColumn> columns_;
  Form form_;
  std::vector<std::deque<double>> history_;
  int lines_ = 0;
  unsigned lost_ = 0;
};

}  // namespace feltgate::host
