// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The verbs of feltgate host; each adds its options and returns the function that runs it.
// Documentation: docs/host.md
#pragma once

#include <CLI/CLI.hpp>
#include <functional>

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

/// The options of calibrate cogging.
struct CoggingArguments {
  std::string from, write, json, slow_turn, into;
  double confidence = 0;
};
/// Writes the law that turns the lever slowly, or from its recording the one that compensates.
int calibrate_cogging(Session& session, const CoggingArguments& a);

}  // namespace feltgate::host
