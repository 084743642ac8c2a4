// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The twin of axes with their engine from event to event against its clocks, random programs and
// every shipped law: the same outputs at the end of every stretch and in every snapshot, the same
// memories, the same run behind every torque. Documentation: docs/architecture.md
#include <filesystem>
#include <memory>

#include "../../engine/machine/machine_programs.hpp"
#include "both.hpp"
#include "law/compile.hpp"
#include "mismatch.hpp"

using namespace feltgate;
using namespace feltgate::test;

namespace {

template <int N>
void random_programs(std::uint64_t seed, int programs) {
  Random random(seed);
  std::int64_t done = 0, whole = 0;
  for (int k = 0; k < programs; ++k) {
    auto b = std::make_unique<Both<N>>();
    const int length = 1 + static_cast<int>(random.below(random.coin() ? 8 : 30));
    const unsigned rounds = static_cast<unsigned>(length) * 6 / 50 + 1;
    const unsigned divider = random.one_in(4) ? random.below(6) : rounds + random.below(3);
    const unsigned run = random.one_in(6) ? random.below(16) : 1U << random.below(4);
    INFO("program " << k << ", length " << length << ", divider " << divider << ", run " << run);
    load<N>(*b, random_program(random, length), run, divider,
            random.one_in(4)   ? random.below(4)
            : random.one_in(2) ? 30
                               : 4000);
    live<N>(*b, random, 60, true);
    if (random.one_in(3)) {
      b->engine(H::mailbox_first, random.below(32));
      b->engine(H::mailbox_age, random.below(6));
    }
    b->arm(D::S::law);
    b->engine(H::commit, 1);
    b->in.reg_addr = 0;
    live<N>(*b, random, 150, false);
    live<N>(*b, random, 250, true);
    done += b->done;
    whole += b->whole;
  }
  INFO("clocks " << done << ", run by run " << whole);
  CHECK(whole > done / 10);
}

}  // namespace

TEST_CASE("axes by runs: a few random programs", "[few]") {
  random_programs<1>(1, 4);
  random_programs<2>(2, 1);
}

TEST_CASE(
    "axes by runs: starts that are late, long and short runs in turns, looked at in any clock",
    "[few]") {
  Random random(1);
  for (int k = 0; k < 14; ++k) {
    const int length = 9 + k / 2;
    const bool branches = k % 2 == 0;
    EngineMemory m;
    program(m, 0,
            {word(EngineOp::cmp, 0, kPosition, kConstant + 1),
             word(branches ? EngineOp::brf : EngineOp::add, 0, 0, length)});
    for (int n = 2; n < length; ++n) {
      m.set_program(n, engine_encode(to(n, EngineOp::add, n - 1, EngineMap::input_tick)));
    }
    m.set_program(length, engine_encode(out(0, EngineOp::add, kPosition, EngineMap::input_tick)));
    m.set_data(kConstant + 1, 1);
    Both<1> b;
    load<1>(b, m, 1, 1, length % 3 == 0 ? 1 : 4000);
    for (int n = 0; n < 400; ++n) {
      if (n % 130 == 0) b.arm(D::S::law);
      if (random.one_in(2)) b.step(0, (n & 1) != 0);
      b.run(1 + random.below(150));
      if (random.one_in(5)) b.memories();
    }
  }
}

TEST_CASE("axes by runs: each arming by the panel has a check of its own, and restarts", "[few]") {
  EngineMemory m;
  m.set_program(0, engine_encode(out(0, EngineOp::add, kPosition, kConstant)));
  Both<1> b;
  load<1>(b, m, 1, 1, 30);
  b.core(0, D::A::self_test_pulse, 0);
  b.core(0, C::command, 1U << C::command_clear_faults);
  b.in.reg_addr = 0;
  b.in.axis[0].scene = D::S::law;
  for (const int ticks : {1, 2, 20, 300}) {
    b.in.arm = true;
    b.run(2 * D::clocks_per_tick);
    CHECK_FALSE(b.by_clock.out().axis[0].armed);
    for (int k = 0; k < 1300 && !b.by_clock.out().axis[0].armed; ++k) b.run(D::clocks_per_tick);
    REQUIRE(b.by_clock.out().axis[0].armed);
    int restarts = 0;
    for (int k = 0; k < 6; ++k) {
      b.run(D::clocks_per_tick);
      restarts += b.by_clock.glue().restarted();
    }
    CHECK(restarts >= 2);
    CHECK(restarts <= 4);
    b.run(50 * D::clocks_per_tick);
    CHECK_FALSE(b.by_clock.glue().restarted());
    CHECK(b.by_event.glue().runs_whole());
    b.in.arm = false;
    b.run(ticks * D::clocks_per_tick);
  }
}

TEST_CASE("axes by runs: a mailbox that becomes too old while runs are passed as a whole",
          "[few]") {
  EngineMemory m;
  m.set_program(0, engine_encode(out(0, EngineOp::add, kConstant + 1, kConstant)));
  m.set_data(kConstant + 1, 1000);
  for (const int ticks : {1, 7, EngineMap::mailbox_step, 5 * EngineMap::mailbox_step}) {
    Both<1> b;
    load<1>(b, m, 1, 1, 30);
    b.engine(H::mailbox_first, 0);
    b.engine(H::mailbox_age, 3);
    b.arm(D::S::law);
    for (int n = 0; n < 3; ++n) {
      b.engine(H::commit, 1);
      b.in.reg_addr = 0;
      b.run(EngineMap::mailbox_step * D::clocks_per_tick);
      CHECK(b.by_clock.out().axis[0].tau_ref != 0);
      CHECK(b.by_event.glue().runs_whole());
      for (int k = 0; k < 5 * EngineMap::mailbox_step; k += ticks) {
        b.run(ticks * D::clocks_per_tick);
      }
      CHECK(b.by_clock.out().axis[0].tau_ref == 0);
      CHECK(b.by_clock.glue().watch().stale);
    }
  }
}

TEST_CASE("axes by runs: calm until a torque is too old", "[few]") {
  // Outputs end when the lever is moved; with a divider of 30 the age ends before the second.
  EngineMemory m;
  program(m, 0,
          {word(EngineOp::cmp, 0, kPosition, kConstant + 1), word(EngineOp::brf, 0, 0, 3),
           word(EngineOp::nop, 0, 0, 0, EngineTarget::none, 0, true),
           out(0, EngineOp::add, kPosition, kConstant)});
  m.set_data(kConstant + 1, 1);
  for (const unsigned divider : {1U, 30U}) {
    for (const unsigned max_age : {20U, 21U, 22U}) {
      Both<1> b;
      load<1>(b, m, 1, divider, max_age);
      b.arm(D::S::law);
      REQUIRE(b.by_clock.out().axis[0].armed);
      b.run(D::clocks_per_tick - b.by_clock.clock_of_tick());
      for (int k = 0; k < 15; ++k) b.run(D::clocks_per_tick);
      if (divider == 1) {
        CHECK(b.by_clock.out().axis[0].armed);
        CHECK(b.by_event.glue().runs_whole());
        for (int k = 0; k < 4; ++k) {
          b.step(0, true);
          b.run(D::clocks_per_tick);
        }
      }
      for (int k = 0; k < 40; ++k) b.run(D::clocks_per_tick);
      CHECK_FALSE(b.by_clock.out().axis[0].armed);
    }
  }
}

TEST_CASE("axes by runs: random programs, one axis, two and three") {
  random_programs<1>(3, static_cast<int>(scaled_clocks(6)));
  random_programs<2>(4, static_cast<int>(scaled_clocks(3)));
  random_programs<3>(5, static_cast<int>(scaled_clocks(3)));
}

TEST_CASE("axes by runs: every shipped law of one axis") {
  const law::Target target = law::target_of(design_info<D>());
  int laws = 0;
  for (const auto& entry : std::filesystem::directory_iterator(FELTGATE_SOURCE_DIR "/rtl/laws")) {
    if (entry.path().extension() != ".law") continue;
    const law::Compiled c = law::compile_file(entry.path().string(), target);
    if (c.image.outputs.size() != 1) continue;
    ++laws;
    INFO(entry.path().stem().string()
         << ", " << c.image.threads[0].length << " instructions, divider " << c.divider);
    const auto b = std::make_unique<Both<1>>();
    EngineMemory m;
    m.program = c.image.program;
    m.data = c.image.data;
    m.table = c.image.table;
    m.line_base = c.image.line_base;
    load<1>(*b, m, 1, static_cast<unsigned>(c.divider), 1000);
    b->arm(D::S::law);
    for (int word = 0; word < EngineMap::parameter_words; ++word) {
      const std::int32_t value = c.image.data[static_cast<std::size_t>(320 + word)];
      b->engine(EngineMap::D::parameter + word, static_cast<std::uint32_t>(value));
    }
    b->engine(H::commit, 1);
    REQUIRE(b->by_clock.out().axis[0].armed);
    b->in.reg_addr = 0;
    b->run(20 * D::clocks_per_tick);
    Random random(7);
    const std::int64_t done = b->done, whole = b->whole;
    live<1>(*b, random, 2000, false);
    // Run by run it goes from a start on: where runs are far apart that is late.
    const double share = c.divider < 50 ? 0.95 : 0.0;
    CHECK(static_cast<double>(b->whole - whole) > share * static_cast<double>(b->done - done));
    live<1>(*b, random, 150, true);
  }
  CHECK(laws >= 8);
}
