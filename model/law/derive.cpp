// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
#include "law/derive.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "law/ranges.hpp"
#include "law/units.hpp"

namespace feltgate::law {

namespace {

using Ids = std::vector<NodeId>;

/// Copies the nodes that a run (device) needs, or that the host needs for a derived word.
class Finish {
 public:
  Finish(Law& law, const Graph& graph, Diagnostics& diagnostics)
      : law_(law),
        diagnostics_(diagnostics),
        count_(law.nodes.size()),
        on_device_(count_),
        on_host_(count_),
        device_(count_, kNone),
        host_(count_, kNone) {
    for (NodeId id = 0; id < static_cast<NodeId>(count_); ++id)
      fixed_.push_back(graph.is_fixed(id));
  }

  void run() {
    narrow_parameters();
    each_root(law_, [&](NodeId& id) {
      if (id != kNone) on_device_[index(id)] = true;
    });
    for (const Requirement& r : law_.requirements) {
      on_host_[index(r.smaller)] = on_host_[index(r.larger)] = true;
    }
    for (std::size_t i = count_; i-- > 0;) {
      if (on_device_[i] && is_derived(i)) on_host_[i] = true;
      for (const NodeId a : law_.nodes[i].arguments) {
        if (on_host_[i]) on_host_[index(a)] = true;
        if (on_device_[i] && !is_derived(i)) on_device_[index(a)] = true;
      }
    }
    for (std::size_t i = 0; i < count_; ++i) copy(i);
    law_.nodes = std::move(nodes_);
    each_root(law_, [&](NodeId& id) {
      if (id != kNone) id = device_[index(id)];
    });
    for (Requirement& r : law_.requirements) {
      r.smaller = host_[index(r.smaller)];
      r.larger = host_[index(r.larger)];
    }
    name_derived();
  }

 private:
  static std::size_t index(NodeId id) { return static_cast<std::size_t>(id); }

  /// Narrows the ranges of parameters to values for which the requirements can hold. The file's own
  /// value stays inside; if it violates a requirement, the error names both.
  void narrow_parameters() {
    const auto limit = [&](NodeId id) {
      const Node& n = law_.nodes[index(id)];
      if (n.op == Op::parameter) return law_.parameters[index(n.index)].range;
      if (n.op == Op::constant) return Range{n.value, n.value};
      return Range{-infinity, infinity};
    };
    const auto narrow = [&](NodeId id, double lower, double upper) {
      const Node& n = law_.nodes[index(id)];
      if (n.op != Op::parameter) return;
      Parameter& p = law_.parameters[index(n.index)];
      if (p.whole) lower = std::ceil(lower), upper = std::floor(upper);
      const Range r{std::max(p.range.lower, std::min(lower, p.initial)),
                    std::min(p.range.upper, std::max(upper, p.initial))};
      if (r.lower < r.upper) p.range = r;
    };
    for (std::size_t round = 0; round < law_.requirements.size(); ++round) {
      for (const Requirement& r : law_.requirements) {
        narrow(r.smaller, -infinity, limit(r.larger).upper);
        narrow(r.larger, limit(r.smaller).lower, infinity);
      }
    }
  }

  /// Names derived words by their formulas; shortened long formulas may be equal.
  void name_derived() {
    std::map<std::string, int> seen;
    for (Parameter& p : law_.parameters) {
      if (p.derived == kNone) continue;
      p.name = formula(law_, p.derived);
      const int number = ++seen[p.name];
      if (number > 1) p.name += fmt::format(" ({})", number);
    }
  }

  /// Whether a run reads node `i` as a word that the host computes.
  bool is_derived(std::size_t i) const {
    const Node& n = law_.nodes[i];
    return fixed_[i] && !n.truth && n.op != Op::constant && n.op != Op::parameter;
  }

  NodeId push(Node n) {
    nodes_.push_back(std::move(n));
    ranges_.emplace_back();
    return static_cast<NodeId>(nodes_.size()) - 1;
  }

  Node moved(const Node& n, const Ids& to) const {
    Node copy = n;
    for (NodeId& a : copy.arguments) a = to[index(a)];
    return copy;
  }

  void copy(std::size_t i) {
    const Node& n = law_.nodes[i];
    const bool leaf = n.arguments.empty();
    if (on_host_[i] || (leaf && on_device_[i])) {
      host_[i] = push(moved(n, host_));
      if (on_host_[i]) bound(host_[i]);
    }
    if (!on_device_[i]) return;
    if (is_derived(i)) {
      device_[i] = derive(host_[i], n);
    } else {
      device_[i] = leaf ? host_[i] : push(moved(n, device_));
    }
  }

  void bound(NodeId id) {
    const Node& n = nodes_[index(id)];
    try {
      ranges_[index(id)] = host_range(law_, n, ranges_);
      Range& range = ranges_[index(id)];
      for (Requirement r : law_.requirements) {
        r.smaller = host_[index(r.smaller)];
        r.larger = host_[index(r.larger)];
        narrow_difference(n, r, &range.lower, &range.upper);
      }
    } catch (const NoRange& error) {
      diagnostics_.add(n.place, error.what, error.mend);
    }
  }

  NodeId derive(NodeId from, const Node& n) {
    Parameter p;
    p.unit = n.unit;
    if (!(n.unit == kNumber)) p.unit_text = text_of(n.unit);
    p.range = ranges_[index(from)];
    p.derived = from;
    p.place = n.place;
    law_.parameters.push_back(p);
    Node word;
    word.op = Op::parameter;
    word.index = static_cast<int>(law_.parameters.size()) - 1;
    word.unit = n.unit;
    word.whole = n.whole;
    word.place = n.place;
    return push(word);
  }

  Law& law_;
  Diagnostics& diagnostics_;
  std::size_t count_;
  std::vector<bool> fixed_, on_device_, on_host_;
  Ids device_, host_;
  std::vector<Node> nodes_;
  std::vector<Range> ranges_;
};

std::string text(const Law& law, NodeId id, int depth);

/// An argument as text, in parentheses if it is a sum or similar.
std::string part(const Law& law, NodeId id, int depth) {
  const Op op = law.nodes[static_cast<std::size_t>(id)].op;
  const std::string inside = text(law, id, depth);
  const bool sum = op == Op::add || op == Op::subtract || op == Op::negate || op == Op::select;
  return sum ? "(" + inside + ")" : inside;
}

std::string text(const Law& law, NodeId id, int depth) {
  if (depth == 0) return "...";
  const Node& n = law.nodes[static_cast<std::size_t>(id)];
  const auto index = static_cast<std::size_t>(n.index);
  const auto arg = [&](std::size_t i) { return text(law, n.arguments[i], depth - 1); };
  const auto bracketed = [&](std::size_t i) { return part(law, n.arguments[i], depth - 1); };
  const auto call = [&](const char* name) {
    std::string all = std::string(name) + "(";
    for (std::size_t i = 0; i < n.arguments.size(); ++i) all += (i == 0 ? "" : ", ") + arg(i);
    return all + ")";
  };
  switch (n.op) {
    case Op::constant:
      return fmt::format("{:.6g}", n.value);
    case Op::parameter:
      return law.parameters[index].name;
    case Op::input:
      return n.index < 0 ? "x" : law.inputs[index].name;
    case Op::state:
      return law.states[index].name;
    case Op::add:
      return arg(0) + " + " + arg(1);
    case Op::subtract:
      return arg(0) + " - " + bracketed(1);
    case Op::multiply:
      return bracketed(0) + "*" + bracketed(1);
    case Op::negate:
      return "-" + bracketed(0);
    case Op::absolute:
      return call("abs");
    case Op::minimum:
      return call("min");
    case Op::maximum:
      return call("max");
    case Op::less:
      return arg(0) + " < " + arg(1);
    case Op::both:
      return arg(0) + " and " + arg(1);
    case Op::either:
      return "(" + arg(0) + " or " + arg(1) + ")";
    case Op::opposite:
      return "not (" + arg(0) + ")";
    case Op::select:
      return "if " + arg(0) + " then " + arg(1) + " else " + arg(2);
    case Op::sine:
      return call("sin");
    case Op::cosine:
      return call("cos");
    case Op::root:
      return call("sqrt");
    case Op::reciprocal:
      return "1/(" + arg(0) + ")";
    case Op::exponential:
      return call("exp");
    case Op::logarithm:
      return call("log");
    case Op::arctangent:
      return call("atan");
    case Op::lookup:
      return call(law.tables[index].name.c_str());
    case Op::element:
      return law.arrays[index].name + "[" + arg(0) + "]";
    case Op::line_read:
      return law.lines[index].name + "[" + arg(0) + "]";
  }
  return "";
}

}  // namespace

std::string formula(const Law& law, NodeId id) {
  constexpr std::size_t longest = 60;
  constexpr int deepest = 12;
  std::string best = "...";
  for (int depth = 1; depth <= deepest; ++depth) {
    const std::string all = text(law, id, depth);
    if (all.size() > longest) break;
    best = all;
  }
  return best;
}

void finish(Law& law, const Graph& graph, Diagnostics& diagnostics) {
  Finish(law, graph, diagnostics).run();
}

// The ranges of formulas of parameters.

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

Range wider(double lower, double upper) {
  if (!(lower >= -kLargest) || !(upper <= kLargest)) {
    throw NoRange{"a formula of parameters that gets too large",
                  "make the parameters' ranges smaller"};
  }
  // An end of 0 comes from a factor 0 or from an exact difference: it needs no rounding.
  return {lower == 0 ? 0 : std::nextafter(lower, -kInfinity),
          upper == 0 ? 0 : std::nextafter(upper, kInfinity)};
}

Range range_of_product(const Range& a, const Range& b) {
  const auto [low, high] =
      std::minmax({a.lower * b.lower, a.lower * b.upper, a.upper * b.lower, a.upper * b.upper});
  return wider(low, high);
}

Range square(const Range& a) {
  const double most = std::max(a.lower * a.lower, a.upper * a.upper);
  const bool over_zero = a.lower <= 0 && a.upper >= 0;
  const Range r = wider(std::min(a.lower * a.lower, a.upper * a.upper), most);
  return {over_zero ? 0 : r.lower, r.upper};
}

Range join(const Range& a, const Range& b) {
  return {std::min(a.lower, b.lower), std::max(a.upper, b.upper)};
}

}  // namespace

Range host_range(const Law& law, const Node& n, const std::vector<Range>& ranges) {
  const auto argument = [&](std::size_t i) {
    return ranges[static_cast<std::size_t>(n.arguments[i])];
  };
  const Range a = n.arguments.empty() ? Range{} : argument(0);
  const Range b = n.arguments.size() < 2 ? Range{} : argument(1);
  switch (n.op) {
    case Op::constant:
      return {n.value, n.value};
    case Op::parameter:
      return law.parameters[static_cast<std::size_t>(n.index)].range;
    case Op::add:
      return wider(a.lower + b.lower, a.upper + b.upper);
    case Op::subtract:
      return wider(a.lower - b.upper, a.upper - b.lower);
    case Op::multiply:
      return n.arguments[0] == n.arguments[1] ? square(a) : range_of_product(a, b);
    case Op::negate:
      return {0 - a.upper, 0 - a.lower};
    case Op::absolute:
      return {a.lower > 0 ? a.lower : a.upper < 0 ? -a.upper : 0, std::max(-a.lower, a.upper)};
    case Op::minimum:
      return {std::min(a.lower, b.lower), std::min(a.upper, b.upper)};
    case Op::maximum:
      return {std::max(a.lower, b.lower), std::max(a.upper, b.upper)};
    case Op::select:
      return join(b, argument(2));
    case Op::less:
    case Op::both:
    case Op::either:
    case Op::opposite:
      return {0, 1};
    case Op::sine:
    case Op::cosine:
      return {-1, 1};
    case Op::root:
      if (a.lower < 0) {
        throw NoRange{"the square root of parameters that may be below 0",
                      "begin their ranges at 0, or write sqrt(max(x, 0))"};
      }
      return {std::max(0.0, wider(std::sqrt(a.lower), 0).lower),
              wider(0, std::sqrt(a.upper)).upper};
    case Op::reciprocal:
      if (a.lower <= 0 && a.upper >= 0) {
        throw NoRange{"a division by parameters that may be 0", "let their ranges not hold 0"};
      }
      return wider(1 / a.upper, 1 / a.lower);
    case Op::exponential: {
      const Range r = wider(std::exp(a.lower), std::exp(a.upper));
      return {std::max(0.0, r.lower), r.upper};
    }
    case Op::logarithm:
      if (a.lower <= 0) {
        throw NoRange{"the logarithm of parameters that may be 0 or below",
                      "begin their ranges above 0, or write log(max(x, 0.01))"};
      }
      return wider(std::log(a.lower), std::log(a.upper));
    case Op::element: {
      const auto& values = law.arrays[static_cast<std::size_t>(n.index)].values;
      const auto [low, high] = std::minmax_element(values.begin(), values.end());
      return {*low, *high};
    }
    case Op::lookup:
      if (!law.tables[static_cast<std::size_t>(n.index)].points.empty()) {
        throw NoRange{"a table of what only depends on parameters",
                      "make what it gives the parameter, or write its lines with if"};
      }
      break;
    case Op::arctangent:
    case Op::input:
    case Op::state:
    case Op::line_read:
      break;
  }
  throw NoRange{"a table of what only depends on parameters",
                "write its formula in its place; the host computes that"};
}

}  // namespace feltgate::law
