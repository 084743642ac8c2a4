// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Starts, supervises and ends the stream that watch and record follow; ticks as rows of a CSV.
// Documentation: docs/host.md
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "apps/commands/host/session.hpp"

namespace feltgate::host {

struct StreamArguments {
  std::vector<std::string> names;
  std::string arm;     ///< scene to arm while the stream lasts; empty: none
  double every_s = 0;  ///< interval between shown ticks
  double seconds = 0;  ///< how long; 0: until Ctrl-C
};

/// Adds the options --arm, --every, --for and the names.
void add_stream_options(CLI::App& sub, StreamArguments& a);

/// Mask of the words to stream: those of the quantities, plus status and faults for every display.
WordMask stream_mask(Device& device, const StreamArguments& a);
std::vector<const Quantity*> stream_columns(Device& device, const StreamArguments& a);

/// Ticks between two of the stream, for --every; 0 there: as the wire allows. Throws
/// std::invalid_argument where that is too fast for it.
std::uint32_t stream_period(Session& session, const StreamArguments& a);

/// Head and rows of a CSV that PlotJuggler and `replay` read: time_s, then one column per quantity.
std::string csv_head(const std::vector<const Quantity*>& columns);
std::string csv_row(const std::vector<const Quantity*>& columns, const Tick& tick);

/// Streams until the time ends or Ctrl-C. If the host armed the motor, it feeds the watchdog and
/// disarms at the end. `period` in ticks. Throws Refused when a fault disarms the motor.
void follow_stream(Device& device, const StreamArguments& a, std::uint32_t period,
                   const std::function<void(const Tick&)>& show);

}  // namespace feltgate::host
