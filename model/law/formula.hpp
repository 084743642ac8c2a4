// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Evaluates the postfix formulas of words that the host derives from parameters. Documentation:
// docs/laws.md
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace feltgate::law {

template <class ValueOf>
double evaluate_formula(const std::string& formula, const ValueOf& value_of) {
  std::istringstream in(formula);
  std::vector<double> stack;
  const auto take = [&stack] {
    if (stack.empty()) throw std::invalid_argument("formula takes more values than it has");
    const double value = stack.back();
    stack.pop_back();
    return value;
  };
  for (std::string word; in >> word;) {
    const char c = word[0];
    if (std::isdigit(static_cast<unsigned char>(c)) != 0 || (c == '-' && word.size() > 1)) {
      stack.push_back(std::strtod(word.c_str(), nullptr));
    } else if (word == "neg") {
      stack.push_back(-take());
    } else if (word == "abs") {
      stack.push_back(std::fabs(take()));
    } else if (word == "sqrt") {
      stack.push_back(std::sqrt(take()));
    } else if (word == "exp") {
      stack.push_back(std::exp(take()));
    } else if (word == "log") {
      stack.push_back(std::log(take()));
    } else if (word == "sin") {
      stack.push_back(std::sin(take()));
    } else if (word == "cos") {
      stack.push_back(std::cos(take()));
    } else if (word == "not") {
      stack.push_back(take() == 0 ? 1 : 0);
    } else if (word == "?") {
      const double no = take(), yes = take();
      stack.push_back(take() != 0 ? yes : no);
    } else if (word == "+" || word == "-" || word == "*" || word == "/" || word == "min" ||
               word == "max" || word == "<" || word == "and" || word == "or") {
      const double b = take(), a = take();
      stack.push_back(word == "+"     ? a + b
                      : word == "-"   ? a - b
                      : word == "*"   ? a * b
                      : word == "/"   ? a / b
                      : word == "min" ? std::min(a, b)
                      : word == "max" ? std::max(a, b)
                      : word == "<"   ? (a < b ? 1 : 0)
                      : word == "and" ? (a != 0 && b != 0 ? 1 : 0)
                                      : (a != 0 || b != 0 ? 1 : 0));
    } else {
      stack.push_back(value_of(word));
    }
  }
  const double result = take();
  if (!stack.empty()) throw std::invalid_argument("formula leaves values over");
  return result;
}

template <class ValueOf>
std::string broken_requirement(const Image& image, const ValueOf& value_of) {
  for (const ImageRequirement& r : image.requirements) {
    const double a = evaluate_formula(r.smaller, value_of);
    const double b = evaluate_formula(r.larger, value_of);
    if (r.strict ? a < b : a <= b) continue;
    return fmt::format("{} {} {}, which are {:g} and {:g}", r.smaller_name,
                       r.strict ? "<" : "<=", r.larger_name, a, b);
  }
  return {};
}

}  // namespace feltgate::law
