// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Runs some of the random laws on the RTL: its words must equal the words of the interpreter, which
// the judge compares with the laws.
#include "engine_device.hpp"
#include "generate.hpp"
#include "law/compile.hpp"
#include "law/diagnostics.hpp"
#include "law/engine/machine.hpp"
#include "law/load.hpp"
#include "strips.hpp"

namespace feltgate::judge {
namespace {

std::int64_t lived = 0, told = 0;

/// Loads and enters the law, and makes `runs` runs with random inputs and parameters.
void live(const law::Compiled& c, std::uint64_t seed, int runs) {
  SplitMix64 random(seed);
  test::LoadedDevice device(law::memory(c.image));
  device.clock(100);                      // until the last word is written
  EngineMemory m = device.twin.memory();  // one bank of parameters is not set yet
  m.line_base = c.image.line_base;
  law::Machine machine(m);
  device.since = -10000;  // no tick while the lines are cleared
  device.write(test::H::divider0, 1);
  device.write(test::H::run, 1);
  device.clock(1000);
  machine.enter();
  for (int k = 0; k < runs; ++k) {
    if (k % 10 == 0) {
      device.since = -20000;
      std::vector<double> values;
      for (const law::ImageWord& w : c.image.words) {
        if (!w.formula.empty()) continue;
        const std::int64_t word = w.lower + random.below(std::int64_t{w.upper} - w.lower + 1);
        values.push_back(static_cast<double>(word) * w.scale);
      }
      const std::vector<std::int32_t> words = law::parameter_words(c.image, values);
      for (int i = 0; i < EngineMap::parameter_words; ++i) {
        const std::int32_t word = words[static_cast<std::size_t>(i)];
        machine.set_parameter(i, word);
        device.write(EngineMap::D::parameter + test::H::data + i, static_cast<std::uint32_t>(word));
      }
      machine.commit();
      device.write(test::H::commit, 1);
      device.clock(4000);  // the check of all words
    }
    Inputs words;
    random_inputs(c.target, random, &words);
    law::MachineInputs inputs{};
    for (std::size_t n = 0; n < AXES; ++n) {
      device.in.position[n] = inputs[3 * n] = static_cast<std::int32_t>(words[3 * n]);
      device.in.velocity[n] = inputs[3 * n + 1] = static_cast<std::int32_t>(words[3 * n + 1]);
      device.in.tau_hat[n] = inputs[3 * n + 2] = static_cast<std::int32_t>(words[3 * n + 2]);
    }
    device.clock();  // a tick samples the inputs of the clock before it
    device.since = test::kTick - 1;
    inputs[9] = static_cast<std::int32_t>(device.in.tick_count + 1);
    const law::MachineRun& run = machine.run(0, inputs);
    REQUIRE(run.ended);
    std::size_t events = 0;
    device.clock();
    for (int clock = 0; clock < 6 * (run.instructions + 8); ++clock) {
      if (device.out().event_valid) {
        REQUIRE(events < run.events.size());
        REQUIRE(device.out().event_number == run.events[events].number);
        REQUIRE(device.out().event_value == run.events[events].value);
        ++events;
      }
      device.since = 1;  // no tick during a run
      device.clock();
    }
    REQUIRE(events == run.events.size());
    for (std::size_t n = 0; n < AXES; ++n) {
      if ((run.written >> n & 1U) == 0) continue;
      REQUIRE(device.out().torque[n] == std::clamp(run.outputs[n], -(1 << 20), (1 << 20) - 1));
    }
    REQUIRE(device.twin.memory().data == machine.memory().data);
    REQUIRE(device.twin.memory().table == machine.memory().table);
    ++lived;
    told += static_cast<std::int64_t>(events);
  }
  device.play();
}

TEST_CASE("random laws on the RTL: torques, events and words of the interpreter") {
  law::Target target;
  target.axes = AXES;
  // One law of each shape.
  for (std::uint64_t seed = 1; seed <= shapes; ++seed) {
    const Law law = random_law(seed, static_cast<Shape>(seed - 1));
    const std::string text = Printer(law).text();
    INFO(text);
    try {
      live(law::compile_text(text, "random.law", target), seed, 60);
    } catch (const law::LawError& e) {
      WARN(e.what());
    }
  }
  CAPTURE(lived, told);
  CHECK(lived >= 5 * 60);
  CHECK(told > 0);
}

}  // namespace
}  // namespace feltgate::judge
