// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Open loop on an encoder recording: every engine sees the same edges. Documentation:
// docs/traces.md
#pragma once

#include "feltgate/encoder_source.hpp"
#include "loop.hpp"

namespace feltgate {

struct ReplayOptions {
  std::string design = "lever";
  std::string engine = "all";
  std::string scene = "spring_tension";  ///< rendered while the recording moves the lever
  bool arm = true;
  std::uint64_t seed = 1;
  std::string fst;
  Clock fst_from = 0, fst_to = -1;
  const bounds::Coverage* coverage = nullptr;  ///< of error bounds that are to be checked
  Clock most_clocks = 0;                       ///< stop there; 0: to the end of the recording
  std::function<void(const Row&)> row;         ///< for every row_every-th tick
  int row_every = 1;
  std::function<void(Clock done)> progress;
};

/// Replays a recording to its end. Memory does not grow with its length.
/// Throws traces::TraceError where the recording is wrong.
RunResult run_replay(EncoderSource& source, const std::string& subject,
                     const ReplayOptions& options);

}  // namespace feltgate
