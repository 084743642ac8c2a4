// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The C++ of laws in fixed point: the interpreter's words and the clocked engine's, bit for bit.
// Documentation: docs/law-compiler.md
#include "law_cpp_bench.hpp"

#include <deque>
#include <map>

#include "catch.hpp"
#include "feltgate/engine.hpp"
#include "laws/constructs.hpp"
#include "mismatch.hpp"

namespace feltgate::test {
namespace {

using law::CompiledLaw;
using law::Machine;
using law::MachineInputs;
using law::MachineRun;

void require_same(const MachineRun& a, const MachineRun& b) {
  const bool same =
      a.written == b.written && a.outputs == b.outputs && a.events.size() == b.events.size();
  if (!same) REQUIRE(a.outputs == b.outputs);
  REQUIRE(same);
  for (std::size_t n = 0; n < a.events.size(); ++n) {
    REQUIRE(a.events[n].number == b.events[n].number);
    REQUIRE(a.events[n].value == b.events[n].value);
  }
}

struct Seen {
  std::map<std::int32_t, int> torques;
  std::int64_t events = 0, runs = 0;
};

/// Against the interpreter of the image that the same file gives here.
struct AgainstMachine {
  std::int64_t runs;
  std::map<std::string, Seen>& seen;

  template <template <class> class Law>
  void law() {
    const law::Compiled& c = compiled_law(Law<Fixed>::name);
    INFO(c.law.name);
    REQUIRE(Law<Fixed>::image_crc == law::crc(c.image));
    REQUIRE(Law<Fixed>::instructions == static_cast<int>(c.assembled.instructions.size()));
    REQUIRE(Law<Fixed>::ticks_per_run == c.divider);
    CompiledLaw<Law> compiled(law::memory(c.image));
    Machine machine(law::memory(c.image));
    Stimulus stimulus(7);
    Seen& s = seen[c.law.name];
    for (std::int64_t n = 0; n < runs; ++n) {
      if (stimulus.one_in(50)) {
        const std::vector<std::int32_t> words =
            law::parameter_words(c.image, stimulus.values(c.image));
        for (int w = 0; w < EngineMap::parameter_words; ++w) {
          compiled.set_parameter(w, words[static_cast<std::size_t>(w)]);
          machine.set_parameter(w, words[static_cast<std::size_t>(w)]);
        }
      }
      // Without a commit in between the host has written twice.
      if (stimulus.one_in(70)) {
        compiled.commit();
        machine.commit();
      }
      if (stimulus.one_in(200)) {
        compiled.enter();
        machine.enter();
      }
      const MachineInputs in = stimulus.inputs();
      const MachineRun& a = compiled.run(in);
      const MachineRun& b = machine.run(0, in);
      require_same(a, b);
      if (s.torques.size() < 100) ++s.torques[a.outputs[0]];
      s.events += static_cast<std::int64_t>(a.events.size());
      ++s.runs;
    }
  }
};

TEST_CASE("C++ of laws: every word of the interpreter, parameters and entries in between") {
  std::map<std::string, Seen> seen;
  visit_shipped(AgainstMachine{scaled_clocks(whole_run() ? 100'000 : 30'000), seen});
  laws::visit_constructs(AgainstMachine{scaled_clocks(20'000), seen});
  for (const auto& [name, s] : seen) {
    INFO(name);
    CHECK(s.torques.size() >= 3);  // a membrane's are few
  }
  CHECK(seen["echo"].events > 1000);
}

/// The clocked engine with the image, its host and its ticks.
template <int Axes>
class Clocked {
 public:
  using H = EngineMap::H;
  explicit Clocked(const law::Compiled& c) : c_(c), engine_(0xffff) {
    engine_.reset();
    engine_.memory() = law::memory(c.image);
    write(H::line_base, c.image.line_base);
    write(H::divider0, c.divider);
    write(H::run, 1);
  }
  void write(int address, std::int32_t word) {
    in_.addr = static_cast<unsigned>(address);
    in_.wdata = static_cast<std::uint32_t>(word);
    in_.write = true;
    clock();
    in_.write = false;
    // The check of a commit begins behind the words that are still on their way.
    for (int k = 0; k < 4 || engine_.out().busy; ++k) clock();
  }
  void set(const std::vector<std::int32_t>& words) {
    for (const law::ImageWord& w : c_.image.words) {
      write(H::data + EngineMap::D::parameter + w.word, words[static_cast<std::size_t>(w.word)]);
    }
    write(H::commit, 1);
  }
  void enter() {
    in_.enter = true;
    clock();
    in_.enter = false;
  }
  /// A tick in which a run begins, and those up to the next.
  void run(const MachineInputs& words) {
    for (std::size_t n = 0; n < Axes; ++n) {
      in_.position[n] = words[3 * n];
      in_.velocity[n] = words[3 * n + 1];
      in_.tau_hat[n] = words[3 * n + 2];
    }
    for (int k = 0; k < c_.divider * c_.target.clocks_per_tick; ++k) {
      in_.tick = k % c_.target.clocks_per_tick == 0;
      in_.tick_count += in_.tick ? 1 : 0;
      clock();
    }
  }
  /// Until what began has ended.
  void settle() {
    for (int k = 0; k < 4000; ++k) clock();
  }
  std::deque<std::array<std::int32_t, Axes>> torques;
  std::deque<law::MachineEvent> events;

 private:
  void clock() {
    engine_.clock(in_);
    in_.tick = false;
    const auto out = engine_.out();
    if (out.fresh) torques.push_back(out.torque);
    if (out.event_valid) events.push_back({out.event_number, out.event_value});
  }

  const law::Compiled& c_;
  law::Engine<Axes> engine_;
  typename law::Engine<Axes>::In in_;
};

/// Against the clocked engine, for so many ticks.
struct AgainstEngine {
  std::int64_t ticks;

  template <template <class> class Law>
  void law() {
    const law::Compiled& c = compiled_law(Law<Fixed>::name);
    INFO(c.law.name);
    c.target.axes == 1   ? law_of<Law, 1>(c)
    : c.target.axes == 2 ? law_of<Law, 2>(c)
                         : law_of<Law, 3>(c);
  }
  template <template <class> class Law, int Axes>
  void law_of(const law::Compiled& c) {
    Clocked<Axes> engine(c);
    CompiledLaw<Law> compiled(law::memory(c.image));
    Stimulus stimulus(11);
    std::deque<std::array<std::int32_t, Axes>> torques;
    std::deque<law::MachineEvent> events;
    const std::int64_t runs = std::max<std::int64_t>(ticks / c.divider, 300);
    for (std::int64_t n = 0; n < runs; ++n) {
      if (stimulus.one_in(100)) {
        engine.settle();
        if (stimulus.one_in(2)) {
          engine.enter();
          engine.settle();  // lines become zeros
          compiled.enter();
        } else {
          const auto words = law::parameter_words(c.image, stimulus.values(c.image));
          engine.set(words);
          for (int w = 0; w < EngineMap::parameter_words; ++w) {
            compiled.set_parameter(w, words[static_cast<std::size_t>(w)]);
          }
          compiled.commit();
        }
      }
      const MachineInputs in = stimulus.inputs();
      engine.run(in);
      const MachineRun& run = compiled.run(in);
      torques.emplace_back();
      for (std::size_t axis = 0; axis < Axes; ++axis) {
        torques.back()[axis] = std::clamp(run.outputs[axis], -(1 << 20), (1 << 20) - 1);
      }
      events.insert(events.end(), run.events.begin(), run.events.end());
      compare(&engine, &torques, &events);
    }
    engine.settle();
    compare(&engine, &torques, &events);
    REQUIRE(torques.empty());
    REQUIRE(events.empty());
  }
  template <int Axes, class Torques, class Events>
  static void compare(Clocked<Axes>* engine, Torques* torques, Events* events) {
    while (!engine->torques.empty()) {
      REQUIRE(engine->torques.front() == torques->front());
      engine->torques.pop_front();
      torques->pop_front();
    }
    while (!engine->events.empty()) {
      REQUIRE(engine->events.front().number == events->front().number);
      REQUIRE(engine->events.front().value == events->front().value);
      engine->events.pop_front();
      events->pop_front();
    }
    REQUIRE(torques->size() <= 1);
  }
};

TEST_CASE("C++ of laws: every torque and event of the engine's twin, clock by clock") {
  visit_shipped(AgainstEngine{scaled_clocks(whole_run() ? 100'000 : 30'000)});
  laws::visit_constructs(AgainstEngine{scaled_clocks(3'000)});
}

/// A host's words from values: those that the header computes.
struct AgainstHost {
  template <template <class> class Law>
  void law() {
    const law::Compiled& c = compiled_law(Law<Fixed>::name);
    INFO(c.law.name);
    REQUIRE(Law<Fixed>::words.size() == c.image.words.size());
    Stimulus stimulus(5);
    SplitMix64 random(6);
    for (int n = 0; n < 1000; ++n) {
      std::vector<double> values = stimulus.values(c.image);
      for (double& v : values) v *= random.between(0.9, 1.1);
      std::array<double, Law<Fixed>::parameters> own{};
      for (std::size_t k = 0; k < own.size(); ++k) own[k] = values[k];
      const auto words = law::law_words<Law<Fixed>>(own);
      const std::vector<std::int32_t> host = law::parameter_words(c.image, values);
      for (std::size_t w = 0; w < words.size(); ++w) {
        REQUIRE(words[w] == host[static_cast<std::size_t>(Law<Fixed>::words[w].number)]);
      }
    }
  }
};

TEST_CASE("C++ of laws: parameter words from values are the host's") {
  visit_shipped(AgainstHost{});
  laws::visit_constructs(AgainstHost{});
}

TEST_CASE("the example of the page") {
  using Detent = laws::Detent<Fixed>;
  Detent law;
  law.set_values(std::array<double, 2>{24, 0.05});
  law.run({Detent::O::word(100)});
  const std::int32_t torque = Detent::O::raw(law.output(0));
  CHECK(std::abs(torque * Detent::outputs[0].scale +
                 0.05 * std::sin(24 * 100 * Detent::inputs[0].scale)) < 1.5e-5);
}

TEST_CASE("what runs a law: a shipped one is compiled, another is interpreted") {
  const law::Compiled &detent = compiled_law("detent"), &other = compiled_law("echo");
  CHECK(law::make_law_runner(law::memory(detent.image), law::crc(detent.image))->compiled());
  CHECK_FALSE(law::make_law_runner(law::memory(other.image), law::crc(other.image))->compiled());
  CHECK(law::shipped_laws().size() >= 11);
}

}  // namespace
}  // namespace feltgate::test
