// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// A stream that watch and record follow: started, watched over, ended. Documentation: docs/host.md
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "tools/host/session.hpp"

namespace feltgate::host {

struct StreamArguments {
  std::vector<std::string> names;
  std::string arm;     ///< scene to arm for as long as the stream lasts; empty: none
  double every_s = 0;  ///< from tick to tick
  double seconds = 0;  ///< how long; 0: until Ctrl-C
};

/// --arm, --every, --for and the names.
void add_stream_options(CLI::App& sub, StreamArguments& a);

/// Words to stream for these quantities, and status and faults, which every display needs.
std::uint16_t stream_mask(Device& device, const StreamArguments& a);
std::vector<const Quantity*> stream_columns(Device& device, const StreamArguments& a);

/// Streams until the time is over or Ctrl-C; feeds the watchdog and disarms at the end where the
/// host armed the motor. `period` in ticks. Throws Refused when a fault ends an armed motor.
void follow_stream(Device& device, const StreamArguments& a, std::uint32_t period,
                   const std::function<void(const Tick&)>& show);

}  // namespace feltgate::host
