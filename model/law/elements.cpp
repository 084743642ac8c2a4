// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Lowers reads of array elements whose index is computed in the run. Documentation:
// docs/laws.md
#include <fmt/format.h>

#include <cmath>

#include "law/back_end.hpp"

namespace feltgate::law {

Value BackEnd::element(NodeId id) {
  const Node& n = node(id);
  const Array& array = law_.arrays[at(n.index)];
  const double last_index = static_cast<double>(array.values.size()) - 1;
  const Span range = span(n.arguments[0]);
  const NodeId of = n.arguments[0];
  Value v =
      node(of).whole ? align({whole_word(of), 1, range.size()}, 1.0 / 4096, of) : floor_word(of, 0);
  if (range.lo < 0) {
    emit(EngineOp::max, 0, v.operand, constant(0), v.scale, id);
    v.operand = last();
  }
  if (range.hi >= last_index + 1) {
    emit(EngineOp::min, 0, v.operand, constant(last_index / v.scale), v.scale, id);
    v.operand = last();
  }
  double size = 0;
  for (const double a : array.values) size = std::max(size, std::fabs(a));
  const std::string memory = fmt::format("array {}", n.index);
  const auto same = memory_scales_.find(memory);
  const double scale = same != memory_scales_.end()
                           ? same->second
                           : chosen_scale(id, 1, largest_fraction(id, 1, size), size);
  if (n.whole && scale > 1) throw Unfit("a whole element counts in ones", id);
  memory_scales_[memory] = scale;
  const std::string key = fmt::format("array {} {:.17g}", n.index, scale);
  auto found = table_keys_.find(key);
  int index = found == table_keys_.end() ? -1 : found->second;
  if (index < 0) {
    TableUse t;
    t.what = array.name;
    t.proof = "rounded numbers";
    for (const double a : array.values) {
      const auto w = static_cast<std::int32_t>(std::lround(a / scale));
      if (w * scale != a) t.error = 0.5;
      t.words.push_back(static_cast<std::uint32_t>(w));
      t.values =
          t.words.size() == 1 ? Span{double(w), double(w)} : hull(t.values, {double(w), double(w)});
    }
    index = place_table(key, t);
  }
  Step& s = emit(EngineOp::tab, 0, v.operand, {}, scale, id);
  s.table = index;
  s.node = id;
  s.condition = id;
  s.floors = n.arguments[0];
  s.margin_scale = v.scale;
  return {last(), scale, 0};
}

}  // namespace feltgate::law
