// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// A run's figures as JSON and its rows as CSV.
// Documentation: docs/json.md
#pragma once

#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include "bounds/error_bounds.hpp"
#include "loop/loop.hpp"

namespace feltgate {

/// Rows to CSV, every n-th one.
class CsvWriter {
 public:
  CsvWriter(std::FILE* to, int every);
  void add(const Row& row);

 private:
  std::FILE* to_;
  int every_;
  std::int64_t count_ = 0;
};

/// What the JSON says beyond the figures.
struct RunLabels {
  std::string subject_key;  ///< "scene" or "trace"
  std::string plant, probes;
  bool closed_loop = false;
  int expectations = 0;
  int step_clocks = 0;                          ///< of the plant
  std::vector<std::string> effects_off = {};    ///< of the plant
  const bounds::ErrorBounds* bounds = nullptr;  ///< shown beside the errors; may be none
};

/// Adds to result.broken where an error exceeds its bound in a tick for which the bound holds.
void check_bounds(RunResult& result, const bounds::ErrorBounds& bounds);

/// The JSON object, pretty-printed.
std::string run_json(const RunResult& result, const RunLabels& labels);

/// The same for reading on a terminal.
std::string run_text(const RunResult& result, const RunLabels& labels);

}  // namespace feltgate
