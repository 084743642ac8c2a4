// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The bound of a law as problems for Gappa, which proves it again. Documentation:
// docs/law-compiler.md
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "law/compile.hpp"

namespace feltgate::law {

/// One problem of Gappa: a straight-line segment between table reads, branches and words that are
/// used more than once.
struct GappaLemma {
  std::string name;        ///< of its file, without folder
  std::string text;        ///< the problem
  std::vector<int> steps;  ///< Program::steps whose results it is about
};

/// A table's words against its function, looked at one by one: for every word of the argument, not
/// by the compiler's curvature.
struct TableProof {
  std::vector<double> error;     ///< of each segment: largest |line - function| at its 4096 words
  std::vector<double> gradient;  ///< of each segment: largest |function'|, words per word
  std::vector<double> between;   ///< as error, between words too; may be infinite
  std::vector<double> rise;      ///< of each segment's line: |slope|, words per word
};

/// Of the step's table, an LRP's, over the words that its argument can be.
TableProof table_proof(const Compiled& compiled, int step);

class Gappa {
 public:
  explicit Gappa(const Compiled& compiled);

  /// Lemmas that together show what bound() says of Bound::parts[cell]: from the ranges and errors
  /// of what a segment is given, those of its result; that nothing saturates, that no index leaves
  /// its table, that comparisons are decided alike beyond the margin.
  std::vector<GappaLemma> lemmas(int cell) const;

 private:
  const Compiled& compiled_;
  std::vector<TableProof> tables_;  ///< of each step; empty where it is no LRP
};

struct GappaCount {
  int steps = 0;                  ///< instructions that compute
  std::vector<int> uncovered;     ///< those that are in no lemma, or in one that was not proven
  int cells = 0, all_cells = 0;   ///< looked at, and of how many
  int lemmas = 0;                 ///< different ones
  std::vector<std::string> open;  ///< names of those that were not proven
};

/// The lemmas of so many of a law's cells (0: all; the one with the largest error first, the others
/// evenly among the rest), each text once; `proves` says whether Gappa does.
GappaCount prove_again(const Compiled& compiled, int cells,
                       const std::function<bool(const GappaLemma&)>& proves);

}  // namespace feltgate::law
