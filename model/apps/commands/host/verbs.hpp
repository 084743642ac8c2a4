// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The verbs of feltgate host; each adds its options and returns the function that runs it.
// Documentation: docs/host.md
#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <optional>

namespace feltgate::host {

class Session;
using Run = std::function<int(Session&)>;

Run add_info(CLI::App& sub);
Run add_get(CLI::App& sub);
Run add_set(CLI::App& sub);
Run add_law(CLI::App& sub);
Run add_events(CLI::App& sub);
Run add_scene(CLI::App& sub);
Run add_arm(CLI::App& sub);
Run add_disarm(CLI::App& sub);
Run add_stop(CLI::App& sub);
Run add_clear(CLI::App& sub);
Run add_zero(CLI::App& sub);
Run add_watch(CLI::App& sub);
Run add_capture(CLI::App& sub);
Run add_record(CLI::App& sub);
Run add_calibrate(CLI::App& sub);
Run add_identify(CLI::App& sub);

/// The options of calibrate align.
struct AlignArguments {
  std::string from, write, json, save;
  double voltage_v = 0;  ///< 0: half of the nominal current's
  double confidence = 0;
};
/// Pole pairs and offset of a motor with three phases, from a file or from the board's motor.
int calibrate_align(Session& session, const AlignArguments& a);

/// Reads a line that a user types while a motor is held armed; calls `meanwhile` about twenty times
/// a second while it waits. Returns nothing when `go_on` returns false. Throws
/// std::invalid_argument at the end of the input; the message names `what` was expected.
std::optional<std::string> typed_line(const std::string& what, const std::function<bool()>& go_on,
                                      const std::function<void()>& meanwhile);

}  // namespace feltgate::host
