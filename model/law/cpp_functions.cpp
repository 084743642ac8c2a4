// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Writes formulas, tables and arrays of a law as C++ in real numbers. Documentation:
// docs/law-compiler.md
#include <fmt/format.h>

#include <cctype>
#include <set>
#include <sstream>

#include "law/cpp.hpp"

namespace feltgate::law {

namespace {

/// Collects the nodes of a table's body, arguments first.
void body(const Law& law, NodeId id, std::set<NodeId>& nodes) {
  for (const NodeId a : law.nodes[at(id)].arguments) body(law, a, nodes);
  nodes.insert(id);
}

std::string expression(const Law& law, const Node& n) {
  const auto arg = [&](std::size_t i) { return fmt::format("n{}", n.arguments[i]); };
  const auto two = [&](const char* op) { return arg(0) + op + arg(1); };
  switch (n.op) {
    case Op::constant:
      return fmt::format("T({})", cpp_number(n.value));
    case Op::input:
      return "x";
    case Op::add:
      return two(" + ");
    case Op::subtract:
      return two(" - ");
    case Op::multiply:
      return two(" * ");
    case Op::negate:
      return "-" + arg(0);
    case Op::absolute:
      return fmt::format("{0} < 0 ? -{0} : {0}", arg(0));
    case Op::minimum:
      return fmt::format("{1} < {0} ? {1} : {0}", arg(0), arg(1));
    case Op::maximum:
      return fmt::format("{0} < {1} ? {1} : {0}", arg(0), arg(1));
    case Op::less:
      return two(" < ");
    case Op::both:
      return two(" && ");
    case Op::either:
      return two(" || ");
    case Op::opposite:
      return "!" + arg(0);
    case Op::select:
      return fmt::format("{} ? {} : {}", arg(0), arg(1), arg(2));
    case Op::sine:
      return "law::sine_of(" + arg(0) + ")";
    case Op::cosine:
      return "law::cosine_of(" + arg(0) + ")";
    case Op::root:
      return "law::root_of(" + arg(0) + ")";
    case Op::reciprocal:
      return "1 / " + arg(0);
    case Op::exponential:
      return "law::exponential_of(" + arg(0) + ")";
    case Op::logarithm:
      return "law::logarithm_of(" + arg(0) + ")";
    case Op::arctangent:
      return "law::arctangent_of(" + arg(0) + ")";
    case Op::lookup:
      return fmt::format("{}({})", cpp_table_name(law, n.index), arg(0));
    case Op::element:
      return fmt::format("{}<T>(static_cast<int>(law::floor_of({})))", cpp_array_name(law, n.index),
                         arg(0));
    default:
      throw Refused(n.place, "a table cannot hold this", "write the law without it");
  }
}

std::string values(const std::vector<double>& list) {
  std::string s = "    constexpr double values[] = {";
  for (std::size_t i = 0; i < list.size(); ++i) {
    s += fmt::format("{}{}", i % 8 == 0 ? "\n        " : " ", cpp_number(list[i]) + ",");
  }
  return s + "\n    };\n";
}

/// The end of the C++ function of a table through points.
std::string points(const Table& t) {
  return values(t.points) +
         fmt::format(
             "    const T place = (x - T({})) / T({}) * T({});\n"
             "    const int at = static_cast<int>(law::floor_of(place));\n"
             "    const int first = at < {} ? at : {};\n",
             cpp_number(t.domain.lower), cpp_number(t.domain.upper - t.domain.lower), t.segments,
             t.segments - 1, t.segments - 1) +
         "    return T(values[first]) + (T(values[first + 1]) - T(values[first])) * "
         "(place - T(first));\n  }\n";
}

std::string table(const Law& law, int index) {
  const Table& t = law.tables[at(index)];
  std::string s = fmt::format(
      "  /// The law's table `{}`, exact; beyond {:.6g} .. {:.6g} it {}.\n"
      "  template <class T>\n  static T {}(T x) {{\n",
      t.name, t.domain.lower, t.domain.upper, t.periodic ? "repeats" : "stays",
      cpp_table_name(law, index));
  if (t.periodic) {
    s += fmt::format("    x -= T({1}) * law::floor_of((x - T({0})) / T({1}));\n",
                     cpp_number(t.domain.lower), cpp_number(t.domain.upper - t.domain.lower));
  }
  s += fmt::format("    x = x < T({0}) ? T({0}) : x > T({1}) ? T({1}) : x;\n",
                   cpp_number(t.domain.lower), cpp_number(t.domain.upper));
  if (!t.points.empty()) return s + points(t);
  std::set<NodeId> nodes;
  body(law, t.body, nodes);
  for (const NodeId id : nodes) {
    const Node& n = law.nodes[at(id)];
    s += fmt::format("    const {} n{} = {};\n", n.truth ? "bool" : "T", id, expression(law, n));
  }
  return s + fmt::format("    return n{};\n  }}\n", t.body);
}

std::string array(const Law& law, int index) {
  const Array& a = law.arrays[at(index)];
  std::string s = fmt::format(
      "  /// The law's array `{}`; beyond its ends it stays.\n"
      "  template <class T>\n  static T {}(int index) {{\n",
      a.name, cpp_array_name(law, index));
  return s + values(a.values) +
         fmt::format("    return T(values[index < 0 ? 0 : index > {0} ? {0} : index]);\n  }}\n",
                     a.values.size() - 1);
}

}  // namespace

std::string cpp_number(double x) {
  for (int digits = 6; digits < 17; ++digits) {
    std::string s = fmt::format("{:.{}g}", x, digits);
    if (std::strtod(s.c_str(), nullptr) == x) {
      return s.find_first_of(".e") == std::string::npos ? s + ".0" : s;
    }
  }
  return fmt::format("{:.17g}", x);
}

std::string cpp_class(const std::string& law) {
  std::string s;
  bool upper = true;
  for (const char c : law) {
    const auto letter = static_cast<unsigned char>(c);
    if (std::isalnum(letter) == 0) {
      upper = true;
      continue;
    }
    s += upper ? static_cast<char>(std::toupper(letter)) : c;
    upper = false;
  }
  return s.empty() || std::isdigit(static_cast<unsigned char>(s[0])) != 0 ? "Law" + s : s;
}

std::string cpp_name(const std::string& name) {
  static const std::set<std::string> taken = {
      "alignas", "alignof",   "and",     "asm",       "auto",     "bool",     "break",    "case",
      "catch",   "char",      "class",   "const",     "continue", "default",  "delete",   "do",
      "double",  "else",      "enum",    "explicit",  "export",   "extern",   "false",    "flag",
      "float",   "for",       "friend",  "goto",      "if",       "in",       "inline",   "int",
      "law",     "long",      "mutable", "namespace", "new",      "not",      "operator", "or",
      "private", "protected", "public",  "register",  "return",   "short",    "signed",   "sizeof",
      "static",  "struct",    "switch",  "table",     "template", "this",     "throw",    "true",
      "try",     "typedef",   "typeid",  "typename",  "union",    "unsigned", "using",    "virtual",
      "void",    "volatile",  "while",   "xor",       "N",        "O",        "Word",     "Inputs",
      "run",     "enter",     "words",   "inputs",    "outputs",  "events",   "name",     "design"};
  std::string s;
  for (const char c : name) s += std::isalnum(static_cast<unsigned char>(c)) != 0 ? c : '_';
  // t0, t1, ... are names of results; a trailing underscore marks members.
  const bool result =
      s.size() > 1 && s[0] == 't' && s.find_first_not_of("0123456789", 1) == std::string::npos;
  return taken.count(s) != 0 || result || s.back() == '_' ? s + "_v" : s;
}

std::string cpp_table_name(const Law& law, int table) {
  return "table_" + law.tables[at(table)].name;
}
std::string cpp_array_name(const Law& law, int array) {
  return "array_" + law.arrays[at(array)].name;
}

std::string cpp_formula(const std::string& postfix,
                        const std::map<std::string, std::string>& values) {
  static const std::map<std::string, std::string> functions = {{"sqrt", "law::root_of"},
                                                               {"exp", "law::exponential_of"},
                                                               {"log", "law::logarithm_of"},
                                                               {"sin", "law::sine_of"},
                                                               {"cos", "law::cosine_of"}};
  std::istringstream in(postfix);
  std::vector<std::string> stack;
  const auto take = [&stack] {
    std::string s = stack.back();
    stack.pop_back();
    return s;
  };
  for (std::string word; in >> word;) {
    const auto function = functions.find(word);
    if (std::isdigit(static_cast<unsigned char>(word[0])) != 0) {
      stack.push_back(fmt::format("T({})", cpp_number(std::strtod(word.c_str(), nullptr))));
    } else if (word == "neg") {
      stack.push_back("(-" + take() + ")");
    } else if (word == "abs") {
      const std::string a = take();
      stack.push_back(fmt::format("({0} < 0 ? -{0} : {0})", a));
    } else if (function != functions.end()) {
      stack.push_back(function->second + "(" + take() + ")");
    } else if (word == "min" || word == "max") {
      const std::string b = take(), a = take();
      stack.push_back(word == "min" ? fmt::format("({1} < {0} ? {1} : {0})", a, b)
                                    : fmt::format("({0} < {1} ? {1} : {0})", a, b));
    } else if (word == "not") {
      stack.push_back("(!" + take() + ")");
    } else if (word == "?") {
      const std::string no = take(), yes = take();
      stack.push_back(fmt::format("({} ? {} : {})", take(), yes, no));
    } else if (word == "<" || word == "and" || word == "or") {
      const std::string b = take(), a = take();
      stack.push_back("(" + a + (word == "<" ? " < " : word == "and" ? " && " : " || ") + b + ")");
    } else if (word == "+" || word == "-" || word == "*" || word == "/") {
      const std::string b = take(), a = take();
      stack.push_back("(" + a + " " + word + " " + b + ")");
    } else {
      stack.push_back(values.at(word));
    }
  }
  return take();
}

std::string cpp_functions(const Compiled& c) {
  std::string s;
  for (std::size_t i = 0; i < c.law.arrays.size(); ++i) s += array(c.law, static_cast<int>(i));
  for (std::size_t i = 0; i < c.law.tables.size(); ++i) s += table(c.law, static_cast<int>(i));
  return s;
}

}  // namespace feltgate::law
