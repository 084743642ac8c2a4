// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Documentation: docs/laws.md
#include <algorithm>
#include <cmath>
#include <limits>

#include "feltgate/largest.hpp"
#include "feltgate/random.hpp"
#include "law/engine/machine.hpp"
#include "law/load.hpp"
#include "law/measure.hpp"
#include "law/read_law.hpp"
#include "law/source_law.hpp"

namespace feltgate::law {

namespace {

using Real = SourceLaw::Real;

constexpr Real kTurn = 6.28318530717958647692528676655900577L;
constexpr int kAxes = 3;
constexpr int kLengths[] = {50, 150, 400};  ///< runs from the beginning

/// The least |x| + |y| of an atan2, which the language defines by the ranges of x and y. No number
/// where rounds of a loop have different ones.
double nearest(const Law& law, Place place) {
  double least = 0;
  for (const Node& n : law.nodes) {
    if (n.op != Op::maximum || n.place.line != place.line || n.place.column != place.column)
      continue;
    for (const NodeId a : n.arguments) {
      const Node& end = law.nodes[at(a)];
      if (end.op != Op::constant || end.value <= 0) continue;
      if (least != 0 && least != end.value) {
        throw std::invalid_argument("several atan2 at one place");
      }
      least = end.value;
    }
  }
  return least;
}

/// An input's motion: jumps, or a sine.
struct Motion {
  double middle = 0, size = 0, angle = 0, turn = 0;
  bool jumps = false;
  double at(int k, SplitMix64& random) const {
    return jumps ? middle + size * random.between(-1, 1)
                 : middle + size * std::sin(angle + turn * k);
  }
};

/// One output from a beginning on.
struct Episode {
  Span law{infinity, -infinity}, words{infinity, -infinity};
  std::vector<double> off;
};

class Free {
 public:
  Free(const Compiled& c, std::uint64_t seed)
      : c_(c),
        read_(read_law_text(c.law.source, c.law.name, c.law.own_rate ? 0 : c.rate_hz)),
        law_(c.law.source, c.rate_hz, [this](Place place) { return nearest(read_, place); }),
        machine_(memory(c.image)),
        random_(seed),
        reached_(c.law.outputs.size(), Span{infinity, -infinity}) {
    result_.most.assign(c.law.outputs.size(), 0);
  }

  FreeRuns run(std::int64_t runs) {
    for (int start = 0; result_.runs < runs; ++start) {
      // The values of the file come first, and in every second start.
      if (start > 0) start % 2 == 0 ? file_values() : random_values();
      machine_.enter();
      law_.reset();
      moves(start % 4 >= 2);
      std::vector<Episode> episodes(c_.law.outputs.size());
      for (int k = 0; k < kLengths[start % 3]; ++k) step(k, &episodes);
      starts_.push_back(std::move(episodes));
    }
    for (const std::vector<Episode>& start : starts_) count(start);
    result_.starts = static_cast<int>(starts_.size());
    return result_;
  }

 private:
  void file_values() {
    std::vector<double> values;
    for (const ImageWord& w : c_.image.words) {
      if (!w.formula.empty()) continue;
      values.push_back(static_cast<double>(law_.first(w.name)));
      law_.set_parameter(w.name, law_.first(w.name));
    }
    write(parameter_words(c_.image, values));
  }

  /// Any values that the host may set; those of before where the law's requirements exclude them.
  void random_values() {
    std::vector<double> values;
    std::map<std::string, double> named;
    for (const ImageWord& w : c_.image.words) {
      if (!w.formula.empty()) continue;
      const std::int64_t word = w.lower + random_.below(std::int64_t{w.upper} - w.lower + 1);
      const double value = static_cast<double>(word) * w.scale;
      values.push_back(w.whole ? std::nearbyint(value) : value);
      named[w.name] = values.back();
    }
    const auto value_of = [&named](const std::string& name) { return named.at(name); };
    if (!broken_requirement(c_.image, value_of).empty()) return;
    const std::vector<std::int32_t> words = parameter_words(c_.image, values);
    write(words);
    for (const ImageWord& w : c_.image.words) {
      if (w.formula.empty())
        law_.set_parameter(w.name, words[at(w.word)] * static_cast<Real>(w.scale));
    }
  }

  void write(const std::vector<std::int32_t>& words) {
    for (int bank = 0; bank < 2; ++bank) {
      for (int i = 0; i < 32; ++i) machine_.set_parameter(i, words[at(i)]);
      machine_.commit();
    }
  }

  void moves(bool jump) {
    for (std::size_t i = 0; i < motions_.size(); ++i) {
      const double end = i % 3 == 0   ? Target::position_counts * c_.target.count_rad()
                         : i % 3 == 1 ? std::ldexp(1.0, c_.target.velocity.integer)
                                      : std::ldexp(1.0, c_.target.torque.integer);
      Motion m;
      m.jumps = jump;
      m.size = end / 2 * std::exp2(-random_.between(0, 14));
      m.middle = random_.below(2) == 0 ? 0 : end / 2 * std::exp2(-random_.between(0, 14));
      m.angle = random_.between(0, 6.28);
      m.turn = std::exp2(-random_.between(2, 9));
      motions_[i] = m;
    }
  }

  void step(int k, std::vector<Episode>* episodes) {
    MachineInputs words{};
    SourceLaw::Inputs si{};
    for (std::size_t i = 0; i < motions_.size(); ++i) {
      const Format f = i % 3 == 1 ? c_.target.velocity : c_.target.torque;
      const Real scale =
          i % 3 == 0 ? kTurn / c_.target.counts_per_turn : std::ldexp(Real{1}, -f.fraction);
      const double end = std::ldexp(1.0, f.integer + f.fraction) - 1;
      const double word = std::nearbyint(static_cast<double>(motions_[i].at(k, random_) / scale));
      words[i] = static_cast<std::int32_t>(
          std::clamp(word, i % 3 == 0 ? -Target::position_counts : -end - 1,
                     i % 3 == 0 ? Target::position_counts : end));
      si[i] = words[i] * scale;
    }
    law_.run(si);
    const MachineRun& run = machine_.run(c_.target.thread, words);
    ++result_.runs;
    for (std::size_t o = 0; o < episodes->size(); ++o) {
      const int axis = c_.law.outputs[o].axis;
      const double torque = std::ldexp(run.outputs[at(axis)], -c_.target.torque.fraction);
      const auto given = static_cast<double>(law_.torque(axis));
      const double off = std::fabs(torque - given);
      result_.most[o] = larger(result_.most[o], off);
      Episode& e = (*episodes)[o];
      e.law = hull(e.law, {given, given});
      e.words = hull(e.words, {torque, torque});
      e.off.push_back(off);
      reached_[o] = hull(reached_[o], {given, given});
    }
  }

  void count(const std::vector<Episode>& start) {
    bool acts = false, left = false;
    for (std::size_t o = 0; o < start.size(); ++o) {
      const Episode& e = start[o];
      // An idle bound excuses no more than as much again, or a last bit.
      const Span r = reached_[o];
      const double share = kLargeError * (r.width() > 0 ? r.width() : r.size());
      const double most = std::max(share, std::ldexp(1.0, -c_.target.torque.fraction));
      const double large = share + std::min(c_.bound.output[o] * (1 + 1e-9) + 1e-9, most);
      acts = acts || std::max(e.law.width(), e.words.width()) > large;
      const auto apart = std::count_if(e.off.begin(), e.off.end(),
                                       [large](double off) { return !(off <= large); });
      left = left || static_cast<double>(apart) > kLargeRuns * static_cast<double>(e.off.size());
    }
    if (acts || left) ++result_.acting;
    if (left) ++result_.left;
  }

  const Compiled& c_;
  const Law read_;
  SourceLaw law_;
  Machine machine_;
  SplitMix64 random_;
  std::array<Motion, EngineMap::input_axis_words * kAxes> motions_;
  std::vector<std::vector<Episode>> starts_;
  std::vector<Span> reached_;  ///< by the law, of each output
  FreeRuns result_;
};

}  // namespace

FreeRuns measure_free(const Compiled& c, std::uint64_t seed, std::int64_t runs) {
  if (c.law.source.empty()) return {};
  try {
    return Free(c, seed).run(runs);
  } catch (const std::invalid_argument& e) {
    FreeRuns none;
    none.unknown = e.what();
    return none;
  }
}

}  // namespace feltgate::law
