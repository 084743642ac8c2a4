// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Searches the formats: changes the fraction bits of one value at a time, as long as the cost
// falls. Documentation: docs/laws.md
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <tuple>

#include "law/compile.hpp"
#include "law/derive.hpp"
#include "law/mends.hpp"
#include "law/units.hpp"

namespace feltgate::law {

namespace {

constexpr int most_tried = 1500;
constexpr double least_error = 0.4;  ///< LSB of the torque; a smaller error costs the same

constexpr double kOneValue = 1000;  ///< cost of what became one value: no error is worth it

struct Candidate {
  Choice choice;
  Program program;
  double cost = infinity;
  Unfit unfit{""};  ///< why there is no program
};

/// Whether the word has one value for all values of what it is made of.
bool is_one_value(const Word& w, const std::vector<Span>& spans) {
  Span s{1, 1};
  for (const NodeId id : w.nodes) s = s * spans[static_cast<std::size_t>(id)];
  const double a = std::min(s.lo / w.scale, s.hi / w.scale);
  const double b = std::max(s.lo / w.scale, s.hi / w.scale);
  if (!(b - a > 1e-12 * std::max(std::fabs(a), std::fabs(b)))) return false;
  return w.primary ? std::ceil(a - 1e-6) >= std::floor(b + 1e-6)
                   : std::nearbyint(a) == std::nearbyint(b);
}

/// The cost of a program without error and strips.
double least_cost(const Law& law, const Target& target, const Program& program,
                  const std::vector<Span>& spans) {
  // Sums the instructions, with a larger weight for a tick of time, and the bits that a host cannot
  // set.
  const auto steps = static_cast<double>(program.steps.size());
  const int clocks = engine_period(static_cast<int>(program.steps.size()), target.axes);
  const double ticks = std::ceil(1.0 * clocks / target.clocks_per_tick);
  double c = (steps > 8 ? 0.4 * steps + 1.6 : 0.6 * steps) + (law.rate_hz > 0 ? 0 : 3 * ticks) +
             std::log2(least_error);
  for (const Word& w : program.words) {
    double size = 1;
    for (const NodeId id : w.nodes) size *= spans[static_cast<std::size_t>(id)].size();
    const double bits = std::log2(std::max(0.5, size / std::fabs(w.scale)));
    c += 0.02 + 0.08 * std::max(0.0, 14 - bits) + 4 * std::max(0.0, 6 - bits);
    if (is_one_value(w, spans)) c += kOneValue;
  }
  return c;
}

class Search {
 public:
  Search(const Law& law, const Target& target, const std::vector<Span>& spans)
      : law_(law), target_(target), spans_(spans), stays_(std::make_shared<const Stays>(law)) {}

  Candidate run(int* tried) {
    Candidate best = evaluate({}, infinity);
    Choice other;
    other.states_first = true;
    if (!law_.states.empty()) try_choice(best, other);
    for (const int uniform : {target_.torque.fraction, 20, 24}) {
      for (const bool first : {false, true}) {
        if (first && law_.states.empty()) continue;
        Choice c;
        c.uniform = uniform;
        c.states_first = first;
        try_choice(best, c);
      }
    }
    best.choice.uniform = 0;
    for (int round = 0; round < 4; ++round) {
      const double before = best.cost;
      singles(best);
      if (best.cost > before - 0.01) break;
    }
    *tried = tried_;
    return best;
  }

 private:
  /// Keeps the choice if it costs less. The costs only fall, so a choice that came before cannot
  /// win.
  void try_choice(Candidate& best, const Choice& choice) {
    ++tried_;
    if (!seen_.insert({choice.uniform, choice.states_first, choice.sine_bits, choice.fraction})
             .second)
      return;
    Candidate c = evaluate(choice, best.cost);
    if (c.cost < best.cost - 1e-9) best = std::move(c);
  }

  /// Its cost; infinity where no program exists, or where the program alone costs more than
  /// `enough`.
  Candidate evaluate(const Choice& choice, double enough) {
    Candidate c;
    c.choice = choice;
    c.choice.stays = stays_;
    c.choice.made.swap(made_);
    c.choice.fractions.swap(fractions_);
    try {
      c.program = lower(law_, target_, spans_, c.choice);
      mark_primary(law_, c.program);
      if (least_cost(law_, target_, c.program, spans_) < enough) {
        c.cost =
            cost(law_, target_, c.program, bound(law_, target_, c.program, 0, &spans_), spans_);
      }
    } catch (const Unfit& e) {
      c.unfit = e;
    }
    made_.swap(c.choice.made);
    fractions_.swap(c.choice.fractions);
    return c;
  }

  void singles(Candidate& best) {
    std::vector<NodeId> nodes;
    for (const auto& [id, fraction] : best.choice.fraction) nodes.push_back(id);
    std::reverse(nodes.begin(), nodes.end());
    for (const NodeId id : nodes) {
      const auto now = best.choice.fraction.find(id);
      if (now == best.choice.fraction.end()) continue;
      const int from = now->second;
      const Op op = law_.nodes[static_cast<std::size_t>(id)].op;
      const bool table = op == Op::sine || op == Op::cosine || has_pieces(op) || op == Op::lookup;
      for (int by = 1; by <= (table ? 3 : 20); ++by) {
        for (const int to : {from - by, from + by}) {
          if (tried_ >= most_tried) return;
          Choice c = best.choice;
          c.fraction[id] = to;
          try_choice(best, c);
          const std::vector<NodeId> members = group(id, best.choice);
          if (members.size() < 2) continue;
          c = best.choice;
          for (const NodeId m : members) c.fraction[m] = to;
          try_choice(best, c);
        }
      }
    }
  }

  /// Values that are copied into each other without alignment: their formats change together.
  std::vector<NodeId> group(NodeId of, const Choice& choice) const {
    std::vector<NodeId> members{of};
    const auto add = [&](NodeId id) {
      if (id >= 0 && choice.fraction.count(id) != 0 &&
          std::find(members.begin(), members.end(), id) == members.end()) {
        members.push_back(id);
      }
    };
    for (std::size_t i = 0; i < members.size(); ++i) {
      const NodeId id = members[i];
      const Node& n = law_.nodes[static_cast<std::size_t>(id)];
      const bool passes = n.op == Op::select || n.op == Op::minimum || n.op == Op::maximum ||
                          n.op == Op::absolute || n.op == Op::add || n.op == Op::subtract;
      if (passes) {
        for (const NodeId a : n.arguments) add(a);
      }
      if (n.op == Op::state) add(law_.states[static_cast<std::size_t>(n.index)].next);
      for (const State& s : law_.states) {
        if (s.next != id) continue;
        for (const auto& [other, f] : choice.fraction) {
          const Node& o = law_.nodes[static_cast<std::size_t>(other)];
          if (o.op == Op::state && &law_.states[static_cast<std::size_t>(o.index)] == &s)
            add(other);
        }
      }
    }
    return members;
  }

  const Law& law_;
  const Target& target_;
  const std::vector<Span> spans_;
  const std::shared_ptr<const Stays> stays_;
  std::map<std::string, TableUse> made_;
  std::map<std::string, int> fractions_;
  std::set<std::tuple<int, bool, int, std::map<NodeId, int>>> seen_;
  int tried_ = 1;
};

}  // namespace

namespace {

/// The cost of a comparison that decides little: its strip is a quarter of the compared range, or
/// of one step of a rounded-down whole number; or all values on one side of the other operand are
/// within it. 0 for any other one.
double idle_cost(const Law& law, const std::vector<Span>& spans, const Step& s, double margin) {
  const Node& condition = law.nodes[static_cast<std::size_t>(s.condition)];
  const double width = margin * std::fabs(s.margin_scale != 0 ? s.margin_scale : s.scale);
  double most = 0.25;  // a wider strip is idle
  if (condition.op == Op::less) {
    const Span x = spans[static_cast<std::size_t>(condition.arguments[0])];
    const Span y = spans[static_cast<std::size_t>(condition.arguments[1])];
    most *= std::max(x.size(), y.size());
    const double below = y.hi - x.lo, above = x.hi - y.lo;  // the farthest values on each side
    if (below > 0 && above > 0) most = std::min({most, below, above});
  }
  return width > most ? 20 + std::log2(width / most) : 0;
}

}  // namespace

bool is_dead(const Law& law, const Target& target, const Step& s, const Span& words,
             const std::vector<Span>& spans) {
  if (words.lo != words.hi) return false;
  const double lsb = std::ldexp(1.0, -target.torque.fraction);
  return std::any_of(law.outputs.begin(), law.outputs.end(), [&](const Output& o) {
    return o.axis == s.output && spans[static_cast<std::size_t>(o.value)].width() > 2 * lsb;
  });
}

double cost(const Law& law, const Target& target, const Program& program, const Bound& b,
            const std::vector<Span>& spans) {
  const double lsb = std::ldexp(1.0, -target.torque.fraction);
  double error = 0;
  for (const double e : b.output) error = std::max(error, e / lsb);
  // The strip of a comparison counts half as much as an error of the compared value.
  double strips = 0;
  for (std::size_t i = 0; i < program.steps.size(); ++i) {
    const Step& s = program.steps[i];
    if (b.margins[i] <= 0) continue;
    double size = 1;
    for (const Operand& o : {s.x, s.op == EngineOp::abs ? s.x : s.y}) {
      if (o.from == From::step)
        size = std::max(size, b.words[static_cast<std::size_t>(o.index)].size());
    }
    strips += 0.5 * std::max(0.0, std::log2(b.margins[i] / size * 65536));
    if (s.condition >= 0) strips += idle_cost(law, spans, s, b.margins[i]);
  }
  double drifts = 0;
  // A state whose error does not reach the outputs counts relative to its own range.
  for (std::size_t i = 0; i < law.states.size(); ++i) {
    const Range& r = law.states[i].range;
    const double size = std::max(r.upper - r.lower, 1e-12);
    const double e = b.states_bounded ? b.state[i] : program.states[i].scale;
    error = std::max(error, e / size * 65536);
    if (b.states_bounded || law.states[i].phase) continue;
    if (law.rate_hz > 0) {
      // An unbounded error counts with its growth in a tenth of a second.
      drifts += std::max(0.0, std::log2(b.drift[i] * 0.1 * law.rate_hz / size * 65536));
    } else if (!law.states[i].whole) {
      // The bound of one run does not show the rounding loss of this state: its bits count instead.
      drifts += std::max(0.0, std::log2(program.states[i].scale / size * 262144));
    }
  }
  double dead = 0;
  for (std::size_t i = 0; i < program.steps.size(); ++i) {
    if (program.steps[i].output >= 0 && is_dead(law, target, program.steps[i], b.words[i], spans)) {
      dead += kOneValue;
    }
  }
  double c = least_cost(law, target, program, spans) + dead +
             std::log2(std::max(error, least_error) / least_error);
  c += strips + drifts + 1e4 * static_cast<double>(b.unproven.size());
  // What no cell reaches has no error, and looks cheap.
  c += (b.states_bounded ? 0 : 1000) + (b.reachable ? 0 : 1e7);
  return c;
}

namespace {

bool divides_one(double scale) {
  const double words = 1 / std::fabs(scale);
  return words > 0.5 && std::fabs(words - std::nearbyint(words)) <= 1e-12 * words;
}

}  // namespace

void mark_primary(const Law& law, Program& program) {
  for (std::size_t i = 0; i < program.words.size(); ++i) {
    Word& w = program.words[i];
    if (w.nodes.size() != 1) continue;
    const Node& n = law.nodes[static_cast<std::size_t>(w.nodes[0])];
    if (n.op != Op::parameter || law.parameters[static_cast<std::size_t>(n.index)].derived >= 0) {
      continue;
    }
    // The primary word of a whole parameter must hold the value as a whole number.
    const bool whole = law.parameters[static_cast<std::size_t>(n.index)].whole;
    if (whole && !divides_one(w.scale)) continue;
    bool finest = true;
    for (std::size_t k = 0; k < program.words.size(); ++k) {
      const Word& o = program.words[k];
      if (k == i || o.nodes != w.nodes || (whole && !divides_one(o.scale))) continue;
      const double mine = std::fabs(w.scale), other = std::fabs(o.scale);
      if (other < mine || (other == mine && k < i)) finest = false;
    }
    w.primary = finest;
  }
  for (Word& w : program.words) {
    w.exact = w.primary ? 1 : 0;
    for (const Word& p : program.words) {
      const double ratio = p.scale / w.scale;
      if (p.primary && p.nodes == w.nodes && std::fabs(ratio - std::nearbyint(ratio)) < 1e-9 &&
          std::fabs(ratio) > 0.5) {
        w.exact = std::nearbyint(ratio);
      }
    }
  }
}

namespace {

std::string unit_text(const Unit& unit) { return unit == kNumber ? "" : " " + text_of(unit); }

std::string range_text(const Span& s, const Unit& unit) {
  return fmt::format("{:.6g} .. {:.6g}", s.lo, s.hi) + unit_text(unit);
}

/// Refuses a value that far exceeds the range of the line or state that it goes to.
void refuse_kept(const Law& law, const Target& target, const Span& can, NodeId node) {
  const auto leave = [&](std::size_t index, bool is_line, const Range& range) {
    if (can.within({range.lower, range.upper})) return;
    throw leaves_its_range(law, target, static_cast<int>(index), is_line,
                           fmt::format("{:.6g} .. {:.6g}", can.lo, can.hi));
  };
  for (std::size_t i = 0; i < law.lines.size(); ++i) {
    if (law.lines[i].written == node) leave(i, true, law.lines[i].range);
  }
  for (std::size_t i = 0; i < law.states.size(); ++i) {
    const State& s = law.states[i];
    if (s.next == node && !s.phase) leave(i, false, s.range);
  }
}

[[noreturn]] void refuse(const Law& law, const Target& target, const std::vector<Span>& spans,
                         const Unfit& why) {
  const std::string narrow = "narrow the ranges of parameters and states";
  if (why.node < 0) {
    throw Refused(std::string("no formats were found that fit: ") + why.what(),
                  narrow + ", or limit values with clamp");
  }
  const Node& n = law.nodes[static_cast<std::size_t>(why.node)];
  const Span can = spans[static_cast<std::size_t>(why.node)];
  refuse_kept(law, target, can, why.node);
  const double end = 2147483648.0 * why.scale;
  std::string reason = why.what();
  // The value that does not fit may be an intermediate one, of another size than the node's.
  if (why.scale > 0 && can.size() > end * (1 - 1.0 / 256)) {
    reason = fmt::format("a word with the step {:.3g} holds {}", why.scale,
                         range_text({-end, end}, n.unit));
  }
  if (n.op == Op::constant) {
    throw Refused(n.place,
                  fmt::format("{:.6g}{} does not fit: {}", n.value, unit_text(n.unit), reason),
                  "write a smaller number");
  }
  // A long formula is named only by its place.
  const std::string own = formula(law, why.node);
  throw Refused(n.place,
                fmt::format("{} goes over {} and does not fit: {}",
                            own.find("...") == std::string::npos ? own : "this value",
                            range_text(can, n.unit), reason),
                "limit it with clamp, or " + narrow);
}

}  // namespace

Program choose_formats(const Law& law, const Target& target, const std::vector<Span>& spans,
                       int* tried) {
  Candidate best = Search(law, target, spans).run(tried);
  if (best.cost == infinity) refuse(law, target, spans, best.unfit);
  return std::move(best.program);
}

}  // namespace feltgate::law
