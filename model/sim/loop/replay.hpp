// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Open loop on an encoder recording: every back-end gets the same edges.
// Documentation: docs/traces.md
#pragma once

#include "feltgate/encoder_source.hpp"
#include "loop.hpp"

namespace feltgate {

/// Options of a replay.
struct ReplayOptions : BackendOptions {
  std::string scene = "spring_tension";  ///< scene that is rendered during the recording
  bool arm = true;
  const bounds::Coverage* coverage = nullptr;  ///< ticks in which bounds are checked
  Clock most_clocks = 0;                       ///< stops there; 0: at the end
  std::function<void(const Row&)> row;         ///< called for every row_every-th tick
  std::function<void(Clock done)> progress;
};

/// Replays a recording to its end; memory does not grow with its length. Errors: traces::TraceError
/// for a wrong recording.
RunResult run_replay(EncoderSource& source, const std::string& subject,
                     const ReplayOptions& options);

}  // namespace feltgate
