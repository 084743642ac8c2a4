// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Runs a law from its text, in long double. It takes the parser's tree and nothing else of the
// compiler: no graph, no ranges, no formats. So it sees what all of these get wrong together.
// Documentation: docs/laws.md
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

#include "law/syntax.hpp"

namespace feltgate::law {

class SourceLaw {
 public:
  using Real = long double;
  /// SI; position, velocity and tau_hat of axis n at 3n, 3n + 1 and 3n + 2.
  using Inputs = std::array<Real, 9>;

  /// `text`: a law that read_law_text() accepts; `rate_hz`: of its runs. `nearest`: the least
  /// |x| + |y| of the atan2 at a place, which the language defines by the ranges of x and y.
  /// Throws std::invalid_argument for a construct that it does not know.
  SourceLaw(
      const std::string& text, double rate_hz,
      std::function<double(Place)> nearest = [](Place) { return 0.0; });
  SourceLaw(const SourceLaw&) = delete;
  SourceLaw& operator=(const SourceLaw&) = delete;

  /// The first values of the file for all that is kept.
  void reset();
  /// The file's value of a parameter or mailbox, SI. Throws std::out_of_range for another name.
  Real first(const std::string& name) const { return parameters_.at(name).first; }
  void set_parameter(const std::string& name, Real si) { values_[parameters_.at(name).slot] = si; }
  void run(const Inputs& inputs);

  /// Of the last run. Of an axis without an output 0.
  Real torque(int axis) const;
  /// Whether the event, by its number from 0, happened: its condition became true.
  bool happened(std::size_t event) const { return events_[event].happened; }
  /// What the next run finds in a state, phase or bool; throws std::out_of_range for another name.
  Real state(const std::string& name) const { return values_[kept_[states_.at(name)].slot]; }

 private:
  using Slot = std::size_t;  ///< of values_
  struct Symbol {
    Statement::Kind kind = Statement::Kind::let;
    std::size_t index = 0;  ///< a slot; of a table, an array or a line its number
  };
  struct Parameter {
    Slot slot = 0;
    Real first = 0;
  };
  struct Kept {
    Slot slot = 0, next = 0;
    Real first = 0, lower = 0, upper = 0;
    bool whole = false, phase = false;
  };
  struct Line {
    std::vector<Real> ring;
    std::size_t at = 0;
    Slot next = 0;
  };
  struct Event {
    Slot condition = 0;
    bool held = false, happened = false;
  };
  struct Step {
    Slot to;
    std::function<Real()> value;
  };
  struct Table {
    Real lower = 0, upper = 1;
    bool periodic = false;
    std::vector<Real> points;
    Slot variable = 0, value = 0;
    std::vector<Step> steps;
  };

  void statement(const Statement& s);
  void loop(const Statement& s);
  void table(const Statement& s);
  Slot expression(const ExpressionPtr& e);
  Slot name(const Expression& e);
  Slot indexed(const Expression& e);
  Slot binary(const Expression& e);
  Slot call(const Expression& e);
  Slot reduce(const Expression& e);
  Slot since_start();
  Slot lowpass(Slot x, Slot frequency);
  Slot noise(int seed);
  Slot keep(Real first);
  Slot number(Real value);
  Slot step(std::function<Real()> value);
  Slot binary_step(const std::string& sign, Slot a, Slot b);
  Slot input(const std::string& name, int axis);
  Real constant(const ExpressionPtr& e) { return values_[expression(e)]; }
  Real looked_up(Table& t, Real x);
  std::vector<Real> numbers(const Statement& s);
  const Symbol* find(const std::string& name) const;
  void define(const std::string& name, Symbol symbol) { scopes_.back()[name] = symbol; }

  Places places_;
  Real step_time_;
  std::function<double(Place)> nearest_;
  std::vector<Real> values_;
  std::vector<Step> steps_;
  std::vector<Step>* building_ = &steps_;
  std::vector<std::map<std::string, Symbol>> scopes_{1};
  std::map<std::string, Parameter> parameters_;
  std::map<std::string, std::size_t> states_;  ///< numbers in kept_
  std::vector<Kept> kept_;
  std::vector<Line> lines_;
  std::vector<std::vector<Real>> arrays_;
  std::vector<Table> tables_;
  std::vector<Event> events_;
  std::array<Slot, 9> inputs_{};
  std::map<int, Slot> torques_;
};

}  // namespace feltgate::law
