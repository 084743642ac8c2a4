// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Finds places where a table's formula is not a finite number. Documentation: docs/laws.md
#include "law/table_values.hpp"

#include <algorithm>
#include <cmath>

#include "law/evaluate.hpp"

namespace feltgate::law {

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

}  // namespace feltgate::law
