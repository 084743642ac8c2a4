// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Documentation: docs/laws.md
#include "law/back_end.hpp"

#include <algorithm>
#include <cmath>

#include "law/ranges.hpp"

namespace feltgate::law {

namespace {

constexpr std::size_t kMostValues = 64;  ///< of a node; further ones are not looked at

/// The same number, within the rounding of doubles.
bool same_number(double a, double b) {
  return std::fabs(a - b) <= 1e-9 * std::max(std::fabs(a), std::fabs(b));
}

}  // namespace

Stays::Stays(const Law& law) : law_(law), decides_(law.nodes.size(), 0) {
  for (const NodeId id : needed(law)) {
    const Node& n = law.nodes[law::at(id)];
    (void)of(id);
    if (n.op != Op::less) continue;
    const NodeId a = n.arguments[0], b = n.arguments[1];
    const std::vector<double> values = of(a);
    for (const double value : values) {
      // 0 is a word of every scale.
      if (value == 0 || (of(b), !at(b, value))) continue;
      decide(a, value);
      decide(b, value);
    }
  }
}

/// The ends, elements and first values of a node, as far as they reach it.
const std::vector<double>& Stays::of(NodeId id) {
  const auto found = values_.find(id);
  if (found != values_.end()) return found->second;
  values_[id] = {};  // a state that depends on itself
  const Node& n = law_.nodes[law::at(id)];
  std::vector<double> all;
  const auto add = [&](double value) {
    const auto same = [&](double other) { return same_number(value, other); };
    if (all.size() < kMostValues && std::none_of(all.begin(), all.end(), same))
      all.push_back(value);
  };
  const auto each = [&](NodeId from, auto change) {
    if (from < 0) return;
    const std::vector<double> values = of(from);
    for (const double value : values) add(change(value));
  };
  const auto pairs = [&](auto join) {
    const std::vector<double> a = of(n.arguments[0]), b = of(n.arguments[1]);
    for (const double x : a) {
      for (const double y : b) add(join(x, y));
    }
  };
  const auto same = [](double value) { return value; };
  switch (n.op) {
    case Op::constant:
      add(n.value);
      break;
    case Op::input:
      add(0);
      break;
    case Op::minimum:
    case Op::maximum:
      for (const NodeId a : n.arguments) each(a, same);
      break;
    case Op::select:
      for (const NodeId a : {n.arguments[1], n.arguments[2]}) each(a, same);
      break;
    case Op::negate:
      each(n.arguments[0], [](double value) { return -value; });
      break;
    case Op::absolute:
      each(n.arguments[0], [](double value) { return std::fabs(value); });
      break;
    case Op::add:
      pairs([](double a, double b) { return a + b; });
      break;
    case Op::subtract:
      pairs([](double a, double b) { return a - b; });
      break;
    case Op::multiply:
      pairs([](double a, double b) { return a * b; });
      break;
    case Op::element:
      for (const double value : law_.arrays[law::at(n.index)].values) add(value);
      break;
    case Op::state:
      add(law_.states[law::at(n.index)].initial);
      each(law_.states[law::at(n.index)].next, same);
      break;
    case Op::line_read:
      add(0);
      each(law_.lines[law::at(n.index)].written, same);
      break;
    default:
      break;
  }
  return values_[id] = all;
}

bool Stays::at(NodeId id, double value) const {
  const auto found = values_.find(id);
  return found != values_.end() &&
         std::any_of(found->second.begin(), found->second.end(),
                     [&](double other) { return same_number(value, other); });
}

bool Stays::at_whole(NodeId id) const {
  const auto found = values_.find(id);
  return found != values_.end() &&
         std::any_of(found->second.begin(), found->second.end(), [](double value) {
           return std::fabs(value - std::nearbyint(value)) < 1.0 / 1024;
         });
}

/// Marks the node and what it takes this value from.
void Stays::decide(NodeId id, double value) {
  if (id < 0 || decides_[law::at(id)] != 0 || !at(id, value)) return;
  decides_[law::at(id)] = 1;
  const Node& n = law_.nodes[law::at(id)];
  switch (n.op) {
    case Op::minimum:
    case Op::maximum:
    case Op::select:
      for (const NodeId a : n.arguments) decide(a, value);
      break;
    case Op::negate:
      decide(n.arguments[0], -value);
      break;
    case Op::absolute:
      decide(n.arguments[0], value);
      decide(n.arguments[0], -value);
      break;
    case Op::state:
      decide(law_.states[law::at(n.index)].next, value);
      break;
    case Op::line_read:
      decide(law_.lines[law::at(n.index)].written, value);
      break;
    default:
      break;
  }
}

}  // namespace feltgate::law
