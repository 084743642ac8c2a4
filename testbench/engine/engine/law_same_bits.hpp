// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Runs a compiled law of three torques in the interpreter, in the engine's twin and in its RTL with
// three axes, with the same inputs. Documentation: docs/blocks/engine.md
#pragma once

#include <array>
#include <cstdint>

#include "catch.hpp"
#include "engine_device.hpp"
#include "law/compile.hpp"
#include "law/engine/machine.hpp"
#include "law/load.hpp"

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
