// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Laws of shapes and of fields of heights as words: proven, and the same bits in the interpreter,
// in the engine's twin and in its RTL. Documentation: docs/devices/shapes.md
#include <array>
#include <cstdint>

#include "catch.hpp"
#include "engine_device.hpp"
#include "law/compile.hpp"
#include "law/engine/machine.hpp"
#include "law/load.hpp"
#include "shape_case.hpp"
#include "studies/texture/texture_law.hpp"

namespace feltgate::test {

/// Checks torques and data words of every run; `counts(step)` are the positions. Returns the number
/// of runs whose first torque is not 0.
template <class Counts>
int same_bits(const law::Compiled& c, int steps, const Counts& counts) {
  const EngineMemory memory = law::memory(c.image);
  LoadedDevice device(memory);
  law::Machine machine(memory);
  for (const law::ImageWord& w : c.image.words) {
    machine.set_parameter(w.word, memory.data_at(EngineMap::D::parameter + w.word));
  }
  machine.commit();
  device.write(H::max_age, 400);
  device.write(H::divider0, 1);
  device.write(H::crc, image_crc(memory));
  device.in.crc_start = true;
  device.clock();
  while (device.out().busy) device.clock();
  CHECK(device.out().crc_good);
  device.write(H::commit, 1);
  device.clock(2000);
  device.in.armed = true;
  device.since = -1000;  // no tick before the first run
  device.write(H::run, 1);
  device.clock(60);  // until the threads have started
  machine.enter();
  int felt = 0, same = 0;
  for (int step = 0; step < steps; ++step) {
    device.in.position = counts(step);
    device.in.velocity = {1000 * (step % 7 - 3), 900 * (step % 5 - 2), 0};
    law::MachineInputs inputs{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      inputs[3 * axis] = device.in.position[axis];
      inputs[3 * axis + 1] = device.in.velocity[axis];
    }
    inputs[9] = static_cast<std::int32_t>(device.in.tick_count + 1);
    const law::MachineRun& run = machine.run(c.target.thread, inputs);
    REQUIRE(run.ended);
    // One tick, and no tick during the run.
    device.since = kTick - 1;
    device.clock();
    for (int k = 0; k < 6 * (run.instructions + 8); ++k) {
      device.since = 1;
      device.clock();
    }
    for (std::size_t axis = 0; axis < 3; ++axis) {
      same += run.outputs[axis] == device.out().torque[axis] ? 1 : 0;
    }
    felt += run.outputs[0] != 0 ? 1 : 0;
    // Only words that programs write: the host owns the bank of parameters that is not in force.
    for (int k = 0; k < EngineMap::D::parameter; ++k) {
      if (device.twin.memory().data_at(k) != machine.memory().data_at(k))
        FAIL("word " << k << " of step " << step);
    }
  }
  CHECK(same == 3 * steps);
  device.play();
  return felt;
}

}  // namespace feltgate::test

using namespace feltgate;
namespace law = feltgate::law;

namespace {

std::int32_t word(double value) { return static_cast<std::int32_t>(std::lround(value)); }

}  // namespace

TEST_CASE("the law of a shape is proven, within its bound, fits, and has the same bits in RTL") {
  // An engine of three axes needs three torques.
  const std::string third = "out torque[2] = 0.1 Nm * sin(position[2])\n";
  for (const int vertices : {20, 100}) {
    const auto fish = shape::sampled(shape::curve_of("fish", 2e-3), vertices);
    const law::Compiled c =
        law::compile_text(shape::law_text(fish, {"a fish"}) + third, "fish.law", law::Target{});
    CHECK(c.bound.unproven.empty());
    CHECK(c.rate_hz >= 40e3);
    // 30 mm deep at 200 N/m are 6 N along each axis: of 1.2 Nm the bound is some per cent.
    for (const double bound : c.bound.output) CHECK(bound < 0.02);
    // In and out of the shape, all around it.
    const int felt = test::same_bits(c, 400, [&](int step) {
      const double angle = 0.013 * step, away = 0.028 + 0.012 * std::sin(0.057 * step);
      const auto a = shape::cranks({away * std::cos(angle), 0.12 + away * std::sin(angle)});
      const double count = c.target.count_rad();
      return std::array<std::int32_t, 3>{word(a[0] / count), word(a[1] / count), 3 * step};
    });
    CHECK(felt > 30);
    CHECK(felt < 350);
  }
}

TEST_CASE("a field of heights has the same bits in RTL") {
  const auto valley =
      texture::read_png(std::string(FELTGATE_ROOT) + "/vectors/textures/valley.png");
  texture::LawRequest r{"a valley", 2e-3, 8e-3};
  for (const auto normals : {texture::Normals::interpolated, texture::Normals::facets}) {
    r.normals = normals;
    // All over the field and beyond it, from above to 5 mm below black, in counts of 15 um.
    const int felt = test::same_bits(
        law::compile_text(texture::field_law(valley, r), "valley.law", law::Target{}), 400,
        [](int step) {
          return std::array<std::int32_t, 3>{word(1200 * std::sin(0.31 * step)),
                                             word(1200 * std::sin(0.17 * step + 1)),
                                             word(200 + 500 * std::sin(0.057 * step))};
        });
    // Sideways only on the walls, which are half of the field, and in it.
    CHECK(felt > 60);
    CHECK(felt < 300);
  }
}
