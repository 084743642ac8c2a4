// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The judge uses only the results of the compiler: bounds, strips by their lines, the words and
// their scales. It uses nothing of the way in which the compiler found them.
#include "judge.hpp"

#include <algorithm>
#include <cmath>

#include "feltgate/random.hpp"
#include "law/engine/machine.hpp"
#include "law/load.hpp"

namespace feltgate::judge {

namespace {

using feltgate::law::Compiled;
using feltgate::law::ImageWord;

class Judge {
 public:
  Judge(const Law& law, const Printer& printer, const Compiled& c, std::uint64_t seed)
      : law_(law),
        c_(c),
        evaluator_(law),
        random_(seed),
        machine_(memory(c.image)),
        strips_(printer, c) {
    before_.rate_hz = c.rate_hz;
    before_.params.assign(law.params.size(), 0);
    before_.inputs.assign(9, 0);
    int filters = 0;
    for (const State& s : law.states) {
      const bool filter = s.follows && printer.needed(s.name);
      const long i = index(c.law.states, filter ? fmt::format("lowpass_{}", ++filters) : s.name);
      const bool unread = i >= 0 && !is_read(c.program, i);
      state_index_.push_back(unread ? -1 : i);
      verdict_.unread_states += unread ? 1 : 0;
    }
    for (const Line& l : law.lines) line_index_.push_back(index(c.law.lines, l.name));
    set_parameters(true);
    enter();
  }

  Verdict run(int runs) {
    for (int i = 0; i < runs && verdict_.failure.empty(); ++i) {
      if (i > 0 && i % 40 == 0) set_parameters(false);
      if (i % 200 == 0) {
        enter();
      } else if (i % 4 == 2) {
        scatter();
      }
      if (i % 16 == 15) {
        aim();
      } else {
        inputs(&words_);
        step(false);
      }
      resync();
    }
    for (int i = 0; i < 12 && verdict_.failure.empty(); ++i) free_run();
    const bool memory = !law_.states.empty() || !law_.lines.empty();
    if (!memory || !c_.bound.states_bounded) return verdict_;
    // A free run: law and words each continue from their own states.
    enter();
    for (int i = 0; i < runs / 2 && verdict_.failure.empty(); ++i) {
      if (i % 100 == 50) set_parameters(false);
      if (i % 150 == 0) enter();
      inputs(&words_);
      if (step(false)) resync();
    }
    return verdict_;
  }

 private:
  void fail(const std::string& what) {
    if (verdict_.failure.empty()) verdict_.failure = what;
  }

  void set_parameters(bool initial) {
    std::vector<double> values;
    for (const ImageWord& w : c_.image.words) {
      if (!w.formula.empty()) continue;
      const std::int64_t width = std::int64_t{w.upper} - w.lower;
      const std::int64_t pick = random_.below(4);
      std::int64_t word = initial     ? w.initial
                          : pick == 0 ? w.lower
                          : pick == 1 ? w.upper
                                      : w.lower + random_.below(width + 1);
      double value = static_cast<double>(word) * w.scale;
      if (w.whole) value = std::nearbyint(value);
      values.push_back(value);
    }
    const std::vector<std::int32_t> words = law::parameter_words(c_.image, values);
    for (int bank = 0; bank < 2; ++bank) {
      for (int i = 0; i < 32; ++i) machine_.set_parameter(i, words[at(i)]);
      machine_.commit();
    }
    for (std::size_t p = 0; p < law_.params.size(); ++p) {
      const Param& param = law_.params[p];
      for (const ImageWord& w : c_.image.words) {
        if (!w.formula.empty() || w.name != param.name) continue;
        before_.params[p] = words[at(w.word)] * w.scale;
        const std::string wrong = wrong_word(param, w, words[at(w.word)], initial);
        if (!wrong.empty()) fail(wrong);
      }
    }
  }

  void enter() {
    machine_.enter();
    before_.states.clear();
    for (const State& s : law_.states) before_.states.push_back(s.initial);
    before_.lines.clear();
    for (const Line& l : law_.lines) before_.lines.emplace_back(at(l.length), Real{0});
    held_.assign(law_.events.size(), 0);
    for (std::size_t k = 0; k < law_.states.size(); ++k) {
      if (c_.bound.states_bounded || state_index_[k] < 0 || noise(k)) continue;
      before_.states[k] = first(law_.states[k], c_.program.states[at(state_index_[k])]);
    }
  }

  /// From the law's own first values on, without a look at the words' states: what is wrong in both
  /// after resync() shows here.
  void free_run() {
    constexpr int runs = 60;
    set_parameters(false);
    enter();
    for (std::size_t k = 0; k < law_.states.size(); ++k) before_.states[k] = law_.states[k].initial;
    std::vector<std::vector<double>> off(law_.torques.size());
    std::vector<law::Span> moved(law_.torques.size(), law::Span{law::infinity, -law::infinity});
    for (int i = 0; i < runs; ++i) {
      inputs(&words_);
      set_inputs(words_);
      law::MachineInputs in{};
      for (std::size_t k = 0; k < 9; ++k) in[k] = static_cast<std::int32_t>(words_[k]);
      const Outcome o = evaluator_.run(before_, {});
      run_ = machine_.run(c_.target.thread, in);
      for (std::size_t axis = 0; axis < off.size(); ++axis) {
        const auto given = static_cast<double>(o.torques[axis]);
        const double torque = std::ldexp(run_.outputs[axis], -c_.target.torque.fraction);
        off[axis].push_back(std::fabs(torque - given));
        moved[axis] = law::hull(moved[axis], law::hull({given, given}, {torque, torque}));
      }
      after(o);
    }
    bool acts = false, left = false;
    for (std::size_t k = 0; k < c_.law.outputs.size(); ++k) {
      const std::size_t axis = at(c_.law.outputs[k].axis);
      const double large = c_.bound.output[k] + 0.05 * moved[axis].width() + 1e-9;
      acts = acts || moved[axis].width() > 2 * large;
      left = left || std::count_if(off[axis].begin(), off[axis].end(),
                                   [large](double x) { return !(x <= large); }) > runs / 10;
    }
    verdict_.acting += acts || left ? 1 : 0;
    verdict_.left += left ? 1 : 0;
  }

  bool noise(std::size_t k) const {
    return state_index_[k] >= 0 && !law_.states[k].next && !law_.states[k].follows;
  }
  int address(std::size_t state) const {
    return c_.target.thread * EngineMap::private_words + c_.assembled.state_address[state];
  }
  std::int32_t data(std::size_t state) const { return machine_.memory().data_at(address(state)); }
  Real state(std::size_t k) const {
    return data(k) * static_cast<Real>(c_.program.states[k].scale);
  }
  /// Returns the value written into line k `ago` runs ago.
  Real kept(std::size_t k, int ago) const {
    const law::LineUse& use = c_.program.lines[k];
    const int length = c_.law.lines[k].length, next = data(at(use.pointer)) / 4096;
    const int word = c_.program.tables[at(use.table)].base + (next + length - ago) % length;
    return static_cast<std::int32_t>(machine_.memory().table_at(word)) *
           static_cast<Real>(use.scale);
  }

  /// Sets random states in their ranges; the bound of a run holds from these as well.
  void scatter() {
    for (const long k : state_index_) {
      if (k < 0) continue;
      const law::StateUse& use = c_.program.states[at(k)];
      const std::int64_t width = std::int64_t{use.upper} - use.lower;
      const std::int64_t corner = random_.below(8);
      const std::int64_t word = corner == 0   ? use.lower
                                : corner == 1 ? use.upper
                                              : use.lower + random_.below(width + 1);
      // The word of a whole state always stands for a whole number.
      const auto one = static_cast<std::int64_t>(std::llround(1 / use.scale));
      const std::int64_t off = c_.law.states[at(k)].whole ? ((word % one) + one) % one : 0;
      machine_.memory().set_data(address(at(k)), static_cast<std::int32_t>(word - off));
    }
    resync();
  }

  /// Sets the law's states to those of the words. `own_` are those of the law, or the ends of their
  /// ranges, where they have the same words: a state's step need not divide its ends.
  void resync() {
    own_ = before_.states;
    for (std::size_t k = 0; k < law_.states.size(); ++k) {
      if (state_index_[k] < 0) continue;
      const Real word = state(at(state_index_[k]));
      const Real half = c_.program.states[at(state_index_[k])].scale / 2;
      for (const double end : {law_.states[k].lower, law_.states[k].upper}) {
        if (!(std::fabs(own_[k] - word) <= half)) own_[k] = end;
      }
      if (!(std::fabs(own_[k] - word) <= half)) own_[k] = word;
      before_.states[k] = word;
    }
    for (std::size_t k = 0; k < law_.lines.size(); ++k) {
      if (line_index_[k] < 0) continue;
      for (int ago = 1; ago <= law_.lines[k].length; ++ago) {
        before_.lines[k][at(ago - 1)] = kept(at(line_index_[k]), ago);
      }
    }
    for (std::size_t e = 0; e < law_.events.size(); ++e)
      held_[e] = data(c_.law.states.size() + e) != 0;
  }

  void inputs(Inputs* words) { random_inputs(c_.target, random_, words); }
  void set_inputs(const Inputs& words) {
    for (std::size_t i = 0; i < 9; ++i) before_.inputs[i] = input_si(c_.target, i, words[i]);
  }

  /// Searches, between two random inputs, for inputs at which a comparison changes its result.
  void aim() {
    Inputs from, to;
    inputs(&from);
    inputs(&to);
    set_inputs(from);
    const Outcome a = evaluator_.run(before_, {});
    set_inputs(to);
    const Outcome b = evaluator_.run(before_, {});
    std::vector<Decision> turn;
    for (const Decision& d : a.decisions) {
      for (const Decision& e : b.decisions) {
        if (d.key == e.key && d.taken != e.taken) turn.push_back(d);
      }
    }
    words_ = to;
    if (!turn.empty()) {
      const Decision d = turn[at(random_.below(static_cast<std::int64_t>(turn.size())))];
      const auto between = [&](std::int64_t t) {
        for (std::size_t i = 0; i < 9; ++i) {
          words_[i] = from[i] + (((to[i] - from[i]) * t) >> 28);
        }
      };
      std::int64_t low = 0, high = std::int64_t{1} << 28;
      while (high - low > 1) {
        const std::int64_t middle = (low + high) / 2;
        between(middle);
        set_inputs(words_);
        const Outcome o = evaluator_.run(before_, {});
        bool same = false;
        for (const Decision& e : o.decisions) same = same || (e.key == d.key && e.taken == d.taken);
        (same ? low : high) = middle;
      }
      between(random_.below(2) == 0 ? low : high);
    }
    step(true);
  }

  /// Runs words and law once. Returns whether only a turned comparison explains the words.
  bool step(bool aimed) {
    set_inputs(words_);
    law::MachineInputs inputs{};
    for (std::size_t i = 0; i < 9; ++i) inputs[i] = static_cast<std::int32_t>(words_[i]);
    Outcome o = evaluator_.run(before_, {});
    run_ = machine_.run(c_.target.thread, inputs);
    if (!run_.ended) fail("the run does not end");
    difference_.clear();
    double far = apart(o, true);
    if (far > 1 && !own_.empty()) {
      Before own = before_;
      own.states = own_;
      const Outcome other = evaluator_.run(own, {});
      if (apart(other, false) <= 1) {
        o = other;
        far = 0;
      }
    }
    own_.clear();
    (aimed ? verdict_.aimed : verdict_.runs) += 1;
    bool turned = false;
    if (far <= 1) {
      verdict_.worst = std::max(verdict_.worst, far);
      after(o);
    } else {
      for (int turns = 1; turns <= 5 && !turned; ++turns) {
        tries_ = 0;
        turned = explain(o, {}, turns);
      }
      turned = turned || told(o);
      (aimed ? verdict_.aimed_turned : verdict_.turned) += 1;
      if (!turned) fail(difference_ + near(o));
      if (verdict_.first_turned.empty()) verdict_.first_turned = difference_ + near(o);
    }
    return turned;
  }

  void after(const Outcome& o) {
    before_.states = o.states;
    for (std::size_t k = 0; k < law_.states.size(); ++k) {
      if (noise(k)) before_.states[k] = state(at(state_index_[k]));
    }
    for (std::size_t k = 0; k < law_.lines.size(); ++k) {
      before_.lines[k].insert(before_.lines[k].begin(), o.written[k]);
      before_.lines[k].pop_back();
    }
    held_ = o.holds;
  }

  /// Returns whether the declared strips of this run allow a difference of torque this large.
  bool told(const Outcome& o) const {
    for (std::size_t k = 0; k < c_.law.outputs.size(); ++k) {
      const std::size_t axis = at(c_.law.outputs[k].axis);
      double most = c_.bound.output[k] * (1 + 1e-9) + 1e-10;
      std::set<std::string> counted;
      for (const Decision& d : o.decisions) {
        const double w = strips_.width(d);
        if (d.exact || !(w > 0) || !(d.distance <= w) || !counted.insert(*d.canonical).second)
          continue;
        most += strips_.jump(d, k);
      }
      const Real torque =
          std::ldexp(static_cast<Real>(run_.outputs[axis]), -c_.target.torque.fraction);
      if (!(std::fabs(torque - o.torques[axis]) <= most)) return false;
    }
    return difference_.rfind("torque", 0) == 0;
  }

  /// Returns whether words and law agree if so many comparisons, all within their strips, give
  /// another result. Gives up after 400 tries.
  bool explain(const Outcome& o, const std::map<long, long>& forced, int turns) {
    for (const Decision& d : o.decisions) {
      if (forced.count(d.key) != 0) continue;
      for (const long result : strips_.other_results(d)) {
        if (++tries_ > 400) return false;
        std::map<long, long> more = forced;
        more[d.key] = result;
        const Outcome other = evaluator_.run(before_, more);
        if (turns == 1 ? apart(other, false) <= 1 : explain(other, more, turns - 1)) return true;
      }
    }
    return false;
  }

  /// Returns the largest distance between words and law after a run, divided by its bound; more
  /// than 1 is a failure. NaN counts as a failure.
  double apart(const Outcome& o, bool tell) {
    double far = 0;
    const auto one = [&](const std::string& what, Real words, Real law, double bound, Real width) {
      Real d = std::fabs(words - law);
      if (width > 0) d = std::min(d, std::fabs(width - d));
      const bool near = d <= bound * (1 + 1e-9) + 1e-10;
      const double r = !near ? 2 : bound > 0 ? std::min(1.0, static_cast<double>(d) / bound) : 0;
      if (r > 1 && tell && difference_.empty()) {
        difference_ = fmt::format("{}: words {:.9g}, law {:.9g}, apart {:.3g}, bound {:.3g}", what,
                                  static_cast<double>(words), static_cast<double>(law),
                                  static_cast<double>(d), bound);
      }
      far = std::max(far, r);
    };
    for (std::size_t k = 0; k < c_.law.outputs.size(); ++k) {
      const std::size_t axis = at(c_.law.outputs[k].axis);
      const Real torque =
          std::ldexp(static_cast<Real>(run_.outputs[axis]), -c_.target.torque.fraction);
      one(fmt::format("torque {}", axis), torque, o.torques[axis], c_.bound.output[k], 0);
    }
    for (std::size_t k = 0; k < law_.states.size(); ++k) {
      const State& s = law_.states[k];
      if (state_index_[k] < 0 || noise(k)) continue;
      const std::size_t i = at(state_index_[k]);
      const double bound = s.whole                   ? 0
                           : c_.bound.states_bounded ? c_.bound.state[i]
                                                     : c_.bound.drift[i];
      one("state " + s.name, state(i), o.states[k], bound, s.phase ? Real{s.upper} - s.lower : 0);
    }
    for (std::size_t k = 0; k < law_.lines.size() && c_.bound.states_bounded; ++k) {
      if (line_index_[k] < 0) continue;
      const double bound = c_.bound.state[c_.law.states.size() + at(line_index_[k])];
      one("line " + law_.lines[k].name, kept(at(line_index_[k]), 1), o.written[k], bound, 0);
    }
    for (std::size_t e = 0; e < law_.events.size(); ++e) {
      const bool happens = o.holds[e] != 0 && held_[e] == 0;
      const int number = static_cast<int>(e) + 1;
      bool told = false;
      for (const law::MachineEvent& event : run_.events) {
        if (event.number != number) continue;
        told = true;
        double bound = 0;
        for (std::size_t s = 0; s < c_.program.steps.size(); ++s) {
          const law::Step& step = c_.program.steps[s];
          if (step.event == number) bound = c_.bound.errors[s] * std::fabs(step.scale);
        }
        if (happens) {
          one("event " + law_.events[e].name,
              event.value * static_cast<Real>(c_.image.events[e].scale), o.events[e], bound, 0);
        }
      }
      if (told != happens || (data(c_.law.states.size() + e) != 0) != (o.holds[e] != 0)) {
        one("event " + law_.events[e].name + " happens", told ? 1 : 0, happens ? 1 : 2, 0, 0);
      }
    }
    return far;
  }

  std::string near(const Outcome& o) const {
    std::string s;
    const auto tell = [&s](const std::string& name, Real x) {
      s += fmt::format("\n  {} = {:.9g}", name, static_cast<double>(x));
    };
    for (std::size_t p = 0; p < law_.params.size(); ++p)
      tell(law_.params[p].name, before_.params[p]);
    for (std::size_t k = 0; k < law_.states.size(); ++k)
      tell(law_.states[k].name, before_.states[k]);
    s += "\n  inputs";
    for (const Real x : before_.inputs) s += fmt::format(" {:.9g}", static_cast<double>(x));
    for (const Decision& d : o.decisions) {
      if (d.distance < 0.01L || d.distance <= strips_.width(d)) {
        s += fmt::format("\n  {}: {:.3g} from turning, strip {:.3g}{}", *d.canonical,
                         static_cast<double>(d.distance), strips_.width(d),
                         d.exact ? ", whole" : "");
      }
    }
    return s;
  }

  const Law& law_;
  const Compiled& c_;
  Evaluator evaluator_;
  SplitMix64 random_;
  law::Machine machine_;
  law::MachineRun run_;
  Strips strips_;
  std::vector<long> state_index_, line_index_;
  Before before_;
  std::vector<Real> own_;
  std::vector<char> held_;
  Inputs words_{};
  Verdict verdict_;
  std::string difference_;
  int tries_ = 0;
};

}  // namespace

Verdict judge(const Law& law, const Printer& printer, const Compiled& compiled, std::uint64_t seed,
              int runs) {
  return Judge(law, printer, compiled, seed).run(runs);
}

}  // namespace feltgate::judge
