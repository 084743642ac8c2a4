// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Writes the bound of a law as problems for Gappa, which proves it independently. Documentation:
// docs/laws.md
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "law/compile.hpp"

namespace feltgate::law {

/// One Gappa problem: a straight-line segment between table reads, branches and words with more
/// than one use.
struct GappaLemma {
  std::string name;        ///< its file name, without folder
  std::string text;        ///< the problem
  std::vector<int> steps;  ///< Program::steps whose results it proves
};

/// The error of a table against its function, evaluated at every word of the argument; it does not
/// use the compiler's curvature bound.
struct TableProof {
  std::vector<double> error;     ///< of each segment: largest |line - function| at its 4096 words
  std::vector<double> gradient;  ///< of each segment: largest |function'|, words per word
  std::vector<double> between;   ///< as error, but also between words; may be infinite
  std::vector<double> rise;      ///< of each segment's line: |slope|, words per word
};

/// The proof of the table of `step` (an LRP), over the words that its argument can have.
TableProof table_proof(const Compiled& compiled, int step);

class Gappa {
 public:
  explicit Gappa(const Compiled& compiled);

  /// Lemmas that together prove the claims of bound() about Bound::parts[cell]. They derive the
  /// range and error of each segment's result from those of its operands, and show that nothing
  /// saturates, that no index leaves its table, and that law and words decide comparisons alike
  /// beyond the margin.
  std::vector<GappaLemma> lemmas(int cell) const;

 private:
  const Compiled& compiled_;
  std::vector<TableProof> tables_;  ///< of each step; empty unless the step is an LRP
};

struct GappaCount {
  int steps = 0;                  ///< number of instructions that compute
  std::vector<int> uncovered;     ///< steps that are in no lemma, or in an unproven one
  int cells = 0, all_cells = 0;   ///< cells examined, and cells in total
  int lemmas = 0;                 ///< number of different lemmas
  std::vector<std::string> open;  ///< names of the unproven lemmas
};

/// Proves the lemmas of `cells` of the law's cells (0: all), each text once. The cell with the
/// largest error comes first; the others are spread evenly. `proves` reports whether Gappa proves a
/// lemma.
GappaCount prove_again(const Compiled& compiled, int cells,
                       const std::function<bool(const GappaLemma&)>& proves);

}  // namespace feltgate::law
