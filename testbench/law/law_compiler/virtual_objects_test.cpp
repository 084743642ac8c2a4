// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The words of a flywheel keep momentum and energy, except for the error that the bound allows per
// run. Documentation: docs/devices/one-lever.md
#include <catch2/catch.hpp>
#include <cmath>

#include "law/compile.hpp"
#include "law/engine/machine.hpp"
#include "law/load.hpp"

namespace feltgate::law {
namespace {

std::size_t at(int i) { return static_cast<std::size_t>(i); }

/// The image of the flywheel in the interpreter, its states in SI.
class Wheel {
 public:
  explicit Wheel(bool damped)
      : c_(compile_file(std::string(FELTGATE_ROOT) + "/rtl/laws/flywheel.law", Target{})),
        machine_(memory(c_.image)) {
    std::vector<double> values;
    for (const ImageWord& w : c_.image.words) {
      if (!w.formula.empty()) continue;
      const bool off = !damped && w.name == "damping";
      values.push_back(off ? 0 : w.initial * w.scale);
      if (w.name == "inertia") inertia = values.back();
      if (w.name == "stiffness") stiffness = values.back();
    }
    const std::vector<std::int32_t> words = parameter_words(c_.image, values);
    for (int i = 0; i < static_cast<int>(words.size()); ++i) {
      machine_.set_parameter(i, words[at(i)]);
    }
    machine_.commit();
    machine_.enter();
  }
  /// The torque, Nm.
  double run(std::int32_t counts) {
    MachineInputs inputs{};
    inputs[0] = counts;
    return machine_.run(c_.target.thread, inputs).outputs[0] *
           std::ldexp(1.0, -c_.target.torque.fraction);
  }
  double state(const std::string& name) const {
    const std::size_t k = number(name);
    const int address = c_.target.thread * EngineMap::private_words + c_.assembled.state_address[k];
    return machine_.memory().data_at(address) * c_.program.states[k].scale;
  }
  double drift(const std::string& name) const { return c_.bound.drift[number(name)]; }
  double bound() const { return c_.bound.output[0]; }
  double dt() const { return 1 / c_.rate_hz; }
  double inertia = 0, stiffness = 0;

 private:
  std::size_t number(const std::string& name) const {
    for (std::size_t k = 0; k < c_.law.states.size(); ++k) {
      if (c_.law.states[k].name == name) return k;
    }
    throw std::runtime_error("no state " + name);
  }
  Compiled c_;
  Machine machine_;
};

TEST_CASE("flywheel in words: torque times time is its momentum, within the bound") {
  Wheel wheel(true);
  double given = 0;
  const int runs = 100000;
  for (int i = 0; i < runs; ++i) {
    given -= wheel.dt() * wheel.run(static_cast<std::int32_t>(200 * std::sin(1e-4 * i)));
    if (i % 1000 != 0) continue;
    const double off = std::abs(wheel.inertia * wheel.state("speed") - given);
    REQUIRE(off <= (i + 1) * (wheel.inertia * wheel.drift("speed") + wheel.dt() * wheel.bound()));
  }
  CHECK(std::abs(wheel.state("speed")) > 1);
  CHECK(wheel.inertia * wheel.state("speed") == Approx(given).epsilon(1e-4));
}

TEST_CASE("flywheel in words: without damping it swings on, its energy within the bound") {
  Wheel wheel(false);
  wheel.run(0);
  wheel.run(30);  // the lever moves, then is held
  const auto energy = [&] {
    const double w = wheel.state("speed"), x = wheel.state("twist");
    return wheel.inertia * w * w / 2 + wheel.stiffness * x * x / 2;
  };
  const double before = energy(), most = std::sqrt(2 * before / wheel.inertia),
               far = std::sqrt(2 * before / wheel.stiffness);
  CHECK(far == Approx(0.046).epsilon(0.02));
  // The swing from the time step, and the error that each run may add.
  const double swing = before * std::sqrt(wheel.stiffness / wheel.inertia) * wheel.dt();
  const double added =
      wheel.inertia * most * wheel.drift("speed") + wheel.stiffness * far * wheel.drift("twist");
  const int runs = 250000;
  for (int i = 0; i < runs; ++i) {
    wheel.run(30);
    if (i % 1000 == 0) REQUIRE(std::abs(energy() - before) <= swing + (i + 1) * added);
  }
  CHECK(energy() == Approx(before).epsilon(1e-3));
}

}  // namespace
}  // namespace feltgate::law
