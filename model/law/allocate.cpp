// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Documentation: docs/laws.md
#include "law/allocate.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "law/ranges.hpp"

namespace feltgate::law {

namespace {

constexpr int registers = EngineMap::input_first;

class Assembly {
 public:
  Assembly(const Law& law, const Target& target, Program& program)
      : law_(law), target_(target), program_(program), steps_(program.steps) {}

  Assembled run() {
    place_tables();
    lives();
    start();
    body();
    copies();
    out_.instructions.back().last = true;
    out_.private_words = most_;
    const int base = target_.thread * EngineMap::thread_words;
    const auto length = static_cast<int>(out_.instructions.size());
    if (base + length > EngineMap::program_words) {
      throw Refused(fmt::format("the law needs {} instructions, {} fit", length,
                                EngineMap::program_words - base),
                    "make it smaller: shorter loops, fewer functions");
    }
    return out_;
  }

 private:
  void place_tables() {
    // A sine table that uses all words is placed first; the other tables follow in order.
    int next = 0, lines = EngineMap::table_words;
    for (TableUse& t : program_.tables) {
      const auto size = static_cast<int>(t.words.size());
      if (t.line >= 0) lines -= size;
      t.base = t.line >= 0 ? lines : next;
      if (t.line < 0) next += size;
    }
    out_.line_base = lines;
    next += EngineMap::table_words - lines;
    if (next > EngineMap::table_words) {
      throw Refused(
          fmt::format("tables need {} words, table memory has {}", next, EngineMap::table_words),
          "give tables fewer segments");
    }
  }

  bool reads_state(const Step& s, int state) const {
    const Operand o{From::state, state};
    return s.x == o || s.y == o;
  }

  /// Finds the last use of each result, and the results that are written directly to a state.
  void lives() {
    last_use_.assign(steps_.size(), -1);
    home_.assign(steps_.size(), -1);
    const auto end = static_cast<int>(steps_.size());
    for (int i = 0; i < end; ++i) {
      for (const Operand& o : {steps_[at(i)].x, steps_[at(i)].y}) {
        if (o.from == From::step) last_use_[at(o.index)] = i;
      }
    }
    direct_.assign(program_.states.size(), 0);
    for (std::size_t k = 0; k < program_.states.size(); ++k) {
      out_.state_address.push_back(static_cast<int>(k));
      const Operand next = program_.states[k].next;
      const auto state = static_cast<int>(k);
      if (next.from == From::none || next == Operand{From::state, state}) {
        direct_[k] = 1;
        continue;
      }
      if (next.from != From::step) continue;
      bool late = false;
      for (int i = next.index + 1; i < end; ++i) late = late || reads_state(steps_[at(i)], state);
      const Step& s = steps_[at(next.index)];
      // A step that a branch may skip would leave the old value in the state.
      if (!late && s.output < 0 && s.event < 0 && home_[at(next.index)] < 0) {
        home_[at(next.index)] = state;
        direct_[k] = 1;
      } else {
        last_use_[at(next.index)] = end;
      }
    }
    most_ = static_cast<int>(program_.states.size());
    busy_.assign(at(registers), -1);
    if (most_ > registers) {
      throw Refused(fmt::format("the law has {} states, {} fit", most_, registers),
                    "use fewer states");
    }
    for (int r = 0; r < most_; ++r) busy_[at(r)] = end + 1;
  }

  int constant(std::int32_t value) {
    auto& c = program_.constants;
    const auto found = std::find(c.begin(), c.end(), value);
    if (found == c.end()) c.push_back(value);
    return static_cast<int>(std::find(c.begin(), c.end(), value) - c.begin());
  }

  int address(const Operand& o) const {
    switch (o.from) {
      case From::step:
        return register_[at(o.index)];
      case From::input: {
        const Input& input = law_.inputs[at(o.index)];
        return EngineMap::input_first + EngineMap::input_axis_words * input.axis +
               static_cast<int>(input.source);
      }
      case From::state:
        return o.index;
      case From::word:
        return EngineMap::D::parameter + word_number(law_, program_, o.index);
      case From::constant:
        return EngineMap::D::constant + o.index;
      case From::none:
        break;
    }
    return 0;
  }

  void push(const EngineInstruction& i, int step) {
    out_.instructions.push_back(i);
    out_.step_of.push_back(step);
  }

  /// Whether the first comparison and selection also initialise the state: the initial value is the
  /// one that the selection takes. It uses `flag or c` with the first-run flag.
  bool starts_itself(int state) {
    const StateUse& use = program_.states[at(state)];
    int compare = -1, select = -1;
    for (int i = 0; i < static_cast<int>(steps_.size()); ++i) {
      const Step& s = steps_[at(i)];
      if (s.op == EngineOp::cmp) {
        compare = compare < 0 && select < 0 ? i : -2;
        if (compare == -2 && select < 0) return false;
      }
      if (s.op == EngineOp::sel && select < 0) {
        if (compare < 0 || steps_[at(compare)].mode != 0) return false;
        if (!(s.y == Operand{From::state, state}) || s.x.from != From::constant) return false;
        if (program_.constants[at(s.x.index)] != use.initial) return false;
        select = i;
        continue;
      }
      if (reads_state(s, state)) return false;
    }
    if (select < 0) return false;
    for (int i = 0; i < select; ++i) {
      if (steps_[at(i)].op == EngineOp::cmp) steps_[at(i)].mode = 1;
    }
    return true;
  }

  void start() {
    int own = -1;
    if (program_.states.size() == 1 && program_.states[0].next.from != From::none &&
        starts_itself(0)) {
      own = 0;
    }
    for (int k = 0; k < static_cast<int>(program_.states.size()); ++k) {
      const StateUse& use = program_.states[at(k)];
      if (use.next.from == From::none || k == own) continue;
      EngineInstruction i;
      i.op = EngineOp::sel;
      i.dst = static_cast<int>(EngineTarget::data);
      i.d = k;
      i.a = EngineMap::D::constant + constant(use.initial);
      i.b = k;
      push(i, -1);
    }
  }

  void body() {
    register_.assign(steps_.size(), -1);
    const auto base = target_.thread * EngineMap::thread_words;
    for (int n = 0; n < static_cast<int>(steps_.size()); ++n) {
      const Step& s = steps_[at(n)];
      EngineInstruction i;
      i.op = s.op;
      i.mode = s.mode;
      i.a = address(s.x);
      i.b = address(s.y);
      if (s.table >= 0) {
        const TableUse& t = program_.tables[at(s.table)];
        i.b = (t.base + s.offset - t.low) & (EngineMap::table_words - 1);
      }
      if (s.op == EngineOp::brf) {
        i.b = base + static_cast<int>(out_.instructions.size()) + 1 + s.skip;
      }
      if (s.output >= 0) {
        i.dst = static_cast<int>(EngineTarget::output);
        i.d = s.output;
      } else if (s.event >= 0) {
        i.dst = static_cast<int>(EngineTarget::event);
        i.d = s.event;
      } else if (home_[at(n)] >= 0) {
        register_[at(n)] = home_[at(n)];
      } else if (last_use_[at(n)] > n) {
        int r = 0;
        while (r < registers && busy_[at(r)] > n) ++r;
        if (r == registers) {
          throw Refused(s.place, "more values are alive at once than the thread has words",
                        "make the law smaller, or compute less before it is used");
        }
        busy_[at(r)] = last_use_[at(n)];
        register_[at(n)] = r;
        most_ = std::max(most_, r + 1);
      }
      if (register_[at(n)] >= 0) {
        i.dst = static_cast<int>(EngineTarget::data);
        i.d = register_[at(n)];
      }
      push(i, n);
    }
  }

  void copies() {
    const auto length = out_.instructions.size();
    for (std::size_t k = 0; k < program_.states.size(); ++k) {
      if (direct_[k] != 0) continue;
      EngineInstruction i;
      i.op = EngineOp::add;
      i.dst = static_cast<int>(EngineTarget::data);
      i.d = static_cast<int>(k);
      i.a = address(program_.states[k].next);
      i.b = EngineMap::D::constant + constant(0);
      push(i, -1);
    }
    (void)length;
  }

  const Law& law_;
  const Target& target_;
  Program& program_;
  std::vector<Step>& steps_;
  Assembled out_;
  std::vector<int> last_use_, home_, register_, busy_;
  std::vector<char> direct_;
  int most_ = 0;
};

}  // namespace

Assembled assemble(const Law& law, const Target& target, Program& program) {
  return Assembly(law, target, program).run();
}

}  // namespace feltgate::law
