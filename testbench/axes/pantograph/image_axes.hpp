// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Compiles a law file for a design and runs its program words in the engine's interpreter. The
// program of several axes gives the same bits as an engine. docs/devices/pantograph.md
#pragma once

#include <string>
#include <vector>

#include "axes_twin.hpp"
#include "catch.hpp"
#include "law/compile.hpp"
#include "law/engine/machine.hpp"
#include "law/load.hpp"

namespace feltgate::test {

template <std::size_t N>
class ImageAxes {
 public:
  ImageAxes(const std::string& name, const DesignInfo& design)
      : compiled_(law::compile_file(std::string(FELTGATE_SOURCE_DIR) + "/rtl/laws/" + name + ".law",
                                    law::target_of(design))),
        machine_(law::memory(compiled_.image)) {
    for (const law::ImageWord& w : compiled_.image.words) {
      if (w.formula.empty()) values_.push_back(w.initial * w.scale);
    }
    write();
  }

  /// Sets a parameter or mailbox word, in SI units.
  void set(const std::string& name, double si) {
    std::size_t i = 0;
    for (const law::ImageWord& w : compiled_.image.words) {
      if (!w.formula.empty()) continue;
      if (w.name == name) {
        values_[i] = si;
        return write();
      }
      ++i;
    }
    FAIL("the law has no parameter " << name);
  }

  /// One run of the program.
  std::array<std::int32_t, N> run(const AxesWords<N>& words) {
    law::MachineInputs inputs{};
    for (std::size_t n = 0; n < N; ++n) {
      inputs[3 * n] = words.position[n];
      inputs[3 * n + 1] = static_cast<std::int32_t>(words.velocity[n]);
      inputs[3 * n + 2] = words.tau_hat[n];
    }
    inputs[9] = static_cast<std::int32_t>(words.tick);
    const law::MachineRun& done = machine_.run(compiled_.target.thread, inputs);
    REQUIRE(done.ended);
    std::array<std::int32_t, N> torque{};
    for (std::size_t n = 0; n < N; ++n) torque[n] = done.outputs[n];
    return torque;
  }

  /// The program starts at the rate that the compiler reports; the result of a run is available at
  /// the next start.
  AxesProgram<N> program() {
    return [this, since = compiled_.divider](const AxesWords<N>& words) mutable {
      if (++since < compiled_.divider) return shown_;
      since = 0;
      shown_ = next_;
      next_ = run(words);
      return shown_;
    };
  }
  const law::Compiled& compiled() const { return compiled_; }

 private:
  void write() {
    const std::vector<std::int32_t> words = law::parameter_words(compiled_.image, values_);
    for (const law::ImageWord& w : compiled_.image.words) {
      machine_.set_parameter(w.word, words[static_cast<std::size_t>(w.word)]);
    }
    machine_.commit();
  }

  law::Compiled compiled_;
  law::Machine machine_;
  std::vector<double> values_;
  std::array<std::int32_t, N> shown_{}, next_{};
};

}  // namespace feltgate::test
