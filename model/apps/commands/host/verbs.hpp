// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The verbs of feltgate host; each adds its options and returns the function that runs it.
// Documentation: docs/host.md
#pragma once

#include <functional>

#include "apps/commands/commands.hpp"
#include "apps/commands/host/session.hpp"

namespace feltgate::host {

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

/// A value in the unit of a law's parameter: "0.05 Nm".
std::string law_text(const law::ImageWord& of, double value);
/// The range of the parameter: "0 .. 0.5 Nm".
std::string range_text(const law::ImageWord& of);
/// The name and state of the law that runs.
std::string law_state(LawEngine& laws);

}  // namespace feltgate::host
