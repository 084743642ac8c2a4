// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Documentation: docs/laws.md
#include "law/compile.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "law/allocate.hpp"
#include "law/mends.hpp"
#include "law/read_law.hpp"
#include "law/verdict.hpp"

namespace feltgate::law {

namespace {

/// Gives filters the range of the node that they follow, extended to include their start value 0.
void complete_states(Law& law, const Target& target) {
  for (State& s : law.states) {
    if (s.follows >= 0) s.range = {0, 0};
  }
  for (std::size_t round = 0; round <= law.states.size(); ++round) {
    const std::vector<Span> spans = ranges(law, whole_cell(law, target));
    for (State& s : law.states) {
      if (s.follows < 0) continue;
      const Span r = spans[at(s.follows)];
      s.range = {std::min({r.lo, 0.0, s.initial}), std::max({r.hi, 0.0, s.initial})};
    }
  }
}

void require_proofs(const Law& law, const Target& target, const Program& program, const Bound& b) {
  if (b.unproven.empty()) return;
  const Unproven& u = b.unproven.front();
  if (u.state >= static_cast<int>(law.states.size())) {
    const auto line = at(u.state) - law.states.size() - law.events.size();
    throw leaves_its_range(law, target, static_cast<int>(line), true, u.reason);
  }
  if (u.state >= 0) {
    const State& s = law.states[at(u.state)];
    if (s.follows < 0) throw leaves_its_range(law, target, u.state, false, u.reason);
    throw Refused(s.place,
                  fmt::format("state {} can leave its range {:.6g} .. {:.6g}: its next value can "
                              "be {}",
                              s.name, s.range.lower, s.range.upper, u.reason),
                  "keep the filter's frequency above 0, e.g. max(..., 10 Hz), and give the law a "
                  "lower rate");
  }
  throw Refused(program.steps[at(u.step)].place, "this cannot be proven: " + u.reason,
                "limit it with clamp, or narrow the ranges of what it is made of");
}

/// The cell in which each parameter has the value of its word; a mailbox has its whole range.
Cell cell_as_set(const Law& law, const Target& target, const Image& image) {
  Cell cell = whole_cell(law, target);
  for (const ImageWord& w : image.words) {
    if (!w.formula.empty() || w.mailbox) continue;
    for (std::size_t p = 0; p < law.parameters.size(); ++p) {
      if (law.parameters[p].name != w.name) continue;
      cell.parameters[p] = {w.initial * w.scale, w.initial * w.scale};
    }
  }
  return cell;
}

int divider_for(const Law& law, const Target& target, int instructions) {
  const int clocks = engine_period(instructions, target.axes);
  const auto least =
      static_cast<int>((clocks + target.clocks_per_tick - 1) / target.clocks_per_tick);
  const double tick = static_cast<double>(target.tick_hz);
  if (law.rate_hz <= 0) return least;
  const double exact = tick / law.rate_hz;
  const auto divider = static_cast<int>(std::lround(exact));
  if (divider < 1 || std::fabs(exact - divider) > 1e-6 * exact) {
    throw Refused(
        fmt::format("rate {:.6g} Hz is no whole part of the tick, {:.6g} Hz", law.rate_hz, tick),
        fmt::format("write rate = {:.6g} Hz", tick / std::max(1.0, std::ceil(exact))));
  }
  if (divider < least) {
    throw Refused(
        fmt::format("{} instructions take {} clocks from start to start and do not fit in {}: at "
                    "most {:.9g} Hz",
                    instructions, clocks, divider * target.clocks_per_tick, tick / least),
        fmt::format("write rate = {:.9g} Hz, or leave the rate away", tick / least));
  }
  if (divider > 4095) {
    throw Refused(fmt::format("a rate of {:.6g} Hz needs a divider of {}, 4095 is the largest",
                              law.rate_hz, divider),
                  fmt::format("use a rate from {:.6g} Hz on", std::ceil(tick / 4095)));
  }
  return divider;
}

/// Chooses the formats, proves them, and assembles the program.
void form(Compiled& c) {
  const std::vector<Span> spans = ranges(c.law, whole_cell(c.law, c.target));
  int tried = 0;
  c.program = choose_formats(c.law, c.target, spans, &tried);
  c.tried += tried;
  c.bound = bound(c.law, c.target, c.program, 400);
  require_proofs(c.law, c.target, c.program, c.bound);
  c.assembled = assemble(c.law, c.target, c.program);
  c.divider = divider_for(c.law, c.target, static_cast<int>(c.assembled.instructions.size()));
}

bool has_functions(const Program& program) {
  return std::any_of(program.steps.begin(), program.steps.end(), [&](const Step& s) {
    return s.op == EngineOp::lrp && !program.tables[at(s.table)].wraps;
  });
}

/// Whether a strip of `more` is much wider than the same one of `now`: an error that only decides a
/// comparison is no part of the bound.
bool strips_grow(const Bound& more, const Bound& now) {
  return std::any_of(more.strips.begin(), more.strips.end(), [&](const Strip& s) {
    double before = 0;
    for (const Strip& t : now.strips) {
      const bool same = t.place.line == s.place.line && t.place.column == s.place.column;
      if (same) before = std::max(before, t.width);
    }
    return s.width > 2 * before;
  });
}

/// Per comparison of `law`, by its place, of what comes from a function: the room that interest()
/// leaves beside what it is compared with.
std::map<std::pair<int, int>, double> rooms(const Law& law, const Target& target) {
  std::vector<char> from_function(law.nodes.size(), 0);
  const std::vector<Span> spans = ranges(law, whole_cell(law, target));
  std::map<std::pair<int, int>, double> all;
  for (std::size_t i = 0; i < law.nodes.size(); ++i) {
    const Node& n = law.nodes[i];
    from_function[i] = has_pieces(n.op) ? 1 : 0;
    for (const NodeId a : n.arguments) from_function[i] |= from_function[at(a)];
    for (std::size_t k = 0; n.op == Op::less && k < 2; ++k) {
      if (from_function[at(n.arguments[k])] == 0) continue;
      const double room = room_beside(spans[at(n.arguments[k])], spans[at(n.arguments[1 - k])]);
      const auto [known, is_new] = all.insert({{n.place.line, n.place.column}, room});
      if (!is_new) known->second = std::min(known->second, room);
    }
  }
  return all;
}

/// Whether a strip is as wide as the room beside it. Limits that were moved within such a strip
/// would let words come out otherwise than the law far from it.
bool is_coarse(const Bound& b, const std::map<std::pair<int, int>, double>& rooms) {
  return std::any_of(b.strips.begin(), b.strips.end(), [&](const Strip& s) {
    const auto room = rooms.find({s.place.line, s.place.column});
    return room != rooms.end() && s.width >= room->second;
  });
}

/// Splits functions of wide ranges into more tables, as long as the bound or a strip is large and
/// the law still fits.
void into_pieces(Compiled& c) {
  // Without a function there are still limits to move.
  const int most = has_functions(c.program) ? kMostPieces : 1;
  const std::vector<Span> given = given_ranges(c.law, c.target);
  const auto share = [&](const Compiled& of) {
    return std::max(largest_share(given, of.target, of.bound), largest_drift(of.law, of.bound));
  };
  Compiled whole = c;
  const auto own_rooms = rooms(c.law, c.target);
  bool moved = false;  // limits of `whole` are those of interest()
  for (int pieces = 1; pieces <= most; ++pieces) {
    const bool coarse = is_coarse(c.bound, own_rooms);
    if (share(c) <= kLargeShare && !coarse) return;
    Compiled more = c;
    bool narrowed = false;
    more.law = in_pieces(whole.law, c.target, whole.program, whole.bound, pieces, &narrowed);
    try {
      form(more);
    } catch (const Refused&) {
      return;
    }
    // A bound for all runs is better than a smaller one for few.
    const bool better = share(more) < (coarse ? 1 : 0.7 * share(c));
    const bool too_near =
        (narrowed || moved) &&
        (is_coarse(more.bound, own_rooms) || is_coarse(more.bound, rooms(whole.law, c.target)));
    if (!better || too_near || strips_grow(more.bound, c.bound)) continue;
    c = more;
    // One piece only moves limits. The argument is finer there, and worth more pieces.
    if (pieces == 1) {
      whole = c;
      moved = narrowed;
    }
  }
}

}  // namespace

Compiled compile(const Law& given, const Target& target) {
  Compiled c;
  c.law = given;
  c.target = target;
  if (c.law.outputs.empty()) throw Refused("the law has no output", "write: out torque = ...");
  for (const Input& i : c.law.inputs) c.target.axes = std::max(c.target.axes, i.axis + 1);
  for (const Output& o : c.law.outputs) c.target.axes = std::max(c.target.axes, o.axis + 1);
  complete_states(c.law, target);
  form(c);
  into_pieces(c);
  refuse_idle_bounds(c.law, target, c.program, c.bound);
  c.rate_hz = static_cast<double>(target.tick_hz) / c.divider;
  c.image = make_image(c.law, target, c.program, c.assembled, c.divider);
  const Cell as_set = cell_as_set(c.law, target, c.image);
  c.bound.as_set = bound_as_set(c.law, target, c.program, as_set, c.bound, 400);
  tighten_jumps(c.law, target, c.program, as_set, &c.bound);
  return c;
}

namespace {

template <class Read>
Compiled settled(const Read& read, const Target& target) {
  double rate = static_cast<double>(target.tick_hz);
  try {
    // The file has its own rate, or nothing in it depends on the rate.
    return compile(read(0.0), target);
  } catch (const LawError&) {
    // Reading succeeds now if only the rate was missing. If the file has an own rate, the first
    // error stands.
    if (read(rate).own_rate) throw;
  }
  // The file has no own rate: the assumed rate only serves dt and filters.
  const auto at_rate = [&] {
    Law free = read(rate);
    free.rate_hz = 0;
    return compile(free, target);
  };
  Compiled c = at_rate();
  for (int i = 0; i < 3 && c.rate_hz != rate; ++i) {
    rate = c.rate_hz;
    c = at_rate();
  }
  return c;
}

/// Reports a refusal of the compiler in the form of the reader's errors.
template <class Read>
Compiled settle(const Read& read, const std::string& path, const Target& target) {
  try {
    return settled(read, target);
  } catch (const Refused& r) {
    throw LawError(path, {{r.place, r.reason, r.mend}});
  }
}

}  // namespace

Compiled compile_file(const std::string& path, const Target& target) {
  return settle([&](double rate) { return read_law(path, rate); }, path, target);
}

Compiled compile_text(const std::string& text, const std::string& name, const Target& target) {
  return settle([&](double rate) { return read_law_text(text, name, rate); }, name, target);
}

}  // namespace feltgate::law
