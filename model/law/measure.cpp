// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Documentation: docs/laws.md
#include "law/measure.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "feltgate/largest.hpp"
#include "feltgate/random.hpp"
#include "law/engine/machine.hpp"
#include "law/evaluate.hpp"
#include "law/image.hpp"
#include "law/load.hpp"

namespace feltgate::law {

namespace {

class Meter {
 public:
  /// `bound`: of the outputs, for the parameters of the runs.
  Meter(const Compiled& c, const std::vector<double>& bound)
      : c_(c), bound_(bound), law_(c.law), machine_(memory(c.image)) {
    result_.output.assign(c.law.outputs.size(), 0);
    result_.reached.assign(c.law.outputs.size(), {infinity, -infinity});
    result_.move.assign(c.law.states.size(), 0);
    for (const int step : c.assembled.step_of) {
      strips_.push_back(nullptr);
      for (const Strip& s : c.bound.strips) {
        if (s.step == step && s.condition >= 0) strips_.back() = &s;
      }
    }
    for (const Strip& s : c.bound.strips) {
      const bool compares = s.condition >= 0 && c.law.nodes[at(s.condition)].op == Op::less;
      if (!compares || side_of_.count(s.condition) > 0) continue;
      side_of_[s.condition] = result_.sides.size();
      result_.sides.push_back({s.place});
    }
    set([](const ImageWord& w) { return static_cast<double>(w.initial); });
  }

  /// Sets each parameter in both to the word from `choose`; keeps the old words if the law's
  /// requirements exclude the new ones.
  template <class Choose>
  void set(const Choose& choose) {
    std::vector<double> values;
    std::map<std::string, double> named;
    for (const ImageWord& w : c_.image.words) {
      if (!w.formula.empty()) continue;
      const double value = choose(w) * w.scale;
      values.push_back(w.whole ? std::nearbyint(value) : value);
      named[w.name] = values.back();
    }
    const auto value_of = [&named](const std::string& name) { return named.at(name); };
    if (!broken_requirement(c_.image, value_of).empty()) return;
    const std::vector<std::int32_t> words = parameter_words(c_.image, values);
    for (int bank = 0; bank < 2; ++bank) {
      for (int i = 0; i < 32; ++i) machine_.set_parameter(i, words[at(i)]);
      machine_.commit();
    }
    for (const ImageWord& w : c_.image.words) {
      for (std::size_t p = 0; w.formula.empty() && p < c_.law.parameters.size(); ++p) {
        if (c_.law.parameters[p].name == w.name) {
          law_.set_parameter(p, words[at(w.word)] * w.scale);
        }
      }
    }
  }

  void restart() {
    machine_.enter();
    for (int i = c_.image.line_base; i < EngineMap::table_words; ++i) {
      machine_.memory().set_table(i, 0);
    }
    law_.reset();
    started_ = false;
  }

  /// Sets `time` of both to the number of runs that `choose` makes of its largest one.
  template <class Choose>
  void set_time(const Choose& choose) {
    for (std::size_t k = 0; k < c_.law.states.size() && started_; ++k) {
      const State& s = c_.law.states[k];
      if (!s.counts_runs || c_.program.states[k].next.from == From::none) continue;
      const std::int64_t runs = choose(static_cast<std::int64_t>(s.range.upper));
      machine_.memory().set_data(state_address(k), static_cast<std::int32_t>(runs));
      law_.set_state(k, static_cast<double>(runs));
    }
  }

  /// Executes one run of both; `word` gives an input's word.
  template <class Word>
  void run(const Word& word, bool free_running) {
    MachineInputs inputs{};
    std::vector<double> values;
    for (const Input& input : c_.law.inputs) {
      const std::int32_t w = word(input);
      inputs[at(EngineMap::input_axis_words * input.axis + static_cast<int>(input.source))] = w;
      values.push_back(w * scale(input));
    }
    const bool from_words = started_ && !free_running;
    std::vector<double> own, before;
    for (std::size_t k = 0; k < c_.law.states.size(); ++k) {
      const double word = state_word(k) * c_.program.states[k].scale, left = law_.state(k);
      before.push_back(from_words ? word : left);
      own.push_back(std::fabs(left - word) <= c_.program.states[k].scale / 2 ? left : word);
    }
    if (from_words) {
      read_lines();
      begin(before);
    }
    law_.run(values);
    std::vector<Decided> decided;
    const MachineRun& run = machine_.run_seen(
        c_.target.thread, inputs, 100000, [&](int address, std::int32_t x, std::int32_t y) {
          const Strip* s = strips_[at(address - c_.target.thread * EngineMap::thread_words)];
          if (s != nullptr) decided.push_back({s, x, y});
        });
    std::vector<const Strip*> crossed = crossings(decided);
    // A state that stays at an end has a word whose step need not divide the end.
    bool rounded = false;
    if (from_words && !crossed.empty()) {
      begin(own);
      law_.run(values);
      rounded = crossings(decided).empty();
      if (rounded) crossed.clear();
    }
    if (from_words && !crossed.empty()) {
      begin(before);
      law_.run(values);
    }
    started_ = true;
    for (std::size_t k = 0; k < before.size(); ++k) {
      const State& s = c_.law.states[k];
      double move = std::fabs(law_.state(k) - before[k]);
      if (s.phase) move = std::min(move, std::fabs(s.range.upper - s.range.lower - move));
      result_.move[k] = larger(result_.move[k], move);
    }
    for (std::size_t o = 0; o < result_.reached.size(); ++o) {
      Span& reached = result_.reached[o];
      reached = {smaller(reached.lo, law_.outputs()[o]), larger(reached.hi, law_.outputs()[o])};
    }
    for (const auto& [condition, side] : side_of_) {
      Sides& of = result_.sides[side];
      ++(law_.value(condition) > 0 ? of.holds : of.fails);
    }
    const bool otherwise = std::any_of(crossed.begin(), crossed.end(),
                                       [&](const Strip* s) { return free_running || shows(*s); });
    ++result_.runs;
    if (!crossed.empty() && !otherwise) ++result_.kept_otherwise;
    if (otherwise) ++result_.in_strips;
    std::vector<double> off;
    for (std::size_t o = 0; o < result_.output.size(); ++o) {
      const double torque =
          run.outputs[at(c_.law.outputs[o].axis)] * std::ldexp(1.0, -c_.target.torque.fraction);
      off.push_back(std::fabs(torque - law_.outputs()[o]));
      if (!otherwise && !rounded) result_.output[o] = larger(result_.output[o], off.back());
    }
    if (crossed.empty() || (!outside(off, bound_) && !kept_outside())) return;
    std::set<NodeId> conditions;
    for (const Strip* s : crossed) conditions.insert(s->condition);
    for (const NodeId condition : conditions) {
      const auto side = side_of_.find(condition);
      if (side != side_of_.end()) ++result_.sides[side->second].outside;
    }
  }

  Measured result() const { return result_; }

 private:
  int state_address(std::size_t k) const {
    return c_.target.thread * EngineMap::private_words + c_.assembled.state_address[k];
  }
  std::int32_t state_word(std::size_t k) const {
    return machine_.memory().data_at(state_address(k));
  }
  static bool outside(const std::vector<double>& off, const std::vector<double>& bound) {
    for (std::size_t i = 0; i < off.size(); ++i) {
      if (!(off[i] <= bound[i] * (1 + 1e-9) + 1e-9)) return true;
    }
    return false;
  }
  /// Whether the run may have left something that is not the law's. What it left in a line, and
  /// whether an event happened, are not compared.
  bool kept_outside() const {
    if (!c_.law.lines.empty() || !c_.law.events.empty()) return true;
    std::vector<double> off;
    for (std::size_t k = 0; k < c_.law.states.size(); ++k) {
      const State& s = c_.law.states[k];
      double apart = std::fabs(state_word(k) * c_.program.states[k].scale - law_.state(k));
      if (s.phase) apart = std::min(apart, std::fabs(s.range.upper - s.range.lower - apart));
      off.push_back(apart);
    }
    return outside(off, c_.bound.states_bounded ? c_.bound.state : c_.bound.drift);
  }
  void read_lines() {
    lines_.clear();
    for (std::size_t i = 0; i < c_.law.lines.size(); ++i) {
      const LineUse& use = c_.program.lines[i];
      const int length = c_.law.lines[i].length, base = c_.program.tables[at(use.table)].base,
                next = state_word(at(use.pointer)) / 4096;
      std::vector<double> line;
      for (int ago = 1; ago <= length; ++ago) {
        const int word = base + (next + length - ago) % length;
        line.push_back(static_cast<std::int32_t>(machine_.memory().table_at(word)) * use.scale);
      }
      lines_.push_back(line);
    }
  }
  /// Sets what the law finds in its states, and in its lines what read_lines() found.
  void begin(const std::vector<double>& states) {
    for (std::size_t k = 0; k < states.size(); ++k) law_.set_state(k, states[k]);
    for (std::size_t i = 0; i < lines_.size(); ++i) {
      for (std::size_t ago = 1; ago <= lines_[i].size(); ++ago) {
        law_.set_line(i, ago, lines_[i][ago - 1]);
      }
    }
  }
  double scale(const Input& input) const {
    return input.source == Source::position   ? c_.target.count_rad()
           : input.source == Source::velocity ? std::ldexp(1.0, -c_.target.velocity.fraction)
                                              : std::ldexp(1.0, -c_.target.torque.fraction);
  }

  /// Whether the strip affects an output of this run. An effect that shows only in the next run
  /// does not matter if that run starts from the states of the words.
  static bool shows(const Strip& s) {
    return std::any_of(s.jump.begin(), s.jump.end(), [](double j) { return j > 0; });
  }
  /// An instruction that decides, with its operands.
  struct Decided {
    const Strip* strip;
    std::int32_t x, y;
  };
  /// The strips in which the law's last run decided differently.
  std::vector<const Strip*> crossings(const std::vector<Decided>& decided) const {
    std::vector<const Strip*> list;
    for (const Decided& d : decided) {
      if (crossed(*d.strip, d.x, d.y)) list.push_back(d.strip);
    }
    return list;
  }
  /// Whether the law, within the strip, decides differently from an instruction with these
  /// operands.
  bool crossed(const Strip& s, std::int32_t x, std::int32_t y) const {
    const Node& n = c_.law.nodes[at(s.condition)];
    const double width = s.width * (1 + 1e-9);
    if (s.floors >= 0) {
      const double a = law_.value(s.floors);
      double index = std::floor(a);
      if (n.op == Op::element) {
        const double most = static_cast<double>(c_.law.arrays[at(n.index)].values.size()) - 1;
        index = std::clamp(index, 0.0, most);
      }
      return std::fabs(a - std::nearbyint(a)) <= width && std::floor(x / 4096.0) != index;
    }
    if (n.op != Op::less) return false;
    const double a = law_.value(n.arguments[0]), b = law_.value(n.arguments[1]);
    const bool turns = c_.program.steps[at(s.step)].op == EngineOp::abs;
    return std::fabs(a - b) <= width && (x < (turns ? 0 : y)) != (a < b);
  }

  const Compiled& c_;
  const std::vector<double>& bound_;
  Evaluation<double> law_;
  Machine machine_;
  std::vector<const Strip*> strips_;        ///< of each instruction
  std::map<NodeId, std::size_t> side_of_;   ///< Measured::sides of each comparison with a strip
  std::vector<std::vector<double>> lines_;  ///< what the words keep in them before a run
  Measured result_;
  bool started_ = false;
};

std::int64_t low_of(const Input& input, const Target& t) {
  if (input.source == Source::position) return -static_cast<std::int64_t>(Target::position_counts);
  const Format f = input.source == Source::velocity ? t.velocity : t.torque;
  return -(std::int64_t{1} << (f.integer + f.fraction));
}

}  // namespace

Measured measure(const Compiled& c, std::uint64_t seed, std::int64_t runs, bool free_running) {
  Meter meter(c, c.bound.output);
  SplitMix64 random(seed);
  const auto below = [&random](std::int64_t n) { return random.below(n); };
  for (std::int64_t i = 0; i < runs; ++i) {
    if (i % 1000 == 0 && free_running) meter.restart();
    if (i % 50 == 0 && i > 0 && (!free_running || i % 1000 == 0)) {
      meter.set([&](const ImageWord& w) {
        const std::int64_t width = std::int64_t{w.upper} - w.lower;
        const std::int64_t corner = below(4);
        return static_cast<double>(corner == 0   ? w.lower
                                   : corner == 1 ? w.upper
                                                 : w.lower + below(width + 1));
      });
    }
    // A run at any time, early and late.
    if (!free_running) {
      meter.set_time([&](std::int64_t end) { return below((end >> below(31)) + 1); });
    }
    meter.run(
        [&](const Input& input) {
          const std::int64_t low = low_of(input, c.target);
          const std::int64_t spread = -low >> below(20);
          const std::int64_t high = input.source == Source::position ? -low : -low - 1;
          const std::int64_t any = below(2 * spread + 1) - spread;
          const std::int64_t corner = below(32);
          return static_cast<std::int32_t>(corner == 0   ? low
                                           : corner == 1 ? high
                                                         : std::clamp(any, low, high));
        },
        free_running);
  }
  return meter.result();
}

Measured measure_all(const Compiled& c) {
  const bool one = c.law.inputs.size() == 1 && c.law.inputs[0].source == Source::position;
  if (!one || !c.program.states.empty() || !c.law.lines.empty()) return {};
  Meter meter(c, c.bound.as_set);
  const auto end = static_cast<std::int32_t>(Target::position_counts);
  for (std::int32_t position = -end; position <= end; ++position) {
    meter.run([position](const Input&) { return position; }, true);
  }
  Measured m = meter.result();
  m.all_inputs = true;
  return m;
}

}  // namespace feltgate::law
