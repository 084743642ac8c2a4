// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Documentation: docs/bench.md
#include "studies/bench/law_speed.hpp"

#include <array>

#include "feltgate/random.hpp"
#include "law/compile.hpp"
#include "law/engine/law_runner.hpp"
#include "laws/shipped.hpp"
#include "studies/bench/cpu_time.hpp"

namespace feltgate::bench {

namespace {

constexpr std::size_t input_sets = 1024;

/// Positions, velocities and torques of a lever in a hand, as words.
std::vector<law::MachineInputs> some_inputs() {
  SplitMix64 random(1);
  std::vector<law::MachineInputs> all(input_sets);
  for (law::MachineInputs& in : all) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      in[3 * axis] = static_cast<std::int32_t>(random.below(4096) - 2048);
      in[3 * axis + 1] = static_cast<std::int32_t>(random.below(1 << 26) - (1 << 25));
      in[3 * axis + 2] = static_cast<std::int32_t>(random.below(1 << 16) - (1 << 15));
    }
  }
  return all;
}

}  // namespace

class LawBench::Runs {
 public:
  virtual ~Runs() = default;
  virtual void add(LawSamples* s) = 0;
};

namespace {

/// ns of one of the runs.
template <class Law>
double compiled_ns(Law* law, const std::vector<typename Law::Inputs>& inputs, int times) {
  const double s = cpu_seconds([&] {
    for (int k = 0; k < times; ++k) {
      for (const auto& in : inputs) {
        law->run(in);
        // The result is in memory after each run, whoever may read it.
        asm volatile("" : : "r"(law) : "memory");
      }
    }
  });
  return 1e9 * s / (static_cast<double>(times) * static_cast<double>(inputs.size()));
}

}  // namespace

namespace {

template <template <class> class Law, class Base>
class RunsOf : public Base {
 public:
  explicit RunsOf(const law::Image& image) {
    EngineMemory memory;
    memory.program = image.program;
    memory.data = image.data;
    memory.table = image.table;
    memory.line_base = image.line_base;
    machine_ = law::Machine(memory);
    words_ = some_inputs();
    for (const law::MachineInputs& in : words_) {
      fixed_inputs_.emplace_back();
      real_inputs_.emplace_back();
      for (std::size_t n = 0; n < Law<Fixed>::inputs.size(); ++n) {
        const law::LawInput& of = Law<Fixed>::inputs[n];
        const std::int32_t word = in[static_cast<std::size_t>(3 * of.axis + of.source)];
        fixed_inputs_.back()[n] = law::LawOps<Fixed>::word(word);
        real_inputs_.back()[n] = word;
      }
    }
  }
  void add(LawSamples* s) override {
    const int times = 4000 / Law<Fixed>::instructions + 1;
    s->compiled.push_back(compiled_ns(&fixed_, fixed_inputs_, times));
    s->real.push_back(compiled_ns(&real_, real_inputs_, times));
    const int fewer = times / 8 + 1;
    const double seconds = cpu_seconds([&] {
      for (int k = 0; k < fewer; ++k) {
        for (const law::MachineInputs& in : words_) {
          const law::MachineRun& run = machine_.run(0, in);
          asm volatile("" : : "r"(&run) : "memory");
        }
      }
    });
    s->interpreted.push_back(1e9 * seconds / (fewer * static_cast<double>(words_.size())));
  }

 private:
  Law<Fixed> fixed_;
  Law<Real<double>> real_;
  law::Machine machine_;
  std::vector<law::MachineInputs> words_;
  std::vector<typename Law<Fixed>::Inputs> fixed_inputs_;
  std::vector<typename Law<Real<double>>::Inputs> real_inputs_;
};

template <class Base>
struct Collect {
  const std::string& folder;
  std::vector<std::unique_ptr<Base>>& runs;
  std::vector<LawSamples>& samples;

  template <template <class> class Law>
  void law() {
    const std::string name = Law<Fixed>::name;
    const law::Compiled c = law::compile_file(folder + "/" + name + ".law", law::Target{});
    runs.push_back(std::make_unique<RunsOf<Law, Base>>(c.image));
    samples.push_back({name, Law<Fixed>::instructions, {}, {}, {}});
  }
};

}  // namespace

LawBench::LawBench(const std::string& folder) {
  laws::visit_shipped(Collect<Runs>{folder, runs_, samples_});
}
LawBench::~LawBench() = default;

void LawBench::repeat() {
  for (std::size_t n = 0; n < runs_.size(); ++n) runs_[n]->add(&samples_[n]);
}

}  // namespace feltgate::bench
