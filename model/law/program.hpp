// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// A law as instructions before register allocation. Each step's result has a scale, so that proofs
// know which real value it stands for. Documentation: docs/laws.md
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "feltgate/engine_ops.hpp"
#include "law/law.hpp"
#include "law/spans.hpp"

namespace feltgate::law {

/// The source of an operand: a step's result, an input (Law::inputs), a state after the previous
/// run (Program::states), a parameter word, a constant.
enum class From : std::uint8_t { none, step, input, state, word, constant };

struct Operand {
  From from = From::none;
  int index = -1;
  double exact = 0;  ///< of a constant: its value in words before rounding
  bool operator==(const Operand& o) const { return from == o.from && index == o.index; }
  bool operator<(const Operand& o) const {
    return from != o.from ? from < o.from : index < o.index;
  }
};

/// One instruction. Its result stands for result * scale, in SI, or in turns if `turns`.
struct Step {
  EngineOp op = EngineOp::nop;
  int mode = 0;
  Operand x, y;
  double x_error = 0, y_error = 0;  ///< rounding error of a constant operand, in words
  int table = -1, offset = 0;       ///< of LRP and TAB: Program::tables, words from its start
  double argument_scale = 1;        ///< of LRP: SI value, or turns, of 1 of x
  double scale = 1;
  NodeId node = -1;    ///< the node whose value (and range) the result has; -1: a part of a node
  int sign = 1;        ///< -1: the result is the negated value of `node`
  bool turns = false;  ///< the result wraps, so its range does not matter
  int output = -1;     ///< the output that receives the result
  int event = -1;      ///< the number of the event that receives the result
  int skip = 0;        ///< of BRF: steps that it may pass over
  int condition = -1;  ///< of CMP and SEL: the law's node of the condition
  double margin_scale = 0;  ///< of ABS: scale of the operand that gives the sign, if not `scale`
  NodeId floors = -1;       ///< this node's value is rounded down here to a whole number
  bool whole = false;       ///< the law's value is a whole number of words
  Place place;
};

/// A parameter word: the product of nodes that only depend on parameters, divided by scale.
struct Word {
  std::vector<NodeId> nodes;
  double scale = 1;      ///< negative: the word holds the negated value
  double exact = 0;      ///< of a word that is a whole multiple of a primary word: that multiple
  bool primary = false;  ///< the word is the parameter itself and carries its value
};

/// The words from a to b or from b to a, rounded outward. The operations of intervals have moved an
/// end that is a whole number by some last bits; it stays that number. The host limits to these.
inline Span outward_words(double a, double b) {
  const auto up = [](double x) { return std::ceil(x - 1e-6 - 4e-15 * std::fabs(x)); };
  return {-up(-std::min(a, b)), up(std::max(a, b))};
}

/// A table in table memory.
struct TableUse {
  std::vector<std::uint64_t> words;
  int low = 0;                 ///< index x >> 12 of the first word
  bool wraps = false;          ///< all 512 words, any index
  double error = 0;            ///< largest, in words of the value; proven
  std::vector<double> errors;  ///< of each segment
  std::vector<double> steep;   ///< largest slope of each segment and its neighbours
  double slope = 0;            ///< largest change of the value in words per word of the argument
  double jump = 0;             ///< largest jump between segments, words
  std::vector<double> jumps;   ///< at the begin of each segment; empty of a periodic table
  Span values;                 ///< words
  std::string what;            ///< for the listing
  std::string proof;           ///< how its error was proven
  int line = -1;               ///< >= 0: the words belong to this delay line, which runs write
  int base = 0;                ///< address, once placed

  /// The largest jump within the segments from .. to.
  double jump_over(double from, double to) const {
    if (wraps || jumps.empty()) return jump;
    double most = 0;
    for (double i = from + 1; i <= to; ++i)
      most = std::max(most, jumps[static_cast<std::size_t>(i)]);
    return most;
  }
  /// Of an array: the largest difference between two elements that follow each other.
  double neighbours() const {
    double most = 0;
    for (std::size_t i = 1; i < words.size(); ++i) {
      const auto element = [this](std::size_t k) {
        return double(static_cast<std::int32_t>(words[k]));
      };
      most = std::max(most, std::fabs(element(i) - element(i - 1)));
    }
    return most;
  }
};

struct StateUse {
  double scale = 1;
  Operand next;
  std::int32_t initial = 0, lower = 0, upper = 0;
};

/// A delay line: as Law::lines.
struct LineUse {
  double scale = 1;
  Operand written;   ///< a step
  int table = -1;    ///< Program::tables
  int pointer = -1;  ///< index in Program::states of the next index to write, times 4096
};

struct Program {
  std::vector<Step> steps;
  std::vector<Word> words;
  std::vector<std::int32_t> constants;
  std::vector<TableUse> tables;
  std::vector<StateUse> states;  ///< as Law::states, then one per event (whether its condition
                                 ///< held), then one per line (where it is written)
  std::vector<LineUse> lines;
};

/// Whether word `index` of Program::words is a mailbox's.
inline bool is_mailbox(const Law& law, const Program& program, std::size_t index) {
  const Node& n = law.nodes[static_cast<std::size_t>(program.words[index].nodes[0])];
  return n.op == Op::parameter && law.parameters[static_cast<std::size_t>(n.index)].mailbox;
}

/// The number of word `index` in parameter memory; mailbox words lie at the end, up to 31.
inline int word_number(const Law& law, const Program& program, int index) {
  const auto i = static_cast<std::size_t>(index);
  int before = 0, from_here = 0;
  for (std::size_t k = 0; k < program.words.size(); ++k) {
    if (is_mailbox(law, program, k)) {
      from_here += k >= i ? 1 : 0;
    } else {
      before += k < i ? 1 : 0;
    }
  }
  return is_mailbox(law, program, i) ? EngineMap::parameter_words - from_here : before;
}

/// Whether a step reads acc, the result of the step before.
inline bool takes_acc(const Step& s) {
  return s.op == EngineOp::mac || s.op == EngineOp::tst ||
         ((s.op == EngineOp::add || s.op == EngineOp::sub) && s.mode >= 2);
}

}  // namespace feltgate::law
