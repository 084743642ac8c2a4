// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Cuts a program over one cell into problems for Gappa. Documentation: docs/law-compiler.md
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

/// A word and what it stands for, as expressions.
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

  /// Gappa follows it by itself.
  bool plain(int i) const;
  /// Where segments end: at what is used twice, or by what is a segment of its own.
  void cut();
  bool plain_user(int user, int i) const;
  std::vector<int> arguments(int i) const;
  // One problem.

  void begin();
  void give(const std::string& h) { given_ += (given_.empty() ? "" : "\n  /\\ ") + h; }
  void want(const std::string& g) { goals_ += (goals_.empty() ? "" : "\n  /\\ ") + g; }

  void finish(const std::string& branch);
  /// A word with its range, and how far it is from the law's; upper case only where it differs.
  Term leaf(const std::string& low, const std::string& high, const Fact& f);
  Term result_of(int i);
  Term operand(int i, bool second);
  /// A constant's distance to what it stands for.
  Term apart(Term t, int i, bool second, double extra);
  Term product(int i, const char* rounding);
  Term expression(int i);
  Term define(int i);
  /// left = right, which Gappa is to try.
  void hint(const std::string& left, const std::string& right);
  void require(const Term& t) { require(t.word, t.law); }

  /// That `word` may stand for the step's result where `law` is the law's.
  void require(const std::string& word, const std::string& law);
  void step();
  void extreme(bool least);
  void select();
  /// What a comparison that came out so says of its operands, and of a sum of them.
  void known_branch(int c, bool truth, bool second);
  void compare();
  void amount();
  void sign();
  /// The index lies in the table, or line.
  bool index();
  /// `m` is the line at the word of the argument, between segments as the table says.
  void table();
  /// y + a (x - y) with a in 0 .. 1 is (1 - a) y + a x; k is a in the law's unit.
  void between();
  void states();
  /// The ranges of the law itself that narrowed words: every node from those of its arguments.
  /// Inputs, parameters and states have theirs declared, functions by what they are.
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
