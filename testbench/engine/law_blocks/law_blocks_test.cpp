// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Wall and charge as laws beside the twin of the block, with the same coefficients, over every
// position. Torques are in the last bit of the torque format, 2^-16 Nm.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <map>
#include "catch.hpp"

#include "feltgate/axis/scene.hpp"
#include "feltgate/generated/lever.hpp"
#include "feltgate/largest.hpp"
#include "law/compile.hpp"
#include "law/engine/machine.hpp"
#include "law/load.hpp"

namespace feltgate::law {
namespace {

constexpr std::int32_t end = 131072;          // of the positions that laws are proven for
constexpr std::int64_t torque_end = 1 << 20;  // of the torque format, 16 Nm

/// A shipped law in the interpreter.
class Running {
 public:
  explicit Running(const std::string& name)
      : compiled_(
            compile_file(std::string(FELTGATE_ROOT) + "/rtl/laws/" + name + ".law", Target{})),
        machine_(memory(compiled_.image)) {}

  /// In SI; rounded to a word, which word() tells.
  void set(const std::map<std::string, double>& named) {
    std::vector<double> values;
    for (const ImageWord& w : compiled_.image.words) {
      if (w.formula.empty()) values.push_back(named.at(w.name));
    }
    words_ = parameter_words(compiled_.image, values);
    for (int bank = 0; bank < 2; ++bank) {
      for (int i = 0; i < 32; ++i) machine_.set_parameter(i, words_[static_cast<std::size_t>(i)]);
      machine_.commit();
    }
  }
  /// The value of a parameter as its word says it, SI.
  double value(const std::string& name) const {
    for (const ImageWord& w : compiled_.image.words) {
      if (w.name == name && w.formula.empty()) {
        return words_[static_cast<std::size_t>(w.word)] * w.scale;
      }
    }
    throw std::invalid_argument(name);
  }
  std::int64_t torque(std::int32_t position, std::int32_t velocity) {
    MachineInputs inputs{};
    inputs[0] = position;
    inputs[1] = velocity;
    const std::int64_t t = machine_.run(0, inputs).outputs[0];
    return std::clamp(t, -torque_end, torque_end - 1);
  }

 private:
  Compiled compiled_;
  Machine machine_;
  std::vector<std::int32_t> words_;
};

/// The block.
class Block {
 public:
  axis::Words<std::int64_t> words;

  std::int64_t torque(int scene, std::int32_t position, std::int64_t velocity) const {
    return law_.tick({}, words, true, scene, position, velocity, {}).torque;
  }

 private:
  axis::Scene<axis::Fixed> law_{axis::Design::of<Lever>()};
};
using P = Lever::P;

/// x in steps of 2^-fraction, which it is a whole number of.
std::int64_t exact(double x, int fraction) {
  const double words = std::ldexp(x, fraction);
  INFO(x << " in steps of 2^-" << fraction);
  REQUIRE(std::fabs(words - std::nearbyint(words)) < 1e-6 * std::max(1.0, std::fabs(words)));
  return std::llround(words);
}

double mnm(std::int64_t lsb) { return std::ldexp(1e3 * static_cast<double>(lsb), -16); }

std::int64_t in_torque_format(std::int64_t t) { return std::clamp(t, -torque_end, torque_end - 1); }

/// Say `what` on stdout where FELTGATE_SHOW is set: numbers of docs/laws.md.
void show(const std::string& what) {
  if (std::getenv("FELTGATE_SHOW") != nullptr) fmt::print("{}\n", what);
}

TEST_CASE("the wall as a law is within a last bit of the block, at every position") {
  const double count = Target{}.count_rad();
  Running law("wall");
  Block wall;
  std::int64_t worst = 0, pushing = 0, different = 0, all = 0;
  for (const auto& [contact, stiffness, damping] :
       {std::array<double, 3>{0.5, 4, 0.005}, {-3, 40, 0.1}, {9.99, 0.1, 0}, {0, 7.7, 0.03}}) {
    law.set({{"contact", contact}, {"stiffness", stiffness}, {"damping", damping}});
    wall.words.first = 256 * exact(law.value("contact") / count, 0);
    wall.words.stiffness = exact(law.value("stiffness") * count, P::wall_stiffness.fraction);
    wall.words.damping = exact(law.value("damping"), P::wall_damping.fraction);
    for (const double rad_s : {0.0, 3.7, -3.7, 200.0, -200.0}) {
      const auto raw = static_cast<std::int32_t>(std::ldexp(rad_s, Lever::f.velocity.fraction));
      for (std::int32_t position = -end; position <= end; ++position) {
        const std::int64_t block = in_torque_format(wall.torque(Map::S::wall, position, raw));
        const std::int64_t apart = std::abs(law.torque(position, raw) - block);
        worst = larger(worst, apart);
        pushing += block < 0 && block > -torque_end ? 1 : 0;
        different += apart > 0 ? 1 : 0;
        ++all;
      }
    }
  }
  show(
      fmt::format("wall: {} torques, {} of them differ, by {} LSB at most", all, different, worst));
  CHECK(worst <= 1);
  CHECK(pushing > 50000);
}

/// Largest difference to the block where the distance is up to `reach` counts, and beyond, LSB.
std::array<std::int64_t, 2> charges_apart(const std::string& name, double core_rad,
                                          std::int64_t reach) {
  const double count = Target{}.count_rad();
  Running law(name);
  std::array<std::int64_t, 2> worst{};
  for (const double centre : {0.0, 1.5339807878856412, -6.1359231515425647}) {  // whole counts
    for (const double peak : {0.45, -0.45, 0.1, 0.003}) {
      law.set({{"centre", centre}, {"core", core_rad}, {"peak", peak}});
      const double own = law.value("peak"), core = core_rad / count;
      const std::int64_t middle = std::llround(law.value("centre") / count);
      Block charge;
      charge.words.first = 256 * middle;
      charge.words.core = std::llround(core);
      charge.words.strength =
          std::llround(std::ldexp(std::fabs(own) * core * core, P::attract_strength.fraction));
      charge.words.slope =
          std::llround(std::ldexp(std::fabs(own) / core, P::attract_core_slope.fraction));
      const int scene = own > 0 ? Map::S::charge_attract : Map::S::charge_repel;
      for (std::int32_t position = -end; position <= end; ++position) {
        const std::int64_t block = charge.torque(scene, position, 0);
        const std::int64_t apart = std::abs(law.torque(position, 0) - block);
        std::int64_t& w = worst[std::abs(position - middle) <= reach ? 0 : 1];
        w = larger(w, apart);
      }
    }
  }
  show(fmt::format("{}: {} LSB ({:.3g} mNm) to {} counts, {} LSB ({:.3g} mNm) beyond", name,
                   worst[0], mnm(worst[0]), reach, worst[1], mnm(worst[1])));
  return worst;
}

TEST_CASE("the charge as a law is within 0.2 mNm of the block where it reaches") {
  // 15.5 cores of 128 counts; beyond, the law keeps the 1/15.5^2 of its peak that it has there.
  const auto worst = charges_apart("charge", 2 * pi / 32, 1984);
  CHECK(mnm(worst[0]) <= 0.2);
  CHECK(mnm(worst[1]) <= 0.45e3 / 15.5 / 15.5 + 0.2);
}

TEST_CASE("the far charge is within 0.2 mNm of the block at every position") {
  const auto worst = charges_apart("charge_far", 128 * Target{}.count_rad(), 8149);
  CHECK(mnm(worst[0]) <= 0.2);
  CHECK(mnm(worst[1]) <= 0.2);
}

}  // namespace
}  // namespace feltgate::law
