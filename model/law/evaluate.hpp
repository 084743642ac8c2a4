// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Runs a law in real numbers: double, long double or Quad. Only the number type rounds; no value is
// limited. Documentation: docs/laws.md
#pragma once

#include <cstddef>
#include <vector>

#include "feltgate/real_functions.hpp"
#include "law/law.hpp"

namespace feltgate::law {

/// How a table is evaluated. exact: by its formula; an argument outside the domain is clamped to
/// its end, or shifted by whole periods for a periodic table. sampled: as the engine does, linear
/// between samples. A table without a number of segments is always exact.
enum class Tables { exact, sampled };

template <class N>
class Evaluation {
 public:
  /// Parameters and states have their initial values. The law must outlive this.
  explicit Evaluation(const Law& law, Tables tables = Tables::exact);

  /// Restores the conditions after load, arming and entry: initial states, lines, and no event's
  /// condition has held before.
  void reset();
  /// Sets a parameter in SI; a value outside its range is allowed. Derived words follow.
  void set_parameter(std::size_t index, N si);
  N parameter(std::size_t index) const { return parameters_[index]; }

  /// Executes one run. `inputs` in SI, in the order of Law::inputs.
  void run(const std::vector<N>& inputs);

  /// Outputs of the last run in Nm, in the order of Law::outputs.
  const std::vector<N>& outputs() const { return outputs_; }
  /// Whether Law::events[index] happened in the last run: its condition has become true.
  bool happened(std::size_t index) const { return happened_[index]; }
  N event_value(std::size_t index) const { return event_values_[index]; }
  /// A state as the next run will find it, SI.
  N state(std::size_t index) const { return states_[index]; }
  void set_state(std::size_t index, N si) { states_[index] = si; }
  /// Sets the value that the next run reads from the line at index `runs_ago`, 1 to its length.
  void set_line(std::size_t line, std::size_t runs_ago, N si) {
    std::vector<N>& ring = lines_[line];
    ring[(line_at_[line] + ring.size() - runs_ago) % ring.size()] = si;
  }
  /// Value of any node in the last run, except nodes of a table's body. Truth values are 0 and 1.
  N value(NodeId id) const { return values_[at(id)]; }
  /// Value of a table at x, as runs see it.
  N table(std::size_t index, N x) const;
  /// Computes a node from the values of its arguments.
  N compute(const Node& n, const std::vector<N>& values) const;

 private:
  N number(double x) const { return static_cast<N>(x); }
  N exact(std::size_t table, N x) const;
  /// Interpolates linearly between equidistant samples, at a place within the domain.
  template <class Sample>
  N through(const std::vector<Sample>& samples, const Range& domain, N inside) const;
  N read_line(std::size_t line, N runs_ago) const;
  void find_bodies();
  void derive();
  void sample();
  /// Nodes that `roots` need, in the order of computation.
  std::vector<NodeId> needed_by(const std::vector<NodeId>& roots) const;

  const Law& law_;
  Tables tables_;
  std::vector<N> values_, parameters_, states_, outputs_, event_values_;
  mutable std::vector<N> body_;  ///< nodes of tables' bodies; no body has another's variable
  std::vector<char> happened_, held_;
  std::vector<std::vector<N>> lines_;  ///< rings, [position_ of the line] is written next
  std::vector<std::size_t> line_at_;
  std::vector<NodeId> order_, host_order_;
  std::vector<std::vector<NodeId>> bodies_;
  std::vector<std::vector<N>> samples_;
  const std::vector<N>* inputs_ = nullptr;
};

template <class N>
Evaluation<N>::Evaluation(const Law& law, Tables tables)
    : law_(law), tables_(tables), values_(law.nodes.size()), body_(law.nodes.size()) {
  for (const Parameter& p : law.parameters) parameters_.push_back(number(p.initial));
  outputs_.resize(law.outputs.size());
  event_values_.resize(law.events.size());
  happened_.resize(law.events.size());
  samples_.resize(law.tables.size());
  find_bodies();
  derive();
  sample();
  reset();
}

template <class N>
void Evaluation<N>::reset() {
  states_.clear();
  for (const State& s : law_.states) states_.push_back(number(s.initial));
  held_.assign(law_.events.size(), 0);
  lines_.clear();
  for (const Line& l : law_.lines) lines_.emplace_back(static_cast<std::size_t>(l.length), N{0});
  line_at_.assign(law_.lines.size(), 0);
}

template <class N>
std::vector<NodeId> Evaluation<N>::needed_by(const std::vector<NodeId>& roots) const {
  std::vector<char> needed(law_.nodes.size());
  for (const NodeId id : roots) {
    if (id >= 0) needed[at(id)] = 1;
  }
  std::vector<NodeId> order;
  for (std::size_t i = law_.nodes.size(); i-- > 0;) {
    if (needed[i] == 0) continue;
    for (const NodeId a : law_.nodes[i].arguments) needed[at(a)] = 1;
  }
  for (std::size_t i = 0; i < needed.size(); ++i) {
    if (needed[i] != 0) order.push_back(static_cast<NodeId>(i));
  }
  return order;
}

template <class N>
void Evaluation<N>::find_bodies() {
  std::vector<NodeId> roots, host;
  for (const State& s : law_.states) roots.push_back(s.next);
  for (const Line& l : law_.lines) roots.push_back(l.written);
  for (const Output& o : law_.outputs) roots.push_back(o.value);
  for (const Event& e : law_.events) {
    roots.push_back(e.value);
    roots.push_back(e.condition);
  }
  for (const Parameter& p : law_.parameters) host.push_back(p.derived);
  order_ = needed_by(roots);
  host_order_ = needed_by(host);
  for (const Table& t : law_.tables) bodies_.push_back(needed_by({t.body}));
}

template <class N>
void Evaluation<N>::set_parameter(std::size_t index, N si) {
  parameters_[index] = si;
  derive();
}

template <class N>
void Evaluation<N>::derive() {
  for (const NodeId id : host_order_) values_[at(id)] = compute(law_.nodes[at(id)], values_);
  for (std::size_t i = 0; i < parameters_.size(); ++i) {
    if (law_.parameters[i].derived >= 0) parameters_[i] = values_[at(law_.parameters[i].derived)];
  }
}

template <class N>
void Evaluation<N>::sample() {
  for (std::size_t t = 0; t < law_.tables.size(); ++t) {
    const Table& table = law_.tables[t];
    if (tables_ == Tables::exact) continue;
    const N width = number(table.domain.upper) - number(table.domain.lower);
    for (int i = 0; table.segments > 0 && i <= table.segments; ++i) {
      const N share = static_cast<N>(i) / static_cast<N>(table.segments);
      samples_[t].push_back(exact(t, number(table.domain.lower) + width * share));
    }
  }
}

template <class N>
N Evaluation<N>::exact(std::size_t table, N x) const {
  const Table& t = law_.tables[table];
  if (!t.points.empty()) return through(t.points, t.domain, x);
  for (const NodeId id : bodies_[table]) {
    body_[at(id)] = id == t.argument ? x : compute(law_.nodes[at(id)], body_);
  }
  return body_[at(t.body)];
}

template <class N>
N Evaluation<N>::table(std::size_t index, N x) const {
  const Range domain = law_.tables[index].domain;
  const N lower = number(domain.lower), upper = number(domain.upper);
  if (law_.tables[index].periodic) x -= (upper - lower) * floor_of((x - lower) / (upper - lower));
  const N inside = x < lower ? lower : x > upper ? upper : x;
  if (samples_[index].empty()) return exact(index, inside);
  return through(samples_[index], domain, inside);
}

template <class N>
template <class Sample>
N Evaluation<N>::through(const std::vector<Sample>& samples, const Range& domain, N inside) const {
  const N lower = number(domain.lower), upper = number(domain.upper);
  const auto segments = static_cast<N>(samples.size() - 1);
  const N place = (inside - lower) / (upper - lower) * segments;
  const N first = place < segments ? floor_of(place) : segments - 1;
  const auto i = static_cast<std::size_t>(static_cast<double>(first));
  const N from = static_cast<N>(samples[i]), to = static_cast<N>(samples[i + 1]);
  return from + (to - from) * (place - first);
}

template <class N>
N Evaluation<N>::read_line(std::size_t line, N runs_ago) const {
  const std::vector<N>& ring = lines_[line];
  const N length = static_cast<N>(ring.size());
  const N whole = floor_of(runs_ago);
  const N inside = whole < 1 ? N{1} : whole > length ? length : whole;
  const auto back = static_cast<std::size_t>(static_cast<double>(inside));
  return ring[(line_at_[line] + ring.size() - back) % ring.size()];
}

template <class N>
N Evaluation<N>::compute(const Node& n, const std::vector<N>& values) const {
  const auto index = static_cast<std::size_t>(n.index);
  const auto arg = [&](std::size_t i) { return values[at(n.arguments[i])]; };
  const auto truth = [](bool b) { return static_cast<N>(b ? 1 : 0); };
  switch (n.op) {
    case Op::constant:
      return number(n.value);
    case Op::parameter:
      return parameters_[index];
    case Op::input:
      return (*inputs_)[index];
    case Op::state:
      return states_[index];
    case Op::add:
      return arg(0) + arg(1);
    case Op::subtract:
      return arg(0) - arg(1);
    case Op::multiply:
      return arg(0) * arg(1);
    case Op::negate:
      return -arg(0);
    case Op::absolute:
      return arg(0) < 0 ? -arg(0) : arg(0);
    case Op::minimum:
      return arg(1) < arg(0) ? arg(1) : arg(0);
    case Op::maximum:
      return arg(0) < arg(1) ? arg(1) : arg(0);
    case Op::less:
      return truth(arg(0) < arg(1));
    case Op::both:
      return truth(arg(0) != 0 && arg(1) != 0);
    case Op::either:
      return truth(arg(0) != 0 || arg(1) != 0);
    case Op::opposite:
      return truth(arg(0) == 0);
    case Op::select:
      return arg(0) != 0 ? arg(1) : arg(2);
    case Op::sine:
      return sine_of(arg(0));
    case Op::cosine:
      return cosine_of(arg(0));
    case Op::root:
      return root_of(arg(0));
    case Op::reciprocal:
      return 1 / arg(0);
    case Op::exponential:
      return exponential_of(arg(0));
    case Op::logarithm:
      return logarithm_of(arg(0));
    case Op::arctangent:
      return arctangent_of(arg(0));
    case Op::lookup:
      return table(index, arg(0));
    case Op::line_read:
      return read_line(index, arg(0));
    case Op::element: {
      const std::vector<double>& from = law_.arrays[index].values;
      const N last = static_cast<N>(from.size() - 1), whole = floor_of(arg(0));
      const N inside = whole < 0 ? N{0} : whole > last ? last : whole;
      return number(from[static_cast<std::size_t>(static_cast<double>(inside))]);
    }
  }
  return 0;
}

template <class N>
void Evaluation<N>::run(const std::vector<N>& inputs) {
  inputs_ = &inputs;
  for (const NodeId id : order_) values_[at(id)] = compute(law_.nodes[at(id)], values_);
  inputs_ = nullptr;
  for (std::size_t i = 0; i < outputs_.size(); ++i) {
    outputs_[i] = values_[at(law_.outputs[i].value)];
  }
  for (std::size_t i = 0; i < happened_.size(); ++i) {
    const bool holds = values_[at(law_.events[i].condition)] != 0;
    happened_[i] = holds && held_[i] == 0 ? 1 : 0;
    held_[i] = holds ? 1 : 0;
    if (happened_[i] != 0) event_values_[i] = values_[at(law_.events[i].value)];
  }
  for (std::size_t i = 0; i < states_.size(); ++i) {
    const State& s = law_.states[i];
    N next = values_[at(s.next)];
    if (s.whole) next = floor_of(next);
    if (s.phase) {
      const N width = number(s.range.upper) - number(s.range.lower);
      next -= width * floor_of((next - number(s.range.lower)) / width);
    }
    states_[i] = next;
  }
  for (std::size_t i = 0; i < lines_.size(); ++i) {
    lines_[i][line_at_[i]] = values_[at(law_.lines[i].written)];
    line_at_[i] = (line_at_[i] + 1) % lines_[i].size();
  }
}

}  // namespace feltgate::law
