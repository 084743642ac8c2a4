// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Writes a run of a law as C++, one instruction per line. Documentation: docs/law-compiler.md
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <stdexcept>

#include "law/cpp.hpp"
#include "law/derive.hpp"
#include "law/units.hpp"

namespace feltgate::law {

namespace {

class Body {
 public:
  explicit Body(const Compiled& c) : c_(c), law_(c.law), steps_(c.program.steps) {
    find_uses();
    lines_ = !law_.lines.empty();
  }

  std::string run() {
    std::string s;
    if (uses_flag_) s += "    bool flag = first_;\n";
    if (uses_flag_) s += "    first_ = false;\n";
    if (!law_.events.empty()) s += "    happened_ = {};\n";
    s += names();
    for (const int step : c_.assembled.step_of) {
      if (step >= 0) s += line(step);
    }
    return s + states();
  }

 private:
  void find_uses() {
    const auto use = [this](const Operand& o) {
      if (o.from == From::step) used_.insert(o.index);
      if (o.from == From::word) words_.insert(o.index);
      if (o.from == From::input) inputs_.insert(o.index);
      if (o.from == From::state) states_.insert(o.index);
    };
    for (std::size_t i = 0; i < steps_.size(); ++i) {
      use(steps_[i].x);
      use(steps_[i].y);
      if (takes_acc(steps_[i])) used_.insert(static_cast<int>(i) - 1);
      uses_flag_ = uses_flag_ || steps_[i].op == EngineOp::cmp || steps_[i].op == EngineOp::sel;
    }
    for (std::size_t k = 0; k < c_.program.states.size(); ++k) {
      const Operand& next = c_.program.states[k].next;
      if (next.from == From::none) continue;
      use(next);
      kept_.insert(static_cast<int>(k));
      uses_flag_ = true;
    }
    // States that a selection of the run initialises need no initialisation at its start.
    for (std::size_t n = 0; n < c_.assembled.step_of.size(); ++n) {
      const EngineInstruction& i = c_.assembled.instructions[n];
      if (c_.assembled.step_of[n] < 0 && i.op == EngineOp::sel) begun_.insert(i.d);
    }
  }

  /// Declares the values that the run reads, with the law's names.
  std::string names() const {
    std::string s;
    for (const int i : inputs_) {
      s += fmt::format("    const Word& {} = in[{}];\n", cpp_input(law_, i), i);
    }
    for (const int i : words_) {
      s += fmt::format(
          "    const Word& {} = word_[{}];{}\n", word(i), i,
          c_.image.words[at(i)].formula.empty() ? "" : "  // " + c_.image.words[at(i)].formula);
    }
    for (const int k : kept_) {
      const StateUse& use = c_.program.states[at(k)];
      const std::string name = cpp_state(law_, k);
      if (begun_.count(k) == 0) {
        if (states_.count(k) != 0) s += fmt::format("    const Word {} = {}_;\n", name, name);
        continue;
      }
      const double exact = k < static_cast<int>(law_.states.size())
                               ? law_.states[at(k)].initial / use.scale
                               : use.initial;
      if (states_.count(k) == 0) continue;
      s += fmt::format("    const Word {} = O::select(flag, {}, {}_);\n", name,
                       constant(use.initial, exact), name);
    }
    return s;
  }

  std::string word(int i) const {
    const ImageWord& w = c_.image.words[at(i)];
    return w.formula.empty() ? cpp_name(w.name) : fmt::format("derived{}", i);
  }

  static std::string constant(std::int32_t raw, double exact) {
    if (exact == raw) return fmt::format("O::word({})", raw);
    return fmt::format("O::constant({}, {})", raw, cpp_number(exact));
  }

  std::string operand(const Operand& o) const {
    switch (o.from) {
      case From::step:
        return fmt::format("t{}", o.index);
      case From::input:
        return cpp_input(law_, o.index);
      case From::state:
        return cpp_state(law_, o.index);
      case From::word:
        return word(o.index);
      case From::constant:
        return constant(c_.program.constants[at(o.index)], o.exact);
      case From::none:
        break;
    }
    return "Word{}";
  }

  /// The comment above a line: the law's formula, its range, step and error.
  std::string note(int step) const {
    const Step& s = steps_[at(step)];
    if (s.op == EngineOp::brf || s.op == EngineOp::tst) return {};
    std::string text = s.node >= 0 ? (s.sign < 0 ? "-" : "") + formula(law_, s.node)
                                   : fmt::format("line {}", s.place.line);
    if (s.op == EngineOp::cmp) {
      text = s.condition >= 0 ? formula(law_, s.condition) : text;
      return "    // " + text + "\n";
    }
    if (s.turns) return fmt::format("    // {}: in turns, step {:.3g}\n", text, s.scale);
    const Span w = c_.bound.words[at(step)];
    return fmt::format("    // {}: {:.6g} .. {:.6g}, step {:.3g}, error {:.2g}\n", text,
                       std::min(w.lo * s.scale, w.hi * s.scale) + 0.0,
                       std::max(w.lo * s.scale, w.hi * s.scale) + 0.0, std::fabs(s.scale),
                       c_.bound.errors[at(step)] * std::fabs(s.scale));
  }

  std::string line(int step) {
    const Step& s = steps_[at(step)];
    std::string text = note(step);
    if (s.op == EngineOp::brf) return {};  // the event after it tests the flag
    if (s.op == EngineOp::tst) {
      return text +
             fmt::format("    lines_.write({}, {}, t{});\n", operand(s.x), base(step), step - 1);
    }
    const std::string value = expression(step);
    if (s.event >= 0) {
      return text +
             fmt::format("    if (flag) happened_[{}] = {{true, {}}};\n", s.event - 1, value);
    }
    if (s.op == EngineOp::cmp) {
      text += fmt::format("    flag = {};\n", value);
      if (used_.count(step) == 0) return text;
      return text + fmt::format("    const Word t{} = O::truth(flag);\n", step);
    }
    if (used_.count(step) == 0) {
      return s.output < 0 ? std::string()
                          : text + fmt::format("    out_[{}] = {};\n", s.output, value);
    }
    text += fmt::format("    const Word t{} = {};\n", step, value);
    if (s.output >= 0) text += fmt::format("    out_[{}] = t{};\n", s.output, step);
    return text;
  }

  std::string expression(int step) const {
    const Step& s = steps_[at(step)];
    const std::string x = operand(s.x), y = operand(s.y), acc = fmt::format("t{}", step - 1);
    const int shift = engine_shift(s.mode);
    if (takes_acc(s) &&
        (steps_[at(step - 1)].event >= 0 || steps_[at(step - 1)].op == EngineOp::brf)) {
      throw std::logic_error("an instruction goes on from an event");
    }
    switch (s.op) {
      case EngineOp::add:
        return fmt::format("O::add{}({}, {})", (s.mode & 1) != 0 ? "_wrapped" : "",
                           s.mode >= 2 ? acc : x, s.mode >= 2 ? x : y);
      case EngineOp::sub:
        return fmt::format("O::sub{}({}, {})", (s.mode & 1) != 0 ? "_wrapped" : "",
                           s.mode == 2 ? acc : x, s.mode == 2 ? x : y);
      case EngineOp::mul:
        return fmt::format("O::template mul<{}>({}, {})", shift, x, y);
      case EngineOp::mac:
        return fmt::format("O::template mac<{}>({}, {}, {})", shift, acc, x, y);
      case EngineOp::mlw:
        return fmt::format("O::template {}<{}>({}, {})", s.turns ? "turn" : "floor", shift, x, y);
      case EngineOp::min:
        return fmt::format("O::min({}, {})", x, y);
      case EngineOp::max:
        return fmt::format("O::max({}, {})", x, y);
      case EngineOp::sel:
        return fmt::format("O::select(flag, {}, {})", x, y);
      case EngineOp::abs:
        return fmt::format("O::with_sign({}, {})", x, y);
      case EngineOp::cmp: {
        const char* join[] = {"", "flag || ", "flag && ", "!"};
        return fmt::format("{}O::less({}, {})", join[s.mode & 3], x, y);
      }
      case EngineOp::lrp:
      case EngineOp::tab:
        return fmt::format("{}{}(table, {}, {}, {})",
                           lines_ ? "lines_." : "O::", s.op == EngineOp::lrp ? "lookup" : "element",
                           x, base(step), exact(s));
      default:
        throw std::logic_error("the compiler makes no such instruction");
    }
  }

  /// The begin of the table, as the instruction encodes it.
  int base(int step) const {
    for (std::size_t n = 0; n < c_.assembled.step_of.size(); ++n) {
      if (c_.assembled.step_of[n] == step) return c_.assembled.instructions[n].b;
    }
    return 0;
  }

  /// The function in real numbers that a table approximates.
  std::string exact(const Step& s) const {
    const Node& n = law_.nodes[at(s.node)];
    const std::string begin = "[](auto x) {\n      using T = decltype(x);\n      return ";
    const std::string end = fmt::format(" / T({});\n    }}", cpp_number(s.scale));
    const std::string argument = fmt::format("x * T({})", cpp_number(s.argument_scale));
    const std::string angle =
        fmt::format("law::law_angle(x, {})", cpp_number(1 / s.argument_scale));
    switch (n.op) {
      case Op::sine:
        return begin + "law::sine_of(" + angle + ")" + end;
      case Op::cosine:
        return begin + "law::cosine_of(" + angle + ")" + end;
      case Op::root:
        return begin + "law::root_of(" + argument + ")" + end;
      case Op::reciprocal:
        return begin + "1 / (" + argument + ")" + end;
      case Op::exponential:
        return begin + "law::exponential_of(" + argument + ")" + end;
      case Op::logarithm:
        return begin + "law::logarithm_of(" + argument + ")" + end;
      case Op::lookup:
        return begin + cpp_table_name(law_, n.index) + "(" + argument + ")" + end;
      case Op::element:
        return begin + cpp_array_name(law_, n.index) + "<T>(static_cast<int>(x))" + end;
      default:
        return "[](auto x) { return 0 * x; }";  // unused: real numbers read a delay line directly
    }
  }

  std::string states() const {
    std::string s;
    for (const int k : kept_) {
      const Operand& next = c_.program.states[at(k)].next;
      // A state that keeps its value must also keep its first value.
      s += fmt::format("    {}_ = {};\n", cpp_state(law_, k), operand(next));
    }
    return s;
  }

  const Compiled& c_;
  const Law& law_;
  const std::vector<Step>& steps_;
  std::set<int> used_, words_, inputs_, states_, kept_, begun_;
  bool uses_flag_ = false, lines_ = false;
};

}  // namespace

std::string cpp_input(const Law& law, int input) {
  const Input& in = law.inputs[at(input)];
  const char* of[] = {"position", "velocity", "tau_hat"};
  const char* name = of[static_cast<std::size_t>(in.source)];
  return in.axis == 0 ? name : fmt::format("{}_{}", name, in.axis);
}

std::string cpp_state(const Law& law, int state) {
  auto k = at(state);
  if (k < law.states.size()) return cpp_name(law.states[k].name);
  k -= law.states.size();
  if (k < law.events.size()) return "held_" + law.events[k].name;
  return "next_of_" + law.lines[k - law.events.size()].name;
}

std::string cpp_body(const Compiled& compiled) { return Body(compiled).run(); }

}  // namespace feltgate::law
