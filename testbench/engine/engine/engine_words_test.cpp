// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// engine: no word of the host is lost without a flag, and no word arrives after the commit that it
// was written for. Documentation: docs/blocks/engine.md
#include "catch.hpp"
#include "engine_device.hpp"

using namespace feltgate;
using namespace feltgate::test;
using S = EngineMap::S;

namespace {

/// Writes a word in one clock and does not wait for the result.
void post(Device* device, int addr, std::uint32_t word) {
  device->in.addr = static_cast<unsigned>(addr);
  device->in.wdata = word;
  device->in.write = true;
  device->clock();
}

/// An image with parameter 0 from -1000 to 1000 and a run that never ends.
EngineMemory endless() {
  EngineMemory m;
  program(m, 0, {word(EngineOp::brf, 1, 0, 0)});
  m.set_data(EngineMap::D::lower, -1000);
  m.set_data(EngineMap::D::upper, 1000);
  return m;
}

}  // namespace

TEST_CASE("engine: words of a set that is being committed are dropped and told") {
  for (const bool commits : {false, true}) {
    LoadedDevice device(endless());
    device.write(H::run, 1);
    device.clock(5 * kTick);
    device.write(H::data + kParameter, 5);
    CHECK_FALSE(device.status(S::status_dropped));
    device.write(H::commit, 1);
    device.clock(100 * kTick);
    // The new set is in force, but the run continues with the set before.
    REQUIRE(device.status(S::status_bank));
    REQUIRE(device.status(S::status_committing));
    CHECK_FALSE(device.status(S::status_dropped));
    // A word outside the set is not dropped; a commit without words is not dropped either.
    device.write(H::data + kConstant + 3, 1);
    device.write(H::commit, 0);
    CHECK_FALSE(device.status(S::status_dropped));
    device.write(commits ? H::commit : H::data + kParameter, commits ? 1 : 8);
    CHECK(device.status(S::status_dropped));
    device.write(H::commit, 3);  // reported again
    CHECK(device.status(S::status_dropped));
    device.write(H::run, 0);
    CHECK_FALSE(device.status(S::status_committing));
    CHECK(device.status(S::status_bank));
    CHECK(device.status(S::status_dropped));
    CHECK(device.read(H::data + kParameter) == 0);  // the word of the idle set
    device.write(H::commit, 2);
    CHECK_FALSE(device.status(S::status_dropped));
    CHECK_FALSE(device.status(S::status_committing));
    device.write(H::data + kParameter, 8);
    device.write(H::commit, 1);
    device.clock(100 * kTick);
    CHECK_FALSE(device.status(S::status_bank));
    CHECK_FALSE(device.status(S::status_dropped));
    CHECK(device.read(H::data + kParameter) == 8);
    device.play();
  }
}

TEST_CASE("engine: a word that the lock refuses is told") {
  LoadedDevice device(endless());
  device.in.locked = true;
  device.write(H::data + kParameter, 5);
  CHECK_FALSE(device.status(S::status_dropped));
  for (const int address : {H::program + 3, H::table + 3, H::data + kConstant}) {
    const std::uint32_t before = device.read(address);
    device.write(address, before + 1);
    CHECK(device.status(S::status_dropped));
    CHECK(device.read(address) == before);
    device.write(H::commit, 2);
    CHECK_FALSE(device.status(S::status_dropped));
  }
  device.play();
}

TEST_CASE("engine: a parameter written in the clock before the commit is of that set") {
  for (const std::int32_t value : {-1001, 1001, 400}) {
    for (int phase = 0; phase < 6; ++phase) {
      LoadedDevice device(endless());
      device.clock(phase);
      device.write(H::data + kParameter, static_cast<std::uint32_t>(value));
      device.write(H::commit, 1);
      while (device.status(S::status_committing)) device.clock();
      INFO("value " << value << ", phase " << phase);
      CHECK(device.status(S::status_refused) == (value != 400));
      CHECK(device.status(S::status_bank) == (value == 400));
      device.play();
    }
  }
}

TEST_CASE("engine: a word that waits when a CRC is asked for is in it") {
  EngineMemory m;
  // Three endless threads leave few turns, and the inputs of the fourth thread use them.
  for (int t = 0; t < 3; ++t) {
    const int first = EngineMap::thread_words * t;
    program(m, t, {word(EngineOp::brf, 0, 0, first), word(EngineOp::brf, 1, 0, first)});
  }
  program(m, 3, {out(0, EngineOp::add, 63, 63)});
  m.line_base = EngineMap::table_words;
  EngineMemory changed = m;
  changed.set_program(0, m.program_at(0) ^ 4);
  int waited = 0;
  for (int phase = 0; phase < kTick; ++phase) {
    LoadedDevice device(m);
    device.write(H::high, static_cast<std::uint32_t>(changed.program_at(0) >> 32));
    device.write(H::crc, image_crc(changed));
    device.write(H::run, 15);
    device.clock(5 * kTick + phase);
    device.in.crc_start = true;
    const std::int64_t begun = device.clocks;
    post(&device, H::program, static_cast<std::uint32_t>(changed.program_at(0)));
    while (device.twin.memory().program_at(0) != changed.program_at(0)) device.clock();
    waited = std::max(waited, static_cast<int>(device.clocks - begun));
    while (!device.out().crc_done) device.clock();
    INFO("phase " << phase);
    CHECK(device.out().crc_good);
    if (phase % 10 == 5) device.play();
  }
  CHECK(waited > 20);
}
