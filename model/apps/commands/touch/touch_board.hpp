// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// `feltgate touch --board`: the planes of a mesh for a stylus at a port, as fast as its line
// allows. Documentation: docs/touch.md#on-a-board
#pragma once

#include "apps/commands/touch/touch_report.hpp"
#include "host/mailbox_burst.hpp"
#include "sim/axes_loop/axes_scene.hpp"

namespace feltgate {

/// What a session at a board was.
struct BoardTouch {
  touch::TouchRun run;  ///< poses, planes, and the force that the law asked for then; no result
  double rate_hz = 0;   ///< at which poses are asked for
  std::int64_t skipped = 0;  ///< poses that a newer one had overtaken
  host::BurstCounts counts;
};

/// The stylus with planes that is shipped.
AxesScene stylus_scene();

/// Loads the law if the board has another one, arms it, and sends planes until `a.seconds` are over
/// or Ctrl-C; the motors are off afterwards. A pen that is in the mesh feels nothing until it is
/// led out. Errors: std::invalid_argument, also for a board that is no stylus; host::Refused,
/// host::LinkLost.
BoardTouch touch_board(const TouchArguments& a, const touch::Mesh& mesh,
                       const touch::TouchRequest& request);
std::string board_text(const BoardTouch& b);
void add_board(nlohmann::ordered_json& j, const BoardTouch& b);

}  // namespace feltgate
