// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// What a run of a shipped law costs: compiled C++ in fixed point and in double, and the interpreter
// of its words. Documentation: docs/bench.md
#pragma once

#include <memory>
#include <string>
#include <vector>

namespace feltgate::bench {

/// A law; times are ns of a run, one per repetition.
struct LawSamples {
  std::string name;
  int instructions = 0;
  std::vector<double> compiled, real, interpreted;
};

/// All shipped laws, on random inputs over their ranges.
class LawBench {
 public:
  /// `folder`: the law files. Errors: law::LawError.
  explicit LawBench(const std::string& folder);
  ~LawBench();
  /// One more sample of each.
  void repeat();
  const std::vector<LawSamples>& samples() const { return samples_; }

 private:
  class Runs;
  std::vector<std::unique_ptr<Runs>> runs_;
  std::vector<LawSamples> samples_;
};

}  // namespace feltgate::bench
