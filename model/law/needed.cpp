// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Which nodes a run needs, which the host computes, and which part of a value's range matters.
// Documentation: docs/laws.md
#include "law/derive.hpp"
#include "law/ranges.hpp"

namespace feltgate::law {

std::vector<NodeId> needed(const Law& law) {
  std::vector<char> wanted(law.nodes.size(), 0);
  std::vector<NodeId> stack;
  const auto want = [&](NodeId id) {
    if (id >= 0 && wanted[at(id)] == 0) {
      wanted[at(id)] = 1;
      stack.push_back(id);
    }
  };
  for (const Output& o : law.outputs) want(o.value);
  for (const Event& e : law.events) {
    want(e.value);
    want(e.condition);
  }
  for (const State& s : law.states) want(s.next);
  for (const Line& l : law.lines) want(l.written);
  while (!stack.empty()) {
    const NodeId id = stack.back();
    stack.pop_back();
    const Node& n = law.nodes[at(id)];
    for (const NodeId a : n.arguments) want(a);
    if (n.op == Op::parameter) want(law.parameters[at(n.index)].derived);
  }
  std::vector<NodeId> list;
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    if (wanted[i] != 0) list.push_back(static_cast<NodeId>(i));
  }
  return list;
}

std::vector<char> fixed_nodes(const Law& law) {
  std::vector<char> fixed(law.nodes.size(), 0);
  for (std::size_t i = 0; i < law.nodes.size(); ++i) {
    const Node& n = law.nodes[i];
    switch (n.op) {
      case Op::constant:
        fixed[i] = 1;
        break;
      case Op::parameter:
        fixed[i] = law.parameters[at(n.index)].mailbox ? 0 : 1;
        break;
      case Op::input:
      case Op::state:
      case Op::line_read:
        break;
      default:
        fixed[i] = 1;
        for (const NodeId a : n.arguments) fixed[i] = static_cast<char>(fixed[i] & fixed[at(a)]);
    }
  }
  return fixed;
}

namespace {

/// Passes the interval of each node on to its arguments.
class Interest {
 public:
  Interest(const Law& law, const std::vector<Span>& spans)
      : law_(law), spans_(spans), of_(law.nodes.size(), Span{infinity, -infinity}) {
    each_root(law, [this](NodeId id) { want(id, whole_line()); });
    const std::vector<NodeId> order = needed(law);
    for (auto id = order.rbegin(); id != order.rend(); ++id) {
      pass_on(law.nodes[at(*id)], of_[at(*id)]);
    }
  }

  std::vector<Span> take() { return std::move(of_); }

 private:
  /// Widens the interval of `id` by `keep`, or by the end of its range that lies nearer to `keep`:
  /// two operands that are clamped at once stay right then.
  void want(NodeId id, const Span& keep) {
    if (id < 0) return;
    const Span& x = spans_[at(id)];
    const bool known = keep.lo <= keep.hi;  // not where ranges without ends were subtracted
    const Span part = known ? Span{std::min(keep.lo, x.hi), std::max(keep.hi, x.lo)} : whole_line();
    of_[at(id)] = hull(of_[at(id)], part);
  }

  void pass_on(const Node& n, const Span& keep) {
    const auto span = [&](std::size_t i) { return spans_[at(n.arguments[i])]; };
    const auto want_argument = [&](std::size_t i, const Span& s) { want(n.arguments[i], s); };
    switch (n.op) {
      case Op::add:
        for (const std::size_t i : {0U, 1U}) {
          want_argument(i, {keep.lo - span(1 - i).hi, keep.hi - span(1 - i).lo});
        }
        return;
      case Op::subtract:
        want_argument(0, {keep.lo + span(1).lo, keep.hi + span(1).hi});
        want_argument(1, {span(0).lo - keep.hi, span(0).hi - keep.lo});
        return;
      case Op::negate:
        return want_argument(0, {-keep.hi, -keep.lo});
      case Op::absolute:
        return want_argument(0, {-std::max(keep.hi, 0.0), std::max(keep.hi, 0.0)});
      case Op::minimum:
        for (const std::size_t i : {0U, 1U}) {
          want_argument(i, {keep.lo, std::max(keep.lo, std::min(keep.hi, span(1 - i).hi))});
        }
        return;
      case Op::maximum:
        for (const std::size_t i : {0U, 1U}) {
          want_argument(i, {std::min(keep.hi, std::max(keep.lo, span(1 - i).lo)), keep.hi});
        }
        return;
      case Op::multiply:
        for (const std::size_t i : {0U, 1U}) {
          const Node& factor = law_.nodes[at(n.arguments[1 - i])];
          const bool known = factor.op == Op::constant && factor.value > 0;
          want_argument(
              i, known ? Span{keep.lo / factor.value, keep.hi / factor.value} : whole_line());
        }
        return;
      case Op::less:
        for (const std::size_t i : {0U, 1U}) {
          const double beside = room_beside(span(i), span(1 - i));
          want_argument(i, {span(1 - i).lo - beside, span(1 - i).hi + beside});
        }
        return;
      case Op::select:
        want_argument(1, keep);
        want_argument(2, keep);
        return;
      default:
        for (std::size_t i = 0; i < n.arguments.size(); ++i) want_argument(i, whole_line());
        if (n.op == Op::parameter) want(law_.parameters[at(n.index)].derived, whole_line());
    }
  }

  const Law& law_;
  const std::vector<Span>& spans_;
  std::vector<Span> of_;
};

}  // namespace

double room_beside(const Span& own, const Span& other) {
  return std::max(own.size() / 1024, other.size() / 8);
}

std::vector<Span> interest(const Law& law, const std::vector<Span>& spans) {
  return Interest(law, spans).take();
}

}  // namespace feltgate::law
