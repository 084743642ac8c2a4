// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The image: the output of the law compiler, which an engine runs. It holds the contents of the
// engine's memories, and the names by which a host knows them. Documentation: docs/laws.md
#pragma once

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include <fmt/format.h>

namespace feltgate::law {

/// A word of parameter memory.
struct ImageWord {
  std::string name;  ///< of the parameter in the file
  std::string unit;  ///< as written in the file
  int word = 0;      ///< 0 to 31, counted from the first parameter word
  double scale = 1;  ///< SI value of one LSB; negative where the program needs the negated value
  double to_si = 1;  ///< SI value of 1 in `unit`
  std::int32_t lower = 0, upper = 0, initial = 0;  ///< words; lower <= upper
  bool whole = false;
  bool mailbox = false;
  double max_age_s = 0;  ///< of a mailbox; 0: any
  /// Empty: the word is the parameter `name` itself and carries its value. Otherwise the formula by
  /// which the host computes the word from the values of other words, before it rounds: postfix, in
  /// SI, tokens separated by spaces: numbers, names of parameters,
  /// + - * / neg abs min max sqrt exp log sin cos < not and or ?
  std::string formula;
};

/// An output; its number, 0 to 2, is the axis.
struct ImageOutput {
  std::string name;
  int axis = 0;
};

/// An event; its value is `scale` times the word that the program outputs.
struct ImageEvent {
  std::string name;
  int number = 0;
  double scale = 1;
};

/// A condition on the parameters that a host must keep: smaller <= larger, or smaller < larger.
/// The formulas have the form of ImageWord::formula; the names are for messages, without blanks.
struct ImageRequirement {
  std::string smaller_name, larger_name;
  std::string smaller, larger;
  bool strict = false;
};

struct ImageThread {
  bool used = false;
  int divider = 1;  ///< ticks from start to start
  int length = 0;   ///< instructions of the longest run
};

/// The memories with the layout of the hardware (docs/engine-isa.md), and the names.
struct Image {
  std::string name, design;
  std::array<std::uint64_t, 512> program{};  ///< 36 bits each
  std::array<std::int32_t, 512> data{};      ///< words from 320 on: parameters, ranges, constants
  std::array<std::uint64_t, 512> table{};    ///< 36 bits each
  std::array<ImageThread, 4> threads{};
  int line_base = 512;         ///< first table word of delay lines; 512: none
  int max_age_ticks = 0xffff;  ///< a result older than this is late
  int mailbox_first = 32;      ///< first parameter word that belongs to a mailbox; 32: none
  int mailbox_age = 0;         ///< register value: largest age of the last commit, in 64 ticks
  std::vector<ImageWord> words;
  std::vector<ImageOutput> outputs;
  std::vector<ImageEvent> events;
  std::vector<ImageRequirement> requirements;

  static constexpr int parameter_base = 320, lower_base = 384, upper_base = 416,
                       constant_base = 448;
  bool operator==(const Image& other) const;
};

/// CRC-32 (zlib) of all program words, of the data words from 384 on, and of the table below the
/// delay lines: program and table words as 5 bytes, data as 4, low byte first.
std::uint32_t crc(const Image& image);

/// The image as text, one line per fact; read_image() restores an equal image.
std::string text(const Image& image);

/// Reads the text of an image. Throws std::invalid_argument with line, reason and mend when a word
/// is wrong or the CRC does not match.
Image read_image(const std::string& text);

/// Value of a formula of ImageWord; `value_of` gives the SI value of a parameter by name. Throws
/// std::invalid_argument where the formula is malformed.
template <class ValueOf>
double evaluate_formula(const std::string& formula, const ValueOf& value_of);

/// The first requirement that the values violate, as "dynamic <= static, which are 0.5 and 0.4";
/// empty when none is violated. `value_of` gives the SI value of a parameter by name.
template <class ValueOf>
std::string broken_requirement(const Image& image, const ValueOf& value_of);

/// Words of all parameters for values in SI; `values` are in the order of the words that are
/// parameters themselves. Formulas are computed from the rounded values of these words. Every word
/// is clamped to its range.
std::vector<std::int32_t> parameter_words(const Image& image, const std::vector<double>& values);

// Evaluates the postfix formulas of words that the host derives from parameters.

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
