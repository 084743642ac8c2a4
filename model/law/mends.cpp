// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Documentation: docs/laws.md
#include "law/mends.hpp"

#include <fmt/format.h>

#include <cmath>

#include "law/compile.hpp"
#include "law/derive.hpp"
#include "law/units.hpp"
#include "law/verdict.hpp"

namespace feltgate::law {

namespace {

constexpr int kDoublings = 12;  ///< of how much a range is widened, until it holds

/// With two digits, and away from 0 by 0.5 % or more: words need some room too.
double outward(double end) {
  if (end == 0 || !std::isfinite(end)) return end;
  const double digit = std::pow(10, std::floor(std::log10(std::fabs(end))) - 1);
  return std::copysign(std::ceil(std::fabs(end) * 1.005 / digit) * digit, end);
}

constexpr double kKeptSteps = 5;  ///< of a value that a word keeps to 10 %

/// The step of a parameter's word if the parameter has this range; infinite if none fits.
double step_with(const Law& law, const Target& target, std::size_t parameter, const Range& range) {
  Law other = law;
  other.parameters[parameter].range = range;
  int tried = 0;
  try {
    const Program program =
        choose_formats(other, target, ranges(other, whole_cell(other, target)), &tried);
    for (const Word& w : program.words) {
      const Node& n = other.nodes[at(w.nodes[0])];
      if (w.primary && n.op == Op::parameter && at(n.index) == parameter) return std::fabs(w.scale);
    }
  } catch (const Refused&) {
  }
  return infinity;
}

/// A product of a parameter and of what changes in a run.
struct Product {
  std::string text;  ///< what it is multiplied with, and over which range; empty: there is none
  double size = 0;   ///< the largest magnitude of that
  bool torque = false;
};

Product product_of(const Law& law, const Target& target, std::size_t parameter) {
  const std::vector<char> fixed = fixed_nodes(law);
  const std::vector<Span> spans = ranges(law, whole_cell(law, target));
  std::vector<char> of(law.nodes.size(), 0);
  for (std::size_t i = 0; i < law.nodes.size(); ++i) {
    const Node& n = law.nodes[i];
    if (n.op == Op::parameter) {
      const NodeId from = law.parameters[at(n.index)].derived;
      of[i] = at(n.index) == parameter || (from >= 0 && of[at(from)] != 0) ? 1 : 0;
    }
    for (const NodeId a : n.arguments) of[i] |= of[at(a)];
    if (n.op != Op::multiply || of[i] == 0 || fixed[i] != 0) continue;
    for (const int side : {0, 1}) {
      const NodeId own = n.arguments[at(side)], other = n.arguments[at(1 - side)];
      if (of[at(own)] == 0 || fixed[at(own)] == 0 || spans[at(other)].empty()) continue;
      const std::string name = formula(law, other);
      return {fmt::format("line {} multiplies it with {}, which by its ranges goes over {:.3g} .. "
                          "{:.3g}",
                          n.place.line, name.find("...") == std::string::npos ? name : "a value",
                          spans[at(other)].lo, spans[at(other)].hi),
              spans[at(other)].size(), n.unit == kNewtonMetre};
    }
  }
  return {};
}

}  // namespace

std::string finer(const Law& law, const Target& target, const Parameter& p, double step) {
  const bool negative = p.range.lower < 0 && p.range.upper <= 0;
  const double value = (negative ? -kKeptSteps : kKeptSteps) * step;
  const std::string shown = fmt::format("{:.3g}{}", value / p.to_si, with_blank(p.unit_text));
  const std::string at_least = "give it a value of " + shown + (negative ? " or less" : " or more");
  if (full(std::max(std::fabs(p.range.lower), std::fabs(p.range.upper)), step)) {
    return "narrow its range, or " + at_least;
  }
  std::size_t index = 0;
  while (index < law.parameters.size() && law.parameters[index].name != p.name) ++index;
  if (index == law.parameters.size()) return at_least + ", and a range with that value";
  const double then = step_with(law, target, index,
                                {std::min(p.range.lower, value), std::max(p.range.upper, value)});
  const Product product = product_of(law, target, index);
  // A step of more than a last bit of the torque comes from the ranges, not from the torque.
  const double lsb = std::ldexp(1.0, -target.torque.fraction);
  const bool coarse = product.torque && step * product.size > 4 * lsb;
  std::string why = product.text;
  if (then > step * 1.001) {
    why = fmt::format("with a value of {} it would be {:.3g}{}", shown, then / p.to_si,
                      why.empty() ? "" : ", for " + why);
  } else if (!coarse) {
    return at_least + ", and a range with that value";
  }
  return why + ": limit " + (product.text.empty() ? "what it is used with" : "that with clamp");
}

Refused leaves_its_range(const Law& law, const Target& target, int index, bool is_line,
                         const std::string& how) {
  Law wider = law;
  Range& range = is_line ? wider.lines[at(index)].range : wider.states[at(index)].range;
  const NodeId next = is_line ? law.lines[at(index)].written : law.states[at(index)].next;
  const Unit& unit = is_line ? law.lines[at(index)].unit : law.states[at(index)].unit;
  const Place& place = is_line ? law.lines[at(index)].place : law.states[at(index)].place;
  const std::string& name = is_line ? law.lines[at(index)].name : law.states[at(index)].name;
  const Range own = range;
  const auto reached = [&] { return ranges(wider, whole_cell(wider, target))[at(next)]; };
  const Span first = reached();
  const bool leaves = !first.within({own.lower, own.upper});
  const bool whole = !is_line && law.states[at(index)].whole;
  bool holds = false;
  for (int i = 0; leaves && !holds && i < kDoublings; ++i) {
    const double more = std::exp2(i);
    range.lower = own.lower - more * std::max(0.0, own.lower - first.lo);
    range.upper = own.upper + more * std::max(0.0, first.hi - own.upper);
    if (range.lower < own.lower)
      range.lower = whole ? std::floor(range.lower) : outward(range.lower);
    if (range.upper > own.upper)
      range.upper = whole ? std::ceil(range.upper) : outward(range.upper);
    holds = range.upper - range.lower < infinity && reached().within({range.lower, range.upper});
  }
  const std::string clamp = fmt::format("{} clamp(..., {:.6g}, {:.6g})",
                                        is_line ? "write" : "end with", own.lower, own.upper);
  const std::string in = unit == kNumber ? "" : " " + text_of(unit);
  return {place,
          fmt::format("{} {} can leave its range {:.6g} .. {:.6g}: its next value can be {}{}",
                      is_line ? "line" : "state", name, own.lower, own.upper, how,
                      leaves && !holds ? ", and in a larger range still more" : ""),
          holds ? fmt::format("{}, or give it a larger range: {:.6g} .. {:.6g}{}", clamp,
                              range.lower, range.upper, in)
                : clamp};
}

}  // namespace feltgate::law
