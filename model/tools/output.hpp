// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// A run's figures as JSON and its rows as CSV; files appear whole or not at all.
// Documentation: docs/json.md
#pragma once

#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include "bounds/error_bounds.hpp"
#include "loop/loop.hpp"

namespace feltgate {

/// A file under construction: written beside its name and renamed by commit(), removed otherwise.
class OutputFile {
 public:
  /// Throws std::runtime_error when it cannot be created.
  explicit OutputFile(const std::string& path);
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;
  std::FILE* handle() { return file_; }
  const std::string& part() const { return part_; }
  /// Throws std::runtime_error when not everything could be written.
  void commit();

 private:
  std::string path_, part_;
  std::FILE* file_ = nullptr;
};

/// Rows to CSV, every n-th one.
class CsvWriter {
 public:
  CsvWriter(const std::string& path, int every);
  void add(const Row& row);
  void commit() { file_.commit(); }

 private:
  OutputFile file_;
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
