// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Lowers periodic tables: their argument is in turns, as that of the sine. Documentation:
// docs/laws.md
#include <fmt/format.h>

#include <cmath>

#include "law/back_end.hpp"

namespace feltgate::law {

namespace {

/// Treats the first and the last segment as neighbours.
void join_ends(TableUse& t, bool whole_segments) {
  const std::size_t last = t.words.size() - 1;
  t.steep.front() = t.steep.back() = t.slope;
  t.errors.front() = t.errors.back() = t.error;
  t.jumps.clear();
  if (!whole_segments) return;  // half of one segment at each end
  const int end = engine_table_value(t.words[last]) + engine_table_slope(t.words[last]);
  t.jump =
      std::max(t.jump, std::fabs(static_cast<double>(engine_table_value(t.words.front()) - end)));
}

}  // namespace

Value BackEnd::periodic(NodeId id) {
  const Node& n = node(id);
  const Table& table = law_.tables[at(n.index)];
  const double period = table.domain.upper - table.domain.lower;
  const int words = table_words_left_ / std::max(1, other_tables_);
  int segments = table.segments;
  if (segments == 0) {
    if (words < 2) {
      throw Refused(n.place, "no table memory is left for this",
                    "ask for fewer segments of the other tables");
    }
    segments = 1 << static_cast<int>(std::log2(words));
  }
  const double start = table.domain.lower / period * segments;
  if (!table.points.empty() && std::fabs(start - std::nearbyint(start)) > 1e-9) {
    throw Refused(table.place, "the first point is no whole number of segments from 0",
                  fmt::format("let the table {} begin at 0", table.name));
  }
  const Operand turns = phase(n.arguments[0], std::ldexp(1.0, -32), period);
  // Takes the upper bits of the turn: an index and 12 bits.
  constexpr int drop = 27;  // of mode 3
  Step& index = emit(EngineOp::mlw, 3, turns, constant(std::ldexp(segments, drop - 20)),
                     1 / (4096.0 * segments), id);
  index.turns = true;
  const Operand x = last();
  TableRequest r;
  r.function = [this, &table](const Span& at) { return table_jet(law_, table, at); };
  r.argument_scale = period / segments / 4096;
  r.low = -(segments + 1) / 2;
  r.count = segments + segments % 2;
  r.domain = Span{1.0 * r.low, 1.0 * r.low + r.count} * (period / segments);
  r.limit = 524287;
  const int fraction = value_fraction(r);
  // The table is stored once: its first reader chooses the scale for all.
  const std::string memory = fmt::format("periodic {}", n.index);
  const auto same = memory_scales_.find(memory);
  r.value_scale =
      same != memory_scales_.end() ? same->second : chosen_scale(id, 1, fraction, span(id).size());
  memory_scales_[memory] = r.value_scale;
  if (-std::log2(r.value_scale) > fraction + 0.5) throw Unfit("a table's value has 20 bits", id);
  auto placed = table_keys_.find(memory);
  if (placed == table_keys_.end()) {
    const std::string key = fmt::format("{} {} {:.17g}", memory, segments, r.value_scale);
    auto made = choice_.made.find(key);
    if (made == choice_.made.end()) {
      TableUse t = make_table(r);
      join_ends(t, segments % 2 == 0);
      t.what = table.name;
      made = choice_.made.emplace(key, t).first;
    }
    place_table(memory, made->second);
    placed = table_keys_.find(memory);
  }
  Step& s = emit(EngineOp::lrp, 0, x, {}, r.value_scale, id);
  s.table = placed->second;
  s.argument_scale = r.argument_scale;
  s.node = id;
  return {last(), r.value_scale, 0};
}

}  // namespace feltgate::law
