// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Lowers constants: values with ranges, whole numbers, the ranges of loops.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "law/lowering.hpp"

namespace feltgate::law {

namespace {

constexpr int kMostRounds = 1024;  ///< largest number of rounds of one loop

/// A number as written, with or without a sign; nullptr for any other expression.
const Expression* literal(const ExpressionPtr& e) {
  const Expression* at = e.get();
  while (at->kind == Expression::Kind::unary && at->name == "-") at = at->arguments[0].get();
  return at->kind == Expression::Kind::number ? at : nullptr;
}

bool is_bare(const ExpressionPtr& e) {
  const Expression* const l = literal(e);
  return l != nullptr && l->unit_text.empty();
}

const Expression* with_unit(const ExpressionPtr& e) {
  const Expression* const l = literal(e);
  return l != nullptr && !l->unit_text.empty() ? l : nullptr;
}

}  // namespace

bool Lowering::constant_of(const ExpressionPtr& e, const char* what, double& value, Unit& unit) {
  const NodeId id = number_of(e);
  if (id == kNone) return false;
  if (!graph_.is_constant(id)) {
    report(e->offset, std::string(what) + " is not constant",
           "it may hold numbers, pi, dt and lets made of them");
    return false;
  }
  value = graph_.node(id).value;
  unit = graph_.node(id).unit;
  return true;
}

int Lowering::whole_of(const ExpressionPtr& e, const char* what, int least, int most) {
  double value = 0;
  Unit unit;
  if (!constant_of(e, what, value, unit)) return least;
  if (unit == kNumber && value == std::floor(value) && value >= least && value <= most) {
    return static_cast<int>(value);
  }
  report(e->offset, fmt::format("{} is no whole number from {} to {}", what, least, most),
         fmt::format("write one of {} .. {}", least, most));
  return least;
}

std::pair<int, int> Lowering::loop_range(const ExpressionPtr& from, const ExpressionPtr& to) {
  constexpr int kFar = 1'000'000;
  const std::size_t before = diagnostics_.size();
  const int first = whole_of(from, "the loop's first number", -kFar, kFar);
  const int last = whole_of(to, "the loop's last number", -kFar, kFar);
  if (diagnostics_.size() != before) return {0, -1};
  if (last < first) {
    report(from->offset, fmt::format("the loop's range is upside down: {} .. {}", first, last),
           fmt::format("write {} .. {}", last, first));
    return {0, -1};
  }
  if (last - first >= kMostRounds) {
    report(from->offset, fmt::format("a loop of {} rounds", last - first + 1),
           fmt::format("loops are unrolled: at most {}", kMostRounds));
    return {0, -1};
  }
  return {first, last};
}

Lowering::Quantity Lowering::quantity(const Statement& s) {
  struct Part {
    const ExpressionPtr& e;
    const char* what;
    double value = 0;
    Unit unit{};
  };
  Part parts[] = {{s.value, "the value"},
                  {s.lower, "the range's lower end"},
                  {s.upper, "the range's upper end"}};
  Quantity q;
  bool good = true;
  for (Part& p : parts) good = constant_of(p.e, p.what, p.value, p.unit) && good;
  if (!good) return q;
  // The unit as written is the value's; without one, the upper end's, which also serves the lower
  // end.
  const Expression* const of_value = with_unit(s.value);
  const Expression* const of_upper = with_unit(s.upper);
  const Expression* const shown = of_value != nullptr   ? of_value
                                  : of_upper != nullptr ? of_upper
                                                        : with_unit(s.lower);
  if (of_upper != nullptr && is_bare(s.lower)) {
    parts[1].value *= of_upper->unit.to_si;
    parts[1].unit = of_upper->unit.unit;
  }
  const Unit unit = shown != nullptr ? shown->unit.unit : parts[2].unit;
  const std::string words = shown != nullptr ? shown->unit_text : text_of(unit);
  for (Part& p : parts) {
    if (p.value == 0 && p.unit == kNumber) p.unit = unit;
    if (shown != nullptr && is_bare(p.e) && p.value != 0 &&
        !(&p == &parts[1] && of_upper != nullptr)) {
      report(p.e->offset, fmt::format("{} has no unit", p.what),
             fmt::format("write {} {}", p.value, words));
      return q;
    }
    if (!(p.unit == unit)) {
      const Expression* const own = with_unit(p.e);
      report(p.e->offset,
             fmt::format("{} is in {}, not in {}", p.what,
                         own != nullptr ? own->unit_text : text_of(p.unit), words),
             "value and range need the same unit");
      return q;
    }
  }
  q.unit = unit;
  if (shown != nullptr) {
    q.unit_text = shown->unit_text;
    q.to_si = shown->unit.to_si;
  } else if (!(unit == kNumber)) {
    q.unit_text = text_of(unit);
  }
  const auto say = [&](double si) {
    return fmt::format("{:.6g}{}", si / q.to_si, q.unit_text.empty() ? "" : " " + q.unit_text);
  };
  const double value = parts[0].value, lower = parts[1].value, upper = parts[2].value;
  if (!(lower < upper)) {
    report(s.lower->offset,
           fmt::format("the range of \"{}\" is {}: {} .. {}", s.name,
                       lower > upper ? "upside down" : "empty", say(lower), say(upper)),
           lower > upper ? fmt::format("write {} .. {}", say(upper), say(lower))
                         : "a value that never changes is a let");
    return q;
  }
  if (s.kind == Statement::Kind::line && (value < lower || value > upper)) {
    report(s.lower->offset, "a range without 0, of a line that begins with zeros",
           "let the range hold 0");
    return q;
  }
  if (value < lower || value > upper) {
    report(s.value->offset,
           fmt::format("{} of \"{}\" lies outside of its range {} .. {}", say(value), s.name,
                       say(lower), say(upper)),
           "choose a value inside, or widen the range");
    return q;
  }
  if (s.whole) {
    for (const Part& p : parts) {
      if (p.unit == kNumber && q.unit_text.empty() && p.value == std::floor(p.value)) continue;
      report(p.e->offset, fmt::format("{} of \"{}\" is no whole number", p.what, s.name),
             "whole stands behind whole numbers without unit");
      return q;
    }
  }
  q.value = value;
  q.range = {lower, upper};
  q.good = true;
  return q;
}

}  // namespace feltgate::law
