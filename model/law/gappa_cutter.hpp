// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Cuts a program over one cell into problems for Gappa. Documentation: docs/laws.md
#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

#include "law/gappa.hpp"

namespace feltgate::law::gappa {

std::string number(double x);  ///< as Gappa reads it, exactly
std::string within(const Span& s);
std::string within(double e);

/// A word and the law's value that it stands for, as Gappa expressions.
struct Term {
  std::string word, law;
};

class Cutter {
 public:
  Cutter(const Compiled& c, const Cell& cell, const std::vector<TableProof>& tables, int number)
      : c_(c),
        steps_(c.program.steps),
        tables_(tables),
        cell_(number),
        facts_(analyse(c.law, c.target, c.program, cell, c.bound.state, -1, nullptr, true)),
        spans_(ranges(c.law, cell)) {}
  std::vector<GappaLemma> run();

 private:
  const Fact& fact(int i) const { return facts_.steps[at(i)]; }
  const Reason& why(int i) const { return facts_.reasons[at(i)]; }
  static bool wraps(const Fact& f) { return f.words.width() >= 4294967295.0; }

  /// Whether Gappa can follow step `i` without hints.
  bool plain(int i) const;
  /// Finds the ends of segments: steps with two or more uses, and steps whose user is a segment of
  /// its own.
  void cut();
  bool plain_user(int user, int i) const;
  std::vector<int> arguments(int i) const;
  // One problem.

  void begin();
  void give(const std::string& h) { given_ += (given_.empty() ? "" : "\n  /\\ ") + h; }
  void want(const std::string& g) { goals_ += (goals_.empty() ? "" : "\n  /\\ ") + g; }

  void finish(const std::string& branch);
  /// A word with its range and its distance from the law's value; the law's value gets its own
  /// (upper-case) name only where it differs.
  Term leaf(const std::string& low, const std::string& high, const Fact& f);
  Term result_of(int i);
  Term operand(int i, bool second);
  /// Adds the distance of a constant operand from the exact value.
  Term apart(Term t, int i, bool second, double extra);
  Term product(int i, const char* rounding);
  Term expression(int i);
  Term define(int i);
  /// Adds the rewriting left -> right as a hint for Gappa.
  void hint(const std::string& left, const std::string& right);
  void require(const Term& t) { require(t.word, t.law); }

  /// Demands that `word`, with the law's value `law`, satisfies the facts of the step's result.
  void require(const std::string& word, const std::string& law);
  void step();
  void extreme(bool least);
  void select();
  /// Adds the consequences of comparison `c` having the result `truth`: for its operands and for a
  /// sum of them.
  void known_branch(int c, bool truth, bool second);
  void compare();
  void amount();
  void sign();
  /// Proves that the index lies in the table or the delay line.
  bool index();
  /// Proves a table read; `m` names the segment's line at the argument's word.
  void table();
  /// Proves y + a (x - y) with a in 0 .. 1 as (1 - a) y + a x; k is a in the law's unit.
  void between();
  void states();
  /// Proves the law's ranges that narrowed words: each node's range from those of its arguments.
  /// Ranges of inputs, parameters and states are declared; a function's range follows from the
  /// function.
  void law_ranges();
  bool law_between(NodeId id);
  const Compiled& c_;
  const std::vector<Step>& steps_;
  const std::vector<TableProof>& tables_;
  int cell_;
  CellFacts facts_;
  std::vector<Span> spans_;
  std::vector<char> sink_;
  std::vector<GappaLemma> lemmas_;
  std::set<NodeId> wanted_;
  int n_ = 0;
  std::string given_, definitions_, goals_, hints_;
  std::map<int, Term> defined_;
  std::set<std::string> known_;
};

}  // namespace feltgate::law::gappa
