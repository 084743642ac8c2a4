// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Lowers a law's graph to steps: formats are chosen or taken as given, and operations become
// instructions. Documentation: docs/laws.md
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <stdexcept>
#include <string>
#include <tuple>
#include <vector>

#include "law/law.hpp"
#include "law/program.hpp"
#include "law/ranges.hpp"
#include "law/target.hpp"

namespace feltgate::law {

// Makes the words of table memory for functions, and proves their error.

/// A function that returns its jet: value, slope and curvature over a span of its argument, in SI.
using JetFunction = std::function<Jet(const Span&)>;

struct TableRequest {
  JetFunction function;
  Span domain;            ///< SI; the argument is clamped to it
  double argument_scale;  ///< SI value of one LSB of the argument's word
  int low, count;         ///< first index x >> 12, and how many segments
  double value_scale;     ///< SI value of one LSB of the result
  std::int32_t limit;     ///< largest magnitude of a value, words
};

/// The function, continued beyond its domain where the domain ends inside a segment: there it is
/// the line through the domain's end and the segment's sample inside. `request` must outlive the
/// result.
std::function<double(double)> extended(const TableRequest& request);

/// Makes linear segments between samples; each is shifted so that its largest positive and negative
/// errors are equal.
TableUse make_table(const TableRequest& request);

/// Sine over a full turn, wrapping: 2^21 words of the argument per turn, values of at most `limit`
/// words.
TableUse sine_turn(std::int32_t limit, double value_scale);
/// Sine over [-1/2, 1/2) turn in segments of 2^-bits turns; with `cosines`, over [-1/2, 3/4) turn.
TableUse sine_part(int bits, bool cosines, std::int32_t limit, double value_scale);

// The values at which a law's values stay: clamp(x, 0, 3) is 3 over half of all positions. A word
// beside that 3 would be on the wrong side of a comparison with 3 in all of them.

class Stays {
 public:
  explicit Stays(const Law& law);

  /// Whether the node can keep this value while what it is made of moves.
  bool at(NodeId id, double value) const;
  /// Whether the node, or what it goes to unchanged, is compared with a value at which it stays.
  bool decides(NodeId id) const { return decides_[static_cast<std::size_t>(id)] != 0; }
  /// Whether the node can stay at a whole number.
  bool at_whole(NodeId id) const;

 private:
  const std::vector<double>& of(NodeId id);
  void decide(NodeId id, double value);

  const Law& law_;
  std::map<NodeId, std::vector<double>> values_;
  std::vector<char> decides_;
};

/// The decisions that a search may change. lower() notes its own choice where none is given.
struct Choice {
  std::map<NodeId, int> fraction;  ///< fraction bits of nodes with an own format: scale = unit/2^f
  int uniform = 0;                 ///< > 0: first fraction bits of selected and of kept values
  bool states_first = false;       ///< order of the roots
  int sine_bits = 0;  ///< log2 of segments per turn; 9: all table memory; 0: as many as fit
  std::map<std::string, TableUse> made;  ///< tables by a key of their content: each proven once
  std::map<std::string, int> fractions;  ///< fraction bits of such tables' values, by their domain
  std::shared_ptr<const Stays> stays;    ///< of the law: computed once
};

/// Thrown when no instructions exist for this choice of formats; another choice may have some.
class Unfit : public std::runtime_error {
 public:
  /// `node` does not fit; `scale` > 0: the scale of the word that cannot hold it.
  explicit Unfit(const std::string& what, NodeId node = -1, double scale = 0)
      : std::runtime_error(what), node(node), scale(scale) {}
  NodeId node;
  double scale;
};

/// Lowers the law to steps; `spans` are the ranges of its nodes. Throws Unfit when another choice
/// may help, Refused when no choice helps.
Program lower(const Law& law, const Target& target, const std::vector<Span>& spans, Choice& choice);

/// An operand and the SI value that it stands for.
struct Value {
  Operand operand;
  double scale = 1;  ///< SI value of one word LSB
  double size = 0;   ///< largest magnitude, SI
  double error = 0;  ///< of a constant operand: its rounding error, in words
};

/// A product of a number, of parameters (fixed during a run) and of other nodes.
struct Term {
  double number = 1;
  std::vector<NodeId> fixed;
  std::vector<NodeId> factors;
};

/// Whether a/b is a power of two, within the rounding of doubles.
bool same_unit(double a, double b);
bool same_scale(double a, double b);
/// Whether every whole number has a word of this scale.
bool counts(double scale);

class BackEnd {
 public:
  BackEnd(const Law& law, const Target& target, const std::vector<Span>& spans, Choice& choice);
  Program run();

 private:
  // sums.cpp
  void collect(NodeId id, double number, bool root, std::vector<Term>& terms) const;
  void gather(NodeId id, bool root, Term& term) const;
  Value sum(NodeId id, double hint);
  bool turned(NodeId id, NodeId* by, Term* amount) const;
  Value turned_sum(NodeId id, Term term, double hint);
  struct Multiply {
    Operand x, y;
    int mode = 0;
    double y_error = 0;
  };
  struct Addend {
    Operand operand;
    int sign = 1;
    double error = 0;
  };
  struct Chain {
    std::vector<Multiply> products;
    std::vector<Addend> addends;
    bool steps = false;  ///< the scale is for the whole steps of one of the terms
  };
  double step_of(const std::vector<Term>& terms) const;
  double sum_scale(NodeId id, const std::vector<Term>& terms, double hint);
  void add_term(const Term& term, double scale, NodeId id, Chain& chain);
  Value chain(const Chain& chain, double scale, NodeId id);
  Value product(const Value& a, const Value& b, NodeId id);
  Multiply pair(const Value& a, const Value& b, int shift, NodeId id);
  Multiply by_number(const Value& v, double ratio, NodeId id);
  Multiply by_word(const Value& v, const Term& term, double scale, NodeId id);
  Value narrow(const Value& v, NodeId id);
  Value negated(const Value& v, NodeId id);
  bool fits_factor(const Value& v) const;

  // lower.cpp
  Value value(NodeId id, double hint = 0);
  Value compute(NodeId id, double hint);
  bool breaks(const std::vector<NodeId>& fixed, double word_scale) const;
  Value in_ones(const std::vector<NodeId>& fixed);
  Value at_scale(NodeId id, double scale, double* error);
  Value align(const Value& v, double scale, NodeId id);
  bool flips(NodeId id) const;
  Value selection(NodeId id, double hint);
  double common_scale(NodeId id, const std::vector<NodeId>& children, double hint, bool chosen);
  Value absolute(NodeId id, double hint);
  Value state(NodeId id);
  Value mailbox(NodeId id);
  double chosen_scale(NodeId id, double unit, int preferred, double size);
  int largest_fraction(NodeId id, double unit, double size) const;

  // conditions.cpp
  void lower_leaves(NodeId condition);
  void flag(NodeId condition);
  int raise(NodeId condition, bool opposite);
  bool simple(NodeId condition, bool opposite) const;
  Operand threshold(double exact, bool above);
  Value compared(NodeId leaf, int side, double scale, double* error);
  void compare(NodeId leaf, int mode);
  Value element(NodeId id);
  void begin_lines();
  Value line_read(NodeId id);
  void write_lines();
  struct Map {
    double factor = 1, offset = 0;
    /// This map of f * x + o.
    Map after(double f, double o) const { return {factor * f, factor * o + offset}; }
  };
  struct Ends {
    double scale;
    Span range;  ///< of the whole result
    bool down;   ///< ends are rounded down
  };
  bool has_ends(NodeId id, bool or_whole = false) const;
  Value with_ends(NodeId id, double scale, bool down);
  Value with_ends(NodeId id, const Map& map, const Ends& ends);
  Value mapped(NodeId id, const Map& map, const Ends& ends);
  Value clipped(Value v, const Map& map, const Ends& ends, NodeId id);

  // functions.cpp
  Value function(NodeId id);
  Value sine(NodeId id);
  Value align_for_table(const Value& v, double scale, NodeId argument);
  Value limited(Value v, const Node& n, NodeId id);
  void count_tables();
  static int value_fraction(const TableRequest& r);
  Operand phase(NodeId id, double turn, double period);
  int place_table(const std::string& key, const TableUse& table);

  // tables.cpp
  Value periodic(NodeId id);

  // roots.cpp
  void outputs();
  void events();
  void states();
  /// The node as a whole number, in words of scale 1; other values are rounded down.
  Operand whole_word(NodeId id);
  Operand rounded_down(NodeId id);
  Value floor_word(NodeId id, double hint);
  Value next_state(const State& s, double scale);
  double state_unit(NodeId id, int depth) const;
  void finish();

  const Node& node(NodeId id) const { return law_.nodes[static_cast<std::size_t>(id)]; }
  const Span& span(NodeId id) const { return spans_[static_cast<std::size_t>(id)]; }
  bool is_fixed(NodeId id) const { return fixed_[static_cast<std::size_t>(id)] != 0; }
  bool once(NodeId id) const { return users_[static_cast<std::size_t>(id)] <= 1; }
  int word(const std::vector<NodeId>& nodes, double scale);
  Operand constant(double value, NodeId of = -1);
  double fixed_size(const std::vector<NodeId>& nodes) const;
  Step& emit(EngineOp op, int mode, Operand x, Operand y, double scale, NodeId origin);
  Operand last() const { return {From::step, static_cast<int>(program_.steps.size()) - 1}; }

  const Law& law_;
  const Target& target_;
  const std::vector<Span>& spans_;
  Choice& choice_;
  Program program_;
  std::vector<char> fixed_;
  std::vector<int> users_;
  std::map<NodeId, Value> values_;
  std::vector<std::pair<Value, Value>> aligned_;
  std::map<Operand, Value> negated_;
  std::map<std::tuple<NodeId, double, bool>, Value> ended_;
  bool clipped_ = false;  ///< with_ends() has limited a value by clipped()
  std::map<std::pair<Operand, Operand>, Value> products_;
  std::map<std::string, int> table_keys_;
  std::map<std::string, double> memory_scales_;  ///< scales of arrays and of tables through points
  NodeId flag_ = -1;
  int sine_tables_ = 0, other_tables_ = 0, table_words_left_ = 512;
  bool cosines_ = false, sines_ = false;
};

}  // namespace feltgate::law
