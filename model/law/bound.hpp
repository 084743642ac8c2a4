// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Proves the error bound of a program: no instruction saturates, no factor, index or state leaves
// its range, and each result has a largest distance from the law in real numbers. Documentation:
// docs/laws.md
#pragma once

#include <string>
#include <vector>

#include "law/law.hpp"
#include "law/program.hpp"
#include "law/ranges.hpp"
#include "law/target.hpp"

namespace feltgate::law {

/// Range and error of a step's result, in words.
struct Fact {
  Span words;
  double error = 0;  ///< largest distance from the law's value
};

/// A forbidden effect of an instruction that the proof cannot exclude.
struct Unproven {
  int step = -1;  ///< -1: the entry is about a state
  int state = -1;
  std::string reason;
};

/// How the analysis derived the facts of a step; a second proof starts from it.
struct Reason {
  Fact x, y, acc;        ///< facts of the operands
  bool between = false;  ///< ADD: taken as y + a (x - y)
  int taken = 0;         ///< MIN, MAX, SEL: 1: surely x; 2: surely y; 0: either
  Span decided{0, 1};    ///< CMP: its own result, before it is joined with the flag
  Span law{1, 0};        ///< the law's range in words, where it narrowed the step's; else empty
  /// SEL: the comparisons that decide, if joined_alike().
  std::vector<int> sources;
};

/// Whether the flag is one comparison, or all are joined by `or`, or all by `and`: an operand can
/// then be narrowed by each of them.
bool joined_alike(const Program& program, const std::vector<int>& comparisons);
/// Whether a flag `truth` says the result of every one of them; else it says that of at least one.
bool hold_together(const Program& program, const std::vector<int>& comparisons, bool truth);

/// The facts of a program over one cell.
struct CellFacts {
  bool reachable = true;
  std::vector<Fact> steps;
  std::vector<Reason> reasons;  ///< of each step; only when asked for
  std::vector<Unproven> unproven;
  std::vector<double> output_error;  ///< Nm, in the order of Law::outputs
  std::vector<double> output_apart;  ///< Nm: largest distance of words and law by their ranges
  std::vector<double> state_error;   ///< SI, after the run
  std::vector<double> margin;        ///< words: within it, a comparison may have either result
};

/// `value`, which lies outside lower .. upper, printed with enough digits to show that.
std::string beyond_text(double value, double lower, double upper);

/// Analyses the program over `cell`. `state_error`: largest distance of the states from the law's
/// before the run, SI. `swap`: step of a comparison that is assumed to go wrong (-1: none); its
/// selections may then take either value, and every comparison whose margin becomes wider than in
/// `margins` (the margins without a swap) may go wrong too. `spans`: the law's ranges over the
/// cell, when already known. `explain`: also fill CellFacts::reasons.
CellFacts analyse(const Law& law, const Target& target, const Program& program, const Cell& cell,
                  const std::vector<double>& state_error, int swap = -1,
                  const std::vector<Span>* spans = nullptr, bool explain = false,
                  const std::vector<double>* margins = nullptr);

/// A band around a comparison's switching point in which outputs may exceed the bound.
struct Strip {
  NodeId condition = -1;
  int step = -1;       ///< Program::steps
  NodeId floors = -1;  ///< >= 0: the band lies around the whole numbers of this node's value
  Place place;
  double width = 0;  ///< on each side, in `unit`
  Unit unit;
  std::vector<double> jump;         ///< of each output, Nm
  std::vector<double> jump_as_set;  ///< the same with the parameter values of the file
  std::vector<double> next;         ///< of each state, then of each line: of its next value, SI
};

struct Bound {
  std::vector<double> output;  ///< Nm
  std::vector<double> as_set;  ///< Nm, with the parameter values of the file
  std::vector<double> state;   ///< SI
  bool states_bounded = true;  ///< false: some state error has no finite bound; all bounds then
                               ///< hold for one run from the current states
  std::vector<double> drift;   ///< SI: error that a run adds to each state, where not bounded
  std::vector<Unproven> unproven;
  bool reachable = true;  ///< false: the formats hold no value in any cell
  std::vector<Strip> strips;
  std::vector<Place> sharp;     ///< comparisons without a strip: words and law switch together
  std::vector<Span> words;      ///< of each step, over all cells
  std::vector<double> errors;   ///< of each step, words
  std::vector<double> margins;  ///< of each comparison, words
  int cells = 1;
  std::vector<Cell> parts;  ///< the cells, the one with the largest error first
};

/// Bounds the program over the whole cell; splits the cell at most `splits` times, where a split
/// reduces the bound.
Bound bound(const Law& law, const Target& target, const Program& program, int splits,
            const std::vector<Span>* whole = nullptr);

/// Bound::as_set over `cell`, in which each parameter has one value. It holds for one run if `all`
/// does.
std::vector<double> bound_as_set(const Law& law, const Target& target, const Program& program,
                                 const Cell& cell, const Bound& all, int splits);

// The range of a value of the law that conditions decide: what is compared is narrowed on each
// side.

/// The range of node `id` over `cell`. Where it is a choice (or a choice of choices), each side is
/// looked at where its condition can hold: `if n < 9 then n + 1 else 0` goes to 9 for a whole n.
Span reach(const Law& law, RangesOf& ranges, NodeId id, const Cell& cell);

}  // namespace feltgate::law
