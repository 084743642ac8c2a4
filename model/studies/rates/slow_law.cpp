// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Documentation: docs/speed-for-accuracy.md
#include "studies/rates/slow_law.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "law/diagnostics.hpp"
#include "law/read_law.hpp"

namespace feltgate::rates {

namespace {

using law::Law;
using law::NodeId;
using law::Op;

constexpr int largest_divider = 4095;  // of the engine

/// Appends nodes to a law.
class Builder {
 public:
  Builder(Law& law, law::Place place) : law_(law), place_(place) {}
  NodeId constant(double value, law::Unit unit = {}) {
    law::Node n = node(Op::constant, {}, unit);
    n.value = value;
    return add(n);
  }
  NodeId state(std::size_t index) {
    law::Node n = node(Op::state, {}, law_.states[index].unit);
    n.index = static_cast<int>(index);
    return add(n);
  }
  NodeId two(Op op, NodeId a, NodeId b) {
    law::Node n = node(op, {a, b}, unit(a));
    n.truth = op == Op::less || op == Op::both;
    if (n.truth) n.unit = {};
    return add(n);
  }
  NodeId select(NodeId condition, NodeId a, NodeId b) {
    return add(node(Op::select, {condition, a, b}, unit(a)));
  }

 private:
  law::Unit unit(NodeId id) const { return law_.nodes[static_cast<std::size_t>(id)].unit; }
  law::Node node(Op op, std::vector<NodeId> arguments, law::Unit unit) const {
    law::Node n;
    n.op = op;
    n.arguments = std::move(arguments);
    n.unit = unit;
    n.place = place_;
    return n;
  }
  NodeId add(const law::Node& n) {
    law_.nodes.push_back(n);
    return static_cast<NodeId>(law_.nodes.size() - 1);
  }

  Law& law_;
  law::Place place_;
};

std::size_t new_state(Law& law, const std::string& name, law::Unit unit, law::Range range,
                      law::Place place) {
  law::State s;
  s.name = name;
  s.unit = unit;
  s.range = range;
  s.place = place;
  law.states.push_back(s);
  return law.states.size() - 1;
}

}  // namespace

Law read(const LawSource& source, double rate_hz) {
  return source.text.empty() ? law::read_law(source.path, rate_hz)
                             : law::read_law_text(source.text, source.path, rate_hz);
}

bool keeps_time(const LawSource& source) {
  // dt is folded into constants.
  const Law a = read(source, 1e6), b = read(source, 1.024e6);
  const auto same = [](const law::Node& x, const law::Node& y) {
    return x.op == y.op && x.value == y.value && x.arguments == y.arguments;
  };
  return a.nodes.size() != b.nodes.size() ||
         !std::equal(a.nodes.begin(), a.nodes.end(), b.nodes.begin(), same);
}

law::Compiled fastest(const LawSource& source, const law::Target& target) {
  return source.text.empty() ? law::compile_file(source.path, target)
                             : law::compile_text(source.text, source.path, target);
}

Law held(Law law, int runs, const law::Target& target) {
  if (runs <= 1) return law;
  const std::size_t own_states = law.states.size();
  const law::Place place = law.outputs.front().place;
  const std::size_t turn = new_state(law, "turn", {}, {0, runs - 1.0}, place);
  Builder b(law, place);
  const NodeId now = b.state(turn);
  const NodeId due = b.two(Op::less, now, b.constant(0.5));
  // The minimum is for the proof: a word may be coarse.
  const NodeId next = b.two(Op::minimum, b.two(Op::add, now, b.constant(1)), b.constant(runs - 1));
  law.states[turn].next =
      b.select(b.two(Op::less, now, b.constant(runs - 1.5)), next, b.constant(0));
  for (std::size_t i = 0; i < own_states; ++i) {
    law.states[i].next = b.select(due, law.states[i].next, b.state(i));
  }
  for (law::Event& e : law.events) e.condition = b.two(Op::both, due, e.condition);
  // What is held fits the format in which the torque leaves the engine.
  const double end = std::ldexp(1, target.torque.integer);
  const double most = end - std::ldexp(1, -target.torque.fraction);
  for (law::Output& o : law.outputs) {
    const law::Unit unit = law.nodes[static_cast<std::size_t>(o.value)].unit;
    const std::size_t kept =
        new_state(law, fmt::format("held{}", o.axis), unit, {-end, most}, place);
    const NodeId limited = b.two(Op::minimum, b.two(Op::maximum, o.value, b.constant(-end, unit)),
                                 b.constant(most, unit));
    o.value = b.select(due, limited, b.state(kept));
    law.states[kept].next = o.value;
  }
  return law;
}

Law scaled(Law law, double gain) {
  const double most_nm = 12 / gain;  // the product fits the torque's word
  Builder b(law, law.outputs.front().place);
  for (law::Output& o : law.outputs) {
    const law::Unit unit = law.nodes[static_cast<std::size_t>(o.value)].unit;
    const NodeId above = b.two(Op::maximum, o.value, b.constant(-most_nm, unit));
    const NodeId within = b.two(Op::minimum, above, b.constant(most_nm, unit));
    o.value = b.two(Op::multiply, within, b.constant(gain));
  }
  return law;
}

law::Compiled at_rate(const LawSource& source, const law::Target& target, int ticks) {
  const double tick_hz = static_cast<double>(target.tick_hz);
  int runs = (ticks + largest_divider - 1) / largest_divider;
  while (ticks % runs != 0) ++runs;
  Law law = read(source, tick_hz / ticks);
  if (!law.lines.empty()) {
    throw std::invalid_argument(
        fmt::format("{}:{}: line {} counts runs, so this is another law at another rate; measure "
                    "it at its own alone",
                    source.path, law.lines.front().place.line, law.lines.front().name));
  }
  law = held(std::move(law), runs, target);
  law.rate_hz = tick_hz / (ticks / runs);
  try {
    return law::compile(law, target);
  } catch (const law::Refused& r) {
    throw law::LawError(source.path, {{r.place, r.reason, r.mend}});
  }
}

}  // namespace feltgate::rates
