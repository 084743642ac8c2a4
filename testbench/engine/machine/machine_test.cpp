// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The engine's instructions against plain 128-bit arithmetic, and hand-written programs in the
// interpreter against their laws in double. Documentation: docs/blocks/engine.md
#include "law/engine/machine.hpp"

#include <algorithm>
#include <cmath>

#include "catch.hpp"
#include "machine_programs.hpp"
#include "random.hpp"

using namespace feltgate;
using namespace feltgate::test;
using law::Machine;
using law::MachineInputs;

namespace {

__extension__ using Wide = __int128;

/// Numbers at the corners of every width that matters, and random ones of every size.
std::int32_t corner(Random& random) {
  static const std::int64_t corners[] = {0,      1,       2,       0x7ff,   0x800,   0xfff,  0x1000,
                                         0xffff, 0x10000, 0x1ffff, 0x20000, 0x3ffff, 0x40000};
  switch (random.below(4)) {
    case 0: {
      const auto n = static_cast<std::int64_t>(corners[random.below(13)]);
      return static_cast<std::int32_t>(random.one_in(2) ? n : -n);
    }
    case 1:
      return random.one_in(2) ? INT32_MAX - static_cast<int>(random.below(3))
                              : INT32_MIN + static_cast<int>(random.below(3));
    default:
      return static_cast<std::int32_t>(static_cast<std::uint32_t>(random.below(0xffffffffU))) >>
             random.below(32);
  }
}

Wide power(int s) { return Wide{1} << s; }
Wide floor_div(Wide v, Wide by) {
  const Wide q = v / by;
  return q * by > v ? q - 1 : q;
}
Wide modulo(Wide v, Wide by) { return v - floor_div(v, by) * by; }
Wide centred(Wide v, int bits) {
  return modulo(v + power(bits - 1), power(bits)) - power(bits - 1);
}
Wide clamped(Wide v) { return std::clamp(v, -power(31), power(31) - 1); }

/// The result by the documentation, in plain arithmetic.
Wide expected(EngineOp op, int mode, Wide acc, bool flag, Wide x, Wide y, Wide t) {
  static const int shifts[] = {0, 12, 17, 27};
  const int s = shifts[mode];
  const Wide product = x * centred(y, 18);
  const Wide half = s == 0 ? 0 : power(s - 1);
  const Wide rounded = floor_div(product + half, power(s));
  switch (op) {
    case EngineOp::add: {
      const Wide v = mode >= 2 ? acc + x : x + y;
      return mode % 2 != 0 ? centred(v, 32) : clamped(v);
    }
    case EngineOp::sub:
      if (mode == 2) return clamped(acc - x);
      return mode == 0 ? clamped(x - y) : centred(x - y, 32);
    case EngineOp::mul:
      return clamped(rounded);
    case EngineOp::mac:
      return clamped(acc + rounded);
    case EngineOp::mlw:
      return centred(floor_div(product, power(s)), 32);
    case EngineOp::min:
      return std::min(x, y);
    case EngineOp::max:
      return std::max(x, y);
    case EngineOp::sel:
      return flag ? x : y;
    case EngineOp::cmp:
      if (mode == 0) return x < y;
      if (mode == 1) return flag || x < y;
      if (mode == 2) return flag && x < y;
      return x >= y;
    case EngineOp::lrp: {
      const Wide value = centred(t, 20), slope = centred(floor_div(t, power(20)), 16);
      return value + floor_div(slope * modulo(x, 4096) + 2048, 4096);
    }
    case EngineOp::tab:
      return centred(t, 32);
    case EngineOp::frc:
      return modulo(x, 4096);
    case EngineOp::abs:
      return x < 0 ? clamped(-y) : y;
    case EngineOp::nop:
      return 0;
    default:
      return acc;
  }
}

MachineInputs at(std::int32_t position, std::int32_t velocity = 0) { return {position, velocity}; }

}  // namespace

TEST_CASE("machine: every instruction is what plain arithmetic gives") {
  Random random(1);
  int saturated = 0, both = 0;
  for (int k = 0; k < 400'000; ++k) {
    const auto op = static_cast<EngineOp>(random.below(16));
    const int mode = static_cast<int>(random.below(4));
    const std::int32_t x = corner(random), y = corner(random);
    const EngineState before{corner(random), random.one_in(2)};
    const std::uint64_t t =
        static_cast<std::uint64_t>(random.below(0xffffffffU)) << 4 ^ random.below(0xffff);
    const EngineState after = engine_step(op, mode, before, x, y, t);
    const Wide right = expected(op, mode, before.acc, before.flag, x, y, static_cast<Wide>(t));
    INFO("op " << static_cast<int>(op) << " mode " << mode << " x " << x << " y " << y);
    REQUIRE(after.acc == static_cast<std::int32_t>(right));
    REQUIRE(after.flag == (op == EngineOp::cmp ? right != 0 : before.flag));
    saturated += after.acc == INT32_MAX || after.acc == INT32_MIN;
    both += op == EngineOp::mac && after.acc == INT32_MIN;
  }
  CHECK(saturated > 4000);
  CHECK(both > 100);
}

TEST_CASE("machine: a program word is taken apart and put together") {
  Random random(2);
  for (int k = 0; k < 20'000; ++k) {
    const std::uint64_t w =
        (static_cast<std::uint64_t>(random.below(0xffffffffU)) << 4 | random.below(16));
    REQUIRE(engine_encode(engine_decode(w)) == w);
  }
}

TEST_CASE(
    "machine: an instruction of which nothing is said is a nop, a state of which nothing is 0") {
  const EngineInstruction i;
  CHECK(engine_encode(i) == static_cast<std::uint64_t>(EngineOp::nop) << EngineMap::B::op);
  CHECK(EngineState{}.acc == 0);
  CHECK_FALSE(EngineState{}.flag);
}

TEST_CASE("machine: a table word has its value and its slope, and nothing above") {
  Random random(3);
  for (int k = 0; k < 20'000; ++k) {
    const auto value = static_cast<std::int32_t>(centred(corner(random), 20));
    const auto slope = static_cast<std::int32_t>(centred(corner(random), 16));
    const std::uint64_t w = engine_table_word(value, slope);
    REQUIRE(engine_table_value(w) == value);
    REQUIRE(engine_table_slope(w) == slope);
    REQUIRE(w >> 36 == 0);
  }
}

TEST_CASE("machine: addresses reach the words of the thread, and write no others") {
  for (int thread = 0; thread < 4; ++thread) {
    for (int n = 0; n < 512; ++n) {
      const int to = engine_write_address(n, thread);
      const bool own = to >= 64 * thread && to < 64 * thread + 48;
      const bool exchange = to >= 256 + 16 * thread && to < 272 + 16 * thread;
      REQUIRE((to == -1 || own || exchange));
      if (to >= 0) REQUIRE(engine_read_address(n, thread, 0) == to);
      for (const int bank : {0, 1}) {
        const int from = engine_read_address(n, thread, bank);
        if (n < 256) REQUIRE(from == 64 * thread + n % 64);
        if (n >= 320 && n < 384) REQUIRE(from == 320 + 32 * bank + n % 32);
        if (n >= 384 || (n >= 256 && n < 320)) REQUIRE(from == n);
      }
    }
  }
}

TEST_CASE("machine: detent, in every thread") {
  for (int thread = 0; thread < 4; ++thread) {
    EngineMemory m;
    detent(m, thread);
    m.set_data(kParameter, 24 * 512);
    m.set_data(kParameter + 1, 3277);
    Machine machine(m);
    for (int position = -5000; position <= 5000; position += 7) {
      const auto& run = machine.run(thread, at(position));
      REQUIRE(run.ended);
      REQUIRE(run.instructions == 5);
      REQUIRE(run.written == 1);
      const double right = 3277 * std::sin(2 * M_PI * 24 * position / 4096.0);
      REQUIRE(std::abs(run.outputs[0] - right) < 6);
    }
  }
}

TEST_CASE("machine: wall, charge and membrane") {
  EngineMemory m;
  wall(m, 0);
  charge(m, 1);
  membrane(m, 2);
  for (const auto& [word, value] :
       {std::pair{0, 100}, std::pair{1, 20000}, std::pair{2, -60000}, std::pair{3, 500}}) {
    m.set_data(kParameter + word, value);
  }
  Machine machine(m);
  for (int p = -300; p <= 300; ++p) {
    const double spring = std::min(0.0, (100 - p) * 20000 / 4096.0);
    REQUIRE(std::abs(machine.run(0, at(p)).outputs[0] - (p > 100 ? spring : 0)) <= 1);
  }
  machine.memory().set_data(kParameter + 1, 520);  // far
  machine.memory().set_data(kParameter + 2, 1000 * 4096 / 1000);
  for (int p = -400; p <= 400; ++p) {
    const int left = machine.run(1, at(100 - p)).outputs[0];
    REQUIRE(left == -machine.run(1, at(100 + p)).outputs[0]);
  }
  // Between lower = 0 and upper = 200 the torque is that of the side that it came from, beyond 0.
  machine.memory().set_data(kParameter, 0);
  machine.memory().set_data(kParameter + 1, 200);
  machine.memory().set_data(kParameter + 2, -7);
  for (const auto& [p, torque] : {std::pair{100, 500}, std::pair{-1, 0}, std::pair{100, -7},
                                  std::pair{201, 0}, std::pair{100, 500}}) {
    REQUIRE(machine.run(2, at(p)).outputs[0] == torque);
  }
}

TEST_CASE("machine: the first run has a flag, parameters change with a commit, events are kept") {
  EngineMemory m;
  m.set_data(kConstant + 1, 77);
  program(m, 3,
          {to(4, EngineOp::sel, kConstant + 1, 4),
           word(EngineOp::add, 0, 4, kParameter, EngineTarget::event, 300),
           word(EngineOp::brf, 1, 0, 388), to(4, EngineOp::add, 4, kParameter),
           out(2, EngineOp::nop, 0, 0)});
  Machine machine(m);
  REQUIRE(machine.run(3, {}).instructions == 5);
  machine.set_parameter(0, 5);
  for (const int value : {77, 82, 82}) {
    const auto& run = machine.run(3, {});
    REQUIRE(run.events.size() == 1);
    REQUIRE(run.events[0].number == 300);
    REQUIRE(run.events[0].value == value);
    if (value == 77) machine.commit();
  }
  REQUIRE(machine.bank() == 1);
  machine.enter();
  REQUIRE(machine.run(3, {}).instructions == 5);
  REQUIRE(machine.memory().data_at(3 * 64 + 4) == 82);
}

TEST_CASE("machine: lines are written, the rest of the table is not; a loop is given up") {
  EngineMemory m;
  m.line_base = 500;
  m.set_data(kConstant + 1, 1234);
  m.set_data(kConstant + 2, 12 << 12);
  program(
      m, 0,
      {word(EngineOp::add, 0, kConstant + 1, kConstant), word(EngineOp::tst, 0, kConstant + 2, 488),
       word(EngineOp::tst, 0, kConstant, 499), word(EngineOp::brf, 1, 0, 3)});
  Machine machine(m);
  machine.run(0, {}, 50);
  REQUIRE_FALSE(machine.run(0, {}, 50).ended);
  REQUIRE(machine.run(0, {}, 50).instructions == 50);
  REQUIRE(machine.memory().table_at(500) == 1234);
  REQUIRE(machine.memory().table_at(499) == 0);
}
