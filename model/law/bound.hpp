// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// What is proven of a program: no instruction saturates, no factor or index leaves its range,
// states stay in theirs, and how far every result is from the law in real numbers. Documentation:
// docs/law-compiler.md
#pragma once

#include <string>
#include <vector>

#include "law/law.hpp"
#include "law/program.hpp"
#include "law/ranges.hpp"
#include "law/target.hpp"

namespace feltgate::law {

/// Of a step's result, in words.
struct Fact {
  Span words;
  double error = 0;  ///< largest distance from the law's value
};

/// What an instruction may do that it must not.
struct Unproven {
  int step = -1;  ///< -1: of a state
  int state = -1;
  std::string reason;
};

/// How the facts of a step came about; what a second proof starts from.
struct Reason {
  Fact x, y, acc;        ///< what it was given
  bool between = false;  ///< ADD: taken as y + a (x - y)
  int taken = 0;         ///< MIN, MAX, SEL: surely x (1), surely y (2)
  int source = -1;       ///< SEL: the only comparison that decides
  Span decided{0, 1};    ///< CMP: its own result, before it joins the flag
  Span law{1, 0};        ///< words of the law's range, where that narrowed the step's
};

/// A program over one cell.
struct CellFacts {
  bool reachable = true;
  std::vector<Fact> steps;
  std::vector<Reason> reasons;  ///< of each step, where asked for
  std::vector<Unproven> unproven;
  std::vector<double> output_error;  ///< Nm, as Law::outputs
  std::vector<double> output_apart;  ///< Nm: words and law are no further apart by their ranges
  std::vector<double> state_error;   ///< SI, after the run
  std::vector<double> margin;        ///< of comparisons: words within which both ways are possible
};

/// `value`, which is beyond one end of a range, with the digits that show it.
std::string beyond_text(double value, double lower, double upper);

/// `state_error`: how far the states may be from the law's before the run, SI. `swap`: that
/// comparison may go wrong, so what it selects may be off by all that it chooses from, and with it
/// every comparison whose margin is then wider than in `margins`, which are those without; -1:
/// none. `spans`: the ranges of the law over the cell where they are known already. `explain`: with
/// CellFacts::reasons.
CellFacts analyse(const Law& law, const Target& target, const Program& program, const Cell& cell,
                  const std::vector<double>& state_error, int swap = -1,
                  const std::vector<Span>* spans = nullptr, bool explain = false,
                  const std::vector<double>* margins = nullptr);

/// A comparison beside which outputs may differ by more than the bound.
struct Strip {
  NodeId condition = -1;
  int step = -1;  ///< Program::steps
  NodeId floors = -1;  ///< >= 0: where this node's value is beside a whole number
  Place place;
  double width = 0;  ///< either side, in `unit`
  Unit unit;
  std::vector<double> jump;  ///< of each output, Nm
};

struct Bound {
  std::vector<double> output;  ///< Nm
  std::vector<double> as_set;  ///< Nm, with the parameters as the file sets them
  std::vector<double> state;   ///< SI
  bool states_bounded = true;  ///< false: some state has no finite error; bounds are then of one
                               ///< run from the states as they stand
  std::vector<double> drift;   ///< SI: what a run adds to each state's error, where not bounded
  std::vector<Unproven> unproven;
  std::vector<Strip> strips;
  std::vector<Place> sharp;    ///< comparisons without a strip: words and law change sides together
  std::vector<Span> words;     ///< of each step, over all cells
  std::vector<double> errors;  ///< of each step, words
  std::vector<double> margins;  ///< of each comparison, words
  int cells = 1;
  std::vector<Cell> parts;  ///< the cells, the one with the largest error first
};

/// Splits the cell at most `splits` times, where it helps.
Bound bound(const Law& law, const Target& target, const Program& program, int splits,
            const std::vector<Span>* whole = nullptr);

/// Bound::as_set, over `cell`, in which the parameters stand; of one run where `all` is.
std::vector<double> bound_as_set(const Law& law, const Target& target, const Program& program,
                                 const Cell& cell, const Bound& all, int splits);

}  // namespace feltgate::law
