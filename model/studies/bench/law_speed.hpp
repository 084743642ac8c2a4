// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Measures the time of a run of each shipped law: compiled C++ in fixed point and in double, and
// the interpreter of its words. Documentation: docs/bench.md
#pragma once

#include <memory>
#include <string>
#include <vector>

namespace feltgate::bench {

/// Samples of one law: times of a run in ns, one per repetition.
struct LawSamples {
  std::string name;
  int instructions = 0;
  std::vector<double> compiled, real, interpreted;
};

/// Runs all shipped laws on random inputs over their ranges.
class LawBench {
 public:
  /// `folder`: folder of the law files. Throws law::LawError.
  explicit LawBench(const std::string& folder);
  ~LawBench();
  /// Takes one more sample of each law.
  void repeat();
  const std::vector<LawSamples>& samples() const { return samples_; }

 private:
  class Runs;
  std::vector<std::unique_ptr<Runs>> runs_;
  std::vector<LawSamples> samples_;
};

}  // namespace feltgate::bench
