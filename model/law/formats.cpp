// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The search for formats: one value's fraction bits at a time, as long as that helps.
// Documentation: docs/law-compiler.md
#include <algorithm>
#include <cmath>

#include "law/compile.hpp"

namespace feltgate::law {

namespace {

constexpr int most_tried = 1500;

struct Candidate {
  Choice choice;
  Program program;
  double cost = infinity;
  std::string reason;
  std::vector<Unproven> unproven;
};

class Search {
 public:
  Search(const Law& law, const Target& target, const std::vector<Span>& spans)
      : law_(law), target_(target), spans_(spans) {}

  Candidate run(int* tried) {
    Candidate best = evaluate({});
    Choice other;
    other.states_first = true;
    if (!law_.states.empty()) keep(best, evaluate(other));
    for (int round = 0; round < 4; ++round) {
      const double before = best.cost;
      singles(best);
      if (best.cost > before - 0.01) break;
    }
    *tried = tried_;
    return best;
  }

 private:
  Candidate evaluate(const Choice& choice) {
    ++tried_;
    Candidate c;
    c.choice = choice;
    c.choice.made = made_;
    try {
      c.program = lower(law_, target_, spans_, c.choice);
      mark_primary(law_, c.program);
      const Bound b = bound(law_, target_, c.program, 0);
      c.cost = cost(law_, target_, c.program, b);
      c.unproven = b.unproven;
    } catch (const Unfit& e) {
      c.reason = e.what();
    }
    made_ = std::move(c.choice.made);
    c.choice.made.clear();
    return c;
  }

  static bool keep(Candidate& best, Candidate&& c) {
    if (!(c.cost < best.cost - 1e-9)) return false;
    best = std::move(c);
    return true;
  }

  void singles(Candidate& best) {
    std::vector<NodeId> nodes;
    for (const auto& [id, fraction] : best.choice.fraction) nodes.push_back(id);
    std::reverse(nodes.begin(), nodes.end());
    for (const NodeId id : nodes) {
      const auto now = best.choice.fraction.find(id);
      if (now == best.choice.fraction.end()) continue;
      const int from = now->second;
      for (int by = 1; by <= 20; ++by) {
        for (const int to : {from - by, from + by}) {
          if (tried_ >= most_tried) return;
          Choice c = best.choice;
          c.fraction[id] = to;
          keep(best, evaluate(c));
        }
      }
    }
  }

  const Law& law_;
  const Target& target_;
  const std::vector<Span>& spans_;
  std::map<std::string, TableUse> made_;
  int tried_ = 0;
};

}  // namespace

double cost(const Law& law, const Target& target, const Program& program, const Bound& b) {
  const double lsb = std::ldexp(1.0, -target.torque.fraction);
  double error = 0;
  for (const double e : b.output) error = std::max(error, e / lsb);
  // A state whose error the outputs do not show counts in its own range.
  for (std::size_t i = 0; i < law.states.size(); ++i) {
    const Range& r = law.states[i].range;
    const double size = std::max(r.upper - r.lower, 1e-12);
    const double e = b.states_bounded ? b.state[i] : program.states[i].scale;
    error = std::max(error, e / size * 65536);
  }
  double c = static_cast<double>(program.steps.size()) +
             0.02 * static_cast<double>(program.words.size()) + std::log2(std::max(error, 0.4));
  c += 1e4 * static_cast<double>(b.unproven.size());
  c += b.states_bounded ? 0 : 3;
  return c;
}

void mark_primary(const Law& law, Program& program) {
  for (std::size_t i = 0; i < program.words.size(); ++i) {
    Word& w = program.words[i];
    if (w.nodes.size() != 1) continue;
    const Node& n = law.nodes[static_cast<std::size_t>(w.nodes[0])];
    if (n.op != Op::parameter || law.parameters[static_cast<std::size_t>(n.index)].derived >= 0) {
      continue;
    }
    bool finest = true;
    for (std::size_t k = 0; k < program.words.size(); ++k) {
      const Word& o = program.words[k];
      if (k == i || o.nodes != w.nodes) continue;
      const double mine = std::fabs(w.scale), other = std::fabs(o.scale);
      if (other < mine || (other == mine && k < i)) finest = false;
    }
    w.primary = finest;
  }
}

Program choose_formats(const Law& law, const Target& target, const std::vector<Span>& spans,
                       int* tried) {
  Candidate best = Search(law, target, spans).run(tried);
  if (best.cost == infinity) {
    throw Refused("no formats were found that fit: " + best.reason,
                  "narrow the ranges of parameters and states, or limit values with clamp");
  }
  return std::move(best.program);
}

}  // namespace feltgate::law
