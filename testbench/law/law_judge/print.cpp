// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Prints a law as text.
#include "law_tree.hpp"

namespace feltgate::judge {

namespace {

std::string joined(const std::vector<std::string>& parts, const std::string& between) {
  std::string s;
  for (std::size_t i = 0; i < parts.size(); ++i) s += (i == 0 ? "" : between) + parts[i];
  return s;
}

/// Returns an expression's text. `mark` returns the text before a comparison's sign, `let` the text
/// of a let.
template <class Mark, class Let>
std::string written(const Law& law, const Node& n, const Mark& mark, const Let& let) {
  std::vector<std::string> p;
  for (const Node& part : n->parts) p.push_back(written(law, part, mark, let));
  const auto infix = [&](const std::string& sign) {
    return "(" + p[0] + " " + sign + " " + p[1] + ")";
  };
  const auto call = [&](const std::string& name) { return name + "(" + joined(p, ", ") + ")"; };
  switch (n->kind) {
    case Kind::number:
    case Kind::state:
    case Kind::counter:
      return n->text;
    case Kind::let:
      return let(n);
    case Kind::param: {
      const std::string& unit = law.params[static_cast<std::size_t>(n->index)].unit;
      return unit.find("Nm") != std::string::npos ? "(" + n->text + " / (1 Nm))" : n->text;
    }
    case Kind::input: {
      const int of = n->index % 3;
      return of == 0 ? n->text : "(" + n->text + (of == 1 ? " * (1 s))" : " / (1 Nm))");
    }
    case Kind::line:
      return n->text + "[" + std::to_string(n->index) + "]";
    case Kind::power:
      return "(" + p[0] + ")^" + std::to_string(n->index);
    case Kind::negate:
      return "(-" + p[0] + ")";
    case Kind::table:
      return call(n->text);
    case Kind::element:
      return mark(n) + n->text + "[" + p[0] + "]";
    case Kind::noise:
      return "noise(" + n->text + ")";
    case Kind::choice:
      return "(if " + p[0] + " then " + p[1] + " else " + p[2] + ")";
    case Kind::sum:
      return fmt::format("sum({} in {:.0f} .. {}: {})", n->text, static_cast<double>(n->value),
                         n->index, p[0]);
    case Kind::opposite:
      return "(not " + p[0] + ")";
    default:
      break;
  }
  static const std::map<Kind, const char*> signs{{Kind::add, "+"},      {Kind::subtract, "-"},
                                                 {Kind::multiply, "*"}, {Kind::divide, "/"},
                                                 {Kind::both, "and"},   {Kind::either, "or"}};
  static const std::map<Kind, const char*> comparisons{
      {Kind::less, "<"},        {Kind::less_equal, "<="}, {Kind::more, ">"},
      {Kind::more_equal, ">="}, {Kind::equal, "=="},      {Kind::differs, "!="}};
  static const std::map<Kind, const char*> functions{
      {Kind::minimum, "min"},  {Kind::maximum, "max"},     {Kind::clamp, "clamp"},
      {Kind::absolute, "abs"}, {Kind::sine, "sin"},        {Kind::cosine, "cos"},
      {Kind::root, "sqrt"},    {Kind::exponential, "exp"}, {Kind::logarithm, "log"}};
  static const std::map<Kind, const char*> deciding{{Kind::floor, "floor"},
                                                    {Kind::round, "round"},
                                                    {Kind::modulo, "mod"},
                                                    {Kind::angle, "atan2"},
                                                    {Kind::sign, "sgn"}};
  if (signs.count(n->kind) > 0) return infix(signs.at(n->kind));
  if (comparisons.count(n->kind) > 0) return infix(mark(n) + comparisons.at(n->kind));
  if (functions.count(n->kind) > 0) return call(functions.at(n->kind));
  return mark(n) + call(deciding.at(n->kind));
}

std::string full(const Law& law, const Node& n) {
  return written(
      law, n, [](const Node&) { return std::string(); },
      [&](const Node& l) { return full(law, law.lets[static_cast<std::size_t>(l->index)].value); });
}

}  // namespace

std::string canonical(const Law& law, const Node& n) {
  std::string a = full(law, n->parts[0]);
  if (n->kind == Kind::element) return n->text + "[" + a + "]";
  if (n->kind == Kind::floor) return "floor(" + a + ")";
  if (n->kind == Kind::round) return "round(" + a + ")";
  if (n->kind == Kind::modulo) return "mod(" + a + ", " + full(law, n->parts[1]) + ")";
  std::string b = n->kind == Kind::sign || n->kind == Kind::angle ? "0" : full(law, n->parts[1]);
  if (n->kind == Kind::equal) return a + " == " + b;
  if (n->kind == Kind::differs) return a + " != " + b;
  // a > b is b < a, and a <= b is the opposite of this: all are one comparison.
  if (n->kind == Kind::more || n->kind == Kind::less_equal) std::swap(a, b);
  return a + " < " + b;
}

std::string Printer::mark(const Node& n) {
  // The text before the mark is known only at the end, because an operand may be printed first.
  marks_.push_back(canonical(law_, n));
  return fmt::format("\x01{}\x02", marks_.size() - 1);
}

std::string Printer::of(const Node& n) {
  return written(
      law_, n, [this](const Node& c) { return mark(c); }, [](const Node& l) { return l->text; });
}

void Printer::need(const Node& n) {
  if (!n) return;
  for (const Node& part : n->parts) need(part);
  const auto i = static_cast<std::size_t>(n->index);
  const bool named = n->kind == Kind::param || n->kind == Kind::state || n->kind == Kind::let ||
                     n->kind == Kind::line || n->kind == Kind::table || n->kind == Kind::element;
  if (!named || !needed_.insert(n->text).second) return;
  if (n->kind == Kind::let) need(law_.lets[i].value);
  if (n->kind == Kind::state) {
    need(law_.states[i].next);
    need(law_.states[i].follows);
    need(law_.states[i].frequency);
  }
  if (n->kind != Kind::line) return;
  for (const Line& l : law_.lines) {
    if (l.name == n->text) need(l.written);
  }
}

std::string Printer::ends(const std::string& unit, double initial, double lower,
                          double upper) const {
  const std::string u = unit.empty() ? "" : " " + unit;
  return fmt::format("{:.4f}{} in {:.4f} .. {:.4f}{}", initial, u, lower, upper, u);
}

void Printer::declare() {
  std::string s;
  if (law_.rate_khz > 0) s += fmt::format("rate = {:.0f} kHz\n", law_.rate_khz);
  for (const Param& p : law_.params) {
    if (!needed(p.name)) continue;
    s += (p.mailbox ? "mailbox " : "param ") + p.name + " = " +
         ends(p.unit, p.initial, p.lower, p.upper) + (p.whole ? " whole" : "") +
         (p.mailbox ? " max_age 5 ms" : "") + "\n";
  }
  for (const State& m : law_.states) {
    if (!needed(m.name) || m.follows) continue;
    if (m.truth) {
      s += "bool " + m.name + (m.initial != 0 ? " = true\n" : " = false\n");
      continue;
    }
    s += (m.phase ? "phase " : "state ") + m.name + " = " + ends("", m.initial, m.lower, m.upper) +
         (m.whole ? " whole" : "") + "\n";
  }
  for (const Line& l : law_.lines) {
    if (needed(l.name)) {
      s += fmt::format("line {}[{}] in {:.4f} .. {:.4f}\n", l.name, l.length, l.lower, l.upper);
    }
  }
  const auto numbers = [](const std::vector<double>& values) {
    std::vector<std::string> all;
    for (const double v : values) all.push_back(fmt::format("{:.4f}", v));
    return "[" + joined(all, ", ") + "]";
  };
  for (const Array& a : law_.arrays) {
    if (needed(a.name)) s += "array " + a.name + " = " + numbers(a.values) + "\n";
  }
  for (const Table& t : law_.tables) {
    if (!needed(t.name)) continue;
    s += fmt::format("table {}(x) {}on [{:.4f}, {:.4f}] ", t.name, t.periodic ? "periodic " : "",
                     t.lower, t.upper);
    s += t.body ? "= " + of(t.body) : "through " + numbers(t.points);
    if (t.segments > 0) s += fmt::format(" with {} segments", t.segments);
    s += "\n";
  }
  for (const State& m : law_.states) {
    if (needed(m.name) && m.follows) {
      s +=
          "let " + m.name + " = lowpass(" + of(m.follows) + ", " + of(m.frequency) + " * (1 Hz))\n";
    }
  }
  for (const Let& l : law_.lets) {
    if (needed(l.name)) s += "let " + l.name + " = " + of(l.value) + "\n";
  }
  for (const State& m : law_.states) {
    if (!needed(m.name) || !m.next) continue;
    const Node rounded = rounded_next(m);
    s += "next " + m.name + " = " + (rounded ? mark(rounded) : "") + of(m.next) + "\n";
  }
  for (const Line& l : law_.lines) {
    if (needed(l.name)) s += "next " + l.name + " = " + of(l.written) + "\n";
  }
  for (const Event& e : law_.events) {
    s += "event " + e.name + "(" + of(e.value) + ") when " + of(e.condition) + "\n";
  }
  for (std::size_t axis = 0; axis < law_.torques.size(); ++axis) {
    s += axis == 0 ? "out torque" : fmt::format("out torque[{}]", axis);
    s += " = (1 Nm) * " + of(law_.torques[axis]) + "\n";
  }
  text_ = s;
}

Printer::Printer(const Law& law) : law_(law) {
  for (const Node& t : law.torques) need(t);
  for (const Event& e : law.events) {
    need(e.value);
    need(e.condition);
  }
  declare();
  int line = 1;
  std::string text;
  for (std::size_t i = 0; i < text_.size(); ++i) {
    if (text_[i] == '\x01') {
      const std::size_t end = text_.find('\x02', i);
      lines_[marks_[std::stoul(text_.substr(i + 1, end - i - 1))]].insert(++line);
      text += '\n';
      i = end;
    } else {
      if (text_[i] == '\n') ++line;
      text += text_[i];
    }
  }
  text_ = text;
}

}  // namespace feltgate::judge
