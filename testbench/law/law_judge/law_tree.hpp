// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Laws as trees of the test itself. They are printed as text for the compiler, and evaluated in
// long double as docs/laws.md defines. No code of model/law is used here.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

namespace feltgate::judge {

inline std::size_t at(long i) { return static_cast<std::size_t>(i); }

using Real = long double;

// clang-format off
enum class Kind {
  number, param, input, state, line, let, counter,  // leaves
  add, subtract, multiply, divide, power, negate, minimum, maximum, clamp, absolute,
  sine, cosine, root, exponential, logarithm, table, element, sign, choice, sum, floor, round, modulo,
  noise,
  angle,  // atan2(y, x); value: the floor of |x| + |y|
  less, less_equal, more, more_equal, equal, differs, both, either, opposite
};
// clang-format on

struct Tree;
using Node = std::shared_ptr<const Tree>;

struct Tree {
  Kind kind = Kind::number;
  std::string text;  ///< text of a number; name of every other node that has one
  Real value = 0;    ///< value of a number; lower end of a sum's counter (`index` is the upper end)
  int index = -1;    ///< index in the law's list; an exponent; for a line, the number of runs ago
  std::vector<Node> parts;
};

inline Node make(Kind kind, std::vector<Node> parts, int index = -1, std::string text = "",
                 Real value = 0) {
  return std::make_shared<const Tree>(Tree{kind, std::move(text), value, index, std::move(parts)});
}
/// The value is the text read as a decimal number.
inline Node number(const std::string& text) {
  return make(Kind::number, {}, -1, text, std::strtod(text.c_str(), nullptr));
}
inline Node number(double value, int digits = 3) {
  Node n = number(fmt::format("{:.{}f}", value < 0 ? -value : value, digits));
  return value < 0 ? make(Kind::negate, {n}) : n;
}
/// Whether `is` holds for the kind of the node, or of one below it.
template <class Is>
bool any(const Node& n, Is is) {
  if (is(n->kind)) return true;
  return std::any_of(n->parts.begin(), n->parts.end(), [&](const Node& p) { return any(p, is); });
}
/// Whether the value depends on parameters and on nothing else that changes. A `let` may.
inline bool of_parameters(const Node& n) {
  return any(n, [](Kind k) { return k == Kind::param; }) && !any(n, [](Kind k) {
           return k == Kind::input || k == Kind::state || k == Kind::line || k == Kind::let ||
                  k == Kind::noise;
         });
}
inline Node operator+(const Node& a, const Node& b) { return make(Kind::add, {a, b}); }
inline Node operator-(const Node& a, const Node& b) { return make(Kind::subtract, {a, b}); }
inline Node operator*(const Node& a, const Node& b) { return make(Kind::multiply, {a, b}); }
inline Node operator/(const Node& a, const Node& b) { return make(Kind::divide, {a, b}); }
inline Node operator+(const Node& a, double b) { return a + number(b); }
inline Node operator-(const Node& a, double b) { return a - number(b); }
inline Node operator*(double a, const Node& b) { return number(a) * b; }
inline Node operator<(const Node& a, const Node& b) { return make(Kind::less, {a, b}); }
inline Node operator>(const Node& a, const Node& b) { return make(Kind::more, {a, b}); }
inline Node operator<=(const Node& a, const Node& b) { return make(Kind::less_equal, {a, b}); }
inline Node operator>=(const Node& a, const Node& b) { return make(Kind::more_equal, {a, b}); }
inline Node sgn(const Node& a) { return make(Kind::sign, {a}); }
inline Node limited(const Node& a, double lower, double upper) {
  return make(Kind::clamp, {a, number(lower), number(upper)});
}
/// atan2 of `y` and `x`, limited to +-`end_y` and +-`end_x`; without these limits both have no end.
inline Node angle(const Node& y, const Node& x, double end_y, double end_x) {
  return make(Kind::angle, {limited(y, -end_y, end_y), limited(x, -end_x, end_x)}, -1, "",
              (static_cast<Real>(end_y) + end_x) / 128);
}
/// x by the root of x^2 + y^2 + e^2.
inline Node direction(const Node& x, const Node& y, double e) {
  const auto square = [](const Node& n) { return make(Kind::power, {n}, 2); };
  return x / make(Kind::root, {square(x) + square(y) + square(number(e))});
}
inline Node choose(const Node& condition, const Node& a, const Node& b) {
  return make(Kind::choice, {condition, a, b});
}

struct Param {
  std::string name, unit;  ///< `unit` follows its numbers; empty: none
  Real to_si = 1;
  double initial = 0, lower = 0, upper = 1;  ///< in `unit`
  bool whole = false, mailbox = false;
};
struct State {
  std::string name;
  double initial = 0, lower = 0, upper = 1;
  bool whole = false, phase = false;
  Node next;  ///< empty without a lowpass: a noise, whose values are taken from the words
  Node follows, frequency;  ///< for a lowpass, which is a state without its own line
  bool truth = false;       ///< a bool: whole, 0 to 1, and `next` is a condition
};
struct Table {
  std::string name;
  double lower = 0, upper = 1;
  Node body;  ///< a function of Kind::counter, the variable
  std::vector<double> points;
  int segments = 0;  ///< 0: the compiler chooses
  bool periodic = false;
};
struct Array {
  std::string name;
  std::vector<double> values;
};
struct Line {
  std::string name;
  int length = 4;
  double lower = -1, upper = 1;
  Node written;
};
struct Let {
  std::string name;
  Node value;
};
struct Event {
  std::string name;
  Node value, condition;
};

/// A law. Parts that no output, event, state or line needs are not printed.
struct Law {
  double rate_khz = 0;
  std::vector<Param> params;
  std::vector<State> states;  ///< declared ones first, then lowpasses in the order of `lets`
  std::vector<Table> tables;
  std::vector<Array> arrays;
  std::vector<Line> lines;
  std::vector<Let> lets;
  std::vector<Node> torques;  ///< of axis 0, 1, 2
  std::vector<Event> events;

  Node param(const std::string& name, double initial, double lower, double upper,
             bool whole = false) {
    params.push_back({name, "", 1, initial, lower, upper, whole, false});
    return make(Kind::param, {}, static_cast<int>(params.size()) - 1, name);
  }
  Node state(const std::string& name, double initial, double lower, double upper,
             bool whole = false) {
    states.push_back({name, initial, lower, upper, whole, false, {}, {}, {}});
    return make(Kind::state, {}, static_cast<int>(states.size()) - 1, name);
  }
};

/// The main construct of a generated law. `wide`: a function over the whole range of an input;
/// `ends`: values that stay at an end and are compared there.
enum class Shape {
  formula,
  parameters_alone,
  whole_states,
  nested,
  arrays,
  tables,
  memory,
  axes,
  wide,
  ends
};
constexpr int shapes = 8;  ///< without `wide` and `ends`, whose laws have tests of their own

Law random_law(std::uint64_t seed, Shape shape);

/// Laws that were once compiled wrongly, and similar laws.
struct Directed {
  std::string name;
  Law law;
};
std::vector<Directed> directed_laws();
/// Laws whose errors come close to their bounds.
std::vector<Directed> tight_laws();

/// The inputs, three for each axis.
inline Node position(int axis = 0) {
  return make(Kind::input, {}, 3 * axis,
              axis == 0 ? "position" : fmt::format("position[{}]", axis));
}
inline Node velocity(int axis = 0) {
  return make(Kind::input, {}, 3 * axis + 1,
              axis == 0 ? "velocity" : fmt::format("velocity[{}]", axis));
}
inline Node tau_hat(int axis = 0) {
  return make(Kind::input, {}, 3 * axis + 2,
              axis == 0 ? "tau_hat" : fmt::format("tau_hat[{}]", axis));
}

/// The text of a law. Every comparison, sgn, array element and next value of a whole state begins a
/// new line, so that the line number identifies it.
class Printer {
 public:
  explicit Printer(const Law& law);
  const std::string& text() const { return text_; }
  /// For each text that canonical() returns: its lines.
  const std::map<std::string, std::set<int>>& lines() const { return lines_; }
  bool needed(const std::string& name) const { return needed_.count(name) != 0; }

 private:
  std::string of(const Node& n);
  std::string mark(const Node& n);
  void need(const Node& n);
  void declare();
  std::string ends(const std::string& unit, double initial, double lower, double upper) const;

  const Law& law_;
  std::set<std::string> needed_;
  std::string text_;
  std::vector<std::string> marks_;
  std::map<std::string, std::set<int>> lines_;
};

/// Returns the text of a comparison as a < b, of an element's index, of a floor or of a mod, with
/// its lets written in full.
std::string canonical(const Law& law, const Node& n);

/// What a whole state keeps: its next value rounded down. Empty for another state.
inline Node rounded_next(const State& s) {
  return s.whole && s.next && !s.truth ? make(Kind::floor, {s.next}) : Node{};
}

/// A decision of a run, and its distance from the other result.
struct Decision {
  long key = 0;
  const std::string* canonical = nullptr;
  long taken = 0;       ///< 0 or 1; for an element its index
  long other = 0;       ///< the nearest other result
  Real distance = 0;    ///< distance of the operands from the turning point
  Real rounding = 0;    ///< distance within which rounding of doubles may separate equal operands
  bool exact = false;   ///< both sides are whole by definition: no rounding
  bool rounds = false;  ///< not 0 or 1: a number rounded down, whose results follow in steps of 1
};

struct Outcome {
  std::vector<Real> torques, states, written, events;
  std::vector<char> holds;  ///< the events' conditions
  std::vector<Decision> decisions;
};

/// The law's memory and inputs before a run, in SI units.
struct Before {
  std::vector<Real> params, inputs, states;
  std::vector<std::vector<Real>> lines;  ///< [line][k]: value written k + 1 runs ago
  Real rate_hz = 1;
};

/// One run in long double. `forced`: decisions whose result is given, independent of their
/// operands.
class Evaluator {
 public:
  explicit Evaluator(const Law& law) : law_(law) {
    for (const State& s : law.states) rounded_next_.push_back(rounded_next(s));
  }
  Outcome run(const Before& before, const std::map<long, long>& forced);

 private:
  struct Known {
    long number;
    std::string canonical;
  };
  Real of(const Node& n);
  bool truth(const Node& n);
  bool less(const Node& n, const Node& a, const Node& b);
  Real element(const Node& n);
  Real floored(const Node& n, Real x);
  Real table(const Table& t, Real x);
  Real filtered(const State& s, Real y);
  long decide(const Node& n, long taken, long other, Real distance, Real size, bool exact,
              bool rounds = false);
  bool whole(const Node& n) const;

  const Law& law_;
  std::vector<Node> rounded_next_;  ///< of each state
  std::map<const Tree*, Known> known_;
  std::map<std::string, long> numbers_;
  const Before* before_ = nullptr;
  const std::map<long, long>* forced_ = nullptr;
  std::vector<Decision> decisions_;
  std::set<long> seen_;
  Real variable_ = 0;
  int counter_ = -1;
};

}  // namespace feltgate::judge
