// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Lowers statements to nodes: resolves names, checks units, unrolls loops.
// Documentation: docs/laws.md
#pragma once

#include <map>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "law/graph.hpp"
#include "law/ranges.hpp"
#include "law/syntax.hpp"

namespace feltgate::law {

// The symbol table of a law file while it is read from top to bottom.

struct Symbol {
  Statement::Kind kind = Statement::Kind::let;
  NodeId node = kNone;  ///< of a value
  int index = -1;       ///< of a state, table, array or line
  Place place;
  std::string unit_text;  ///< as written in the definition
  bool used = false;
};

/// Nested scopes: the file, and the body of each loop. A name is defined once.
class Scope {
 public:
  Scope() : levels_(1) {}

  void open() { levels_.emplace_back(); }
  /// Closes the innermost scope and returns its symbols.
  std::map<std::string, Symbol> close();

  /// The symbol of a name; nullptr when the name is not defined.
  Symbol* find(const std::string& name);
  void define(const std::string& name, const Symbol& symbol) { levels_.back()[name] = symbol; }
  std::vector<std::string> names() const;

 private:
  std::vector<std::map<std::string, Symbol>> levels_;
};

/// Whether `name` is a built-in function or value of the language.
bool is_function(const std::string& name);
bool is_given_value(const std::string& name);
/// Whether `name` is built in and a law must not define it.
bool is_reserved(const std::string& name);
const std::vector<std::string>& given_names();

/// Thrown, after the error is reported, when the remaining work would take too long.
struct TooLong {};

class Lowering {
 public:
  /// `rate_hz` > 0 overrides the rate in the file. All arguments must outlive this object.
  Lowering(std::string_view text, double rate_hz, Law& law, Diagnostics& diagnostics);

  void run(const std::vector<Statement>& statements);
  const Graph& graph() const { return graph_; }

 private:
  // statements.cpp
  void statement(const Statement& s);
  void define(const Statement& s, Symbol symbol);
  void parameter(const Statement& s);
  void state(const Statement& s);
  void boolean(const Statement& s);
  void let(const Statement& s);
  void set(const Statement& s);
  void next(const Statement& s);
  void table(const Statement& s);
  void array(const Statement& s);
  bool numbers(const Statement& s, Unit& unit, std::vector<double>& values);
  void line(const Statement& s);
  void loop(const Statement& s);
  void out(const Statement& s);
  void event(const Statement& s);
  void rate(const Statement& s);
  void require(const Statement& s);
  void require(NodeId condition, bool holds, std::size_t offset);
  void refuse_changing(NodeId body, const Statement& s);
  void refuse_open(const Table& table, const Statement& s);
  void note_unused(const std::map<std::string, Symbol>& symbols);
  void note_unread();
  void check_ends(const Statement* last);

  // quantities.cpp
  struct Quantity {
    Unit unit;
    std::string unit_text;
    double to_si = 1, value = 0;
    Range range;
    bool good = false;
  };
  Quantity quantity(const Statement& s);
  bool constant_of(const ExpressionPtr& e, const char* what, double& value, Unit& unit);
  /// A whole constant from `least` to `most`. Anything else is reported and gives `least`.
  int whole_of(const ExpressionPtr& e, const char* what, int least, int most);
  std::pair<int, int> loop_range(const ExpressionPtr& from, const ExpressionPtr& to);

  // expressions.cpp
  NodeId value_of(const ExpressionPtr& e);   ///< number or truth value
  NodeId number_of(const ExpressionPtr& e);  ///< a number; anything else is reported
  NodeId truth_of(const ExpressionPtr& e);
  /// A number with `unit`; anything else is reported as a wrong unit of `what`.
  NodeId number_in(const ExpressionPtr& e, const Unit& unit, const std::string& what);
  NodeId named(const Expression& e);
  NodeId given_value(const Expression& e, const std::string& name, int axis);
  NodeId indexed(const Expression& e);
  NodeId unary(const Expression& e);
  NodeId binary(const Expression& e);
  NodeId compare(const Expression& e);
  NodeId equal(const Expression& e, NodeId a, NodeId b);
  NodeId zero_or_one(NodeId truth, Place place);
  NodeId power(const Expression& e);
  NodeId choice(const Expression& e);
  NodeId reduce(const Expression& e);
  NodeId unknown(const Expression& e, const char* what, bool functions);
  /// Gives a 0 the unit of the other side; reports two units that differ. `joint`: the operator
  /// between them in the text.
  bool fit(NodeId& a, NodeId& b, const Expression& ea, const Expression& eb, std::size_t offset,
           const std::string& joint);
  std::string unit_words(const Expression& e, NodeId node);
  std::string unit_mend(NodeId a, NodeId b, std::string unit);

  // calls.cpp
  NodeId call(const Expression& e);
  NodeId call_table(const Expression& e, Symbol& table);
  NodeId call_extreme(const Expression& e);
  NodeId clamp(const Expression& e);
  NodeId sign(const Expression& e);
  NodeId trigonometric(const Expression& e, Op op);
  NodeId root(const Expression& e);
  NodeId lowpass(const Expression& e);
  bool takes(const Expression& e, std::size_t count, const char* form);

  // made_calls.cpp
  Span range_of(NodeId id, const Expression& e);
  NodeId floored(NodeId x, const Expression& e);
  NodeId floor_call(const Expression& e);
  NodeId round_call(const Expression& e);
  NodeId mod(const Expression& e);
  NodeId noise(const Expression& e);
  NodeId angle(const Expression& e);
  int angle_table(Place place);
  std::string own_name(std::string name, Place place);

  NodeId step_time(Place place);
  NodeId since_start(Place place);
  Place at(std::size_t offset) const { return places_.of(offset); }
  void report(std::size_t offset, std::string what, std::string mend) {
    diagnostics_.add(at(offset), std::move(what), std::move(mend));
  }
  void count_step(std::size_t offset);

  Places places_;
  double rate_hz_;
  Law& law_;
  Diagnostics& diagnostics_;
  Graph graph_;
  Scope scope_;
  std::string defining_;                  ///< the name whose definition is being read
  std::map<std::string, Place> defined_;  ///< every name of the file, for "before its definition"
  std::map<std::pair<NodeId, NodeId>, NodeId> filters_;
  std::map<int, NodeId> noises_;  ///< by seed
  int floor_array_ = -1, angle_table_ = -1;
  int runs_state_ = -1;    ///< counts the runs for `time`
  bool in_table_ = false;  ///< in a table's formula
  int ranged_ = 0;
  std::set<std::string> has_next_;
  bool any_out_ = false;
  bool rate_read_ = false;
  int loops_ = 0;
  long steps_ = 0;
};

}  // namespace feltgate::law
