// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Makes the memories and names of a compiled law. Documentation: docs/laws.md
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "law/compile.hpp"
#include "law/derive.hpp"
#include "law/mends.hpp"
#include "law/verdict.hpp"

namespace feltgate::law {

namespace {

constexpr std::size_t kMostWords = EngineMap::parameter_words;
constexpr std::size_t kMostConstants =
    std::tuple_size_v<decltype(Image::data)> - std::size_t{Image::constant_base};

std::string number_text(double value) {
  return value < 0 ? fmt::format("{:.17g} neg", -value) : fmt::format("{:.17g}", value);
}

/// Formula of the element that `index` selects from `first` to `last`, by halving.
std::string one_of(const std::vector<double>& values, std::size_t first, std::size_t last,
                   const std::string& index) {
  if (first == last) return number_text(values[first]);
  const std::size_t middle = (first + last) / 2;
  return fmt::format("{} {} < {} {} ?", index, middle + 1, one_of(values, first, middle, index),
                     one_of(values, middle + 1, last, index));
}

/// A node of parameters in postfix, for ImageWord::formula.
std::string postfix(const Law& law, NodeId id) {
  const Node& n = law.nodes[at(id)];
  const auto arg = [&](std::size_t i) { return postfix(law, n.arguments[i]); };
  const auto two = [&](const char* op) { return arg(0) + " " + arg(1) + " " + op; };
  switch (n.op) {
    case Op::constant:
      return number_text(n.value);
    case Op::parameter: {
      const Parameter& p = law.parameters[at(n.index)];
      return p.derived >= 0 ? postfix(law, p.derived) : p.name;
    }
    case Op::add:
      return two("+");
    case Op::subtract:
      return two("-");
    case Op::multiply:
      return two("*");
    case Op::minimum:
      return two("min");
    case Op::maximum:
      return two("max");
    case Op::negate:
      return arg(0) + " neg";
    case Op::absolute:
      return arg(0) + " abs";
    case Op::root:
      return arg(0) + " sqrt";
    case Op::exponential:
      return arg(0) + " exp";
    case Op::logarithm:
      return arg(0) + " log";
    case Op::sine:
      return arg(0) + " sin";
    case Op::cosine:
      return arg(0) + " cos";
    case Op::reciprocal:
      return "1 " + arg(0) + " /";
    case Op::less:
      return two("<");
    case Op::both:
      return two("and");
    case Op::either:
      return two("or");
    case Op::opposite:
      return arg(0) + " not";
    case Op::select:
      return arg(0) + " " + arg(1) + " " + arg(2) + " ?";
    case Op::element: {
      const std::vector<double>& values = law.arrays[at(n.index)].values;
      return one_of(values, 0, values.size() - 1, arg(0));
    }
    default:
      throw Refused(n.place, "the host cannot compute this from parameters",
                    "write it without a table");
  }
}

class ImageMaker {
 public:
  ImageMaker(const Law& law, const Target& target, const Program& program,
             const Assembled& assembled, int divider)
      : law_(law), target_(target), program_(program), assembled_(assembled) {
    image_.threads[at(target.thread)] = {true, divider,
                                         static_cast<int>(assembled.instructions.size())};
  }

  Image run() {
    image_.name = law_.name;
    image_.design = target_.design;
    for (std::size_t i = 0; i < assembled_.instructions.size(); ++i) {
      image_.program[at(target_.thread * EngineMap::thread_words) + i] =
          engine_encode(assembled_.instructions[i]);
    }
    if (program_.constants.size() > kMostConstants) {
      const std::size_t over = program_.constants.size() - kMostConstants;
      throw Refused(
          first_beyond(),
          fmt::format("the law needs {} constants, {} fit, and here is the first that does not",
                      program_.constants.size(), kMostConstants),
          program_.words.size() + over > kMostWords
              ? "compute fewer terms that each have a number of their own"
              : fmt::format("write {} of its numbers as a param each: params have a memory of "
                            "their own, of which {} of {} words are free",
                            over, kMostWords - program_.words.size(), kMostWords));
    }
    for (std::size_t i = 0; i < program_.constants.size(); ++i) {
      image_.data[Image::constant_base + i] = program_.constants[i];
    }
    image_.line_base = assembled_.line_base;
    for (const TableUse& t : program_.tables) {
      for (std::size_t i = 0; i < t.words.size(); ++i) image_.table[at(t.base) + i] = t.words[i];
    }
    words();
    requirements();
    for (const Output& o : law_.outputs) image_.outputs.push_back({o.name, o.axis});
    for (const Event& e : law_.events) {
      double scale = 1;
      for (const Step& s : program_.steps) {
        if (s.event == e.number) scale = s.scale;
      }
      image_.events.push_back({e.name, e.number, scale});
    }
    // Two missed starts are allowed.
    const ImageThread& thread = image_.threads[at(target_.thread)];
    image_.max_age_ticks = std::min(0xffff, 4 * thread.divider);
    return image_;
  }

 private:
  void words() {
    const std::vector<Span> spans = ranges(law_, whole_cell(law_, target_));
    int mailboxes = 0;
    for (std::size_t i = 0; i < program_.words.size(); ++i) {
      const Word& w = program_.words[i];
      ImageWord word;
      word.word = word_number(law_, program_, static_cast<int>(i));
      mailboxes += is_mailbox(law_, program_, i) ? 1 : 0;
      word.scale = w.scale;
      Span s{1, 1};
      for (const NodeId n : w.nodes) s = s * spans[at(n)];
      const double a = s.lo / w.scale, b = s.hi / w.scale;
      if (w.primary) {
        const int index = law_.nodes[at(w.nodes[0])].index;
        const Parameter& p = law_.parameters[at(index)];
        describe(p, &word);
        word.lower = static_cast<std::int32_t>(std::ceil(std::min(a, b) - 1e-6));
        word.upper = static_cast<std::int32_t>(std::floor(std::max(a, b) + 1e-6));
        if (word.lower > word.upper) {
          const double step = std::fabs(w.scale);
          // Far from 0, where a step is a small part, a wider range holds a word.
          const bool far = std::min(std::fabs(a), std::fabs(b)) > 5;
          throw Refused(
              p.place,
              fmt::format("no word of {} lies in its range: its step is {:.3g}{}", word.name,
                          step / p.to_si, with_blank(p.unit_text)),
              far ? "make the range wider than that step" : finer(law_, target_, p, step));
        }
      } else {
        const double r = std::max(1.0, std::fabs(w.exact));
        const Span outward = outward_words(a, b);
        const bool exact = w.exact != 0;
        word.lower = static_cast<std::int32_t>(exact ? r * std::ceil(std::min(a, b) / r - 1e-6)
                                                     : outward.lo);
        word.upper = static_cast<std::int32_t>(exact ? r * std::floor(std::max(a, b) / r + 1e-6)
                                                     : outward.hi);
        word.formula = postfix(law_, w.nodes[0]);
        for (std::size_t k = 1; k < w.nodes.size(); ++k) {
          word.formula += " " + postfix(law_, w.nodes[k]) + " *";
        }
        word.name = fmt::format("word{}", i);
      }
      image_.words.push_back(word);
    }
    // A parameter that serves only to compute others is a word that no instruction reads.
    for (std::size_t p = 0; p < law_.parameters.size(); ++p) {
      const Parameter& parameter = law_.parameters[p];
      if (parameter.derived >= 0) continue;
      const bool known = std::any_of(
          image_.words.begin(), image_.words.end(),
          [&](const ImageWord& w) { return w.formula.empty() && w.name == parameter.name; });
      if (known) continue;
      ImageWord word;
      word.word = static_cast<int>(image_.words.size()) - mailboxes;
      describe(parameter, &word);
      const double size =
          std::max({std::fabs(parameter.range.lower), std::fabs(parameter.range.upper), 1e-30});
      word.scale = std::exp2(std::ceil(std::log2(size)) - 30);
      word.lower = static_cast<std::int32_t>(std::ceil(parameter.range.lower / word.scale));
      word.upper = static_cast<std::int32_t>(std::floor(parameter.range.upper / word.scale));
      image_.words.push_back(word);
    }
    if (image_.words.size() > kMostWords) {
      const Place place = program_.words.size() > kMostWords
                              ? law_.nodes[at(program_.words[kMostWords].nodes[0])].place
                              : law_.parameters.back().place;
      throw Refused(
          place,
          fmt::format("the law needs {} parameter words, {} fit", image_.words.size(), kMostWords),
          "write some parameters as numbers, with let, or use fewer different formulas of "
          "parameters: each is a word");
    }
    image_.mailbox_first = EngineMap::parameter_words - mailboxes;
    image_.mailbox_age = mailboxes > 0 ? mailbox_age() : 0;
    std::vector<double> initial;
    for (const ImageWord& w : image_.words) {
      if (w.formula.empty()) initial.push_back(value_of(w.name));
    }
    const std::vector<std::int32_t> values = parameter_words(image_, initial);
    for (ImageWord& w : image_.words) {
      w.initial = values[at(w.word)];
      image_.data[at(Image::parameter_base + w.word)] = w.initial;
      image_.data[at(Image::parameter_base + 32 + w.word)] = w.initial;
      image_.data[at(Image::lower_base + w.word)] = w.lower;
      image_.data[at(Image::upper_base + w.word)] = w.upper;
    }
  }

  void requirements() {
    const auto name = [&](NodeId id) {
      std::string s = formula(law_, id);
      s.erase(std::remove(s.begin(), s.end(), ' '), s.end());
      return s;
    };
    for (const Requirement& r : law_.requirements) {
      image_.requirements.push_back({name(r.smaller), name(r.larger), postfix(law_, r.smaller),
                                     postfix(law_, r.larger), r.strict});
      const std::string broken = broken_requirement(
          image_, [&](const std::string& parameter) { return value_of(parameter); });
      if (broken.empty()) continue;
      throw Refused(r.place, "the law requires " + broken, "give the parameters other values");
    }
  }

  /// Where the first constant is used that has no place in the memory.
  Place first_beyond() const {
    const Operand beyond{From::constant, kMostConstants};
    for (const Step& s : program_.steps) {
      if (s.x == beyond || s.y == beyond) return s.place;
    }
    return law_.outputs.front().place;
  }

  /// The engine's count for the shortest max_age: data are late after more than this number of
  /// steps, detected at most one step later.
  int mailbox_age() const {
    const double step = EngineMap::mailbox_step / static_cast<double>(target_.tick_hz);
    int least = 0xffff;
    for (const Parameter& p : law_.parameters) {
      if (!p.mailbox) continue;
      const double steps = std::floor(p.max_age_s / step + 1e-9) - 1;
      if (steps < 1 || steps > 0xffff) {
        throw Refused(
            p.place,
            fmt::format("max_age of mailbox {} is {:.6g} ms; this design counts {:.6g} "
                        "ms to {:.6g} ms",
                        p.name, 1e3 * p.max_age_s, 2e3 * step, 1e3 * 0x10000 * step),
            fmt::format("write max_age {:.6g} ms", 1e3 * step * (steps < 1 ? 2 : 0x10000)));
      }
      least = std::min(least, static_cast<int>(steps));
    }
    return least;
  }

  double value_of(const std::string& name) const {
    for (const Parameter& p : law_.parameters) {
      if (p.name == name) return p.initial;
    }
    return 0;
  }

  static void describe(const Parameter& p, ImageWord* w) {
    w->name = p.name;
    w->unit = p.unit_text;
    std::replace(w->unit.begin(), w->unit.end(), ' ', '*');
    w->to_si = p.to_si;
    w->whole = p.whole;
    w->mailbox = p.mailbox;
    w->max_age_s = p.max_age_s;
  }

  const Law& law_;
  const Target& target_;
  const Program& program_;
  const Assembled& assembled_;
  Image image_;
};

}  // namespace

Image make_image(const Law& law, const Target& target, const Program& program,
                 const Assembled& assembled, int divider) {
  return ImageMaker(law, target, program, assembled, divider).run();
}

}  // namespace feltgate::law
