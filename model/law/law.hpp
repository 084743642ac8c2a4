// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// A force law as a graph. The reader of a law file makes it; evaluation, proofs and the compiler
// work on it. Values are real numbers in SI units; angles are in rad. Documentation: docs/laws.md
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace feltgate::law {

/// A place in the file, counted from 1.
struct Place {
  int line = 1;
  int column = 1;
};

/// Exponents of m, kg, s and A. An angle is a number.
struct Unit {
  std::array<int, 4> exponents{};
  bool operator==(const Unit& other) const { return exponents == other.exponents; }
};

/// A closed interval; lower <= upper.
struct Range {
  double lower = 0;
  double upper = 0;
};

/// A node's number in Law::nodes. Arguments come before their users.
using NodeId = int;

constexpr double kPi = 3.14159265358979323846;
/// Largest magnitude of a value of a law.
constexpr double kLargest = 1e300;

/// An index that is known not to be negative.
inline std::size_t at(int i) { return static_cast<std::size_t>(i); }

enum class Op : std::uint8_t {
  constant,     ///< Node::value
  parameter,    ///< Law::parameters[index]: a parameter or a mailbox word, fixed during a run
  input,        ///< Law::inputs[index]
  state,        ///< Law::states[index], its value after the previous run
  add,          ///< a + b
  subtract,     ///< a - b
  multiply,     ///< a * b
  negate,       ///< -a
  absolute,     ///< |a|
  minimum,      ///< of a, b
  maximum,      ///< of a, b
  less,         ///< a < b, a truth value; `a > b` is written `b < a`
  both,         ///< truth values: a and b
  either,       ///< a or b
  opposite,     ///< not a
  select,       ///< a ? b : c, a is a truth value
  sine,         ///< of an angle, of any size
  cosine,       ///<
  root,         ///< square root, argument >= 0
  reciprocal,   ///< 1/a, argument away from 0
  exponential,  ///< e^a
  logarithm,    ///< natural, argument > 0
  arctangent,   ///< only in the table of atan2
  lookup,       ///< Law::tables[index] at a: linear between its samples, clamped to its ends
  element,    ///< Law::arrays[index], element a (a whole number, rounded down), clamped to its ends
  line_read,  ///< Law::lines[index]: what was written b runs ago, b in 1 .. length; argument a is b
};

struct Node {
  Op op = Op::constant;
  std::vector<NodeId> arguments;
  int index = -1;    ///< where `op` says so
  double value = 0;  ///< of a constant
  bool truth = false;
  bool whole = false;  ///< certainly a whole number
  Unit unit;
  Place place;
};

/// A word that the host can write at run time, within its range.
struct Parameter {
  std::string name;
  std::string unit_text;  ///< as written, e.g. "Nm/rad"
  Unit unit;
  double to_si = 1;    ///< SI value of 1 in the unit as written
  double initial = 0;  ///< in SI, as all numbers that follow
  Range range;
  bool whole = false;    ///< an integer
  bool mailbox = false;  ///< written continuously by the host
  double max_age_s = 0;  ///< of a mailbox: the outputs go to 0 when its value is older
  NodeId derived = -1;   ///< >= 0: computed by the host from other parameters by this node
  std::string comment;
  Place place;
};

enum class Source : std::uint8_t { position, velocity, tau_hat };

struct Input {
  Source source = Source::position;
  int axis = 0;
  std::string name;
};

struct State {
  std::string name;
  std::string unit_text;
  Unit unit;
  double initial = 0;
  Range range;          ///< declared; the compiler proves that it is inductive
  bool phase = false;   ///< wraps at the ends of its range
  bool whole = false;   ///< next is rounded down to a whole number
  NodeId follows = -1;  ///< >= 0: the state filters this node and has no own range; it stays in
                        ///< the hull of 0 and the node's range
  NodeId next = -1;
  Place place;
  int least_fraction = 0;    ///< of a phase over 0 .. 1: the fraction bits that it must have
  bool counts_runs = false;  ///< `time`: any value may come, however late
};

/// A function of one variable: a formula that the compiler samples, or a line through points.
struct Table {
  std::string name;
  Range domain;
  NodeId argument = -1;        ///< an Op::input with index -1, and the table's number as
                               ///< value, that stands for the variable in `body`
  NodeId body = -1;            ///< of points: a constant of their unit
  std::vector<double> points;  ///< at equal distances over the domain; empty: a formula
  int segments = 0;            ///< 0: the compiler chooses; of points one less than there are
  bool periodic = false;       ///< repeats beyond its ends, whose values are equal
  Place place;
};

/// An array of constants in table memory.
struct Array {
  std::string name;
  Unit unit;
  std::vector<double> values;
  Place place;
};

/// A delay line: one word written per run.
struct Line {
  std::string name;
  std::string unit_text;
  Unit unit;
  int length = 0;
  Range range;
  NodeId written = -1;
  Place place;
};

struct Output {
  std::string name;  ///< torque
  int axis = 0;
  NodeId value = -1;  ///< Nm
  Place place;
};

struct Event {
  std::string name;
  int number = 0;  ///< from 1 in the order of the file
  NodeId value = -1;
  NodeId condition = -1;
  Place place;
};

/// A condition on parameters that must hold after every write of the host: smaller <= larger.
struct Requirement {
  NodeId smaller = -1, larger = -1;  ///< made of constants and parameters only, without mailboxes
  bool strict = false;               ///< smaller < larger
  Place place;
};

/// A name that nothing uses.
struct Unused {
  std::string name;
  Place place;
};

/// A law after parsing: units are checked, loops unrolled, equal nodes merged, constants folded.
struct Law {
  std::string name;
  std::string summary;    ///< the first comment of the file
  std::string source;     ///< the text, as it was parsed
  double rate_hz = 0;     ///< 0: as fast as possible
  bool own_rate = false;  ///< the file declares a rate
  bool timed = false;     ///< dt or a filter is used
  std::vector<Parameter> parameters;
  std::vector<Input> inputs;
  std::vector<State> states;
  std::vector<Table> tables;
  std::vector<Array> arrays;
  std::vector<Line> lines;
  std::vector<Output> outputs;
  std::vector<Event> events;
  std::vector<Requirement> requirements;
  std::vector<Unused> unused;  ///< in the order of the file
  std::vector<Node> nodes;
  std::vector<std::pair<NodeId, Range>> known;  ///< ranges of nodes, from before a rewriting
};

}  // namespace feltgate::law
