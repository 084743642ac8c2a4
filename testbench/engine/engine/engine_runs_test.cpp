// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// engine: programs written by hand and random programs, run by run: RTL and twin give the same
// results as the interpreter. Documentation: docs/blocks/engine.md
#include <memory>

#include "catch.hpp"
#include "engine_device.hpp"
#include "law/engine/machine.hpp"
#include "random_programs.hpp"

using namespace feltgate;
using namespace feltgate::test;
using law::Machine;
using law::MachineInputs;

namespace {

/// Loads an image over the host's port and runs it at every tick with random inputs, in lock-step.
void run_in_lock_step(EngineMemory m, std::uint64_t seed, std::int64_t clocks,
                      bool commits = false) {
  m.line_base = 200;
  Host host;
  host.load(m);
  host.write(H::max_age, 100);
  host.write(H::crc, image_crc(m));
  host.write(H::run, 15);
  Random random(seed);
  Twin::In in;
  int since = 0;
  const auto fresh = std::make_shared<int>(0);
  const auto good = std::make_shared<bool>(false);
  Bench bench("engine", seed);
  bench.run(
      [=](std::int64_t clock, const Twin::Out& out) mutable {
        in.tick = ++since == kTick;
        if (in.tick) {
          since = 0;
          ++in.tick_count;
          for (std::size_t n = 0; n < AXES; ++n) {
            in.position[n] = static_cast<std::int32_t>(random.between(-3000, 3000));
            in.velocity[n] = static_cast<std::int32_t>(random.between(-30000000, 30000000));
          }
        }
        in.crc_start = host.queue.size() == 1 && !out.busy;
        if (commits && host.queue.empty() && random.one_in(40)) {
          host.write(H::data + kParameter, static_cast<std::uint32_t>(random.between(-900, 900)));
          host.write(H::commit, 1);
        }
        if (clock > 8) host.drive(in, out);  // after the reset
        if (out.fresh) ++*fresh;
        if (out.crc_good) *good = true;
        return in;
      },
      clocks);
  if (AXES == 1) CHECK(*fresh > 20);
  CHECK(*good);
}

}  // namespace

TEST_CASE("engine: detent, wall, membrane and charge, RTL against twin") {
  std::uint64_t seed = 100;
  for (const auto& m :
       {image(detent, {24 * 512, 3277}), image(wall, {100, 20000, -60000}),
        image(membrane, {-1000, 1000, -700, 700}), image(charge, {50, 3000, 700})}) {
    run_in_lock_step(m, ++seed, 55'000);
  }
}

TEST_CASE("engine: every instruction over corners, RTL against twin") {
  for (std::uint64_t seed = 400; seed < 410; ++seed) {
    Random random(seed);
    run_in_lock_step(random_arithmetic(random), seed, 45'000);
  }
}

TEST_CASE("engine: no thread writes its inputs, or words of another, RTL against twin") {
  EngineMemory m;
  m.set_data(kConstant + 1, 4711);
  for (int thread = 0; thread < 4; ++thread) {
    std::vector<EngineInstruction> list;
    for (int n = 48; n < 64; ++n) list.push_back(to(n, EngineOp::add, kConstant + 1, kConstant));
    for (int n = 256; n < 512; n += 5)
      list.push_back(to(n, EngineOp::add, kConstant + 1, kPosition));
    list.push_back(to(64 * (3 - thread) + 1, EngineOp::add, kConstant + 1, 1));
    list.push_back(word(EngineOp::add, 0, 0, kConstant));
    for (const int n : {48, 51, 56, 58, 63, 256, 271, 276, 286, 291, 301, 306, 1}) {
      list.push_back(to(0, EngineOp::add, n, kConstant, 3));
    }
    list.push_back(out(0, EngineOp::add, 0, kConstant));
    int n = thread * EngineMap::thread_words;
    for (const EngineInstruction& i : list) m.set_program(n++, engine_encode(i));
  }
  run_in_lock_step(m, 200, 80'000);
}

TEST_CASE("engine: a run keeps the parameters that it began with, RTL against twin") {
  EngineMemory m;
  m.set_data(EngineMap::D::lower, -1000);
  m.set_data(EngineMap::D::upper, 1000);
  std::vector<EngineInstruction> list(110, word(EngineOp::nop, 0, 0, 0));
  list.front() = to(0, EngineOp::add, kParameter, kConstant);
  list.push_back(to(1, EngineOp::sub, 0, kParameter));
  list.push_back(to(1, EngineOp::mul, 1, kConstant + 1));
  list.push_back(out(0, EngineOp::add, 1, kParameter));
  m.set_data(kConstant + 1, 1000);
  int n = 0;
  for (const EngineInstruction& i : list) m.set_program(n++, engine_encode(i));
  run_in_lock_step(m, 300, 120'000, true);
}

TEST_CASE("engine: every run of every thread is what the interpreter gives") {
  std::int64_t runs = 0, events = 0, outputs = 0, long_runs = 0;
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    for (int thread = 0; thread < 4; ++thread) {
      Random random(seed * 7 + static_cast<std::uint64_t>(thread));
      const EngineMemory m = random_memory(random);
      Device device(m);
      Machine machine(m);
      device.write(H::line_base, static_cast<std::uint32_t>(m.line_base));
      device.write(H::divider0 + thread, 1);
      device.since = -1000;  // no tick while the lines are cleared
      device.write(H::run, 1U << thread);
      machine.enter();
      for (int k = 0; k < 12; ++k) {
        while (!device.in.tick) device.clock();
        MachineInputs inputs{};
        for (std::size_t n = 0; n < AXES; ++n) {
          inputs[3 * n] = device.in.position[n] = corner(random);
          inputs[3 * n + 1] = device.in.velocity[n] = corner(random);
          inputs[3 * n + 2] = device.in.tau_hat[n] = corner(random);
        }
        // A run uses the inputs from the clock of its tick on; here they change just after a tick.
        device.since = kTick - 1;
        inputs[9] = static_cast<std::int32_t>(device.in.tick_count + 1);
        const auto& run = machine.run(thread, inputs, 300);
        if (!run.ended) break;
        std::size_t seen = 0;
        device.clock();
        for (int c = 0; c < 6 * (run.instructions + 8); ++c) {
          if (device.out().event_valid) {
            REQUIRE(seen < run.events.size());
            REQUIRE(device.out().event_number == run.events[seen].number);
            REQUIRE(device.out().event_value == run.events[seen].value);
            ++seen;
          }
          device.since = 1;  // no tick during a run
          device.clock();
        }
        REQUIRE(seen == run.events.size());
        for (int n = 0; n < AXES; ++n) {
          if ((run.written >> n & 1U) == 0) continue;
          const std::int32_t top = (1 << 20) - 1;
          const auto at = static_cast<std::size_t>(n);
          REQUIRE(device.out().torque[at] == std::clamp(run.outputs[at], -top - 1, top));
          ++outputs;
        }
        REQUIRE(device.twin.memory().data == machine.memory().data);
        REQUIRE(device.twin.memory().table == machine.memory().table);
        events += static_cast<std::int64_t>(seen);
        long_runs += run.instructions > 20;
        ++runs;
        device.in.tick = true;
      }
    }
  }
  CAPTURE(runs, events, outputs, long_runs);
  CHECK(runs > 1000);
  CHECK(events > 100);
  CHECK(outputs > 500);
  CHECK(long_runs > 20);
}
