// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Lowers the definitions that occupy the engine's table memory: tables, arrays, delay lines.
// Documentation: docs/laws.md
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "law/evaluate.hpp"
#include "law/law.hpp"
#include "law/lowering.hpp"
#include "law/ranges.hpp"

namespace feltgate::law {

// Finds places where a table's formula is not a finite number.

struct NoNumber {
  NodeId node = -1;  ///< the node without a value; -1: the formula is a number everywhere
  double x = 0;      ///< the argument at which it has no value, SI
};

/// Evaluates a table's formula at 4097 places over its domain, the ends included. A value that min,
/// max or a comparison would discard is also checked; a value that an `if` does not choose is not.
NoNumber no_number(const Law& law, const Table& table);

namespace {

constexpr int kMostLine = 512;
constexpr std::size_t kMostElements = 512;
constexpr int kMostSegments = 511;  // they take one word more

std::string quoted(const std::string& name) { return "\"" + name + "\""; }

/// How an argument is limited to what the function takes; empty for an operation that takes all.
std::string limit_of(Op op) {
  const char* const form = op == Op::root          ? "sqrt(max(x, 0))"
                           : op == Op::logarithm   ? "log(max(x, 0.01))"
                           : op == Op::reciprocal  ? "1 / max(x, 0.01)"
                           : op == Op::exponential ? "exp(min(x, 100))"
                                                   : nullptr;
  return form == nullptr ? "" : std::string(", or limit what it is of, e.g. ") + form;
}

}  // namespace

void Lowering::refuse_changing(NodeId body, const Statement& s) {
  std::vector<bool> needed(static_cast<std::size_t>(body) + 1);
  needed.back() = true;
  for (NodeId id = body; id >= 0; --id) {
    if (!needed[static_cast<std::size_t>(id)]) continue;
    const Node& n = graph_.node(id);
    for (const NodeId a : n.arguments) needed[static_cast<std::size_t>(a)] = true;
    std::string name;
    if (n.op == Op::parameter) name = law_.parameters[static_cast<std::size_t>(n.index)].name;
    if (n.op == Op::state) name = law_.states[static_cast<std::size_t>(n.index)].name;
    if (n.op == Op::input && n.index >= 0) {
      name = law_.inputs[static_cast<std::size_t>(n.index)].name;
    }
    if (n.op == Op::line_read) name = law_.lines[static_cast<std::size_t>(n.index)].name;
    if (name.empty()) continue;
    report(s.name_offset,
           "the table " + quoted(s.name) + " uses " + quoted(name) + ", which changes at run time",
           "a table holds a function of its variable and of constants; multiply outside of it");
    return;
  }
}

/// Reports a periodic table whose value would jump from its end to its begin.
void Lowering::refuse_open(const Table& t, const Statement& s) {
  if (!diagnostics_.empty()) return;
  double first = 0, last = 0, size = 0;
  try {
    first = table_value(law_, t, t.domain.lower);
    last = table_value(law_, t, t.domain.upper);
    size = table_jet(law_, t, {t.domain.lower, t.domain.upper}).v.size();
  } catch (const Refused& refused) {
    report(s.name_offset, refused.reason, refused.mend);
    return;
  }
  const double most = std::max({std::fabs(first), std::fabs(last), size < infinity ? size : 0});
  if (std::fabs(last - first) <= 1e-12 * most) return;
  const auto shown = [most](double x) { return std::fabs(x) <= 1e-12 * most ? 0 : x; };
  report(s.name_offset,
         fmt::format("the periodic table {} begins with {:.6g} and ends with {:.6g}",
                     quoted(s.name), shown(first), shown(last)),
         "let it end as it begins: what jumps is a comparison outside of it");
}

void Lowering::table(const Statement& s) {
  double lower = 0, upper = 0;
  Unit lower_unit, upper_unit;
  Table t;
  Symbol symbol;
  t.name = s.name;
  t.place = at(s.name_offset);
  if (s.segments) t.segments = whole_of(s.segments, "the number of segments", 1, kMostSegments);
  bool good = constant_of(s.lower, "the table's lower end", lower, lower_unit);
  good = constant_of(s.upper, "the table's upper end", upper, upper_unit) && good;
  if (good && lower == 0 && lower_unit == kNumber) lower_unit = upper_unit;
  if (good && upper == 0 && upper_unit == kNumber) upper_unit = lower_unit;
  if (good && !(lower_unit == upper_unit)) {
    report(s.lower->offset,
           "the table's ends are in " + text_of(lower_unit) + " and in " + text_of(upper_unit),
           "both need the same unit");
    good = false;
  }
  if (good && !(lower < upper)) {
    report(s.lower->offset, "the range of the table " + quoted(s.name) + " is upside down",
           "write on [LOWER, UPPER]");
    good = false;
  }
  if (unit_symbol(s.variable) || is_reserved(s.variable) || s.variable == s.name) {
    report(s.name_offset, "the table's variable " + quoted(s.variable) + " has a meaning already",
           "choose another name");
    good = false;
  }
  if (good) {
    const auto index = static_cast<int>(law_.tables.size());
    t.domain = {lower, upper};
    t.argument = graph_.table_argument(index, upper_unit, t.place);
    if (s.value) {
      scope_.open();
      Symbol variable;
      variable.node = t.argument;
      scope_.define(s.variable, variable);
      defining_ = s.name;
      in_table_ = true;
      t.body = number_of(s.value);
      in_table_ = false;
      defining_.clear();
      scope_.close();
    } else {
      Unit unit;
      if (numbers(s, unit, t.points)) t.body = graph_.constant(t.points.front(), unit, t.place);
      t.segments = static_cast<int>(t.points.size()) - 1;
    }
    if (t.body != kNone) {
      const std::size_t before = diagnostics_.size();
      refuse_changing(t.body, s);
      if (s.periodic) refuse_open(t, s);
      t.periodic = s.periodic;
      law_.tables.push_back(t);
      const NoNumber none = diagnostics_.size() == before ? no_number(law_, t) : NoNumber{};
      if (none.node != kNone) {
        diagnostics_.add(
            graph_.node(none.node).place,
            fmt::format("in the table {} this is no number at {:.6g}", quoted(s.name), none.x),
            "let the table end where its formula does" + limit_of(graph_.node(none.node).op));
      }
      symbol.index = index;
    }
  }
  define(s, symbol);
}

/// The numbers of an array or of a table through points, in SI; false if an error is reported.
bool Lowering::numbers(const Statement& s, Unit& own, std::vector<double>& values) {
  own = s.unit.unit;
  bool good = s.elements.size() <= kMostElements;
  if (!good) report(s.name_offset, "more than 512 numbers", "the table has 512 words");
  if (s.kind == Statement::Kind::table && s.elements.size() < 2) {
    report(s.name_offset, "a table through one point", "a line needs two, at the table's ends");
    good = false;
  }
  for (std::size_t i = 0; good && i < s.elements.size(); ++i) {
    double value = 0;
    Unit unit;
    good = constant_of(s.elements[i], "a number between the brackets", value, unit);
    if (!good) break;
    if (!s.unit_text.empty() && !(unit == kNumber)) {
      report(s.elements[i]->offset, "a unit in front of the array's own",
             "write the unit once, behind the bracket");
      good = false;
    } else if (s.unit_text.empty() && i > 0 && !(unit == own)) {
      report(s.elements[i]->offset, "elements in " + text_of(own) + " and in " + text_of(unit),
             "write the unit once, behind the bracket");
      good = false;
    } else if (s.unit_text.empty()) {
      own = unit;
    }
    values.push_back(value * s.unit.to_si);
  }
  return good;
}

void Lowering::array(const Statement& s) {
  Array a;
  a.name = s.name;
  a.place = at(s.name_offset);
  Symbol symbol;
  symbol.unit_text = s.unit_text;
  if (numbers(s, a.unit, a.values)) {
    symbol.index = static_cast<int>(law_.arrays.size());
    law_.arrays.push_back(a);
  }
  define(s, symbol);
}

void Lowering::line(const Statement& s) {
  Line l;
  Symbol symbol;
  l.name = s.name;
  l.place = at(s.name_offset);
  const std::size_t before = diagnostics_.size();
  l.length = whole_of(s.index, "the length of a line", 1, kMostLine);
  Statement as_state = s;  // a delay line starts with zeros
  Expression zero;
  zero.offset = s.lower->offset;
  as_state.value = std::make_shared<const Expression>(zero);
  const Quantity q = quantity(as_state);
  if (q.good && diagnostics_.size() == before) {
    l.unit = q.unit;
    l.unit_text = q.unit_text;
    l.range = q.range;
    symbol.index = static_cast<int>(law_.lines.size());
    symbol.unit_text = q.unit_text;
    law_.lines.push_back(l);
  }
  define(s, symbol);
}

// Finds places where a table's formula is not a finite number.

namespace {

constexpr int looks = 4096;  // equal parts of the domain; the formula is evaluated at their ends

/// Whether the value of argument number `argument` reaches the node's value: false for the value
/// that a selection does not choose.
bool chosen_from(const Node& n, const std::vector<double>& values, std::size_t argument) {
  return n.op != Op::select || argument == 0 ||
         (values[at(n.arguments[0])] != 0) == (argument == 1);
}

/// Among the causes of a value that is not a number, the first node whose arguments all are
/// numbers.
NodeId first_cause(const Law& law, NodeId id, const std::vector<double>& values) {
  const Node& n = law.nodes[at(id)];
  for (std::size_t i = 0; i < n.arguments.size(); ++i) {
    if (chosen_from(n, values, i) && !std::isfinite(values[at(n.arguments[i])])) {
      return first_cause(law, n.arguments[i], values);
    }
  }
  return id;
}

}  // namespace

NoNumber no_number(const Law& law, const Table& table) {
  if (!table.points.empty()) return {};
  std::vector<char> needed(at(table.body) + 1, 0);
  needed.back() = 1;
  for (std::size_t i = needed.size(); i-- > 0;) {
    for (const NodeId a : law.nodes[i].arguments)
      if (needed[i] != 0) needed[at(a)] = 1;
  }
  const Evaluation<double> evaluation(law);
  std::vector<double> values(needed.size(), 0);
  for (int look = 0; look <= looks; ++look) {
    const double share = static_cast<double>(look) / looks;
    const double x = look == looks
                         ? table.domain.upper
                         : table.domain.lower + (table.domain.upper - table.domain.lower) * share;
    for (std::size_t i = 0; i < needed.size(); ++i) {
      if (needed[i] == 0) continue;
      const Node& n = law.nodes[i];
      values[i] = static_cast<NodeId>(i) == table.argument ? x : evaluation.compute(n, values);
      for (std::size_t a = 0; a < n.arguments.size(); ++a) {
        const double from = values[at(n.arguments[a])];
        if (chosen_from(n, values, a) && !std::isfinite(from)) values[i] = std::nan("");
      }
    }
    if (!std::isfinite(values[at(table.body)])) {
      return {first_cause(law, table.body, values), x};
    }
  }
  return {};
}

namespace {

const std::vector<std::string> kFunctions{"min", "max",  "clamp", "abs",     "sgn", "sin",
                                          "cos", "sqrt", "exp",   "lowpass", "sum"};
/// Built-in names that a law may redefine.
const std::vector<std::string> kFreeFunctions{"floor", "round", "mod", "noise", "log", "atan2"};
const std::vector<std::string> kFreeValues{"time"};
const std::vector<std::string> kValues{"position", "velocity", "tau_hat", "torque",
                                       "pi",       "dt",       "true",    "false"};

bool holds(const std::vector<std::string>& all, const std::string& name) {
  return std::find(all.begin(), all.end(), name) != all.end();
}

}  // namespace

std::map<std::string, Symbol> Scope::close() {
  std::map<std::string, Symbol> last = std::move(levels_.back());
  levels_.pop_back();
  return last;
}

Symbol* Scope::find(const std::string& name) {
  for (auto level = levels_.rbegin(); level != levels_.rend(); ++level) {
    const auto found = level->find(name);
    if (found != level->end()) return &found->second;
  }
  return nullptr;
}

std::vector<std::string> Scope::names() const {
  std::vector<std::string> all;
  for (const auto& level : levels_) {
    for (const auto& [name, symbol] : level) all.push_back(name);
  }
  return all;
}

bool is_function(const std::string& name) {
  return holds(kFunctions, name) || holds(kFreeFunctions, name);
}
bool is_reserved(const std::string& name) {
  return holds(kFunctions, name) || holds(kValues, name);
}
bool is_given_value(const std::string& name) {
  return holds(kValues, name) || holds(kFreeValues, name);
}

const std::vector<std::string>& given_names() {
  static const std::vector<std::string> all = [] {
    std::vector<std::string> names = kValues;
    for (const auto* more : {&kFreeValues, &kFunctions, &kFreeFunctions}) {
      names.insert(names.end(), more->begin(), more->end());
    }
    return names;
  }();
  return all;
}

}  // namespace feltgate::law
