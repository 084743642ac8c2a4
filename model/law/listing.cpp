// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Documentation: docs/laws.md
#include "law/listing.hpp"

#include <cmath>

#include <fmt/format.h>

#include "feltgate/largest.hpp"
#include "law/load.hpp"
#include "law/units.hpp"
#include "law/verdict.hpp"

namespace feltgate::law {

namespace {

std::string parameters(const Compiled& c) {
  if (c.image.words.empty()) return {};
  std::string s = fmt::format("\n{:<14} {:>4} {:>12} {:>12} {:>12} {:>10}  {}\n", "parameter",
                              "word", "value", "from", "to", "step", "unit");
  for (const ImageWord& w : c.image.words) {
    const double step = w.scale / w.to_si;
    const double a = w.lower * step, b = w.upper * step;
    if (!w.formula.empty()) {
      s += fmt::format("{:<14} {:>4} {:>12.6g} {:>12.6g} {:>12.6g} {:>10.3g}  = {}\n",
                       "  from others", w.word, w.initial * step + 0.0, std::min(a, b) + 0.0,
                       std::max(a, b) + 0.0, std::fabs(step), w.formula);
      continue;
    }
    s += fmt::format("{:<14} {:>4} {:>12.6g} {:>12.6g} {:>12.6g} {:>10.3g}  {}{}\n", w.name, w.word,
                     w.initial * step + 0.0, std::min(a, b) + 0.0, std::max(a, b) + 0.0,
                     std::fabs(step), w.unit, w.mailbox ? " (mailbox)" : "");
  }
  if (c.image.mailbox_first != EngineMap::parameter_words) {
    const double step = EngineMap::mailbox_step / static_cast<double>(c.target.tick_hz);
    s += fmt::format("mailbox: {:.6g} ms without a commit, and the torque ramps to 0\n",
                     1e3 * step * (c.image.mailbox_age + 1));
  }
  return s;
}

std::string tables(const Compiled& c) {
  std::string s;
  std::size_t words = 0;
  for (const TableUse& t : c.program.tables) {
    words += t.words.size();
    s += fmt::format("table {}: {} words, error {:.3g} of the last bit; {}\n", t.what,
                     t.words.size(), t.error, t.proof);
  }
  return words == 0
             ? s
             : s + fmt::format("table memory: {} of {} words\n", words, EngineMap::table_words);
}

/// A unit as it stands behind a number.
std::string behind(const Unit& unit) { return unit == kNumber ? "" : with_blank(text_of(unit)); }

/// What a strip may change: the outputs, or else the states by which it reaches them later.
std::string changed(const Compiled& c, const Strip& strip) {
  double most = 0, as_set = 0;
  for (std::size_t o = 0; o < strip.jump.size(); ++o) {
    if (strip.jump[o] <= 0) continue;
    most = larger(most, c.bound.output[o] + strip.jump[o]);
    as_set = larger(as_set, c.bound.as_set[o] + strip.jump_as_set[o]);
  }
  if (!(most <= 0)) {
    const std::string at_most = fmt::format("{:.3g} Nm", most),
                      now = fmt::format("{:.3g} Nm", as_set);
    return "outputs may then differ by " +
           (now == at_most ? now : now + " as set, by " + at_most + " for other parameters");
  }
  const std::size_t states = c.law.states.size();
  std::string s;
  for (std::size_t k = 0; k < strip.next.size(); ++k) {
    if (!(strip.next[k] > 0)) continue;
    s += s.empty() ? "outputs differ only in later runs, through " : ", ";
    if (k >= states) {
      s += "line " + c.law.lines[k - states].name;
      continue;
    }
    const State& state = c.law.states[k];
    const double width = state.range.upper - state.range.lower;
    s += state.phase && strip.condition == state.next
             ? fmt::format("phase {}, which may wrap in another run", state.name)
             : fmt::format("state {}, whose next value may differ by {:.3g}{}", state.name,
                           std::min(strip.next[k], width), behind(state.unit));
  }
  if (!s.empty()) return s;
  return c.law.events.empty() ? "no output differs" : "no output differs, but an event may";
}

/// Lists where the law can jump, and the strips in which the words may be on the other side.
std::string strips(const Compiled& c) {
  std::string s;
  for (const Place& place : c.bound.sharp) {
    const std::string line =
        fmt::format("strip: line {}, column {}: none, words and law change sides together\n",
                    place.line, place.column);
    if (s.find(line) == std::string::npos) s += line;
  }
  for (const Strip& strip : c.bound.strips) {
    s += fmt::format("strip: line {}, column {}: ", strip.place.line, strip.place.column) +
         fmt::format(
             "within {:.3g}{} of {} may go either way; {}\n", strip.width, behind(strip.unit),
             strip.floors >= 0 ? "a whole number what is rounded down" : "equal the comparison",
             changed(c, strip));
  }
  return s;
}

std::string free_runs(const FreeRuns& free) {
  if (!free.unknown.empty()) return "free runs: none, for " + free.unknown + "\n";
  if (free.runs == 0) return {};
  double most = 0;
  for (const double e : free.most) most = larger(most, e);
  return fmt::format(
      "free runs: {} from the file's first values, beside the law as its text says it: largest "
      "error {:.3g} Nm; {} of {} starts left the law\n",
      free.runs, most, free.left, free.acting);
}

}  // namespace

std::string report(const Compiled& c, const Measured& m) {
  const auto count = static_cast<int>(c.assembled.instructions.size());
  std::string s =
      text(verdict(c, m)) + fmt::format("law {}, design {}: {}\n", c.law.name, c.target.design,
                                        c.law.summary.empty() ? "no description" : c.law.summary);
  s += parameters(c);
  s += fmt::format("\n{} instructions, {} clocks from start to start: every {} clocks, {:.6g} Hz\n",
                   count, engine_period(count, c.target.axes), c.divider * c.target.clocks_per_tick,
                   c.rate_hz);
  if (c.law.timed && !c.law.own_rate) {
    s += "the file says no rate: this is the fastest, and dt and filters are for it\n";
  }
  s += fmt::format("memory: {} private words of {}, {} parameters of 32, {} constants of 64\n",
                   c.assembled.private_words, EngineMap::input_first, c.image.words.size(),
                   c.program.constants.size());
  s += tables(c);
  s += fmt::format("proven: no instruction saturates, over {} cell{}\n", c.bound.cells,
                   c.bound.cells == 1 ? "" : "s");
  const double lsb = std::ldexp(1.0, -c.target.torque.fraction);
  s += fmt::format("\n{:<14} {:>12} {:>10} {:>12} {:>14}\n", "output", "bound Nm", "in LSB",
                   "as set Nm", m.all_inputs ? "exact maximum" : "measured Nm");
  const std::string without =
      m.in_strips > 0 ? fmt::format("   without {} of {} {}, which are in strips", m.in_strips,
                                    m.runs, m.all_inputs ? "positions" : "runs")
                      : "";
  const std::vector<bool> useful = useful_bounds(c, m);
  for (std::size_t o = 0; o < c.law.outputs.size(); ++o) {
    const Output& output = c.law.outputs[o];
    const std::string name = name_of(output, c.law);
    s += fmt::format("{:<14} {:>12.3g} {:>10.3g} {:>12.3g} {:>14.3g}{}{}\n", name,
                     c.bound.output[o], c.bound.output[o] / lsb, c.bound.as_set[o],
                     m.output.empty() ? 0.0 : m.output[o], without,
                     useful[o] ? "" : "   no useful bound");
  }
  const std::vector<Span> spans = ranges(c.law, whole_cell(c.law, c.target));
  const double end = std::ldexp(1.0, c.target.torque.integer);
  for (const Output& output : c.law.outputs) {
    const Span& law = spans[at(output.value)];
    if (law.size() <= end) continue;
    s += fmt::format("line {}: the law gives {:.4g} .. {:.4g} Nm; torque ends at {:.4g} Nm\n",
                     output.place.line, law.lo, law.hi, end);
  }
  if (!c.bound.states_bounded) {
    s += "a state's error has no end by itself: bounds are of one run from the states as they "
         "stand\n";
  }
  for (std::size_t i = 0; i < c.law.states.size(); ++i) {
    const State& state = c.law.states[i];
    s += fmt::format("state {}: shown to stay in {:.6g} .. {:.6g}, step {:.3g}, ", state.name,
                     state.range.lower, state.range.upper, c.program.states[i].scale) +
         (c.bound.states_bounded
              ? fmt::format("error {:.3g}\n", c.bound.state[i])
              : fmt::format("a run adds an error of up to {:.3g}\n", c.bound.drift[i]));
  }
  if (!m.output.empty()) {
    s += fmt::format(m.all_inputs ? "all {} positions were run, parameters as they stand"
                                  : "{} runs of random inputs and parameters",
                     m.runs);
    if (m.in_strips > 0) s += fmt::format(", {} of them on the other side of a strip", m.in_strips);
    s += "\n";
  }
  s += free_runs(m.free);
  s += strips(c);
  return s;
}

std::string name_of(const Compiled& c, const Operand& o) {
  switch (o.from) {
    case From::none:
      return "-";
    case From::step:
      return fmt::format("t{}", o.index);
    case From::input:
      return c.law.inputs[at(o.index)].name;
    case From::state:
      return at(o.index) < c.law.states.size() ? c.law.states[at(o.index)].name : "held";
    case From::word: {
      const ImageWord& w = c.image.words[at(o.index)];
      return w.formula.empty() ? w.name : w.name;
    }
    case From::constant:
      return fmt::format("#{}", c.program.constants[at(o.index)]);
  }
  return "-";
}

std::string listing(const Compiled& c) {
  std::string s =
      fmt::format("\n{:>4} {:<4} {:<5} {:<8} {:<12} {:<12} {:>7} {:>12} {:>12} {:>9} {}\n", "",
                  "op", "mode", "to", "x", "y", "format", "from", "to", "error", "line");
  for (std::size_t n = 0; n < c.assembled.instructions.size(); ++n) {
    const EngineInstruction& i = c.assembled.instructions[n];
    const std::string to = i.dst == 1   ? fmt::format("r{}", i.d)
                           : i.dst == 2 ? fmt::format("out{}", i.d)
                           : i.dst == 3 ? fmt::format("event{}", i.d)
                                        : "-";
    const int step = c.assembled.step_of[n];
    const bool shifts = i.op == EngineOp::mul || i.op == EngineOp::mac || i.op == EngineOp::mlw;
    const std::string mode =
        shifts ? fmt::format(">>{}", engine_shift(i.mode)) : fmt::format("{}", i.mode);
    const auto name = EngineMap::op_names[static_cast<std::size_t>(i.op)];
    if (step < 0) {
      s += fmt::format("{:>4} {:<4} {:<5} {:<8} {}\n", n, name, mode, to,
                       i.op == EngineOp::sel ? "first value of a state" : "kept for the next run");
      continue;
    }
    const Step& p = c.program.steps[at(step)];
    const Span w = c.bound.words[at(step)];
    s += fmt::format(
        "{:>4} {:<4} {:<5} {:<8} {:<12} {:<12} {:>7.4g} {:>12.6g} {:>12.6g} {:>9.3g} {}\n", n, name,
        mode, to, name_of(c, p.x), name_of(c, p.y), -std::log2(p.scale), w.lo * p.scale,
        w.hi * p.scale, c.bound.errors[at(step)] * p.scale, p.place.line);
  }
  return s +
         "t: result of an earlier line; format: fraction bits; from, to, error: in SI, or turns\n";
}

// Writes the files of an image for the RTL.

namespace {

template <class Words>
std::string hex_lines(const Words& words, int bits) {
  std::string lines;
  for (const auto word : words) {
    const auto bits_of = static_cast<std::uint64_t>(word) & ((std::uint64_t{1} << bits) - 1);
    lines += fmt::format("{:0{}x}\n", bits_of, bits / 4);
  }
  return lines;
}

}  // namespace

Content content(const Image& image, const std::string& folder) {
  const EngineMemory m = memory(image);
  std::string fields;
  reset_words(image).for_each([&](unsigned value, int width) {
    fields = fmt::format("{}'d{}", width, value) + (fields.empty() ? "" : ", ") + fields;
  });
  Content c;
  c.program = hex_lines(m.program, EngineMap::program_bits);
  c.data = hex_lines(m.data, EngineMap::data_bits);
  c.table = hex_lines(m.table, EngineMap::program_bits);
  c.parameters = fmt::format(
      "// {} for design {}: `include it among the parameters of feltgate_axes or feltgate_linked.\n"
      ".ProgramContent(\"{}program.mem\"),\n.DataContent(\"{}data.mem\"),\n"
      ".TableContent(\"{}table.mem\"),\n.Reset({{{}}})\n",
      image.name, image.design, folder, folder, folder, fields);
  return c;
}

}  // namespace feltgate::law
